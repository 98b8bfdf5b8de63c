// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <fcl/narrowphase/collision_object.h>
#include "fcl_kios/scene/scene_types.h"

namespace kios {

/// Asks scene queries over any broadphase manager of FCL: its distance callback, with a memory of
/// the pairs from query to query, so that a pair which stood still or moved too little is not
/// searched again. What the geometries are is looked at in each query: meshes over k-IOS by their
/// root volumes, FCL's shapes by their sizes. Of others, octrees above all, nothing is remembered.
///
///     kios::ManagerQueryd query;
///     query.findWithin(0.1);                       // or query.findClosest()
///     manager->distance(&query, kios::ManagerQueryd::callback);
///     for (const auto& pair : query.pairs()) ...
///
/// The manager leaves out pairs by the objects' AABBs, which are the caller's to keep up to date:
/// computeAABB() and update() after moves and, as FCL doesn't, computeLocalAABB() after a model was
/// replaced or updated. These boxes have no margin, and FCL takes a rotation R for none if no entry
/// of R - I is above 1e-12 (float: 1e-5): a pair nearer than the answer by up to 4e-12 (4e-5) of
/// the distance of the content from its object's origin, or by rounding, may be left out.
/// SceneDistance has its own boxes. Not to be used from two threads at once.
template <typename S>
class ManagerQuery {
 public:
  using Object = fcl::CollisionObject<S>;
  /// Returns true if a query should look at the pair.
  using Filter = std::function<bool(const Object*, const Object*)>;

  /// Two objects, as the manager ordered them.
  struct Pair {
    const Object *a = nullptr, *b = nullptr;
    S distance = 0;  ///< fcl::distance(a, b), bit for bit; float pairs as in SceneDistance
    /// Triangles that realise the distance; -1 for geometries that have none.
    std::intptr_t triangle_a = -1, triangle_b = -1;
  };

  /// An empty filter admits all pairs.
  explicit ManagerQuery(Filter filter = {});
  ~ManagerQuery();
  ManagerQuery(ManagerQuery&&) noexcept;
  ManagerQuery& operator=(ManagerQuery&&) noexcept;

  /// Starts a query: of a nearest pair; of all pairs with distance <= margin, in the models' units.
  /// The manager orders each pair, and the other order's distance may differ in the last bits: a
  /// margin that is a distance itself should be larger by a rounding.
  /// Throws std::invalid_argument if margin is NaN.
  void findClosest();
  void findWithin(S margin);

  /// Serves as FCL's DistanceCallBack; `query` is a `ManagerQuery<S>` that was started. Throws
  /// std::invalid_argument as fcl::distance does.
  static bool callback(Object* o1, Object* o2, void* query, S& dist);

  /// Returns the pairs found: at most one of findClosest().
  const std::vector<Pair>& pairs() const;
  /// Counts how the pairs were dealt with that the manager came up with.
  const SceneCounts& counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};
using ManagerQueryd = ManagerQuery<double>;
using ManagerQueryf = ManagerQuery<float>;

extern template class ManagerQuery<double>;
extern template class ManagerQuery<float>;

}  // namespace kios
