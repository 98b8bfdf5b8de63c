// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/meshes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "continuous/tuning.h"
#include "continuous/velocity_field.h"
#include "fcl_kios/triangle.h"
#include "model/prepared.h"
#include "search/mesh_pair.h"
#include "volume/balls.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::continuous {
namespace {

using Eigen::Vector3d;

Vector3d normalOf(const TriangleVertices<double>& t) {
  return unitVector(unitVector(t[1] - t[0]).cross(unitVector(t[2] - t[1])));
}

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

/// The spheres of a volume along the chords of its body.
class AlongChords {
 public:
  using PlaceOf = const Chords::Place& (Chords::*)(int) const;
  AlongChords(const Chords& chords, PlaceOf place_of, const kIOSd& bv, const VelocityField& field)
      : chords_(chords), place_of_(place_of), bv_(bv) {
    const double far = bv.center0.lpNorm<1>() + bv.radius0;
    const double reach = scaled(double{bv.reach}, bv.exponent);
    sagitta_ = chords.sagitta(field.acceleration(center(0)), far);
    caps_sagitta_ = chords.sagitta(field.acceleration(center(0), reach), far + 2 * reach);
  }
  MovingBall central(int part) const {
    return Chords::alongChord(center(part), center(part + 1), bv_.radius0, sagitta_);
  }
  FourBalls caps(int part) const {
    FourBalls caps;
    caps.radius = capsOf(bv_, place(part).R, center(part), caps.center);
    capsOf(bv_, place(part + 1).R, center(part + 1), caps.velocity);
    for (int c = 0; c < 3; ++c) caps.velocity[c] -= caps.center[c];
    caps.acceleration = Eigen::Array4d::Constant(2 * caps_sagitta_);
    return caps;
  }

 private:
  const Chords::Place& place(int end) const { return (chords_.*place_of_)(end); }
  Vector3d center(int end) const { return place(end).R * bv_.center0 + place(end).T; }

  const Chords& chords_;
  const PlaceOf place_of_;
  const kIOSd& bv_;
  double sagitta_, caps_sagitta_;
};

/// Says how high the points of a moving body lie along a direction n, at the start of a time and at
/// its end. Between them a point lies at most as high as on the line between both heights, since
/// that at the end takes the largest acceleration along n for granted all the time.
class Heights {
 public:
  /// n is of length 1, and it and the velocities are in one frame, in which the body lies at R, T.
  Heights(const VelocityField& field, const Eigen::Matrix3d& R, const Eigen::Vector3d& T,
          const Eigen::Vector3d& n, double duration);

  struct Height {
    double start, end;
  };
  /// Returns the height of a point of the body, in its own frame.
  Height of(const Eigen::Vector3d& y) const {
    return {n_[0].dot(y) + offset_[0], n_[1].dot(y) + offset_[1] + sagitta(y, 0)};
  }
  /// Returns true if all triangles under a node of the body's tree are proven to stay as low, at
  /// the start and at the end. Gives up after `nodes_left` nodes, which is then 0 or less.
  bool below(const Modeld& model, int node, const Height& limit, int& nodes_left) const;

 private:
  double sagitta(const Eigen::Vector3d& y, double radius) const {
    if (!accelerates_) return 0;
    return half_square_ * field_.accelerationAlong(direction_, R_ * y + T_, radius);
  }

