// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/geometry/collision_geometry.h>
#include <fcl/narrowphase/collision_object.h>
#include "fcl_kios/detail/counts.h"
#include "fcl_kios/detail/rigid.h"
#include "fcl_kios/model.h"

namespace kios {

/// Says whether an object is an obstacle: two obstacles are never asked about each other.
enum class Role : std::uint8_t { kBody, kObstacle };

/// Options of a scene query.
struct SceneRequest {
  bool nearest_points = false;  ///< sets ScenePair::nearest_a and nearest_b
  /// If false, pairsWithin() may report any distance of two points of a pair up to the margin. That
  /// spares most of the search; which pairs are reported doesn't depend on it.
  bool exact = true;
};

/// Two objects of a scene, a < b.
template <typename S>
struct ScenePair {
  int a = -1, b = -1;  ///< ids
  S distance = 0;      ///< in the models' units; 0 at contact
  /// Triangles that realise the distance; -1 for geometries that have none.
  std::intptr_t triangle_a = -1, triangle_b = -1;
  /// Nearest points in the world; set if the request wants them.
  fcl::Vector3<S> nearest_a = fcl::Vector3<S>::Zero(), nearest_b = fcl::Vector3<S>::Zero();
};
using ScenePaird = ScenePair<double>;
using ScenePairf = ScenePair<float>;

/// Counts how a scene query dealt with its pairs; all but `proven_farther` and `search` add up to
/// `total`.
struct SceneCounts {
  long long total = 0;      ///< n (n - 1) / 2
  long long filtered = 0;   ///< excluded, refused by the filter, or two obstacles, where reached
  long long far_boxes = 0;  ///< farther by the boxes around their root volumes
  long long far_roots = 0;  ///< farther by their root volumes
  long long still = 0;      ///< at the relative pose of the last proof, which suffices
  long long ties = 0;       ///< no distance is small enough: after a contact, or margin <= 0
  long long queried = 0;    ///< searched by the narrow phase
  long long proven_farther = 0;  ///< of those, proven farther than the query asked for
  SearchCounts search;           ///< the work of the narrow phase

  /// Counts the pairs that the narrow phase was spared.
  long long skipped() const { return total - queried; }
};

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
  void ignorePair(int a, int b, bool ignored = true);
  [[deprecated("now ignorePair()")]] void exclude(int a, int b, bool ignored = true) {
    ignorePair(a, b, ignored);
  }
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

/// A part of an assembly, where it stands.
struct ClashPart {
  /// A mesh over k-IOS, a box, or a convex shape by its faces. Both shapes, and meshes that are
  /// marked as solids (solids.h), have an inside; others are surfaces. See toDouble(), too.
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  UnalignedPose X_WP = UnalignedPose::Identity();
  std::string name;  ///< unlike those of all other parts
  int group = 0;
};

/// Makes a part's mesh of one in float: in double, marked as a solid if the model is. Throws
/// std::invalid_argument if the model is not a finished mesh, and std::bad_alloc.
std::shared_ptr<Modeld> toDouble(const Modelf& model);

/// What findClashes() looks for, lengths in the parts' units.
struct ClashRequest {
  double touch = 1e-6;   ///< what is nearer than that, or no deeper, touches; >= 0
  double clearance = 0;  ///< what is nearer than that lacks clearance; 0, or >= touch
  std::vector<std::pair<std::string, std::string>> ignored;  ///< names of parts; either order
  bool between_groups = false;  ///< leaves out pairs of parts of one group
  int threads = 1;              ///< that share the pairs; 0: one a core
  /// More pairs of parts whose boxes come as near as `touch` or `clearance` are refused.
  std::size_t max_pairs = std::size_t{1} << 23;
  /// Ends the search for the depth of a pair, as in LocalDepthRequest; what isn't decided then is
  /// kOverlap. >= 0.
  long long max_pieces = 100000;
};

/// How two parts stand to each other. A duplicate, or one inside the other, is no overlap.
enum class ClashStatus {
  kOverlap,    ///< deeper than `touch`; also surfaces that meet, and what isn't decided
  kInside,     ///< one lies in the other, their surfaces apart
  kDuplicate,  ///< equal triangles, in one order, whose corners are at most `touch` apart
  kTouch,      ///< at most `touch` apart, or deep
  kClearance   ///< at most `clearance` apart
};

/// Two parts that clash, by their places in the list, a < b; points in the world.
struct ClashResult {
  std::size_t a = 0, b = 0;
  ClashStatus status = ClashStatus::kOverlap;
  /// `lower` and `upper` are a depth: the parts meet, or one is in the other. Else a distance.
  bool deep = false;
  /// Bracket the local depth (solids.h) or the distance, that of the corners of kDuplicate: proven.
  /// The depth of a part without an inside has no upper bound: `upper` is infinity.
  double lower = 0, upper = 0;
  /// The nearest points. Of a depth: where it is deepest, a point of one part and the nearest of
  /// the other's surface. Where no depth is known, a point in which surfaces meet, twice.
  double point_a[3] = {}, point_b[3] = {};
  /// Moves b apart from a: penetration()'s translation for two solids of kOverlap and kInside, else
  /// zero.
  double way_out[3] = {};
  /// The status is proven. Else it is one that the bracket allows: kOverlap before kTouch.
  bool decided = true;
};

/// Finds all pairs of parts that overlap, touch, or are nearer than the clearance, in ascending
/// order of (a, b). Answers don't depend on threads or the machine. Equal meshes share what is
/// built of them, and parts may share models.
///
/// Two solids are judged by localDepth(). Surfaces that meet are kOverlap and not decided, unless
/// a corner of one lies deeper in the other, a solid, than `touch`. Safe from many threads. Throws
/// std::invalid_argument, which names the part, if a geometry is null, none of these,
/// unfinished or marked and no solid any more, a pose is not rigid, or a name is taken or not
/// known; if a length is negative or not finite, or `touch` exceeds a clearance that isn't 0; and
/// where there are more than `max_pairs`. Docs: docs/clash.md.
std::vector<ClashResult> findClashes(const std::vector<ClashPart>& parts,
                                     const ClashRequest& request = {});

}  // namespace kios
