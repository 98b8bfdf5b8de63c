// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/meshes.h"

#include <utility>

#include "bv/rounding.h"
#include "fcl/mesh_pair.h"
#include "fcl_kios/fcl/mesh_queries.h"
#include "fcl_kios/triangle/distance.h"

namespace kios::continuous {
namespace {

using Eigen::Vector3d;

/// Bound of the distance of the mesh's points from the origin of its frame.
double reachOf(const Modeld& model) {
  requireFinished(model);
  const kIOSd& root = model.getBV(0).bv;
  return (root.center0.norm() + root.radius0) * (1 + 0x1p-50);
}

/// Directions of a triangle's edges and of its normal.
struct Edges {
  explicit Edges(const TriangleVertices<double>& t)
      : along{t[1] - t[0], t[2] - t[1], t[0] - t[2]}, normal(along[0].cross(along[1])) {
    for (Vector3d& edge : along) edge = edge.stableNormalized();
    normal = normal.stableNormalized();
  }
  Vector3d along[3], normal;
};

/// The central sphere of a node of B in frame A.
Ball placed(const kIOSd& bv, const RelativePose<double>& X_AB) {
  return {X_AB * bv.center0, bv.radius0 * (1 + X_AB.stretch)};
}

}  // namespace

MovingMeshes::MovingMeshes(const Modeld& a, const Motion& motion_a, const Modeld& b,
                           const Motion& motion_b, ContinuousCounts& counts)
    : a_(a), b_(b), motion_(motion_a, motion_b, reachOf(a), reachOf(b)), counts_(counts) {}

bool MovingMeshes::touching(double t) {
  fcl::CollisionResultd result;
  return collideMeshes(a_, motion_.a().pose(t), b_, motion_.b().pose(t), fcl::CollisionRequestd(),
                       result) > 0;
}

double MovingMeshes::centersGap(NodePair pair, const RelativeVelocities& v) const {
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  return (v.pose() * b.center0 - a.center0).norm() - a.radius0 - b.radius0;
}

/// Descends to the nearer child each time.
MovingMeshes::NodePair MovingMeshes::leafPairNear(const RelativeVelocities& v) const {
  NodePair pair = {0, 0};
  for (;;) {
    const auto &a = a_.getBV(pair.a), &b = b_.getBV(pair.b);
    if (a.isLeaf() && b.isLeaf()) return pair;
    NodePair left = pair, right = pair;
    if (b.isLeaf() || (!a.isLeaf() && a.bv.radius0 > b.bv.radius0)) {
      left.a = a.leftChild();
      right.a = a.rightChild();
    } else {
      left.b = b.leftChild();
      right.b = b.rightChild();
    }
    pair = centersGap(left, v) <= centersGap(right, v) ? left : right;
  }
}

bool MovingMeshes::nodesApart(NodePair pair, const RelativeVelocities& v, double duration) {
  ++counts_.volume_tests;
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  const Ball ball_a = {a.center0, a.radius0}, ball_b = placed(b, v.pose());
  const double approach = v.approach(ball_a, ball_b, duration);
  const Vector3d between = ball_b.center - ball_a.center;
  const double length = between.norm(), gap = length - ball_a.radius - ball_b.radius;
  if (gap >= approach) return true;
  if (gap > 0 && v.apartAlong(between / length, ball_a, ball_b, gap, duration)) return true;
  return separation(a, b, v.pose(), approach) >= approach;
}

double MovingMeshes::trianglesApart(NodePair pair, const RelativeVelocities& v, double enough) {
  ++counts_.leaf_tests;
  const auto p = cornersOf(a_, a_.getBV(pair.a).primitiveId());
  const auto q = transformed(cornersOf(b_, b_.getBV(pair.b).primitiveId()), v.pose());
  const TriangleDistance<double> nearest = triangleDistance(p, q);
  if (!(nearest.distance > 0)) return 0;
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  const Ball ball_a = {a.center0, a.radius0}, ball_b = placed(b, v.pose());
  // The distance is off by 32 u of the pair's extent, which the pad for rounding covers.
  double best = v.apartTime(ball_a, ball_b, nearest.distance);
  const Vector3d witness = (nearest.point_b - nearest.point_a).stableNormalized();
  if (best < enough) best = std::max(best, v.slabTime(witness, p, q));
  // The slab that lasts longest need not be the widest one: what slides along a face stays on its
  // side of it, and what passes an edge on that side of a plane through the edge and the velocity.
  const auto attempt = [&](const Vector3d& normal) {
    if (best >= enough) return;
    const Vector3d n = normal.stableNormalized();
    best = std::max(best, v.slabTime(n.dot(witness) >= 0 ? n : Vector3d(-n), p, q));
  };
  const Edges edges_p(p), edges_q(q);
  attempt(edges_p.normal);
  attempt(edges_q.normal);
  const Vector3d velocity = v.velocityAt(0.5 * (nearest.point_a + nearest.point_b));
  for (const Edges* own : {&edges_p, &edges_q}) {
    for (const Vector3d& edge : own->along) attempt(edge.cross(velocity));
  }
  for (const Edges* own : {&edges_p, &edges_q}) {
    for (const Vector3d& edge : own->along) attempt(edge.cross(own->normal));
  }
  for (const Vector3d& edge_p : edges_p.along) {
    for (const Vector3d& edge_q : edges_q.along) attempt(edge_p.cross(edge_q));
  }
  return best;
}

double MovingMeshes::apartFor(double t) {
  if (motion_.still()) return 1;
  const double left = 1 - t;
  const double window = motion_.steady() ? left : std::min(left, window_);
  const RelativeVelocities v = motion_.at(t, window);

  // What ended the last step will probably end this one: a first upper bound of it.
  if (last_.a < 0) last_ = leafPairNear(v);
  double h = std::min(window, trianglesApart(last_, v, window));
  stack_.assign(1, {0, 0});
  while (!stack_.empty() && h > 0) {
    const NodePair pair = stack_.back();
    stack_.pop_back();
    if (nodesApart(pair, v, h)) continue;
    const auto &a = a_.getBV(pair.a), &b = b_.getBV(pair.b);
    if (a.isLeaf() && b.isLeaf()) {
      const double apart = trianglesApart(pair, v, h);
      if (apart < h) {
        h = apart;
        last_ = pair;
      }
      continue;
    }
    NodePair near = pair, far = pair;
    if (b.isLeaf() || (!a.isLeaf() && a.bv.radius0 > b.bv.radius0)) {
      near.a = a.leftChild();
      far.a = a.rightChild();
    } else {
      near.b = b.leftChild();
      far.b = b.rightChild();
    }
    if (centersGap(far, v) < centersGap(near, v)) std::swap(near, far);
    stack_.push_back(far);
    stack_.push_back(near);
  }
  window_ = std::min(1.0, 8 * h);
  return h;
}

}  // namespace kios::continuous
