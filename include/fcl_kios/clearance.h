// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "fcl_kios/model.h"
#include "fcl_kios/volume.h"

namespace kios {

/// Distance of two k-IOS as volumes: not a bound of it by sphere pairs, as separation() is. Numbers
/// are double for both scalars. Source: paper, III-D (properties 1 to 5) and VI.
struct ExactDistance {
  /// Proven lower bound of the distance of the contents: 0 when the volumes meet, +infinity when
  /// one is empty. Never below separation().
  double distance = 0;
  /// The volumes' true distance is within [distance, distance + error]. In double that is 1e-12 of
  /// the pair's size (reaches of the caps and all) plus 200 roundings of its coordinates; in float
  /// those roundings, of 2^-24, are the larger part. 1e-6 where two spheres of a volume touch from
  /// outside, so that it depends on their radii by a square root; 1e-3 where four do.
  double error = 0;
  /// Nearest points of a and of b in frame A: unique while the volumes are apart; when they meet, a
  /// point of each, `error` apart. On the volumes to the same accuracy.
  fcl::Vector3d p = fcl::Vector3d::Zero();
  fcl::Vector3d q = fcl::Vector3d::Zero();
  /// Unit vector from a to b in frame A: the derivative by B's translation in A (T of X_AB). When
  /// distance = 0 there is no derivative: normal and moment are zero.
  fcl::Vector3d normal = fcl::Vector3d::Zero();
  /// Moment of the normal, (q - T) x normal: the derivative by a rotation vector w in frame A that
  /// turns B about its own origin, R -> exp([w]) R. About a point c of frame A instead: (q - c) x
  /// normal.
  fcl::Vector3d moment = fcl::Vector3d::Zero();

  /// Returns true if the volumes are proven to have no point in common.
  bool apart() const { return distance > 0; }
};

/// Returns the distance of a, in frame A, to b, in frame B. A point x of B is R x + T in A, with R
/// and T as given. C1 in the pose while the volumes are apart, with (normal, moment) as gradient;
/// piecewise smooth beyond. Also covers the rounding of b's points on their way to frame A.
template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<S>& X_AB);
/// Takes both in one frame; the moment is about its origin.
template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const kIOS<S>& b);

/// Finds the point of `volume` nearest to `point`: distance, p (on the volume), q = point; the
/// normal points from the volume to the point, which is the gradient by the point; no moment.
/// Distance 0 and p = point if the point is inside. Throws std::invalid_argument if a coordinate is
/// NaN, infinite, or above 2^1000 (double) or 2^120 (float) in magnitude.
template <typename S>
ExactDistance nearestPoint(const kIOS<S>& volume, const fcl::Vector3<S>& point);

/// Volumes that together contain a model, taken apart for exact distances once. Immutable: safe to
/// use from many threads. It doesn't follow later changes of the model.
template <typename S>
class Cover {
 public:
  /// Takes the nodes at depth `level` of the model's tree, 0 the root, and leaves above it: at most
  /// 2^level volumes, the tighter the deeper. Throws std::invalid_argument if the model is not
  /// finished or the level negative.
  Cover(const Model<S>& model, int level);
  /// Takes volumes that lie each in a ball of diameter `size`, in the model's units: nodes of its
  /// tree, and where a triangle is larger, volumes of parts of it. Clearances of two such covers
  /// are at most their two sizes below the models' distance, whatever their triangles. Throws
  /// std::invalid_argument if the model is not finished, size is not positive, or the cover would
  /// take more than 2^20 volumes.
  static Cover ofSize(const Model<S>& model, double size);
  /// Throws std::invalid_argument if there is no volume, or an empty one.
  explicit Cover(std::vector<kIOS<S>> volumes);
  ~Cover();
  Cover(Cover&&) noexcept;
  Cover& operator=(Cover&&) noexcept;

  int size() const;                    ///< number of volumes
  const kIOS<S>& volume(int i) const;  ///< in the model's frame, 0 <= i < size()

 private:
  struct Parts;
  template <typename T>
  friend struct CoverPairs;
  std::unique_ptr<const Parts> parts_;
};
using Coverd = Cover<double>;
using Coverf = Cover<float>;

/// Distance of two covers, with its gradient by the pose of B in A as in ExactDistance: by B's
/// translation in A, and by a rotation vector in A that turns B about its own origin.
struct Clearance {
  double value = 0;  ///< in the models' units
  fcl::Vector3d by_translation = fcl::Vector3d::Zero();
  fcl::Vector3d by_rotation = fcl::Vector3d::Zero();
  int pairs = 0;      ///< of volumes in all
  int evaluated = 0;  ///< exactly; the others were proven too far to matter
};

/// Returns the min over all pairs of volumes of their exact distance: a lower bound of the models'
/// distance, 0 when a pair of volumes meets. Piecewise smooth only: where the nearest pair changes
/// the gradient jumps (an element of the generalised gradient is returned), and it is zero at
/// contact.
template <typename S>
Clearance minimumClearance(const Cover<S>& a, const Cover<S>& b, const RelativePose<S>& X_AB);

/// Returns -log(sum over n pairs of exp(-beta d)) / beta: C1 in the pose while all pairs of volumes
/// are apart, a lower bound of minimumClearance() and at most log(n) / beta below it, so that it
/// may be negative. Contact of a pair takes that pair's gradient away; start apart, or choose a
/// deeper level. beta is one over a length, > 0 and finite, else std::invalid_argument is thrown.
template <typename S>
Clearance smoothClearance(const Cover<S>& a, const Cover<S>& b, const RelativePose<S>& X_AB,
                          double beta);

}  // namespace kios
