// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/pair_search.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "fcl_kios/triangle/intersection.h"
#include "model/prepared.h"
#include "model/walk.h"
#include "query/few_triangles.h"
#include "query/smaller_off_box.h"
#include "query/unprepared.h"
#include "search/double_bound.h"
#include "search/mesh_search.h"
#include "search/root_bound.h"
#include "tree/prepare.h"
#include "volume/balls.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using engine::PairAnswer;
using engine::PairQuery;
using engine::SearchEnd;
using engine::TrianglePairIds;
using PairIds = std::vector<TrianglePairIds>;

/// Two models with their trees, which stay in use while it lives.
template <typename S>
class EnginePair {
 public:
  /// apart() need tell no more than `required`.
  EnginePair(const MeshPair<S>& frame, double required) : frame_(frame), required_(required) {}

  /// Compares the boxes of the roots where both models are prepared.
  void compareRoots() {
    if (known_ || !copyRoot(frame_.a, root_a_) || !copyRoot(frame_.b, root_b_)) return;
    known_ = true;
    bound(root_a_, root_b_);
  }

  bool knowsRoots() const { return known_; }

  /// Takes the trees, which are prepared first if need be, but not in vain; compares their roots
  /// if that is to be known and isn't. False if FCL's tree must do.
  bool takeTrees(bool compare) {
    if (tooFar()) return false;
    tree_a_ = preparedTree(frame_.a);
    if (tree_a_) tree_b_ = preparedTree(frame_.b);
    if (!tree_b_) return false;
    // The roots' pose serves, but for a copy of a model that has a tree of its own.
    if (!known_ || !isRootOf(root_a_, *tree_a_) || !isRootOf(root_b_, *tree_b_)) {
      if (compare) {
        bound(*tree_a_, *tree_b_);
      } else {
        usable_ = engine::makeTreePose(*tree_a_, *tree_b_, frame_.X_AB, pose_);
      }
    }
    return usable_;
  }

  /// Whether the roots alone prove the models so far apart.
  bool isFar(double far_enough) const { return apart_ > 0 && apart_ >= far_enough; }
  double apart() const { return apart_; }

  /// Once the trees are taken.
  engine::PreparedPair<S> pair() {
    engine::makeFloatFrame(pose_, frames_);
    return {
        {*tree_a_, viewOf(frame_.a)}, {*tree_b_, viewOf(frame_.b)}, frame_.X_AB, pose_, frames_};
  }

 private:
  /// Whether makeTreePose() takes of both what it takes of the same root.
  static bool isRootOf(const engine::TreeRoot& root, const engine::TreeRoot& tree) {
    return root.reach == tree.reach && root.origin[0] == tree.origin[0] &&
           root.origin[1] == tree.origin[1] && root.origin[2] == tree.origin[2];
  }

  void bound(const engine::TreeRoot& a, const engine::TreeRoot& b) {
    usable_ = engine::makeTreePose(a, b, frame_.X_AB, pose_);
    if (!usable_) return;
    apart_ = engine::rootBound(a, b, pose_, required_);
    if (!(apart_ > 0)) apart_ = boxOffBall(a, b);
  }

  /// The bound by the central sphere of the smaller model, which isn't thin, and the other's box.
  double boxOffBall(const engine::TreeRoot& a, const engine::TreeRoot& b) const {
    const kIOS<S>&root_a = frame_.rootA(), &root_b = frame_.rootB();
    const bool a_larger = root_a.radius0 > root_b.radius0;
    const kIOS<S>& smaller = a_larger ? root_b : root_a;
    if (isThin(smaller)) return 0;
    const Eigen::Map<const Eigen::Vector3d> origin(a_larger ? b.origin : a.origin);
    return engine::ballBound(a_larger ? a.root_box : b.root_box, a_larger,
                             smaller.center0.template cast<double>() - origin,
                             double{smaller.radius0}, pose_);
  }

  /// True if the models are so far apart for their size that makeTreePose() would refuse them: its
  /// pad would be as large as the smaller model's radius.
  bool tooFar() const {
    const kIOS<S>&a = frame_.rootA(), &b = frame_.rootB();
    const double apart = (frame_.X_AB * b.center0 - a.center0).template cast<double>().norm();
    return error_bounds::laneError(apart) > std::min<double>(a.radius0, b.radius0);
  }

