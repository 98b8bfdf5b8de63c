// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/meshes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "continuous/heights.h"
#include "fcl_kios/triangle/distance.h"
#include "model/prepared.h"
#include "query/bracket.h"
#include "solid/mesh_and_other.h"
#include "volume/balls.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::continuous {
namespace {

using Eigen::Vector3d;

/// Holds the directions of a triangle's edges and of its normal.
struct Edges {
  explicit Edges(const TriangleVertices<double>& t)
      : along{t[1] - t[0], t[2] - t[1], t[0] - t[2]}, normal(along[0].cross(along[1])) {
    for (Vector3d& edge : along) edge = unitVector(edge);
    normal = unitVector(normal);
  }
  Vector3d along[3], normal;
};

/// Returns the central sphere of a volume of A's, or of B's, in frame A.
MovingBall centralOfA(const kIOSd& bv, const RelativeVelocities& v) {
  return movingBall(v.a(), bv.center0, bv.radius0);
}
MovingBall centralOfB(const kIOSd& bv, const RelativeVelocities& v) {
  return movingBall(v.b(), v.pose() * bv.center0, bv.radius0 * (1 + v.stretch()));
}

/// The caps of a volume that is turned by R, its centre at `center`; their radii are returned. Caps
/// that k doesn't count repeat the central sphere.
Eigen::Array4d capsOf(const kIOSd& bv, const Eigen::Matrix3d& R, const Vector3d& center,
                      Eigen::Array4d* caps) {
  const double unit = scaled(1.0, bv.exponent);
  const Eigen::Array4d x = Eigen::Map<const Eigen::Array4f>(bv.cap_x).cast<double>() * unit;
  const Eigen::Array4d y = Eigen::Map<const Eigen::Array4f>(bv.cap_y).cast<double>() * unit;
  const Eigen::Array4d z = Eigen::Map<const Eigen::Array4f>(bv.cap_z).cast<double>() * unit;
  for (int c = 0; c < 3; ++c) caps[c] = R(c, 0) * x + R(c, 1) * y + R(c, 2) * z + center[c];
  return Eigen::Map<const Eigen::Array4f>(bv.cap_r).cast<double>() * unit;
}

/// True if any pair of spheres with a cap in it is proven apart; a has `k` spheres.
bool capsApart(int k, const MovingBall& central_a, const FourBalls& caps_a,
               const MovingBall& central_b, const FourBalls& caps_b, const RelativeVelocities& v,
               double duration) {
  if (v.anyApart(central_a, caps_b, duration) || v.anyApart(central_b, caps_a, duration)) {
    return true;
  }
  for (int i = 0; i < k - 1; ++i) {
    const MovingBall cap = {{caps_a.center[0][i], caps_a.center[1][i], caps_a.center[2][i]},
                            caps_a.radius[i],
                            {caps_a.velocity[0][i], caps_a.velocity[1][i], caps_a.velocity[2][i]},
                            caps_a.acceleration[i]};
    if (v.anyApart(cap, caps_b, duration)) return true;
  }
  return false;
}

}  // namespace

bool MovingMeshes::touching(double t) {
  const fcl::Transform3d X_WA = motion_.a().pose(t), X_WB = motion_.b().pose(t);
  return MeshAndOther<double>{a_, X_WA, b_, X_WB, &b_}.touch();
}

