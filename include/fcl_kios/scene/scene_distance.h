// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <fcl/geometry/collision_geometry.h>
#include <fcl/narrowphase/collision_object.h>
#include "fcl_kios/scene/scene_types.h"

namespace kios {

/// Answers for the distances in a scene of many objects over many frames. Answers equal
/// fcl::distance over all admissible pairs, bit for bit, with the object of the smaller id as the
/// first argument, but for last bits where hundreds of pairs of triangles are equally near; ties of
/// objects go to the smallest ids. A query leaves out the pairs that it needn't look at, and
/// counts() tells how many. Pairs of floats without a mesh over k-IOS are asked in double, for
/// which libfcl has the code, and rounded once; a mesh over another volume of FCL is then converted
/// at each query, which kios::toKIOS() spares.
///
/// A pair is admissible unless it is excluded, refused by the filter, or both are obstacles. Two
/// meshes over k-IOS are never asked twice at one relative pose if the first answer will do. Models
/// may be replaced, updated and refitted between queries; that is noticed by their root volumes. So
/// may the sizes of FCL's shapes. What is no mesh over k-IOS and no shape of FCL's, octrees above
/// all, is asked at each query that comes near. Docs: docs/scene.md.
///
/// Not to be used from two threads at once; several scenes may share models.
template <typename S>
class SceneDistance {
 public:
  using Geometry = fcl::CollisionGeometry<S>;
  using Pose = fcl::Transform3<S>;
  /// Returns true if a query should look at the pair a < b. It is called only for pairs that are
  /// near enough to matter, and must give the same answer throughout a query.
  using Filter = std::function<bool(int a, int b)>;

  SceneDistance();
  ~SceneDistance();
  SceneDistance(SceneDistance&&) noexcept;
  SceneDistance& operator=(SceneDistance&&) noexcept;

  /// Adds an object at its pose in the world and returns its id, the least that is free. A geometry
  /// other than a mesh over k-IOS has its local AABB computed, as fcl::CollisionObject does, which
  /// is no const use, and so has a shape of FCL's that changed. Throws std::invalid_argument if the
  /// geometry is null or an unfinished mesh, or the pose is not rigid.
  int add(std::shared_ptr<const Geometry> geometry, const Pose& X_W, Role role = Role::kBody);
  /// Adds an object whose pose is read from it at each query. It must outlive its stay here.
  int add(const fcl::CollisionObject<S>* object, Role role = Role::kBody);
  /// Throw std::invalid_argument if there is no such object. So does move() if the pose is not
  /// rigid or not finite, or is read from an fcl::CollisionObject.
  void remove(int id);
  void move(int id, const Pose& X_W);
  /// Tells the scene that the local AABB of a geometry has grown. That is needed for what is
  /// neither a mesh over k-IOS nor one of FCL's shapes or octrees.
  void changed(int id);
  bool contains(int id) const;
  std::size_t size() const;  ///< number of objects

  /// Excludes a pair, or admits it again. Forgotten when one of the two is removed. Throws
  /// std::invalid_argument if one of the two doesn't exist, or a == b.
  void exclude(int a, int b, bool excluded = true);
  /// Replaces the filter; an empty one admits all.
  void setFilter(const Filter& filter);

  /// Finds the nearest admissible pair; none if there is no admissible pair.
  std::optional<ScenePair<S>> closestPair(const SceneRequest& request = {});
  /// Lists all admissible pairs with distance <= margin, in ascending order of (a, b): those that
  /// touch, for 0. Throws std::invalid_argument if margin is NaN.
  std::vector<ScenePair<S>> pairsWithin(S margin, const SceneRequest& request = {});
  /// Lists the distance of every admissible pair, in ascending order of (a, b).
  std::vector<ScenePair<S>> clearances(const SceneRequest& request = {});

  /// Returns the counts of the last query.
  const SceneCounts& counts() const;
  /// Counts the pairs of which something is remembered: at most twice those that the last query
  /// came near, plus 1024, and never more than kMaxRemembered.
  std::size_t rememberedPairs() const;
  enum : std::size_t { kMaxRemembered = std::size_t{1} << 18 };
  /// Forgets all that was learnt of pairs; answers don't depend on it.
  void forget();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};
using SceneDistanced = SceneDistance<double>;
using SceneDistancef = SceneDistance<float>;

extern template class SceneDistance<double>;
extern template class SceneDistance<float>;

}  // namespace kios
