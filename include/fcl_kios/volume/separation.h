// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume/kios.h"
#include "fcl_kios/volume/rigid.h"

namespace kios {

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

}  // namespace kios