// By the engine, as soon as it has paid to prepare both models.
double MovingMeshes::wholeApart(double t, const RelativeVelocities& v) {
  time_ = t;
  chords_.forget();
  order_ = static_cast<Order>(std::max_element(worth_, worth_ + kOrders) - worth_);
  const long long tests = counts_.volume_tests + 4 * counts_.leaf_tests;
  const long long more = tests - std::exchange(spent_, tests);
  bool paid = true;
  for (const Modeld* model : {&a_, &b_}) {
    engine::TreeCache* const trees = treesOf(*model);
    if (!trees) return 0;
    trees->budget.charge(more);
    paid &= trees->budget.remaining(model->num_tris) == 0;
  }
  if (!paid) return 0;
  const MeshPair<double> frame(a_, motion_.a().pose(t), b_, motion_.b().pose(t));
  engine::PairQuery query;
  query.rel_err = 0.05;
  query.start = nearest_;
  const DistanceAnswer<double> answer = bracketDistance(frame, query);
  nearest_ = {answer.triangle_a, answer.triangle_b};
  return v.apartTime(centralOfA(frame.rootA(), v), centralOfB(frame.rootB(), v),
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
  const bool splits_a =
      order_ == Order::kLarger ? a.bv.radius0 > b.bv.radius0 : order_ == Order::kA;
  if (b.isLeaf() || (!a.isLeaf() && splits_a)) {
    near.a = a.leftChild();
    far.a = a.rightChild();
  } else {
    near.b = b.leftChild();
    far.b = b.rightChild();
  }
  if (centersGap(far, v) < centersGap(near, v)) std::swap(near, far);
  return 2;
}

bool MovingMeshes::changeOrder(double way, long long cost) {
  constexpr int kAgain = 32;
  if (++spent_in_vain_ % kAgain == 0) std::fill_n(worth_, kOrders, -1);
  noteStep(0.5 * way, cost);
  double* const unknown = std::find_if(worth_, worth_ + kOrders, [](double w) { return w < 0; });
  if (unknown == worth_ + kOrders) return false;
  order_ = static_cast<Order>(unknown - worth_);
  return true;
}

void MovingMeshes::noteStep(double way, long long cost) {
  worth_[static_cast<int>(order_)] = way / static_cast<double>(cost + 1);
}

// Where bodies hardly turn, velocities tell as much and round less.
bool MovingMeshes::useChords(const RelativeVelocities& v, double duration) {
  constexpr double kTurn = 0x1p-3;
  if (!(duration * v.turn() > kTurn)) return false;
  if (chords_.duration() != duration) chords_.set(motion_, time_, duration);
  return true;
}

bool MovingMeshes::nodesStayApart(NodePair pair, const RelativeVelocities& v) const {
  constexpr int kEnds = Chords::kParts + 1;
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  const Vector3d center_b = v.pose() * b.center0;
  Vector3d centers_a[kEnds], centers_b[kEnds];
  const auto place = [&](int i) {
    centers_a[i] = chords_.ofA(i).R * a.center0 + chords_.ofA(i).T;
    centers_b[i] = chords_.ofB(i).R * b.center0 + chords_.ofB(i).T;
  };
  place(0);
  place(kEnds - 1);
  const double far_a = a.center0.lpNorm<1>() + a.radius0, far_b = b.center0.lpNorm<1>() + b.radius0;
  const double sagitta_a = chords_.sagitta(v.a().acceleration(a.center0), far_a),
               sagitta_b = chords_.sagitta(v.b().acceleration(center_b), far_b);
  // By one chord first: its sagitta is that of a part times the square of their number.
  constexpr double kWhole = Chords::kParts * Chords::kParts;
  if (v.apart(Chords::alongChord(centers_a[0], centers_a[kEnds - 1], a.radius0, kWhole * sagitta_a),
              Chords::alongChord(centers_b[0], centers_b[kEnds - 1], b.radius0, kWhole * sagitta_b),
              1)) {
    return true;
  }
  for (int i = 1; i < kEnds - 1; ++i) place(i);
  unsigned int open = 0;
  for (int i = 0; i < Chords::kParts; ++i) {
    if (v.apart(Chords::alongChord(centers_a[i], centers_a[i + 1], a.radius0, sagitta_a),
                Chords::alongChord(centers_b[i], centers_b[i + 1], b.radius0, sagitta_b), 1)) {
      continue;
    }
    open |= 1U << i;
  }
  if (open == 0) return true;
  if (a.k() == 1 && b.k() == 1) return false;
  const double reach_a = scaled(double{a.reach}, a.exponent),
               reach_b = scaled(double{b.reach}, b.exponent);
  const double caps_sagitta_a =
      chords_.sagitta(v.a().acceleration(a.center0, reach_a), far_a + 2 * reach_a);
  const double caps_sagitta_b =
      chords_.sagitta(v.b().acceleration(center_b, reach_b), far_b + 2 * reach_b);
  const auto capsAlong = [](const kIOSd& bv, const Chords::Place& from, const Vector3d& center_from,
                            const Chords::Place& to, const Vector3d& center_to, double sagitta) {
    FourBalls caps;
    caps.radius = capsOf(bv, from.R, center_from, caps.center);
    capsOf(bv, to.R, center_to, caps.velocity);
    for (int c = 0; c < 3; ++c) caps.velocity[c] -= caps.center[c];
    caps.acceleration = Eigen::Array4d::Constant(2 * sagitta);
    return caps;
  };
  for (int i = 0; i < Chords::kParts; ++i) {
    if ((open >> i & 1U) == 0) continue;
    const FourBalls caps_a = capsAlong(a, chords_.ofA(i), centers_a[i], chords_.ofA(i + 1),
                                       centers_a[i + 1], caps_sagitta_a),
                    caps_b = capsAlong(b, chords_.ofB(i), centers_b[i], chords_.ofB(i + 1),
                                       centers_b[i + 1], caps_sagitta_b);
    if (!capsApart(a.k(), Chords::alongChord(centers_a[i], centers_a[i + 1], a.radius0, sagitta_a),
                   caps_a, Chords::alongChord(centers_b[i], centers_b[i + 1], b.radius0, sagitta_b),
                   caps_b, v, 1)) {
      return false;
    }
  }
  return true;
}

// The nearest points at the ends of a part, and the faces' normals, propose slabs.
bool MovingMeshes::leavesStayApart(NodePair pair, const RelativeVelocities& v) const {
  const Chords::Triangles triangles(chords_, cornersOf(a_, a_.getBV(pair.a).primitiveId()),
                                    cornersOf(b_, b_.getBV(pair.b).primitiveId()));
  for (int part = 0; part < Chords::kParts; ++part) {
    const auto stays = [&](const Vector3d& n) {
      const Vector3d unit = unitVector(n);
      return unit.squaredNorm() > 0 && (chords_.slabStays(v, triangles, part, unit) ||
                                        chords_.slabStays(v, triangles, part, -unit));
    };
    const auto &p = triangles.of_a[part], &q = triangles.of_b[part];
    const TriangleDistance<double> nearest = triangleDistance(p, q);
    if (!(nearest.distance > 0)) return false;
    if (!stays(nearest.point_b - nearest.point_a) && !stays((p[1] - p[0]).cross(p[2] - p[0])) &&
        !stays((q[1] - q[0]).cross(q[2] - q[0]))) {
      return false;
    }
  }
  return true;
}

// What is long and thin fits balls badly, but lies on one side of its own plane, as whatever slides
// along it does.
bool MovingMeshes::planeParts(NodePair pair, const RelativeVelocities& v, double duration) const {
  const auto &a = a_.getBV(pair.a), &b = b_.getBV(pair.b);
  const Eigen::Matrix3d own = Eigen::Matrix3d::Identity(), R = v.pose().R();
  const Vector3d zero = Vector3d::Zero(), T = v.pose().T();
  const double lengths = T.lpNorm<1>() + a_.getBV(0).bv.center0.lpNorm<1>() +
                         a_.getBV(0).bv.radius0 + b_.getBV(0).bv.center0.lpNorm<1>() +
                         b_.getBV(0).bv.radius0;
  const double least = v.pad() + 0x1p-46 * (1 + duration * (v.turn() + 1)) * lengths +
                       (v.stretch() + 0x1p-48) * (a.bv.radius0 + b.bv.radius0);
  // Bounds how far a's points get along n, and b's against it.
  const auto parts = [&](const Vector3d& n) {
    const Heights of_a(v.a(), own, zero, n, duration), of_b(v.b(), R, T, -n, duration);
    int nodes_left = order_ == Order::kLarger ? 48 : 512;
    Heights::Height limit = {-kInfinity, -kInfinity};
    const auto highest = [&limit](const Heights& heights, const Modeld& model, int triangle) {
      for (const Vector3d& corner : cornersOf(model, triangle)) {
        const Heights::Height height = heights.of(corner);
        limit = {std::max(limit.start, height.start), std::max(limit.end, height.end)};
      }
    };
    if (a.isLeaf()) {
      highest(of_a, a_, a.primitiveId());
      return of_b.below(b_, pair.b, {-limit.start - least, -limit.end - least}, nodes_left);
    }
    highest(of_b, b_, b.primitiveId());
    return of_a.below(a_, pair.a, {-limit.start - least, -limit.end - least}, nodes_left);
  };
  const auto facesPart = [&](const Modeld& model, int triangle, const Eigen::Matrix3d& R_AM) {
    const Edges edges(cornersOf(model, triangle));
    const auto partsAcross = [&](const Vector3d& direction) {
      const Vector3d n = R_AM * direction;
      return n.squaredNorm() > 0.5 && (parts(n) || parts(-n));
    };
    if (partsAcross(edges.normal)) return true;
    return order_ != Order::kLarger &&
           std::any_of(std::begin(edges.along), std::end(edges.along),
                       [&](const Vector3d& edge) { return partsAcross(edge.cross(edges.normal)); });
  };
  return (a.isLeaf() && facesPart(a_, a.primitiveId(), own)) ||
         (b.isLeaf() && facesPart(b_, b.primitiveId(), R));
}

bool MovingMeshes::nodesApart(NodePair pair, const RelativeVelocities& v, double duration) {
  if (useChords(v, duration)) return nodesStayApart(pair, v);
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  const MovingBall central_a = centralOfA(a, v), central_b = centralOfB(b, v);
  if (v.apart(central_a, central_b, duration)) return true;
  if (a.k() > 1 || b.k() > 1) {
    Eigen::Array4d centers[3];
    const Eigen::Array4d radii_b =
        capsOf(b, v.pose().R(), central_b.center, centers) * (1 + v.stretch());
    const FourBalls caps_b = movingBalls(v.b(), centers, radii_b);
    const Eigen::Array4d radii_a = capsOf(a, Eigen::Matrix3d::Identity(), a.center0, centers);
    const FourBalls caps_a = movingBalls(v.a(), centers, radii_a);
    if (capsApart(a.k(), central_a, caps_a, central_b, caps_b, v, duration)) return true;
  }
  return (a_.getBV(pair.a).isLeaf() || b_.getBV(pair.b).isLeaf()) && planeParts(pair, v, duration);
}

double MovingMeshes::leavesApart(NodePair pair, const RelativeVelocities& v, double required) {
  const auto p = cornersOf(a_, a_.getBV(pair.a).primitiveId());
  const auto q = transformed(cornersOf(b_, b_.getBV(pair.b).primitiveId()), v.pose());
  const TriangleDistance<double> nearest = triangleDistance(p, q);
  if (!(nearest.distance > 0)) return 0;
  if (useChords(v, required) && leavesStayApart(pair, v)) return required;
  // The distance is off by 32 u of the pair's extent, which the pad for rounding covers.
  double best = v.apartTime(centralOfA(a_.getBV(pair.a).bv, v), centralOfB(b_.getBV(pair.b).bv, v),
                            nearest.distance);
  const Vector3d witness = unitVector(nearest.point_b - nearest.point_a);
  if (best < required) best = std::max(best, v.slabTime(witness, p, q, required));
  // The slab that lasts longest need not be the widest one: a body that slides along a face stays
  // on its side of it, and a body that passes an edge stays on its side of a plane through the edge
  // and the velocity.
  const auto attempt = [&](const Vector3d& normal) {
    if (best >= required) return;
    const Vector3d n = unitVector(normal);
    best = std::max(best, v.slabTime(n.dot(witness) >= 0 ? n : Vector3d(-n), p, q, required));
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