  const MeshPair<S>& frame_;
  const double required_;
  engine::TreeRoot root_a_, root_b_;
  bool known_ = false;  ///< the roots
  engine::TreePose pose_;
  engine::TreeCache::Use tree_a_, tree_b_;
  engine::FloatFrame frames_;
  bool usable_ = false;
  double apart_ = -kInfinity;  ///< lower bound of the distance
};

/// A search of FCL's trees in double, depth first, the nearer of two children before the other.
/// With a budget it is best first, so that more of it never proves less.
template <typename S>
class TreeSearch {
 public:
  TreeSearch(const MeshPair<S>& frame, const PairQuery& query, SearchCounts& counts)
      : frame_(frame), query_(query), counts_(counts), cull_distance_(query.far_enough) {}

  PairAnswer<S> run() {
    if (begin()) return result_;
    long long left = query_.max_expansions;
    const auto skip = [this](const NodePair& at) {
      if (!(at.bound >= cull_distance_)) return false;
      left_out_ = std::min(left_out_, at.bound);
      return true;
    };
    const auto visit = [&](const NodePair& at, const auto& add) {
      const auto &node_a = frame_.a.getBV(at.node_a), &node_b = frame_.b.getBV(at.node_b);
      if (node_a.isLeaf() && node_b.isLeaf()) {
        ++counts_.leaf_pairs;
        return evaluate({node_a.primitiveId(), node_b.primitiveId()}, at.bound);
      }
      if (left-- == 0) {
        result_.end = SearchEnd::kBudget;
        left_out_ = std::min(left_out_, at.bound);
        return true;
      }
      ++counts_.expansions;
      counts_.volume_tests += 2;
      if (node_b.isLeaf() || (!node_a.isLeaf() && node_a.bv.size() > node_b.bv.size())) {
        add(bounded(node_a.leftChild(), at.node_b, at.bound));
        add(bounded(node_a.rightChild(), at.node_b, at.bound));
      } else {
        add(bounded(at.node_a, node_b.leftChild(), at.bound));
        add(bounded(at.node_a, node_b.rightChild(), at.bound));
      }
      return false;
    };
    const std::vector<NodePair> rest =
        walkNearestFirst(bounded(0, 0, -kInfinity), skip, visit, query_.hasBudget());
    // Any pair that intersects is an answer, but which one is given must not depend on the start.
    if (has_bound_ && result_.found() && result_.nearest.distance == 0) return cold();
    for (const NodePair& pair : rest) left_out_ = std::min(left_out_, pair.bound);
    result_.least_other = std::max(0.0, left_out_);
    return result_;
  }

 private:
  struct NodePair {
    double bound;
    int node_a, node_b;
  };

  /// From the triangles of query_.start; true to end the search. An exact answer only learns of
  /// their distance.
  bool begin() {
    if (!frame_.exist(query_.start)) return false;
    const double distance = double{frame_.distanceOf(query_.start).distance};
    const bool near = query_.near_enough > 0 && distance <= query_.near_enough;
    if (!query_.isExact() || query_.hasBudget() || near) return evaluate(query_.start, -kInfinity);
    has_bound_ = distance > 0;
    if (has_bound_) cull_distance_ = std::min(cull_distance_, withRounding(distance));
    return false;
  }

  double withRounding(double distance) const {
    // Bounds of volumes include the frame's rounding: no triangles in volumes that are farther
    // apart than this are computed to be as near as `distance`.
    return distance + frame_.kernelError(distance);
  }

  PairAnswer<S> cold() const {
    PairQuery query = query_;
    query.start = {};
    return TreeSearch(frame_, query, counts_).run();
  }

  NodePair bounded(int node_a, int node_b, double parent) const {
    const double own = separation(frame_.a.getBV(node_a).bv, frame_.b.getBV(node_b).bv, frame_.X_AB,
                                  cull_distance_);
    return {std::max(own, parent), node_a, node_b};
  }

  /// Triangles in volumes that are at least `bound` apart. True to end the search.
  bool evaluate(const TrianglePairIds& ids, double bound) {
    ++counts_.exact;
    const TriangleDistance<S> found = frame_.distanceOf(ids);
    const double distance = double{found.distance}, best = result_.least_evaluated;
    const double proven = std::max(bound, distance - frame_.distanceError(distance));
    result_.proven_evaluated =
        best < kInfinity ? std::min(result_.proven_evaluated, proven) : proven;
    if (distance > best || (distance == best && result_.ids < ids)) return false;
    result_.ids = ids;
    result_.nearest = found;
    result_.least_evaluated = distance;
    // For an exact answer, every pair is evaluated that rounding alone may have made farther.
    cull_distance_ = std::min(
        cull_distance_, query_.isExact() ? withRounding(distance) : query_.cullDistance(distance));
    if (!(distance <= query_.near_enough)) return false;
    result_.end = SearchEnd::kNear;
    return true;
  }

