// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/mesh_and_solids.h"

#include <algorithm>
#include <utility>

#include "model/prepared.h"
#include "search/mesh_pair.h"
#include "shape/triangle_shape.h"
#include "volume/balls.h"
#include "volume/errors.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::continuous {
namespace {

using Eigen::Vector3d;

/// The spheres of a node in the shape's frame; returns how many.
int spheresOf(const kIOSd& bv, const RelativePose<double>& X, Vector3d* centers, double* radii) {
  const double stretch = 1 + detail::boundsOf(X).stretch;
  Ball balls[kIOSd::kMaxSpheres];
  const int k = toBalls(bv, {bv.center0[0], bv.center0[1], bv.center0[2]}, 0, balls);
  for (int i = 0; i < k; ++i) {
    centers[i] = X * Vector3d(balls[i].x, balls[i].y, balls[i].z);
    radii[i] = balls[i].r * stretch;
  }
  return k;
}

/// Reach of the root, which contains the solids that count.
double reachOf(const std::vector<ShapeNode>& solids) {
  return solids.empty() ? 0 : solids[0].center.norm() + solids[0].solid.reach();
}

}  // namespace

MovingMeshAndSolids::MovingMeshAndSolids(const Modeld& mesh, const Motion& mesh_motion,
                                         std::vector<ShapeNode> solids, const Motion& solids_motion,
                                         Open open, ContinuousCounts& counts)
    : StepSearch(solids_motion, reachOf(solids), mesh_motion, reachOf(mesh), counts),
      mesh_(mesh),
      solids_(std::move(solids)),
      open_(std::move(open)),
      reach_(reachOf(solids_) + reachOf(mesh)) {
  if (!(reach_ <= 0x1p300)) refuse("a mesh or shape is too large for continuous collision.");
}

// Four times the tolerance of the kernels, at the largest extent of a triangle and a solid; the
// solids' velocities are rounded where the mesh is.
double MovingMeshAndSolids::pad(const RelativeVelocities& v) const {
  const double lengths = reach_ + detail::boundsOf(v.pose()).T_norm1;
  return v.pad() + (0x1p-40 + 0x1p-46 * v.turn()) * lengths + 0x1p-290;
}

int MovingMeshAndSolids::split(NodePair pair, const RelativeVelocities& v, NodePair* parts) {
  if (solids_.empty()) return 0;
  if (solids_[pair.b].state == ShapeNode::kClosed) open_(pair.b, solids_);
  const auto& node = mesh_.getBV(pair.a);
  const ShapeNode& part = solids_[pair.b];
  if (part.state == ShapeNode::kEmpty) return 0;
  int count = 0;
  if (part.count > 0 && (node.isLeaf() || part.solid.reach() > node.bv.radius0)) {
    for (int i = 0; i < part.count; ++i) parts[count++] = {pair.a, part.first + i};
  } else if (!node.isLeaf()) {
    parts[count++] = {node.leftChild(), pair.b};
    parts[count++] = {node.rightChild(), pair.b};
  }
  double gaps[kMostParts];
  for (int i = 0; i < count; ++i) {
    const kIOSd& bv = mesh_.getBV(parts[i].a).bv;
    const ShapeNode& solid = solids_[parts[i].b];
    const double gap =
        shape::pointBound(solid.solid, v.pose() * bv.center0 - solid.center) - bv.radius0;
    int at = i;  // insertion sort
    for (const NodePair moved = parts[i]; at > 0 && gaps[at - 1] > gap; --at) {
      gaps[at] = gaps[at - 1];
      parts[at] = parts[at - 1];
      parts[at - 1] = moved;
    }
    gaps[at] = gap;
  }
  return count;
}

