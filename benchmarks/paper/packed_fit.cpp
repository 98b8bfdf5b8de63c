// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "paper/sphere_centers.h"
#include "paper/visit_caps.h"
#include "volume/balls.h"
#include "volume/rounding.h"

namespace kios::paper {
namespace {

// Models smaller than 2^-1000 use the units of one of that size: 2^1000 is still a double.
constexpr int kLeastExponent = -1000;

/// Returns the radius that encloses the points q around c + o in exact arithmetic. A coordinate of
/// q is known to u |q| (it was subtracted from the origin), of q - c - o to another 2 u (|q| + |c|
/// + |o|); squares, sum and root have 3.5 u of the length.
float radiusAround(const std::vector<fcl::Vector3d>& q, const fcl::Vector3d& c,
                   const fcl::Vector3d& o) {
  double squared = 0, largest = 0;
  for (const fcl::Vector3d& p : q) {
    squared = std::max(squared, (p - c - o).squaredNorm());
    largest = std::max(largest, p.lpNorm<1>());
  }
  const double pad = 8 * kUlpDouble * (largest + c.lpNorm<1>() + o.lpNorm<1>());
  return roundUpFloat(std::sqrt(squared) * (1 + 8 * kUlpDouble) + pad);
}

void measure(const std::vector<fcl::Vector3d>& q, CapSpheres& v) {
  const fcl::Vector3d c(v.center[0], v.center[1], v.center[2]);
  v.radius = radiusAround(q, c, fcl::Vector3d::Zero());
  for (int i = 0; i < v.caps; ++i) {
    v.r[i] = radiusAround(q, c, fcl::Vector3d(v.x[i], v.y[i], v.z[i]));
  }
  if (v.shared_radius) std::fill_n(v.r, v.caps, *std::max_element(v.r, v.r + v.caps));
}

}  // namespace

PackedPolicy::PackedPolicy(Axes axes, int most_spheres, const FitOptions& options,
                           std::vector<fcl::Vector3f> directions)
    : axes_(axes), most_spheres_(most_spheres), options_(options), given_(std::move(directions)) {
  requireUsable(options);
  if (axes_ == Axes::kCoordinates) {
    given_ = {fcl::Vector3f::UnitX(), fcl::Vector3f::UnitY(), fcl::Vector3f::UnitZ()};
  }
}

FixedDirectionKios::FixedDirectionKios(const std::vector<fcl::Vector3d>& directions,
                                       const FitOptions& options)
    : PackedPolicy(Axes::kGiven, 1 + 2 * static_cast<int>(directions.size()), options,
                   unitDirections(directions)) {}

std::vector<fcl::Vector3f> PackedPolicy::unitDirections(
    const std::vector<fcl::Vector3d>& directions) {
  if (directions.empty() || directions.size() > CapSpheres::kMostCaps / 2) {
    throw std::invalid_argument("fcl_kios: a fixed-direction k-IOS has 1 to 6 directions, not " +
                                std::to_string(directions.size()) + ".");
  }
  std::vector<fcl::Vector3f> units;
  for (const fcl::Vector3d& d : directions) {
    const double length = d.stableNorm();
    if (!(length > 0) || !std::isfinite(length)) {
      std::ostringstream message;
      message << "fcl_kios: (" << d.transpose() << ") is not a direction.";
      throw std::invalid_argument(message.str());
    }
    units.emplace_back((d / length).cast<float>());
  }
  return units;
}

PackedPolicy::Shared PackedPolicy::share(const fcl::Vector3d* points, int n) const {
  Shared model;
  model.exponent = kLeastExponent;
  if (axes_ == Axes::kGiven) model.directions = given_;
  if (axes_ == Axes::kOfTheModel) {
    model.directions = {fcl::Vector3f::UnitX(), fcl::Vector3f::UnitY(), fcl::Vector3f::UnitZ()};
  }
  if (n == 0) return model;
  const RelativePoints relative(points, n);  // refuses what can't be bounded
  if (axes_ == Axes::kOfTheModel) {
    Eigen::Matrix3Xd in_frame;
    const PrincipalFrame frame = principalFrame(relative.p, in_frame);
    for (int i = 0; i < 3; ++i) model.directions[i] = frame.axes.col(i).cast<float>();
  }
  fcl::Vector3d lower = points[0], upper = points[0];
  for (int i = 1; i < n; ++i) {
    lower = lower.cwiseMin(points[i]);
    upper = upper.cwiseMax(points[i]);
  }
  model.origin = 0.5 * lower + 0.5 * upper;
  const double half =
      std::max((upper - model.origin).maxCoeff(), (model.origin - lower).maxCoeff());
  if (half > 0) model.exponent = std::max(kLeastExponent, std::ilogb(half) + 1);
  return model;
}

PackedPolicy::Volume PackedPolicy::fit(const fcl::Vector3d* points, int n,
                                       const Shared& model) const {
  CapSpheres v;
  v.by_height = axes_ != Axes::kOfTheVolume;
  v.shared_radius = options_.shared_radius;
  if (n == 0) return v;
  v.empty = false;
  FitOptions options = options_;
  if (v.by_height) {  // of that fit only S0 is kept
    options = FitMethod::kTuned;
    options.count = SphereCount::kAll;
  }
  const RelativePoints relative(points, n);
  const SphereCenters spheres = placeCenters(relative.p, options, v.by_height ? 1 : most_spheres_);
  const auto inModel = [&](double x) { return scaled(x, relative.exponent); };
  const double unit = scaled(1.0, -model.exponent);
  std::vector<fcl::Vector3d> q(n);
  for (int i = 0; i < n; ++i) q[i] = (points[i] - model.origin) * unit;
  for (int c = 0; c < 3; ++c) {
    v.center[c] =
        static_cast<float>((points[0][c] + inModel(spheres.sphere[0][c]) - model.origin[c]) * unit);
  }
  if (v.by_height) {
    placeAlong(directions(model), q, v);
  } else {
    for (v.caps = 0; v.caps < spheres.k - 1; ++v.caps) {
      const Eigen::Vector3d& o = spheres.sphere[v.caps + 1];
      v.x[v.caps] = static_cast<float>(inModel(o[0]) * unit);
      v.y[v.caps] = static_cast<float>(inModel(o[1]) * unit);
      v.z[v.caps] = static_cast<float>(inModel(o[2]) * unit);
    }
    v.pairs = static_cast<std::uint8_t>((1 << v.caps / 2) - 1);
  }
  measure(q, v);
  return v;
}

/// Caps over the rim of the far side of the content along each direction, and which to keep.
void PackedPolicy::placeAlong(const std::vector<fcl::Vector3f>& directions,
                              const std::vector<fcl::Vector3d>& q, CapSpheres& v) const {
  const fcl::Vector3d center(v.center[0], v.center[1], v.center[2]);
  const double cotangent = 1 / std::tan(options_.angle);
  const int count = static_cast<int>(directions.size());
  double low[CapSpheres::kMostCaps / 2] = {}, high[CapSpheres::kMostCaps / 2] = {}, widest = 0,
                                     radius = 0;
  for (const fcl::Vector3d& p : q) radius = std::max(radius, (p - center).norm());
  for (int i = 0; i < count; ++i) {
    const fcl::Vector3d d = directions[i].cast<double>();
    low[i] = high[i] = d.dot(q[0] - center);
    for (const fcl::Vector3d& p : q) {
      low[i] = std::min(low[i], d.dot(p - center));
      high[i] = std::max(high[i], d.dot(p - center));
    }
    widest = std::max(widest, high[i] - low[i]);
  }
  float wanted[CapSpheres::kMostCaps] = {};  // radii, for the caps that are kept
  for (int i = 0; i < count; ++i) {
    const fcl::Vector3d d = directions[i].cast<double>();
    double rim = 0;
    for (const fcl::Vector3d& p : q) {
      rim = std::max(rim, (p - center - d.dot(p - center) * d).norm());
    }
    const double heights[2] = {std::max(0.0, cotangent * rim + low[i]),
                               std::min(0.0, high[i] - cotangent * rim)};
    double r[2];
    for (int side = 0; side < 2; ++side) {
      r[side] = radiusAround(q, center, heights[side] * d);
    }
    constexpr double kRatio = 1.5, kLeastGain = 0.1;
    const double left = std::min(radius, heights[1] + r[1]) - std::max(-radius, heights[0] - r[0]);
    const bool keep = radius > 0 && (options_.count == SphereCount::kAll ||
                                     (options_.count == SphereCount::kByRatio
                                          ? widest > kRatio * (high[i] - low[i])
                                          : left < (1 - kLeastGain) * 2 * radius));
    if (!keep) continue;
    v.pairs = static_cast<std::uint8_t>(v.pairs | 1 << i);
    for (int side = 0; side < 2; ++side, ++v.caps) {
      v.height[v.caps] = static_cast<float>(heights[side]);
      wanted[v.caps] = static_cast<float>(r[side]);
    }
  }
  const float shared = *std::max_element(wanted, wanted + CapSpheres::kMostCaps);
  int cap = 0;
  for (int i = 0; i < count; ++i) {
    if ((v.pairs >> i & 1) == 0) continue;
    for (int side = 0; side < 2; ++side, ++cap) {
      if (v.shared_radius) v.height[cap] += (side == 0 ? 1.0F : -1.0F) * (shared - wanted[cap]);
      const fcl::Vector3f o = placeAt(v.height[cap], directions[i]);
      v.x[cap] = o[0];
      v.y[cap] = o[1];
      v.z[cap] = o[2];
    }
  }
}

}  // namespace kios::paper
