// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/shape_queries.h"

#include <limits>
#include <vector>

#include "query/collide_with.h"
#include "query/mesh_pair.h"
#include "query/posed_solid.h"
#include "query/shape_solid.h"
#include "solid/triangle_shape.h"

namespace kios {
namespace {

/// A node of the model's tree that waits.
struct Waiting {
  int node;
  double bound;
};

/// The box of a bounded shape along the world's axes. Half-spaces and planes, as in FCL, fill the
/// world but for axes that their normal is parallel to.
template <typename S>
fcl::AABB<S> worldBox(const shape::Solid& solid, const fcl::Transform3<S>& tf) {
  const Eigen::Matrix3d R = tf.linear().template cast<double>();
  fcl::AABB<S> box;
  for (int c = 0; c < 3; ++c) {
    const shape::Vec n = R.row(c).transpose();
    const double high = shape::extentAlong(solid, n), low = -shape::extentAlong(solid, -n);
    const double most = std::numeric_limits<S>::max(), at = tf.translation()[c];
    box.min_[c] = static_cast<S>(std::max(-most, low + at));
    box.max_[c] = static_cast<S>(std::min(most, high + at));
  }
  return box;
}

/// The triangles of a model that meet a shape, reported as FCL's oriented traversal does.
template <typename S>
class ShapeCollision {
 public:
  ShapeCollision(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::CollisionGeometry<S>& geometry, const fcl::Transform3<S>& X_WS,
                 const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                 SearchCounts& counts)
      : model_(model),
        geometry_(geometry),
        X_WM_(X_WM),
        X_WS_(X_WS),
        request_(request),
        result_(result),
        counts_(counts),
        occupied_(model.isOccupied() && geometry.isOccupied()),
        costs_(request.enable_cost && !model.isFree() && !geometry.isFree()),
        posed_(toSolid(geometry), X_WM, X_WS, model.getBV(0).bv) {}

  void run() {
    if (!occupied_ && !costs_) return;
    if (costs_) shape_box_ = worldBox(toSolid(geometry_), X_WS_);
    std::vector<int> waiting = {0};
    while (!waiting.empty() && !request_.isSatisfied(result_)) {
      const auto& node = model_.getBV(waiting.back());
      waiting.pop_back();
      ++counts_.volume_tests;
      if (posed_.bound(node.bv, 0.0) > 0) continue;
      if (node.isLeaf()) {
        test(node.primitiveId());
      } else {
        waiting.push_back(node.rightChild());
        waiting.push_back(node.leftChild());
      }
    }
  }

 private:
  void test(int id) {
    ++counts_.leaf_kernels;
    const TriangleVertices<S> corners = cornersOf(model_, id);
    const shape::Triangle triangle = posed_.place(corners);
    if (!shape::intersects(posed_.solid(), triangle)) return;
    if (occupied_ && result_.numContacts() < request_.num_max_contacts) {
      fcl::Contact<S> contact(&model_, &geometry_, id, fcl::Contact<S>::NONE,
                              fcl::Vector3<S>::Zero(), fcl::Vector3<S>::Zero(), S(0));
      if (request_.enable_contact) {
        const shape::TriangleShapeContact c = shape::contact(posed_.solid(), triangle);
        contact.pos = posed_.toWorld(c.position);
        contact.normal = posed_.directionToWorld(-c.normal);  // from the mesh to the shape
        contact.penetration_depth = c.depth > 0 ? posed_.fromUnits(c.depth) : S(0);
      }
      result_.addContact(contact);
    }
    if (costs_) {
      fcl::AABB<S> shared;
      const auto t = transformed(corners, X_WM_);
      fcl::AABB<S>(t[0], t[1], t[2]).overlap(shape_box_, shared);
      result_.addCostSource(
          fcl::CostSource<S>(shared, model_.cost_density * geometry_.cost_density),
          request_.num_max_cost_sources);
    }
  }