  const MeshPair<S>& frame_;
  const PairQuery& query_;
  SearchCounts& counts_;
  double cull_distance_;
  double left_out_ = kInfinity;  ///< least bound of the pairs left out
  bool has_bound_ = false;       ///< the start lowered cull_distance_
  PairAnswer<S> result_;
};

/// Returns a lower bound of how far the model's content reaches from any point, and so of its
/// tree's reach: a quarter of the radius of a root volume that was fitted to the content. One that
/// was merged, as bottom-up refits do, may be a hundred times as large; some of the content tells
/// then.
template <typename S>
double leastReach(const Model<S>& model) {
  const kIOS<S>& root = model.getBV(0).bv;
  if (treesOf(model)->isBuilt(root.stamp)) return double{root.radius0} / 4;
  constexpr int kSamples = 16;
  const int step = std::max(1, model.num_tris / kSamples);
  Eigen::AlignedBox3d box;
  for (int i = 0; i < model.num_tris; i += step) {
    for (int k = 0; k < 3; ++k) {
      box.extend(model.vertices[model.tri_indices[i][k]].template cast<double>());
    }
  }
  return std::min(double{root.radius0} / 4, 0.49 * box.sizes().maxCoeff());
}

constexpr long long kTestsOfFew = 8;  ///< take as long as intersectingOfFew(), more or less

/// searchContacts() of a pair whose roots may have been compared.
template <typename S>
bool searchTrees(EnginePair<S>& engine, std::size_t limit, PairIds& found, SearchCounts& counts) {
  engine.compareRoots();
  if (engine.isFar(0)) return true;
  if (!engine.takeTrees(true)) return false;
  if (!engine.isFar(0)) found = engine::intersectingTriangles(engine.pair(), limit, counts);
  return true;
}

}  // namespace

template <typename S>
[[gnu::hot]] PairAnswer<S> searchNearest(const MeshPair<S>& frame, const PairQuery& asked,
                                         SearchCounts& counts) {
  PairQuery query = asked;
  EnginePair<S> engine(frame, kInfinity);
  const bool bounded = query.far_enough < kInfinity;
  const bool pair_by_pair = query.isExact() && arePairByPair(frame.a, frame.b);
  if (query.isExact() && !query.endsEarly() && !pair_by_pair) {
    const auto touching = touchingOfFew(frame, query, counts);
    if (touching && touching->found()) return *touching;
    query.apart = touching.has_value();
  }
  const bool roots_pay = !(pair_by_pair && areFewest(frame.a, frame.b));
  if (bounded && roots_pay) engine.compareRoots();
  if (pair_by_pair && !engine.isFar(query.far_enough)) {
    return nearestPairByPair(frame, query, counts);
  }
  if (engine.isFar(query.far_enough) || engine.takeTrees(bounded)) {
    if (engine.isFar(query.far_enough)) {
      PairAnswer<S> far;
      far.nearest.point_a = far.nearest.point_b = fcl::Vector3<S>::Zero();
      far.least_other = engine.apart();
      return far;
    }
    return engine::nearestTriangles(engine.pair(), query, counts);
  }
  ++counts.tree_searches;
  return TreeSearch<S>(frame, query, counts).run();
}

template <typename S>
bool arePrepared(const MeshPair<S>& frame) {
  const engine::TreeCache *const a = treesOf(frame.a), *const b = treesOf(frame.b);
  return a && b && a->isPrepared(frame.rootA().stamp) && b->isPrepared(frame.rootB().stamp);
}

template <typename S>
bool treesPay(const MeshPair<S>& frame) {
  const auto pays = [](const Model<S>& model) {
    const engine::TreeCache* const trees = treesOf(model);
    return trees &&
           (trees->isPrepared(model.getBV(0).bv.stamp) || trees->budget.isSpent(model.num_tris));
  };
  return pays(frame.a) && pays(frame.b);
}

