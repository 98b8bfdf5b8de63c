// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/mesh_nodes.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"
#include "query/mesh_pair.h"
#include "volume/rounding.h"

namespace kios {
namespace {

template <typename S>
fcl::AABB<S> boxOf(const TriangleVertices<S>& t) {
  return fcl::AABB<S>(t[0], t[1], t[2]);
}

template <typename Node, typename S, typename Request, typename Result>
void connect(Node& node, const Model<S>& model1, const fcl::Transform3<S>& tf1,
             const Model<S>& model2, const fcl::Transform3<S>& tf2, const Request& request,
             Result& result) {
  requireFinished(model1);
  requireFinished(model2);
  node.model1 = &model1;
  node.model2 = &model2;
  node.vertices1 = model1.vertices;
  node.vertices2 = model2.vertices;
  node.tri_indices1 = model1.tri_indices;
  node.tri_indices2 = model2.tri_indices;
  node.tf1 = tf1;
  node.tf2 = tf2;
  node.request = request;
  node.result = &result;
  node.X_12.emplace(tf1, tf2);
}

}  // namespace

template <typename S>
bool MeshCollisionTraversalNode<S>::BVTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_bv_tests++;
  return separation(this->model1->getBV(b1).bv, this->model2->getBV(b2).bv, *X_12, 0.0) > 0;
}

template <typename S>
void MeshCollisionTraversalNode<S>::leafTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_leaf_tests++;
  const auto& request = this->request;
  auto& result = *this->result;
  const auto& model1 = *this->model1;
  const auto& model2 = *this->model2;
  const bool occupied = model1.isOccupied() && model2.isOccupied();
  const bool costs = request.enable_cost && !model1.isFree() && !model2.isFree();
  if (!occupied && !costs) return;

  const int id1 = model1.getBV(b1).primitiveId(), id2 = model2.getBV(b2).primitiveId();
  const auto p = cornersOf(*this->model1, id1);
  const auto q_local = cornersOf(*this->model2, id2);
  const auto q = transformed(q_local, *X_12);
  if (!trianglesIntersect(p, q)) return;

  if (occupied) addContacts(model1, id1, p, model2, id2, q, this->tf1, request, result);
  if (costs) {
    fcl::AABB<S> shared;
    boxOf(transformed(p, this->tf1)).overlap(boxOf(transformed(q_local, this->tf2)), shared);
    result.addCostSource(fcl::CostSource<S>(shared, this->cost_density),
                         request.num_max_cost_sources);
  }
}

template <typename S>
void MeshDistanceTraversalNode<S>::lowerTo(S distance) const {
  best_ = prune_at_ = distance;
  if (!(distance < std::numeric_limits<S>::max())) return;  // no bound, and nothing found yet
  prune_at_ = static_cast<S>(engine::pruneAt(distance, this->rel_err, this->abs_err));
}

template <typename S>
void MeshDistanceTraversalNode<S>::preprocess() {
  tri1_ = tri2_ = -1;
  lowerTo(this->result->min_distance);
}

template <typename S>
S MeshDistanceTraversalNode<S>::BVTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_bv_tests++;
  return static_cast<S>(
      separation(this->model1->getBV(b1).bv, this->model2->getBV(b2).bv, *X_12, double{prune_at_}));
}

template <typename S>
bool MeshDistanceTraversalNode<S>::canStop(S bound) const {
  return std::max(bound, S(0)) >= prune_at_;
}

template <typename S>
void MeshDistanceTraversalNode<S>::leafTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_leaf_tests++;
  const int id1 = this->model1->getBV(b1).primitiveId();
  const int id2 = this->model2->getBV(b2).primitiveId();
  const auto p = cornersOf(*this->model1, id1);
  const auto q = transformed(cornersOf(*this->model2, id2), *X_12);
  const TriangleDistance<S> nearest = triangleDistance(p, q);
  if (!(nearest.distance < best_)) return;
  lowerTo(nearest.distance);
  tri1_ = id1;
  tri2_ = id2;
  point1_ = nearest.point_a;
  point2_ = nearest.point_b;
}

template <typename S>
void MeshDistanceTraversalNode<S>::postprocess() {
  if (tri1_ < 0) return;
  if (this->request.enable_nearest_points) {
    this->result->update(best_, this->model1, this->model2, tri1_, tri2_,
                         detail::transform<S>(this->tf1, point1_),
                         detail::transform<S>(this->tf1, point2_));
  } else {
    this->result->update(best_, this->model1, this->model2, tri1_, tri2_);
  }
}

template <typename S>
bool initialize(MeshCollisionTraversalNode<S>& node, const Model<S>& model1,
                const fcl::Transform3<S>& tf1, const Model<S>& model2,
                const fcl::Transform3<S>& tf2, const fcl::CollisionRequest<S>& request,
                fcl::CollisionResult<S>& result) {
  connect(node, model1, tf1, model2, tf2, request, result);
  node.cost_density = model1.cost_density * model2.cost_density;
  return true;
}

template <typename S>
bool initialize(MeshDistanceTraversalNode<S>& node, const Model<S>& model1,
                const fcl::Transform3<S>& tf1, const Model<S>& model2,
                const fcl::Transform3<S>& tf2, const fcl::DistanceRequest<S>& request,
                fcl::DistanceResult<S>& result) {
  requireErrorBounds(request);
  connect(node, model1, tf1, model2, tf2, request, result);
  node.rel_err = request.rel_err;
  node.abs_err = request.abs_err;
  return true;
}

#define KIOS_INSTANTIATE(S)                                                                       \
  template class MeshCollisionTraversalNode<S>;                                                   \
  template class MeshDistanceTraversalNode<S>;                                                    \
  template bool initialize(MeshCollisionTraversalNode<S>&, const Model<S>&,                       \
                           const fcl::Transform3<S>&, const Model<S>&, const fcl::Transform3<S>&, \
                           const fcl::CollisionRequest<S>&, fcl::CollisionResult<S>&);            \
  template bool initialize(MeshDistanceTraversalNode<S>&, const Model<S>&,                        \
                           const fcl::Transform3<S>&, const Model<S>&, const fcl::Transform3<S>&, \
                           const fcl::DistanceRequest<S>&, fcl::DistanceResult<S>&);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
