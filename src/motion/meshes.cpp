// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/meshes.h"

#include <utility>

#include "fcl_kios/query/mesh_queries.h"
#include "fcl_kios/triangle/distance.h"
#include "model/prepared.h"
#include "query/bracket.h"
#include "query/mesh_pair.h"
#include "volume/balls.h"

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

// By the engine, as soon as it has paid to prepare both models.
double MovingMeshes::wholeApart(double t, const RelativeVelocities& v) {
  const long long tests = counts_.volume_tests + 4 * counts_.leaf_tests;
  const long long more = tests - std::exchange(spent_, tests);
  bool paid = true;
  for (const Modeld* model : {&a_, &b_}) {
    engine::TreeCache* const trees = treesOf(*model);
    if (!trees) return 0;
    trees->spend(more);
    paid &= trees->testsToSpare(static_cast<std::size_t>(model->num_tris)) == 0;
  }
  if (!paid) return 0;
  const PairFrame<double> frame(a_, motion_.a().pose(t), b_, motion_.b().pose(t));
  engine::PairQuery query;
  query.rel_err = 0.05;
  query.start = nearest_;
  const DistanceAnswer<double> answer = bracketDistance(frame, query);
  nearest_ = {answer.triangle_a, answer.triangle_b};
  const kIOSd &a = frame.rootA(), &b = frame.rootB();
  return v.apartTime(v.ballOfA(a.center0, a.radius0),
                     v.ballOfB(v.pose() * b.center0, b.radius0 * (1 + v.stretch())),
                     answer.lower_bound);
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
  const double stretch = 1 + v.stretch();
  const MovingBall central_a = v.ballOfA(a.center0, a.radius0);
  const MovingBall central_b = v.ballOfB(v.pose() * b.center0, b.radius0 * stretch);
  if (v.apart(central_a, central_b, duration)) return true;
  // All other pairs of spheres; caps that k doesn't count repeat the central sphere.
  if (a.k() == 1 && b.k() == 1) return false;
  const auto capsOf = [](const kIOSd& bv, const Eigen::Matrix3d& R, const Vector3d& center,
                         Eigen::Array4d* caps) {
    const double unit = scaled(1.0, bv.exponent);
    const Eigen::Array4d x = Eigen::Map<const Eigen::Array4f>(bv.cap_x).cast<double>() * unit;
    const Eigen::Array4d y = Eigen::Map<const Eigen::Array4f>(bv.cap_y).cast<double>() * unit;
    const Eigen::Array4d z = Eigen::Map<const Eigen::Array4f>(bv.cap_z).cast<double>() * unit;
    for (int c = 0; c < 3; ++c) caps[c] = R(c, 0) * x + R(c, 1) * y + R(c, 2) * z + center[c];
    return Eigen::Array4d(Eigen::Map<const Eigen::Array4f>(bv.cap_r).cast<double>() * unit);
  };
  Eigen::Array4d centers[3];
  const Eigen::Array4d radii_b = capsOf(b, v.pose().R(), central_b.center, centers) * stretch;
  const FourBalls caps_b = v.ballsOfB(centers, radii_b);
  if (v.anyApart(central_a, caps_b, duration)) return true;
  const Eigen::Array4d radii_a = capsOf(a, Eigen::Matrix3d::Identity(), a.center0, centers);
  const FourBalls caps_a = v.ballsOfA(centers, radii_a);
  if (v.anyApart(central_b, caps_a, duration)) return true;
  for (int i = 0; i < a.k() - 1; ++i) {
    const MovingBall cap = {{caps_a.center[0][i], caps_a.center[1][i], caps_a.center[2][i]},
                            caps_a.radius[i],
                            {caps_a.velocity[0][i], caps_a.velocity[1][i], caps_a.velocity[2][i]},
                            caps_a.acceleration[i]};
    if (v.anyApart(cap, caps_b, duration)) return true;
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
  double best =
      v.apartTime(v.ballOfA(a.center0, a.radius0),
                  v.ballOfB(v.pose() * b.center0, b.radius0 * (1 + v.stretch())), nearest.distance);
  const Vector3d witness = (nearest.point_b - nearest.point_a).stableNormalized();
  if (best < enough) best = std::max(best, v.slabTime(witness, p, q));
  // The slab that lasts longest need not be the widest one: a body that slides along a face stays
  // on its side of it, and a body that passes an edge stays on its side of a plane through the edge
  // and the velocity.
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
