// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/common_center.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fcl_kios/triangle/intersection.h"
#include "solid/containment.h"
#include "solid/nearest_surface.h"
#include "solid/winding.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds the balls about a point, in a's frame.
struct Balls {
  bool in_a = false, in_b = false;
  double depth = 0;  ///< proven
};

template <typename S>
class CommonCenter {
 public:
  explicit CommonCenter(SolidPair<S>& pair) : pair_(pair) {}

  // The place of c relative to b, and its distance, are those of y = R^T (c - T) in b's frame, but
  // for inverseError(): if b's surface is farther than that, both are on one side. R shrinks no
  // distance by more than the same share of it, which is within the error, too.
  Balls at(const Vec& c, double least) {
    const RelativePose<double>& X_AB = pair_.frame().X_AB;
    Balls balls;
    const Vec y = toB(X_AB, c);
    // No surface lies within the balls of the last point in both.
    const double moved = 1.001 * (c - last_).norm() + 4 * pair_.rounding();
    balls.in_a = moved < radius_a_ || placeOf(c, pair_.a(), pair_.counts()).inside();
    balls.in_b = moved < radius_b_ || placeOf(y, pair_.b(), pair_.counts()).inside();
    if (!balls.in_a || !balls.in_b) return balls;
    constexpr double kCoarse = 0.02;
    constexpr double kFar = kInfinity;
    const NearestSurface a =
        nearestSurface(pair_.a(), c, kCoarse, kFar, known_ ? least - 1.03 * radius_b_ - moved : 0);
    const NearestSurface b =
        nearestSurface(pair_.b(), y, kCoarse, kFar, a.lower > 0 ? least - a.upper : kFar);
    on_a_.push_back(a.point);
    if (a.lower > 0) on_b_.push_back(pair_.R_AB() * b.point + pair_.T_AB());
    const double error =
        2 * inverseError(X_AB, c.lpNorm<1>() + 4 * pair_.size()) + 2 * pair_.rounding();
    if (!(b.lower > error) || !(a.lower > pair_.rounding())) return balls;
    last_ = c;
    known_ = true;
    radius_a_ = a.lower - error;
    radius_b_ = b.lower - error;
    balls.depth = a.lower - pair_.rounding() + b.lower - error;
    return balls;
  }

  /// Returns where the balls may be largest within `reach` of c, by the points of the surfaces that
  /// are known, and by how much at most.
  std::pair<Vec, double> highest(const Vec& c, double reach) const {
    const auto nearest = [](const std::vector<Vec>& points, const Vec& p, Vec& away) {
      away.setZero();
      double least = kInfinity;
      for (const Vec& q : points) {
        const double square = (p - q).squaredNorm();
        if (!(square < least)) continue;
        least = square;
        away = p - q;
      }
      least = std::sqrt(least);
      away /= least;
      return least;
    };
    Vec top = c, at = c, u = Vec::Zero(), v = Vec::Zero();
    double highest = 0, step = 0.5 * reach;
    constexpr int kSteps = 24;
    for (int i = 0; i < kSteps; ++i) {
      const double depth = nearest(on_a_, at, u) + nearest(on_b_, at, v);
      if (depth > highest) {
        highest = depth;
        top = at;
      } else {
        step *= 0.7;
      }
      const Vec uphill = u + v;
      const double slope = uphill.norm();
      if (!(slope > 1e-3)) break;
      at += step / slope * uphill;
      const Vec way = at - c;
      if (way.norm() > reach) at = c + reach * way.normalized();
    }
    return {top, highest};
  }

 private:
  SolidPair<S>& pair_;
  std::vector<Vec> on_a_, on_b_;  ///< points of the surfaces, in a's frame
  Vec last_ = Vec::Zero();
  bool known_ = false;
  double radius_a_ = 0, radius_b_ = 0;  ///< of balls about last_ that lie in a and b
};

}  // namespace

template <typename S>
double depthOfBalls(SolidPair<S>& pair, const Vec& on_a, const Vec& translation, double required,
                    bool fully, const std::optional<Vec>& common) {
  CommonCenter<S> center(pair);
  const Vec from = pair.inA(on_a), way = -(pair.R_WA().transpose() * translation);
  // Where a's surface is flat and b's isn't the balls are best at b's end, and at a's.
  if (!fully) {
    double depth = 0;
    for (const double end : {0.985, 0.015}) {
      if (depth < required) depth = std::max(depth, center.at(from + end * way, depth).depth);
    }
    return depth;
  }
  Vec best = from;
  Balls balls;
  const auto tryPoint = [&](const Vec& c) {
    const Balls here = center.at(c, balls.depth);
    if (here.depth > balls.depth) {
      balls = here;
      best = c;
    }
    return here;
  };
  if (common) tryPoint(*common);
  // Near 0 the way is in a, near 1 in b; in between it is in both, or never.
  constexpr int kHalvings = 6;
  double low = 0, high = 1;
  for (int i = 0; i < kHalvings && balls.depth < required; ++i) {
    const double share = 0.5 * (low + high);
    const Balls here = tryPoint(from + share * way);
    if (here.in_a == here.in_b || balls.depth > 0.6 * required) break;
    (here.in_a ? low : high) = share;
  }
  constexpr double kPoor = 0.2;
  // If that is poor, from where the surfaces meet, a little way into both.
  const auto& contacts = pair.overlap().contacts;
  constexpr std::size_t kSeams = 4;
  for (std::size_t i = 0; i < std::min(2 * kSeams, contacts.size()); i += 2) {
    const Vec seam = intersectionPoint(contacts[i].a, contacts[i].b);
    const Vec inwards = -normalOf(contacts[i].a) - normalOf(contacts[i].b);
    for (double step = 0.3 * translation.norm(); step > 0.01 * translation.norm(); step *= 0.3) {
      if (balls.depth > kPoor * required) break;
      if (tryPoint(seam + step * inwards).depth > 0) break;
    }
  }
  if (!(balls.depth > 0)) return 0;
  constexpr int kSteps = 6;
  constexpr double kWorth = 1.03;
  double reach = 0.8 * balls.depth;
  for (int i = 0; i < kSteps && balls.depth < required; ++i) {
    const auto [c, hope] = center.highest(best, reach);
    if (!(hope > kWorth * balls.depth)) break;
    const double before = balls.depth;
    tryPoint(c);
    if (!(balls.depth > before)) reach *= 0.5;
    if (balls.depth > 2 * before) reach = 0.8 * balls.depth;  // it began much too small
  }
  return balls.depth;
}

KIOS_INSTANTIATE_FUNCTION(depthOfBalls);

}  // namespace kios