bool MovingMeshAndSolids::nodesApart(NodePair pair, const RelativeVelocities& v, double duration) {
  if (solids_.empty() || solids_[pair.b].state == ShapeNode::kEmpty) return true;
  const kIOSd& bv = mesh_.getBV(pair.a).bv;
  const ShapeNode& part = solids_[pair.b];
  const shape::Solid& solid = part.solid;
  Vector3d centers[kIOSd::kMaxSpheres];
  double radii[kIOSd::kMaxSpheres];
  const int k = spheresOf(bv, v.pose(), centers, radii);
  // An inner node may be larger than the leaves in it.
  const double pad = this->pad(v) + 0x1p-46 * (1 + v.turn()) * (part.center.norm() + solid.reach());
  if (solid.bounded() && v.apart(movingBall(v.a(), part.center, solid.reach() + pad),
                                 movingBall(v.b(), centers[0], radii[0]), duration)) {
    return true;
  }
  // A ball is free if it doesn't get as far as the shape lies.
  for (int i = 0; i < k; ++i) {
    const double gap = shape::pointBound(solid, centers[i] - part.center) - radii[i] - pad;
    if (!(gap > 0)) continue;
    const auto drift = v.driftFromA(centers[i], 0, duration);
    if (gap > duration * std::min(drift.most, drift.speed + 0.5 * duration * drift.change)) {
      return true;
    }
  }
  // Slabs lie across the shape's normal, or across the direction that did best for triangles.
  const auto behindSlab = [&](const Vector3d& n) {
    const double extent = n.dot(part.center) + shape::extentAlong(solid, n);
    for (int i = 0; i < k; ++i) {
      const double gap = n.dot(centers[i]) - radii[i] - extent - pad;
      if (!(gap > 0)) continue;
      const auto drift = v.driftFromA(centers[i], 0, duration, &n);
      if (gap > duration * (drift.speed + 0.5 * duration * drift.change)) return true;
    }
    return false;
  };
  if (solid.bounded()) return behindSlab(slab_);
  return behindSlab(solid.normal) || behindSlab(-solid.normal);
}

double MovingMeshAndSolids::slabTime(const Vector3d& n, const ShapeNode& part,
                                     const std::array<Vector3d, 3>& corners,
                                     const RelativeVelocities& v, double duration) const {
  double low = kInfinity, speed = -kInfinity, change = 0;
  for (const Vector3d& x : corners) {
    const auto drift = v.driftFromA(x, 0, duration, &n);
    low = std::min(low, n.dot(x));
    speed = std::max(speed, drift.speed);
    change = std::max(change, drift.change);
  }
  const auto support = [&part](const Vector3d& m) {
    const double length = m.norm();
    if (!(length > 0)) return 0.0;
    return m.dot(part.center) + length * shape::extentAlong(part.solid, m / length);
  };
  const double extent = n.dot(part.center) + shape::extentAlong(part.solid, n);
  const double pad = this->pad(v);
  double time = closingTime(low - extent - pad, speed, change);
  // A slab that doesn't turn suits a body that turns on a table.
  if (part.solid.bounded() && v.turn() > 0) {
    time = std::max(time, v.slabTime(n, support, part.center, part.solid.reach(), corners, pad));
  }
  return std::min(duration, time);
}

double MovingMeshAndSolids::leavesApart(NodePair pair, const RelativeVelocities& v,
                                        double required) {
  if (solids_.empty() || solids_[pair.b].state == ShapeNode::kEmpty) return required;
  const auto& node = mesh_.getBV(pair.a);
  const auto corners = transformed(cornersInDouble(mesh_, node.primitiveId()), v.pose());
  const ShapeNode& part = solids_[pair.b];
  const shape::Solid& solid = part.solid;
  const auto nearest = shape::distance(
      solid, {corners[0] - part.center, corners[1] - part.center, corners[2] - part.center},
      kInfinity);
  const double gap = std::min(nearest.lower, nearest.distance) - pad(v);
  double best = 0;
  if (gap > 0) {
    const auto drift =
        v.driftFromA(v.pose() * node.bv.center0, node.bv.radius0 * (1 + v.stretch()), required);
    best = std::min(required, std::max(closingTime(gap, drift.speed, drift.change),
                                       closingTime(gap, drift.most, 0)));
  }
  // As for two triangles: the slab that lasts longest need not be the widest one.
  const Vector3d witness = unitVector(nearest.on_triangle - nearest.on_shape);
  const auto attempt = [&](const Vector3d& normal) {
    if (best >= required || !(normal.squaredNorm() > 0)) return;
    const Vector3d n = unitVector(normal);
    const double time =
        slabTime(n.dot(witness) >= 0 ? n : Vector3d(-n), part, corners, v, required);
    if (!(time > best)) return;
    best = time;
    slab_ = n.dot(witness) >= 0 ? n : Vector3d(-n);
  };
  if (!solid.bounded()) {
    if (best < required) best = std::max(best, slabTime(solid.normal, part, corners, v, required));
    if (best < required) best = std::max(best, slabTime(-solid.normal, part, corners, v, required));
    return best;
  }
  attempt(witness);
  const Vector3d velocity = unitVector(v.velocityAt(nearest.on_triangle + part.center));
  attempt(unitVector(corners[1] - corners[0]).cross(unitVector(corners[2] - corners[1])));
  for (int i = 0; i < 3; ++i) attempt(Vector3d::Unit(i));
  for (int i = 0; i < 3; ++i) attempt(Vector3d::Unit(i).cross(velocity));
  return best;
}

}  // namespace kios::continuous
