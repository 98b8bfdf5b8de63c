// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/meshes.h"

#include <utility>

#include "bv/balls.h"
#include "fcl/mesh_pair.h"
#include "fcl_kios/fcl/mesh_queries.h"
#include "fcl_kios/triangle/distance.h"

namespace kios::continuous {
namespace {

using Eigen::Vector3d;

/// Directions of a triangle's edges and of its normal.
struct Edges {
  explicit Edges(const TriangleVertices<double>& t)
      : along{t[1] - t[0], t[2] - t[1], t[0] - t[2]}, normal(along[0].cross(along[1])) {
    for (Vector3d& edge : along) edge = edge.stableNormalized();
    normal = normal.stableNormalized();
  }
  Vector3d along[3], normal;
};

}  // namespace

bool MovingMeshes::touching(double t) {
  fcl::CollisionResultd result;
  return collideMeshes(a_, motion_.a().pose(t), b_, motion_.b().pose(t), fcl::CollisionRequestd(),
                       result) > 0;
}

double MovingMeshes::centersGap(NodePair pair, const RelativeVelocities& v) const {
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  return (v.pose() * b.center0 - a.center0).norm() - a.radius0 - b.radius0;
}

int MovingMeshes::split(NodePair pair, const RelativeVelocities& v, NodePair* parts) const {
  const auto &a = a_.getBV(pair.a), &b = b_.getBV(pair.b);
  if (a.isLeaf() && b.isLeaf()) return 0;
  NodePair &near = parts[0], &far = parts[1];
  near = far = pair;
  if (b.isLeaf() || (!a.isLeaf() && a.bv.radius0 > b.bv.radius0)) {
    near.a = a.leftChild();
    far.a = a.rightChild();
  } else {
    near.b = b.leftChild();
    far.b = b.rightChild();
  }
  if (centersGap(far, v) < centersGap(near, v)) std::swap(near, far);
  return 2;
}

bool MovingMeshes::nodesApart(NodePair pair, const RelativeVelocities& v, double duration) {
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  const double stretch = 1 + v.pose().stretch;
  const MovingBall central_a = v.ballOfA(a.center0, a.radius0);
  const MovingBall central_b = v.ballOfB(v.pose() * b.center0, b.radius0 * stretch);
  if (v.apart(central_a, central_b, duration)) return true;
  // All pairs of spheres, most of them off at the first glance.
  MovingBall caps_b[kIOSd::kCaps];
  const int num_a = a.k() - 1, num_b = b.k() - 1;
  for (int j = 0; j < num_b; ++j) {
    const double unit = scaled(1.0, b.exponent);
    const Vector3d cap(b.cap_x[j] * unit, b.cap_y[j] * unit, b.cap_z[j] * unit);
    caps_b[j] = v.ballOfB(central_b.center + v.pose().R * cap, b.cap_r[j] * unit * stretch);
    if (v.apart(central_a, caps_b[j], duration)) return true;
  }
  for (int i = 0; i < num_a; ++i) {
    const double unit = scaled(1.0, a.exponent);
    const Vector3d cap(a.cap_x[i] * unit, a.cap_y[i] * unit, a.cap_z[i] * unit);
    const MovingBall cap_a = v.ballOfA(a.center0 + cap, a.cap_r[i] * unit);
    if (v.apart(cap_a, central_b, duration)) return true;
    for (int j = 0; j < num_b; ++j) {
      if (v.apart(cap_a, caps_b[j], duration)) return true;
    }
  }
  return false;
}

double MovingMeshes::leavesApart(NodePair pair, const RelativeVelocities& v, double enough) {
  const auto p = cornersOf(a_, a_.getBV(pair.a).primitiveId());
  const auto q = transformed(cornersOf(b_, b_.getBV(pair.b).primitiveId()), v.pose());
  const TriangleDistance<double> nearest = triangleDistance(p, q);
  if (!(nearest.distance > 0)) return 0;
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  // The distance is off by 32 u of the pair's extent, which the pad for rounding covers.
  double best = v.apartTime(v.ballOfA(a.center0, a.radius0),
                            v.ballOfB(v.pose() * b.center0, b.radius0 * (1 + v.pose().stretch)),
                            nearest.distance);
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

}  // namespace kios::continuous
