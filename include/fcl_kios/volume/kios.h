// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <fcl/common/types.h>

namespace kios {

/// Intersection of k spheres (k = 1, 3 or 5), each of which contains the whole content: a k-IOS.
/// Source: Zhang & Kim, "k-IOS: Intersection of Spheres for Efficient Proximity Query", III.
///
/// Sphere 0 (S0) is the central sphere; spheres 1, 2 and 3, 4 are pairs of larger "caps" that cut
/// S0 off along the smallest and the middle axis of the content. Units and frame are the model's.
/// In section, along the smallest axis:
/// @verbatim
///             .-"""""""-.            S0
///    ______.-'___________'-.______   part of sphere 2, whose centre lies far below
///        .'    #########    '.
///        |  ###############  |       the content lies in all spheres
///        '.    #########    .'
///    ------'-.-----------.-'------   part of sphere 1, whose centre lies far above
///             '-._____.-'
/// @endverbatim
///
/// Every sphere contains the content in exact arithmetic: its radius is measured from the centre
/// as stored and rounded outwards. Every bound that is derived from it is conservative in floating
/// point for coordinates up to 2^1000 (double) or 2^120 (float); none is ever NaN.
///
/// A default-constructed kIOS is empty: it contains nothing, overlaps nothing, is infinitely far
/// from everything, and is the neutral element of +.
template <typename S_>
class kIOS {
 public:
  using S = S_;
  // Static members would be unique symbols, which keep dlclose() from unloading the library.
  enum : int { kMaxSpheres = 5, kCaps = 4 };

  /// Tests a pair in one frame: paper, IV-A (Algorithm 1) and IV-B (Algorithm 2).
  bool overlap(const kIOS& other) const;
  /// Tests a pair as overlap(other) does. `overlap_part` is not written: the intersection of two
  /// k-IOS is not one.
  bool overlap(const kIOS& other, kIOS& overlap_part) const;
  /// Returns a lower bound of the distance of the contents. It is 0 when the volumes may overlap,
  /// the largest finite S when one is empty. P and Q, if given, are the points of the sphere pair
  /// that attains the bound (on this and on `other`, common frame); both are one point between the
  /// volumes when the bound is 0, and unchanged when a volume is empty.
  S distance(const kIOS& other, fcl::Vector3<S>* P = nullptr, fcl::Vector3<S>* Q = nullptr) const;

  /// Returns true if no sphere excludes p; never false for a point of the content.
  bool contain(const fcl::Vector3<S>& p) const;

  /// Grows the volume, if need be, so that it contains p as well. Throws std::invalid_argument if a
  /// coordinate is NaN, infinite, or above 2^1000 (double) or 2^120 (float) in magnitude.
  kIOS& operator+=(const fcl::Vector3<S>& p);
  kIOS& operator+=(const kIOS& other) { return *this = *this + other; }
  /// Encloses both contents. a + b and b + a are bitwise equal.
  kIOS operator+(const kIOS& other) const;

  /// Returns the centre of S0.
  const fcl::Vector3<S>& center() const { return center0; }
  /// Extents along x, y and z of the box around the intersection; they bound the content.
  S width() const { return extent(0); }
  S height() const { return extent(1); }
  S depth() const { return extent(2); }
  /// Returns an upper bound of the volume: the smaller of the volumes of S0 and of the box of
  /// extents.
  S volume() const;
  /// Returns the squared diameter of S0, a squared length as AABB::size(); saturates at the largest
  /// finite S.
  S size() const;

  /// Corners of the axis-aligned box around the intersection, rounded outwards.
  void bounds(fcl::Vector3<S>& lower, fcl::Vector3<S>& upper) const;

  /// Returns the number of spheres: 0 (empty), 1, 3 or 5.
  int k() const { return num_spheres; }
  /// Returns sphere i of k: centre and radius rounded to S, outwards.
  fcl::Vector3<S> sphereCenter(int i) const;
  S sphereRadius(int i) const;

  // The representation: public as in FCL's own volumes, written by the fit and by merges only.
  // Caps are floats relative to center0 in units of 2^exponent. Caps that k does not count repeat
  // S0, so that all four may always be tested.
  fcl::Vector3<S> center0 = fcl::Vector3<S>::Zero();
  S radius0 = S(0);
  float cap_x[kCaps] = {};
  float cap_y[kCaps] = {};
  float cap_z[kCaps] = {};
  float cap_r[kCaps] = {};
  float reach = 0;            ///< >= |offset| + radius of every sphere, units of 2^exponent.
  std::int16_t exponent = 0;  ///< 0 for radii in about [2^-30, 2^30].
  std::uint8_t num_spheres = 0;

 private:
  S extent(int axis) const;
};

using kIOSd = kIOS<double>;
using kIOSf = kIOS<float>;

/// Returns the volume moved by t; its spheres grow by the rounding error of the moved centre.
template <typename S>
kIOS<S> translate(const kIOS<S>& bv, const fcl::Vector3<S>& t);

extern template class kIOS<double>;
extern template class kIOS<float>;

}  // namespace kios

#include "fcl_kios/volume/specialisations.h"