  const VelocityField& field_;
  const Eigen::Matrix3d& R_;
  const Eigen::Vector3d& T_;
  const Eigen::Vector3d direction_;
  Eigen::Vector3d n_[2];  // in the body's frame
  double length_[2], offset_[2];
  double half_square_;
  bool accelerates_;
};

// n (w x r) = (n x w) r
Heights::Heights(const VelocityField& field, const Eigen::Matrix3d& R, const Vector3d& T,
                 const Vector3d& n, double duration)
    : field_(field),
      R_(R),
      T_(T),
      direction_(n),
      half_square_(0.5 * duration * duration * (1 + 0x1p-48)),
      accelerates_(field.turn_acceleration > 0 || field.originAcceleration() > 0) {
  const Vector3d turn = n.cross(field.angular), last = n + duration * turn;
  n_[0].noalias() = R.transpose() * n;
  n_[1].noalias() = R.transpose() * last;
  offset_[0] = n.dot(T);
  offset_[1] = last.dot(T) + duration * (n.dot(field.linear) - turn.dot(field.origin));
  for (int i = 0; i < 2; ++i) length_[i] = n_[i].norm() * (1 + 0x1p-48);
}

bool Heights::below(const Modeld& model, int node, const Height& limit, int& nodes_left) const {
  if (--nodes_left <= 0) return false;
  const auto& entry = model.getBV(node);
  if (entry.isLeaf()) {
    const fcl::Triangle& t = model.tri_indices[entry.primitiveId()];
    for (int k = 0; k < 3; ++k) {
      const Height height = of(model.vertices[t[k]]);
      if (!(height.start <= limit.start && height.end <= limit.end)) return false;
    }
    return true;
  }
  const kIOSd& bv = entry.bv;
  Ball balls[kIOSd::kMaxSpheres];
  const int k = toBalls(bv, {bv.center0[0], bv.center0[1], bv.center0[2]}, 0, balls);
  const double leaves = sagitta(bv.center0, bv.radius0);
  for (int i = 0; i < k; ++i) {
    const Vector3d center(balls[i].x, balls[i].y, balls[i].z);
    if (n_[0].dot(center) + offset_[0] + length_[0] * balls[i].r <= limit.start &&
        n_[1].dot(center) + offset_[1] + leaves + length_[1] * balls[i].r <= limit.end) {
      return true;
    }
  }
  return below(model, entry.leftChild(), limit, nodes_left) &&
         below(model, entry.rightChild(), limit, nodes_left);
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

void MovingMeshes::beginStep(double t) {
  time_ = t;
  chords_.forget();
  order_ = static_cast<Order>(std::max_element(worth_, worth_ + kOrders) - worth_);
}

double MovingMeshes::centersGap(NodePair pair, const RelativeVelocities& v) const {
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  return (v.pose() * b.center0 - a.center0).norm() - a.radius0 - b.radius0;
}

int MovingMeshes::split(NodePair pair, const RelativeVelocities& v, NodePair* parts) {
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
  noteStep(0.5 * way, cost);
  double* const unknown = std::find_if(worth_, worth_ + kOrders, [](double w) { return w == 0; });
  if (unknown == worth_ + kOrders) return false;
  order_ = static_cast<Order>(unknown - worth_);
  return true;
}

void MovingMeshes::noteStep(double way, long long cost) {
  const auto spent = static_cast<double>(cost + 1);
  worth_[static_cast<int>(order_)] = way > 0 ? way / spent : -spent;
}

// Where bodies hardly turn, velocities tell as much and round less.
bool MovingMeshes::useChords(const RelativeVelocities& v, double duration) {
  if (!(duration * v.turn() > tuning::kTurnForChords)) return false;
  if (chords_.duration() != duration) chords_.set(motion_, time_, duration);
  return true;
}

bool MovingMeshes::nodesStayApart(NodePair pair, const RelativeVelocities& v) const {
  const kIOSd &a = a_.getBV(pair.a).bv, &b = b_.getBV(pair.b).bv;
  const AlongChords of_a(chords_, &Chords::ofA, a, v.a()), of_b(chords_, &Chords::ofB, b, v.b());
  for (int i = 0; i < Chords::kParts; ++i) {
    const MovingBall central_a = of_a.central(i), central_b = of_b.central(i);
    if (v.apart(central_a, central_b, 1)) continue;
    if (a.k() == 1 && b.k() == 1) return false;
    if (!capsApart(a.k(), central_a, of_a.caps(i), central_b, of_b.caps(i), v, 1)) return false;
  }
  return true;
}

// What is long and thin fits balls badly, but lies on one side of its own plane, as whatever slides
// along it does.
bool MovingMeshes::planeParts(NodePair pair, const RelativeVelocities& v, double duration) {
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
    const int most = order_ == Order::kLarger ? tuning::kNodesOfPlane : tuning::kNodesOfPlaneInHole;
    int nodes_left = most;
    Heights::Height limit = {-kInfinity, -kInfinity};
    const auto highest = [&limit](const Heights& heights, const Modeld& model, int triangle) {
      for (const Vector3d& corner : cornersInDouble(model, triangle)) {
        const Heights::Height height = heights.of(corner);
        limit = {std::max(limit.start, height.start), std::max(limit.end, height.end)};
      }
    };
    if (a.isLeaf()) {
      highest(of_a, a_, a.primitiveId());
    } else {
      highest(of_b, b_, b.primitiveId());
    }
    const Heights::Height below = {-limit.start - least, -limit.end - least};
    const bool part = a.isLeaf() ? of_b.below(b_, pair.b, below, nodes_left)
                                 : of_a.below(a_, pair.a, below, nodes_left);
    // To set up both heights takes as long as half a test.
    visits_ += tuning::kTestsOfMoving / 2 + most - nodes_left;
    return part;
  };
  const auto facesPart = [&](const Modeld& model, int triangle, const Eigen::Matrix3d& R_AM) {
    const auto t = cornersInDouble(model, triangle);
    const Vector3d normal = normalOf(t);
    const auto partsAcross = [&](const Vector3d& direction) {
      const Vector3d n = R_AM * direction;
      return n.squaredNorm() > 0.5 && (parts(n) || parts(-n));
    };
    if (partsAcross(normal)) return true;
    for (int k = 0; k < 3 && order_ != Order::kLarger; ++k) {
      if (partsAcross(unitVector(t[(k + 1) % 3] - t[k]).cross(normal))) return true;
    }
    return false;
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
  const auto p = cornersInDouble(a_, a_.getBV(pair.a).primitiveId());
  const auto q = transformed(cornersInDouble(b_, b_.getBV(pair.b).primitiveId()), v.pose());
  const TriangleDistance<double> nearest = triangleDistance(p, q);
  if (!(nearest.distance > 0)) return 0;
  // The distance is off by 32 u of the pair's extent, which the pad for rounding covers.
  double best = v.apartTime(centralOfA(a_.getBV(pair.a).bv, v), centralOfB(b_.getBV(pair.b).bv, v),
                            nearest.distance);
  const Vector3d witness = unitVector(nearest.point_b - nearest.point_a);
  const auto support = [&p](const Vector3d& m) {
    return std::max({m.dot(p[0]), m.dot(p[1]), m.dot(p[2])});
  };
  const Vector3d center = (p[0] + p[1] + p[2]) / 3;
  double square = 0;
  for (const Vector3d& x : p) square = std::max(square, (x - center).squaredNorm());
  const double reach = std::sqrt(square) * (1 + 0x1p-48);
  const auto attempt = [&](const Vector3d& normal) {
    if (best >= required) return;
    const Vector3d n = unitVector(normal);
    best = std::max(best, v.slabTime(n.dot(witness) >= 0 ? n : Vector3d(-n), support, center, reach,
                                     q, v.pad()));
  };
  attempt(witness);
  if (best >= required) return best;
  // The slab that lasts longest need not be the widest one: a body that slides along a face stays
  // on its side of it, and a body that passes an edge stays on its side of a plane through the edge
  // and the velocity.
  const Vector3d velocity = v.velocityAt(0.5 * (nearest.point_a + nearest.point_b));
  const Vector3d normals[2] = {normalOf(p), normalOf(q)};
  for (const Vector3d& normal : normals) attempt(normal);
  for (int i = 0; i < 2 && best < required; ++i) {
    const auto& t = i == 0 ? p : q;
    for (int k = 0; k < 3; ++k) {
      const Vector3d edge = unitVector(t[(k + 1) % 3] - t[k]);
      attempt(edge.cross(velocity));
      attempt(edge.cross(normals[i]));
    }
  }
  return best;
}

}  // namespace kios::continuous
