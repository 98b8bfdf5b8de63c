// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/fcl_nodes.h"

#include <algorithm>
#include <limits>

#include "fcl_kios/triangle.h"
#include "query/mesh_contacts.h"
#include "volume/rounding.h"

namespace kios {
namespace {

template <typename Node, typename S, typename Request, typename Result>
void connect(Node& node, const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
             const fcl::Transform3<S>& X_WB, const Request& request, Result& result) {
  requireFinished(a);
  requireFinished(b);
  node.model1 = &a;
  node.model2 = &b;
  node.vertices1 = a.vertices;
  node.vertices2 = b.vertices;
  node.tri_indices1 = a.tri_indices;
  node.tri_indices2 = b.tri_indices;
  node.tf1 = X_WA;
  node.tf2 = X_WB;
  node.request = request;
  node.result = &result;
  node.X_AB.emplace(X_WA, X_WB);
}

}  // namespace

template <typename S>
bool MeshCollisionTraversalNode<S>::BVTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_bv_tests++;
  return separation(this->model1->getBV(b1).bv, this->model2->getBV(b2).bv, *X_AB, 0.0) > 0;
}

template <typename S>
void MeshCollisionTraversalNode<S>::leafTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_leaf_tests++;
  const auto& request = this->request;
  auto& result = *this->result;
  const auto& a = *this->model1;
  const auto& b = *this->model2;
  const Reports<S> reports(a, b, request);
  if (!reports.contacts && !reports.costs) return;

  const int id_a = a.getBV(b1).primitiveId(), id_b = b.getBV(b2).primitiveId();
  const auto p = cornersInDouble(a, id_a), q = transformed(cornersInDouble(b, id_b), *X_AB);
  if (!trianglesIntersect(p, q)) return;
  addReports(reports, a, id_a, p, this->tf1, b, id_b, q, this->tf2, request, result);
}

template <typename S>
void MeshDistanceTraversalNode<S>::lowerTo(S distance) const {
  best_ = prune_at_ = distance;
  if (!(distance < std::numeric_limits<S>::max())) return;  // no bound, and nothing found yet
  prune_at_ = roundedTo<S>(engine::cullDistance(distance, this->rel_err, this->abs_err));
}

template <typename S>
void MeshDistanceTraversalNode<S>::preprocess() {
  triangle_a_ = triangle_b_ = -1;
  lowerTo(this->result->min_distance);
}

template <typename S>
S MeshDistanceTraversalNode<S>::BVTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_bv_tests++;
  return roundedTo<S>(
      separation(this->model1->getBV(b1).bv, this->model2->getBV(b2).bv, *X_AB, double{prune_at_}));
}

template <typename S>
bool MeshDistanceTraversalNode<S>::canStop(S bound) const {
  return std::max(bound, S(0)) >= prune_at_;
}

template <typename S>
void MeshDistanceTraversalNode<S>::leafTesting(int b1, int b2) const {
  if (this->enable_statistics) this->num_leaf_tests++;
  const int id_a = this->model1->getBV(b1).primitiveId();
  const int id_b = this->model2->getBV(b2).primitiveId();
  const auto p = cornersInDouble(*this->model1, id_a);
  const auto q = transformed(cornersInDouble(*this->model2, id_b), *X_AB);
  const TriangleDistanced nearest = triangleDistance(p, q);
  const S distance = roundedLength<S>(nearest.distance);
  if (!(distance < best_)) return;
  lowerTo(distance);
  triangle_a_ = id_a;
  triangle_b_ = id_b;
  point_a_ = nearest.point_a;
  point_b_ = nearest.point_b;
}

template <typename S>
void MeshDistanceTraversalNode<S>::postprocess() {
  if (triangle_a_ < 0) return;
  if (this->request.enable_nearest_points) {
    this->result->update(best_, this->model1, this->model2, triangle_a_, triangle_b_,
                         toWorld<S>(this->tf1, point_a_), toWorld<S>(this->tf1, point_b_));
  } else {
    this->result->update(best_, this->model1, this->model2, triangle_a_, triangle_b_);
  }
}

template <typename S>
bool initialize(MeshCollisionTraversalNode<S>& node, const Model<S>& a,
                const fcl::Transform3<S>& X_WA, const Model<S>& b, const fcl::Transform3<S>& X_WB,
                const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  connect(node, a, X_WA, b, X_WB, request, result);
  node.cost_density = a.cost_density * b.cost_density;
  return true;
}

template <typename S>
bool initialize(MeshDistanceTraversalNode<S>& node, const Model<S>& a,
                const fcl::Transform3<S>& X_WA, const Model<S>& b, const fcl::Transform3<S>& X_WB,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  requireErrorBounds(request);
  connect(node, a, X_WA, b, X_WB, request, result);
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
