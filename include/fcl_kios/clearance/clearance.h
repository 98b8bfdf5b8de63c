// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "fcl_kios/clearance/exact_distance.h"
#include "fcl_kios/model/model.h"

namespace kios {

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
