// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "interior/common_center.h"

#include <algorithm>

#include "interior/containment.h"
#include "interior/nearest_surface.h"
#include "interior/winding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// The balls about a point, in a's frame.
struct Balls {
  bool in_a = false, in_b = false;
  double depth = 0;  ///< proven
  Vec uphill = Vec::Zero();
};

template <typename S>
class CommonCenter {
 public:
  explicit CommonCenter(SolidPair<S>& pair) : pair_(pair) {}

  // The place of c relative to b, and its distance, are those of y = R^T (c - T) in b's frame, but
  // for inverseError(): if b's surface is farther than that, both are on one side. R shrinks no
  // distance by more than the same share of it, which is within the error, too.
  Balls at(const Vec& c) {
    const PairFrame<S>& frame = pair_.frame();
    Balls balls;
    balls.in_a = placeOf(c, frame.a, pair_.counts()).inside();
    const Vec y = toB(frame.X_AB, c);
    balls.in_b = placeOf(y, frame.b, pair_.counts()).inside();
    if (!balls.in_a || !balls.in_b) return balls;
    constexpr double kCoarse = 0.02;
    const NearestSurface a = nearestSurface(frame.a, c, kCoarse);
    const NearestSurface b = nearestSurface(frame.b, y, kCoarse);
    const double error =
        2 * inverseError(frame.X_AB, c.lpNorm<1>() + 4 * pair_.size()) + 2 * pair_.rounding();
    if (!(b.lower > error) || !(a.lower > pair_.rounding())) return balls;
    balls.depth = a.lower - pair_.rounding() + b.lower - error;
    balls.uphill = (c - a.point).normalized() + pair_.R_AB() * (y - b.point).normalized();
    return balls;
  }

 private:
  SolidPair<S>& pair_;
};

}  // namespace

template <typename S>
double depthOfBalls(SolidPair<S>& pair, const Vec& on_a, const Vec& translation, double enough) {
  CommonCenter<S> center(pair);
  const Vec from = pair.inA(on_a), way = -(pair.R_WA().transpose() * translation);
  // Near 0 the way is in a, near 1 in b; in between it is in both, or never.
  double low = 0, high = 1, share = 0.5;
  Vec best = from;
  Balls balls;
  constexpr int kHalvings = 6;
  for (int i = 0; i < kHalvings; ++i) {
    share = 0.5 * (low + high);
    const Vec c = from + share * way;
    const Balls here = center.at(c);
    if (here.depth > balls.depth) {
      balls = here;
      best = c;
    }
    if (here.in_a && here.in_b) break;
    if (here.in_a == here.in_b) break;
    (here.in_a ? low : high) = share;
  }
  // If that is poor, from where the surfaces meet, a little way into both.
  constexpr double kPoor = 0.8;
  for (const auto& seam : pair.seams()) {
    if (balls.depth > kPoor * enough) break;
    for (double step = 0.3 * translation.norm(); step > 0.01 * translation.norm(); step *= 0.3) {
      const Vec c = seam.point + step * seam.inwards;
      const Balls here = center.at(c);
      if (here.depth > balls.depth) {
        balls = here;
        best = c;
      }
      if (here.depth > 0) break;
    }
  }
  if (!(balls.depth > 0)) return 0;
  double step = 0.25 * balls.depth;
  constexpr int kSteps = 10;
  for (int i = 0; i < kSteps && balls.depth < enough && step > 0.03 * balls.depth; ++i) {
    const Vec c = best + step * balls.uphill;
    const Balls here = center.at(c);
    if (here.depth > balls.depth) {
      balls = here;
      best = c;
      step *= 1.6;
    } else {
      step *= 0.4;
    }
  }
  return balls.depth;
}

template double depthOfBalls(SolidPair<double>&, const Vec&, const Vec&, double);
template double depthOfBalls(SolidPair<float>&, const Vec&, const Vec&, double);

}  // namespace kios
