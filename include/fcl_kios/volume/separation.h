// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume/kios.h"
#include "fcl_kios/volume/rigid.h"

namespace kios {

/// Pose of frame B in frame A, x_A = R x_B + T, with what the bounds need of it precomputed.
template <typename S>
struct RelativePose {
  /// Throws std::invalid_argument if the pose is not finite or not rigid: the Frobenius norm of
  /// R^T R - I may be at most 1e-4 (double) or 1e-3 (float), and a reflection is not rigid.
  RelativePose(const fcl::Matrix3<S>& R_AB, const fcl::Vector3<S>& T_AB);
  /// The pose x -> R1^T (R2 x + (t2 - t1)) of every query, for X_W1 and X_W2 in a common frame W,
  /// each of which must be rigid. A coordinate of a point is off by at most
  /// 3.5 eps (|R1|^T |R2| |x|) + 2.5 eps (|R1|^T |t2 - t1|), absolute values by entry, so by 4 eps
  /// (|x|_1 + |t2 - t1|) with room for R1 and R2 that aren't quite orthonormal.
  RelativePose(const fcl::Transform3<S>& X_W1, const fcl::Transform3<S>& X_W2);
  /// The same for rotations that were checked: `squared_errors` is at least the sum of the squares
  /// of their errors, |R^T R - I| each (Frobenius).
  RelativePose(const fcl::Transform3<S>& X_W1, const fcl::Transform3<S>& X_W2,
               double squared_errors);

  /// A point of B in A.
  fcl::Vector3<S> operator*(const fcl::Vector3<S>& x_B) const {
    return detail::rotate<S>(R, x_B) + T;
  }

  fcl::Matrix3<S> R;  ///< as given, or R1^T R2
  fcl::Vector3<S> T;  ///< origin of B in A
  float Rf[3][3];     ///< R rounded to float.
  double T_norm1;     ///< |T|_1.
  double stretch;     ///< |R|_2 - 1 <= stretch.

 private:
  void precompute(double squared_errors);
};
using RelativePosed = RelativePose<double>;
using RelativePosef = RelativePose<float>;

/// Signed lower bound of the distance between the contents of a (in frame A) and of b (in frame
/// B): > 0 proves them apart. It also covers the rounding of b's points on their way to frame A.
/// Once the bound of the central spheres exceeds `enough`, that is returned. An empty volume gives
/// +infinity. Source: paper, Algorithm 2, kept signed so that deeper overlap orders first.
template <typename S>
double separation(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<S>& X_AB, double enough);

/// FCL's forms of the tests, found by argument-dependent lookup: b sits at (R, T) in a's frame,
/// P and Q are in a's frame. As kIOS::overlap and kIOS::distance otherwise.
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
