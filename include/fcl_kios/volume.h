// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <fcl/common/types.h>
#include "fcl_kios/detail/rigid.h"

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

template <typename S>
class RelativePose;

namespace detail {

/// Parts of a pose that bounds need.
struct PoseBounds {
  float R[3][3];   ///< rounded to float
  double T_norm1;  ///< |T|_1
  double stretch;  ///< |R|_2 - 1 <= stretch
};
template <typename S>
const PoseBounds& boundsOf(const RelativePose<S>& X_AB);

}  // namespace detail

/// Pose of frame B in frame A, x_A = R x_B + T, with bounds of its errors.
template <typename S>
class RelativePose {
 public:
  /// Throws std::invalid_argument if the pose is not finite or not rigid: the Frobenius norm of
  /// R^T R - I may be at most 1e-4 (double) or 1e-3 (float), and a reflection is not rigid.
  RelativePose(const fcl::Matrix3<S>& R_AB, const fcl::Vector3<S>& T_AB);
  /// Computes the relative pose of every query, for rigid poses in a common frame W: x -> R_WA^T
  /// (R_WB x + (t_WB - t_WA)); R = I for equal rotations that are ones but for rounding. A
  /// coordinate of a point is off by at most 3.5 eps (|R_WA|^T |R_WB| |x|) + 2.5 eps (|R_WA|^T
  /// |t_WB - t_WA|), absolute values by entry, so by 4 eps (|x|_1 + |t_WB - t_WA|) with room for
  /// rotations that aren't quite orthonormal. Poses in float may be taken in double, as they are.
  template <typename P>
  RelativePose(const fcl::Transform3<P>& X_WA, const fcl::Transform3<P>& X_WB);
  /// Takes rotations that were checked: `squared_errors` is at least the sum of the squares
  /// of their errors, |R^T R - I| each (Frobenius).
  template <typename P>
  RelativePose(const fcl::Transform3<P>& X_WA, const fcl::Transform3<P>& X_WB,
               double squared_errors);

  /// Maps a point of B to A.
  fcl::Vector3<S> operator*(const fcl::Vector3<S>& x_B) const {
    return detail::rotate<S>(R_, x_B) + T_;
  }
  /// Returns the rotation as given, or R_WA^T R_WB.
  const fcl::Matrix3<S>& R() const { return R_; }
  /// Returns the origin of B in A.
  const fcl::Vector3<S>& T() const { return T_; }

 private:
  friend const detail::PoseBounds& detail::boundsOf<S>(const RelativePose& X_AB);
  void computeBounds(double squared_errors);

  fcl::Matrix3<S> R_;
  fcl::Vector3<S> T_;
  detail::PoseBounds bounds_;
};
using RelativePosed = RelativePose<double>;
using RelativePosef = RelativePose<float>;

namespace detail {
template <typename S>
const PoseBounds& boundsOf(const RelativePose<S>& X_AB) {
  return X_AB.bounds_;
}
}  // namespace detail

/// Returns a signed lower bound of the distance between the contents of a, in A, and b, in B: > 0
/// proves them apart. It also covers the rounding of b's points on their way to frame A. Once the
/// bound of the central spheres exceeds `enough`, that is returned. An empty volume gives
/// +infinity. Source: paper, Algorithm 2, kept signed so that deeper overlap orders first.
template <typename S, typename P>
double separation(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<P>& X_AB, double enough);

/// FCL's forms of the tests, found by argument-dependent lookup: b sits at (R, T) in a's frame, P
/// and Q are in a's frame. As kIOS::overlap and kIOS::distance otherwise.
template <typename S>
bool overlap(const fcl::Matrix3<S>& R, const fcl::Vector3<S>& T, const kIOS<S>& a,
             const kIOS<S>& b);
template <typename S>
bool overlap(const fcl::Transform3<S>& X_AB, const kIOS<S>& a, const kIOS<S>& b);
template <typename S>
S distance(const fcl::Matrix3<S>& R, const fcl::Vector3<S>& T, const kIOS<S>& a, const kIOS<S>& b,
           fcl::Vector3<S>* P = nullptr, fcl::Vector3<S>* Q = nullptr);
template <typename S>
S distance(const fcl::Transform3<S>& X_AB, const kIOS<S>& a, const kIOS<S>& b,
           fcl::Vector3<S>* P = nullptr, fcl::Vector3<S>* Q = nullptr);

/// Fits a kIOS to n points, in the form that FCL finds by argument-dependent lookup. S0 is nearly
/// minimal; each cap is centred in its plane and has its own radius. n = 0 gives the empty volume.
/// Throws std::invalid_argument if a coordinate is NaN, infinite, or above 2^1000 (double) or 2^120
/// (float) in magnitude. The published fits are in fcl_kios/paper.h.
template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv);

}  // namespace kios

#include "fcl_kios/detail/specialisations.h"
