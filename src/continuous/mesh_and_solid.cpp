// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/mesh_and_solid.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bv/balls.h"
#include "fcl/mesh_pair.h"
#include "fcl_kios/fcl/shape_queries.h"
#include "shape/triangle_shape.h"

namespace kios::continuous {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The spheres of a node in the shape's frame; returns how many.
int spheresOf(const kIOSd& bv, const RelativePose<double>& X, Vector3d* centers, double* radii) {
  const double stretch = 1 + X.stretch, unit = scaled(1.0, bv.exponent);
  centers[0] = X * bv.center0;
  radii[0] = bv.radius0 * stretch;
  for (int i = 1; i < bv.k(); ++i) {
    const Vector3d cap(bv.cap_x[i - 1] * unit, bv.cap_y[i - 1] * unit, bv.cap_z[i - 1] * unit);
    centers[i] = centers[0] + X.R * cap;
    radii[i] = bv.cap_r[i - 1] * unit * stretch;
  }
  return bv.k();
}

}  // namespace

MovingMeshAndSolid::MovingMeshAndSolid(const Modeld& mesh, const Motion& mesh_motion,
                                       const fcl::CollisionGeometryd& geometry, shape::Solid solid,
                                       const Motion& solid_motion, ContinuousCounts& counts)
    : PairSearch(solid_motion, solid.reach(), mesh_motion, reachOf(mesh), counts),
      mesh_(mesh),
      geometry_(geometry),
      solid_(std::move(solid)),
      reach_(solid_.reach() + reachOf(mesh)) {
  if (reach_ <= 0x1p300) return;
  throw std::invalid_argument("fcl_kios: a mesh or shape is too large for continuous collision.");
}

bool MovingMeshAndSolid::touching(double t) {
  fcl::CollisionResultd result;
  return collideShape(mesh_, motion_.b().pose(t), geometry_, motion_.a().pose(t),
                      fcl::CollisionRequestd(), result) > 0;
}

// Four times the tolerance of the kernels, at the largest extent of a triangle and the shape; the
// shape's velocities are rounded likewise where the mesh is.
double MovingMeshAndSolid::pad(const RelativeVelocities& v) const {
  return v.pad() + 0x1p-40 * (reach_ + v.pose().T_norm1) * (1 + 0x1p-8 * v.turnOfA()) + 0x1p-290;
}

bool MovingMeshAndSolid::split(NodePair pair, const RelativeVelocities& v, NodePair& near,
                               NodePair& far) const {
  const auto& node = mesh_.getBV(pair.a);
  if (node.isLeaf()) return false;
  near.a = node.leftChild();
  far.a = node.rightChild();
  near.b = far.b = 0;
  const auto gap = [&](int id) {
    const kIOSd& bv = mesh_.getBV(id).bv;
    return shape::pointBound(solid_, v.pose() * bv.center0) - bv.radius0;
  };
  if (gap(far.a) < gap(near.a)) std::swap(near, far);
  return true;
}

bool MovingMeshAndSolid::nodesApart(NodePair pair, const RelativeVelocities& v, double duration) {
  const kIOSd& bv = mesh_.getBV(pair.a).bv;
  Vector3d centers[kIOSd::kMaxSpheres];
  double radii[kIOSd::kMaxSpheres];
  const int k = spheresOf(bv, v.pose(), centers, radii);
  const double pad = this->pad(v);
  if (solid_.bounded() && v.apart(v.ballOfA(Vector3d::Zero(), solid_.reach() + pad),
                                  v.ballOfB(centers[0], radii[0]), duration)) {
    return true;
  }
  // Balls that don't get as far as the shape is.
  for (int i = 0; i < k; ++i) {
    const double gap = shape::pointBound(solid_, centers[i]) - radii[i] - pad;
    if (!(gap > 0)) continue;
    const auto drift = v.driftFromA(centers[i], 0, duration);
    if (gap > duration * std::min(drift.most, drift.speed + 0.5 * duration * drift.change)) {
      return true;
    }
  }
  // Slabs: across the shape's normal, or across that which did best for triangles.
  const auto behindSlab = [&](const Vector3d& n) {
    const double extent = shape::extentAlong(solid_, n);
    for (int i = 0; i < k; ++i) {
      const double gap = n.dot(centers[i]) - radii[i] - extent - pad;
      if (!(gap > 0)) continue;
      const auto drift = v.driftFromA(centers[i], 0, duration, &n);
      if (gap > duration * (drift.speed + 0.5 * duration * drift.change)) return true;
    }
    return false;
  };
  if (solid_.bounded()) return behindSlab(slab_);
  return behindSlab(solid_.normal) || behindSlab(-solid_.normal);
}

double MovingMeshAndSolid::slabTime(const Vector3d& n, const std::array<Vector3d, 3>& corners,
                                    const RelativeVelocities& v, double duration) const {
  double low = kInfinity, speed = -kInfinity, change = 0;
  for (const Vector3d& x : corners) {
    const auto drift = v.driftFromA(x, 0, duration, &n);
    low = std::min(low, n.dot(x));
    speed = std::max(speed, drift.speed);
    change = std::max(change, drift.change);
  }
  const double extent = shape::extentAlong(solid_, n);
  return std::min(duration, closingTime(low - extent - pad(v), speed, change));
}

double MovingMeshAndSolid::leavesApart(NodePair pair, const RelativeVelocities& v, double enough) {
  const auto& node = mesh_.getBV(pair.a);
  const auto corners = transformed(cornersOf(mesh_, node.primitiveId()), v.pose());
  const auto nearest = shape::distance(solid_, corners, kInfinity);
  const double gap = std::min(nearest.lower, nearest.distance) - pad(v);
  double best = 0;
  if (gap > 0) {
    const auto drift =
        v.driftFromA(v.pose() * node.bv.center0, node.bv.radius0 * (1 + v.pose().stretch), enough);
    best = std::min(enough, std::max(closingTime(gap, drift.speed, drift.change),
                                     closingTime(gap, drift.most, 0)));
  }
  // As for two triangles: the slab that lasts longest need not be the widest one.
  const Vector3d witness = (nearest.on_triangle - nearest.on_shape).stableNormalized();
  const auto attempt = [&](const Vector3d& normal) {
    if (best >= enough || !(normal.squaredNorm() > 0)) return;
    const Vector3d n = normal.stableNormalized();
    const double time = slabTime(n.dot(witness) >= 0 ? n : Vector3d(-n), corners, v, enough);
    if (!(time > best)) return;
    best = time;
    slab_ = n.dot(witness) >= 0 ? n : Vector3d(-n);
  };
  if (!solid_.bounded()) {
    if (best < enough) best = std::max(best, slabTime(solid_.normal, corners, v, enough));
    if (best < enough) best = std::max(best, slabTime(-solid_.normal, corners, v, enough));
    return best;
  }
  attempt(witness);
  const Vector3d edges[3] = {corners[1] - corners[0], corners[2] - corners[1],
                             corners[0] - corners[2]};
  const Vector3d normal = edges[0].stableNormalized().cross(edges[1].stableNormalized());
  const Vector3d velocity = v.velocityAt(nearest.on_triangle).stableNormalized();
  attempt(normal);
  for (int i = 0; i < 3; ++i) attempt(Vector3d::Unit(i));
  for (const Vector3d& edge : edges) attempt(edge.stableNormalized().cross(velocity));
  for (int i = 0; i < 3; ++i) attempt(Vector3d::Unit(i).cross(velocity));
  for (const Vector3d& edge : edges) attempt(edge.stableNormalized().cross(normal));
  return best;
}

}  // namespace kios::continuous
