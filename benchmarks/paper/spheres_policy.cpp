// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "paper/spheres_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "paper/sphere_centers.h"
#include "volume/balls.h"
#include "volume/rounding.h"

namespace kios::paper {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// At any scale: within 4 u.
double lengthOf(const fcl::Vector3d& v) {
  const double square = v.squaredNorm();
  return square > 0x1p-900 && square < 0x1p1000 ? std::sqrt(square) : v.stableNorm();
}

/// What rounding does to p - c and its length, where both are coordinates.
double paddedBy(const fcl::Vector3d& p, const fcl::Vector3d& c) {
  return 16 * kUlpDouble * (p.lpNorm<1>() + c.lpNorm<1>()) + 0x1p-1060;
}

/// Returns the sphere around c that contains the points.
Sphere around(const std::vector<fcl::Vector3d>& points, const fcl::Vector3d& c) {
  double radius = 0;
  for (const fcl::Vector3d& p : points) {
    radius = std::max(radius, lengthOf(p - c) + paddedBy(p, c));
  }
  return {c, radius};
}

void shareRadius(Spheres& v) {
  double most = 0;
  for (std::size_t i = 1; i < v.all.size(); ++i) most = std::max(most, v.all[i].radius);
  for (std::size_t i = 1; i < v.all.size(); ++i) v.all[i].radius = most;
}

}  // namespace

SpheresPolicy::SpheresPolicy(Axes axes, int most_spheres, const FitOptions& options,
                             const std::vector<fcl::Vector3d>& directions)
    : axes_(axes), most_spheres_(most_spheres), options_(options) {
  requireUsable(options);
  for (const fcl::Vector3d& d : directions) given_.push_back(d.normalized());
}

SpheresPolicy::Shared SpheresPolicy::share(const fcl::Vector3d* points, int n) const {
  Shared model;
  model.directions = given_;
  if (n == 0) return model;
  const RelativePoints relative(points, n);  // refuses what can't be bounded
  for (int i = 0; i < n; ++i) model.reach = std::max(model.reach, points[i].lpNorm<1>());
  if (axes_ == Axes::kOfTheModel) {
    Eigen::Matrix3Xd in_frame;
    const PrincipalFrame frame = principalFrame(relative.p, in_frame);
    for (int i = 0; i < 3; ++i) model.directions.emplace_back(frame.axes.col(i));
  }
  return model;
}

Spheres SpheresPolicy::fit(const fcl::Vector3d* points, int n, const Shared& model) const {
  Spheres v;
  if (n == 0) return v;
  const bool by_height = axes_ != Axes::kOfTheVolume;
  FitOptions options = options_;
  if (by_height) {  // of that fit only S0 is kept
    options = FitMethod::kTuned;
    options.count = SphereCount::kAll;
  }
  const RelativePoints relative(points, n);
  const SphereCenters places = placeCenters(relative.p, options, by_height ? 1 : most_spheres_);
  const auto inModel = [&](const Eigen::Vector3d& p) -> fcl::Vector3d {
    return {scaled(p[0], relative.exponent), scaled(p[1], relative.exponent),
            scaled(p[2], relative.exponent)};
  };
  const std::vector<fcl::Vector3d> content(points, points + n);
  const fcl::Vector3d center = points[0] + inModel(places.sphere[0]);
  v.all.push_back(around(content, center));
  if (by_height) {
    addCaps(content, model, v);
  } else {
    for (int i = 1; i < places.k; ++i) {
      v.all.push_back(around(content, center + inModel(places.sphere[i])));
    }
  }
  const int caps = static_cast<int>(v.all.size()) - 1, of_place = by_height ? 1 : 3;
  const bool shares = options_.shared_radius && caps > 0;
  if (shares) shareRadius(v);
  v.floats = 4 + of_place * caps + (shares ? 1 : caps);
  return v;
}