template <typename S>
void charge(const MeshPair<S>& frame, long long tests) {
  for (const Model<S>* model : {&frame.a, &frame.b}) {
    engine::TreeCache* const trees = treesOf(*model);
    if (trees && !trees->isPrepared(model->getBV(0).bv.stamp)) trees->budget.charge(tests);
  }
}

// The tests of preparedTree() and makeFloatFrame() with room for what a tree's reach may be: hardly
// ever above 64 times the root volumes' radii, which is for the caps of flat content.
template <typename S>
bool engineServes(const MeshPair<S>& frame) {
  const kIOS<S>&a = frame.rootA(), &b = frame.rootB();
  if (!treesOf(frame.a) || !treesOf(frame.b) || a.stamp == 0 || b.stamp == 0) return false;
  const double least = std::min(leastReach(frame.a), leastReach(frame.b));
  const double reach = 64 * (double{a.radius0} + double{b.radius0});
  const auto norm1 = [](const kIOS<S>& v) {
    return v.center0.template cast<double>().template lpNorm<1>();
  };
  const auto& bounds = detail::boundsOf(frame.X_AB);
  const fcl::Vector3<S> apart = frame.X_AB * b.center0 - a.center0;
  const double scale = reach + apart.template cast<double>().template lpNorm<1>();
  const double pad =
      error_bounds::laneError(scale) + 2 * bounds.stretch * scale +
      error_bounds::volumeError<S>(norm1(b) + 2 * reach, bounds.T_norm1 + norm1(a), 2 * reach, 0);
  return least >= engine::kLeastReach && 2 * scale <= engine::kLargestReach &&
         pad <= 0x1p-4 * least;
}

template <typename S>
[[gnu::hot]] bool searchContacts(const MeshPair<S>& frame, std::size_t limit, PairIds& found,
                                 SearchCounts& counts) {
  EnginePair<S> engine(frame, 0);
  return searchTrees(engine, limit, found, counts);
}

template <typename S>
[[gnu::hot]] std::optional<PairIds> intersectingPairs(const MeshPair<S>& frame, std::size_t limit,
                                                      bool any, SearchCounts& counts) {
  if (frame.a.num_tris == 1 && frame.b.num_tris == 1) {  // bounds would take longer
    ++counts.exact;
    return trianglesIntersect(frame.triangleA(0), frame.triangleB(0)) ? PairIds{{0, 0}} : PairIds();
  }
  if (areFewest(frame.a, frame.b)) return intersectingOfFew(frame, limit, counts);
  const kIOS<S>&root_a = frame.rootA(), &root_b = frame.rootB();
  const bool unlike = areUnlike(root_a, root_b);
  EnginePair<S> engine(frame, 0);
  if (unlike || isThin(root_a) || isThin(root_b)) engine.compareRoots();
  if (engine.isFar(0)) return PairIds();
  if (!unlike && !engine.knowsRoots() && frame.rootBound(0) > 0) return PairIds();
  // The boxes of prepared roots tell more than planes between vertices, and sooner.
  if (areFew(frame.a, frame.b)) {
    if (!treesPay(frame)) {
      charge(frame, kTestsOfFew);
      if (verticesApart(frame, 0)) return PairIds();
    } else {
      for (const Model<S>* model : {&frame.a, &frame.b}) {
        if (!engine.knowsRoots()) preparedTree(*model);
      }
      engine.compareRoots();
      if (engine.isFar(0)) return PairIds();
    }
    return intersectingOfFew(frame, limit, counts);
  }
  PairIds found;
  if (arePrepared(frame)) {
    if (searchTrees(engine, limit, found, counts)) return found;
  } else if (verticesApart(frame, 0)) {
    return PairIds();
  }
  auto walked = touchUnprepared(frame, limit, counts);
  if (walked && (any || walked->size() < limit)) return walked;
  if (!searchTrees(engine, limit, found, counts)) return std::nullopt;
  return found;
}

KIOS_INSTANTIATE_FUNCTION(searchNearest);
KIOS_INSTANTIATE_FUNCTION(arePrepared);
KIOS_INSTANTIATE_FUNCTION(treesPay);
KIOS_INSTANTIATE_FUNCTION(charge);
KIOS_INSTANTIATE_FUNCTION(engineServes);
KIOS_INSTANTIATE_FUNCTION(searchContacts);
KIOS_INSTANTIATE_FUNCTION(intersectingPairs);

}  // namespace kios
