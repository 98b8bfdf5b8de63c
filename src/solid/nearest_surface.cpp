// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/nearest_surface.h"

#include <algorithm>
#include <cmath>

#include "fcl_kios/triangle/distance.h"
#include "model/walk.h"
#include "query/ray_walk.h"
#include "volume/balls.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Returns a lower bound of the distance of the content, but for rounding.
template <typename S>
double distanceOf(const kIOS<S>& bv, const fcl::Vector3d& p, double required) {
  const double x = p[0] - double{bv.center0[0]}, y = p[1] - double{bv.center0[1]},
               z = p[2] - double{bv.center0[2]};
  double bound = std::sqrt(x * x + y * y + z * z) - double{bv.radius0};
  if (bound >= required) return bound;
  // Caps that k doesn't count repeat the first sphere.
  using Caps = Eigen::Array<float, kIOS<S>::kCaps, 1>;
  const double unit = scaled(1, bv.exponent);
  const auto at = [unit](const float* v) {
    return unit * Eigen::Map<const Caps>(v).template cast<double>();
  };
  const auto u = x - at(bv.cap_x), v = y - at(bv.cap_y), w = z - at(bv.cap_z);
  return std::max(bound, ((u * u + v * v + w * w).sqrt() - at(bv.cap_r)).maxCoeff());
}

/// Returns the nearest point of a segment.
fcl::Vector3d nearestOnSegment(const fcl::Vector3d& p, const fcl::Vector3d& a,
                               const fcl::Vector3d& b) {
  const fcl::Vector3d d = b - a;
  const double square = d.squaredNorm();
  if (!(square > 0)) return a;
  return a + std::clamp(d.dot(p - a) / square, 0.0, 1.0) * d;
}

struct NearPoint {
  double distance;
  fcl::Vector3d at;
};

/// Over the face of an ordinary triangle the plane tells the distance, else the nearest edge. About
/// its border a point counts as over the face, where the plane is nearer than the edge by rounding
/// only. The plane's normal has 2^-50 / thin, thin at least 2^-5. All else goes to the robust
/// kernel.
NearPoint nearestOnTriangle(const fcl::Vector3d& p, const TriangleVertices<double>& t) {
  const fcl::Vector3d u = t[1] - t[0], v = t[2] - t[0], w = p - t[0], n = u.cross(v);
  const double square = n.squaredNorm();
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (t[2] - t[1]).squaredNorm()});
  if (!(square > 0x1p-10 * longest * longest && longest > 0x1p-400 && longest < 0x1p400)) {
    const auto d = triangleDistance<double>({p, p, p}, t);
    return {d.distance, d.point_b};
  }
  constexpr double kBorder = -1e-9;
  const double at_v = n.dot(u.cross(w)) / square, at_u = n.dot(w.cross(v)) / square;
  if (at_u >= kBorder && at_v >= kBorder && at_u + at_v <= 1 - kBorder) {
    const double height = n.dot(w) / square;
    return {std::abs(height) * std::sqrt(square), p - height * n};
  }
  NearPoint best = {kInfinity, t[0]};
  for (int k = 0; k < 3; ++k) {
    const fcl::Vector3d q = nearestOnSegment(p, t[k], t[k == 2 ? 0 : k + 1]);
    const double distance = (p - q).norm();
    if (distance < best.distance) best = {distance, q};
  }
  return best;
}

}  // namespace

// Distances from volumes take 8 roundings of |p| + |c| + reach at most; those from triangles are
// right to 16 eps of the extent. 2^-46 of all lengths covers both.
template <typename S>
double surfaceError(const Model<S>& model, const fcl::Vector3d& p) {
  return error_bounds::solidError(4 * (p.lpNorm<1>() + 2 * largestOf(model)));
}

template <typename S>
NearestSurface nearestSurface(const Model<S>& model, const fcl::Vector3d& p, double rel_err,
                              double required, double ignored_below) {
  NearestSurface best;
  double left_out = kInfinity, cull_distance = required;
  const auto bounded = [&](int node) {
    return BoundedNode{distanceOf(model.getBV(node).bv, p, cull_distance), node};
  };
  const auto skip = [&](const BoundedNode& at) {
    if (at.bound < cull_distance) return false;
    left_out = std::min(left_out, at.bound);
    return true;
  };
  walkNearestFirst(bounded(0), skip, [&](const BoundedNode& at, const auto& add) {
    const auto& node = model.getBV(at.node);
    if (!node.isLeaf()) {
      add(bounded(node.rightChild()));
      add(bounded(node.leftChild()));
      return false;
    }
    const NearPoint near = nearestOnTriangle(p, cornersInDouble(model, node.primitiveId()));
    if (!(near.distance < best.upper)) return false;
    best.upper = near.distance;
    best.point = near.at;
    cull_distance = std::min(cull_distance, best.upper * (1 - rel_err));
    return best.upper < ignored_below;
  });
  if (best.upper < ignored_below) return best;
  best.lower = std::max(0.0, std::min(left_out, best.upper) - surfaceError(model, p));
  return best;
}

KIOS_INSTANTIATE_FUNCTION(surfaceError);
KIOS_INSTANTIATE_FUNCTION(nearestSurface);

}  // namespace kios