/// Adds caps over the rim of the far side of the content along each direction that is worth it.
void SpheresPolicy::addCaps(const std::vector<fcl::Vector3d>& points, const Shared& model,
                            Spheres& v) const {
  constexpr double kRatio = 1.5, kLeastGain = 0.1;
  const fcl::Vector3d center = v.all[0].center;
  const double cotangent = 1 / std::tan(options_.angle), radius = v.all[0].radius;
  struct Pair {
    fcl::Vector3d along;
    double low = kInfinity, high = -kInfinity, heights[2] = {}, radii[2] = {};
  };
  std::vector<Pair> pairs;
  double widest = 0, shared = 0;
  for (const fcl::Vector3d& d : model.directions) {
    Pair& pair = pairs.emplace_back(Pair{d});
    double rim = 0;
    for (const fcl::Vector3d& p : points) {
      const double height = d.dot(p - center);
      pair.low = std::min(pair.low, height);
      pair.high = std::max(pair.high, height);
      rim = std::max(rim, lengthOf(p - center - height * d));
    }
    widest = std::max(widest, pair.high - pair.low);
    pair.heights[0] = std::max(0.0, cotangent * rim + pair.low);
    pair.heights[1] = std::min(0.0, pair.high - cotangent * rim);
    for (int side = 0; side < 2; ++side) {
      pair.radii[side] = around(points, center + pair.heights[side] * d).radius;
    }
  }
  const auto isLeftOut = [&](const Pair& pair) {
    if (options_.count == SphereCount::kAll) return !(widest > 0);
    if (options_.count == SphereCount::kByRatio) return widest <= kRatio * (pair.high - pair.low);
    const double left = std::min(radius, pair.heights[1] + pair.radii[1]) -
                        std::max(-radius, pair.heights[0] - pair.radii[0]);
    return left >= (1 - kLeastGain) * 2 * radius;
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), isLeftOut), pairs.end());
  for (const Pair& pair : pairs) shared = std::max({shared, pair.radii[0], pair.radii[1]});
  for (const Pair& pair : pairs) {
    for (int side = 0; side < 2; ++side) {  // one that grows moves outwards
      const double more = options_.shared_radius ? shared - pair.radii[side] : 0;
      const double height = pair.heights[side] + (side == 0 ? more : -more);
      v.all.push_back(around(points, center + height * pair.along));
    }
  }
}

// With u = 2^-53, R c_b + T - c_a takes 6 roundings a coordinate, the leaf's R y + T 5, root and
// sums 8, of the coordinates and radii, as centres are no farther than a radius from the content:
// below 34 u of their sum; 2^-47 is 64 u.
SpheresPolicy::Placed SpheresPolicy::place(const Shared& a, const Shared& b,
                                           const RelativePose<double>& X_AB) const {
  const auto& bounds = detail::boundsOf(X_AB);
  return {X_AB, 0x1p-47 * (1.8 * b.reach + bounds.T_norm1 + a.reach) + 0x1p-1060, bounds.stretch};
}

double SpheresPolicy::separation(const Spheres& a, const Spheres& b, const Placed& at,
                                 double enough) const {
  if (a.all.empty() || b.all.empty()) return kInfinity;
  double best = -kInfinity;
  for (const Sphere& of_b : b.all) {
    if (best > enough) break;
    const fcl::Vector3d c = at.X * of_b.center;
    const double radius_b = of_b.radius * (1 + at.stretch + 0x1p-46) + at.pad;
    for (const Sphere& of_a : a.all) {
      const fcl::Vector3d way = c - of_a.center;
      const double radii = of_a.radius * (1 + 0x1p-46) + radius_b, beaten = best + radii;
      const double square = way.squaredNorm();
      if (beaten > 0 && square > 0x1p-900 && square <= beaten * beaten) continue;
      best = std::max(best, lengthOf(way) - radii);
    }
  }
  return best;
}

}  // namespace kios::paper