  const Model<S>& model_;
  const fcl::CollisionGeometry<S>& geometry_;
  const fcl::Transform3<S>&X_WM_, &X_WS_;
  const fcl::CollisionRequest<S>& request_;
  fcl::CollisionResult<S>& result_;
  SearchCounts& counts_;
  const bool occupied_, costs_;
  const PosedSolid<S> posed_;
  fcl::AABB<S> shape_box_;
};

}  // namespace

template <typename S>
std::size_t collideShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                         SearchCounts* counts) {
  return collideWith(model, X_WM, shape, X_WS, request, result, [&](const auto& asked) {
    SearchCounts unused;
    ShapeCollision<S> search(model, X_WM, shape, X_WS, asked, result, counts ? *counts : unused);
    if (request.isSatisfied(result)) return false;
    search.run();
    return true;
  });
}

template <typename S>
S distanceShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                const fcl::CollisionGeometry<S>& geometry, const fcl::Transform3<S>& X_WS,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                SearchCounts* counts) {
  requireErrorBounds(request);
  requireFinished(model);
  const PosedSolid<S> posed(toSolid(geometry), X_WM, X_WS, model.getBV(0).bv);
  if (request.isSatisfied(result)) return result.min_distance;
  SearchCounts unused;
  SearchCounts& count = counts ? *counts : unused;

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool limited = result.min_distance < std::numeric_limits<S>::max();
  const double abs_err = posed.toUnits(request.abs_err), rel_err = request.rel_err;
  double best = kInfinity, prune_at = kInfinity;
  const auto lowerTo = [&](double distance) {
    best = distance;
    prune_at = engine::pruneAt(distance, rel_err, abs_err);
  };
  if (limited) lowerTo(posed.toUnits(result.min_distance));

  int nearest_id = -1;
  shape::TriangleShapeDistance nearest;
  std::vector<Waiting> waiting;
  waiting.reserve(64);
  const auto boundOf = [&](int node) {
    ++count.volume_tests;
    return posed.bound(model.getBV(node).bv, prune_at);
  };
  waiting.push_back({0, boundOf(0)});
  while (!waiting.empty() && best > 0) {
    const Waiting next = waiting.back();
    waiting.pop_back();
    if (std::max(next.bound, 0.0) >= prune_at) continue;
    const auto& node = model.getBV(next.node);
    if (!node.isLeaf()) {
      Waiting near = {node.leftChild(), boundOf(node.leftChild())};
      Waiting far = {node.rightChild(), boundOf(node.rightChild())};
      if (far.bound < near.bound) std::swap(near, far);
      waiting.push_back(far);
      waiting.push_back(near);
      continue;
    }
    ++count.leaf_kernels;
    const int id = node.primitiveId();
    const auto d = shape::distance(posed.solid(), posed.place(cornersOf(model, id)), prune_at);
    if (!(d.distance < best)) continue;
    lowerTo(d.distance);
    nearest = d;
    nearest_id = id;
  }
  if (nearest_id < 0) return result.min_distance;
  constexpr int kNone = fcl::DistanceResult<S>::NONE;
  if (request.enable_nearest_points) {
    result.update(posed.fromUnits(best), &model, &geometry, nearest_id, kNone,
                  posed.toWorld(nearest.on_triangle), posed.toWorld(nearest.on_shape));
  } else {
    result.update(posed.fromUnits(best), &model, &geometry, nearest_id, kNone);
  }
  return result.min_distance;
}

#define KIOS_INSTANTIATE(S)                                                                      \
  template std::size_t collideShape(const Model<S>&, const fcl::Transform3<S>&,                  \
                                    const fcl::CollisionGeometry<S>&, const fcl::Transform3<S>&, \
                                    const fcl::CollisionRequest<S>&, fcl::CollisionResult<S>&,   \
                                    SearchCounts*);                                              \
  template S distanceShape(const Model<S>&, const fcl::Transform3<S>&,                           \
                           const fcl::CollisionGeometry<S>&, const fcl::Transform3<S>&,          \
                           const fcl::DistanceRequest<S>&, fcl::DistanceResult<S>&,              \
                           SearchCounts*);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
