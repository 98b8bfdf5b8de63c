// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/inner_balls.h"

#include <algorithm>

#include <Eigen/Geometry>
#include "model/prepared.h"
#include "solid/nearest_surface.h"
#include "solid/winding.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds a place of the surface.
struct Sample {
  Vec point, inwards;
  double gap = kInfinity;  ///< to the nearest ball
};

template <typename S>
std::vector<Sample> samplesOf(const Model<S>& model) {
  constexpr int kSamples = 256;
  const int count = std::min(model.num_tris, kSamples);
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const long long t = static_cast<long long>(i) * model.num_tris / count;
    const TriangleVertices<double> p = cornersInDouble(model, static_cast<int>(t));
    const Vec n = (p[2] - p[0]).cross(p[1] - p[0]);
    const double length = n.norm();
    if (length > 0) samples.push_back({(p[0] + p[1] + p[2]) / 3, n / length});
  }
  return samples;
}

/// The largest ball that touches the surface in the sample, about: it shrinks until nothing is
/// within. Its radius is 0 if there is none.
template <typename S>
InnerBalls::Ball shrink(const Model<S>& model, const Sample& sample, double size) {
  constexpr double kEnough = 0.98, kLeast = 1e-3;
  constexpr int kSteps = 12;
  double radius = size;
  for (int i = 0; i < kSteps && radius > kLeast * size; ++i) {
    const Vec center = sample.point + radius * sample.inwards;
    const NearestSurface near = nearestSurface(model, center, 0.02);
    if (near.upper > kEnough * radius || i + 1 == kSteps) {
      SearchCounts unused;
      const bool inside = near.lower > 0 && placeOf(center, model, unused).inside();
      return {center, inside ? near.lower : 0};
    }
    // The ball that touches the sample and passes through that point.
    const Vec chord = near.point - sample.point;
    const double across = 2 * chord.dot(sample.inwards);
    radius = across > 0 ? std::min(0.9 * radius, chord.squaredNorm() / across) : 0.5 * radius;
  }
  return {sample.point, 0};
}

}  // namespace

template <typename S>
InnerBalls innerBalls(const Model<S>& model) {
  constexpr std::size_t kBalls = 16;
  constexpr int kTries = 24;
  const double size = model.getBV(0).bv.radius0;
  std::vector<Sample> samples = samplesOf(model);
  InnerBalls found;
  const auto nearer = [](const Sample& a, const Sample& b) { return a.gap < b.gap; };
  for (int i = 0; i < kTries && found.balls.size() < kBalls && !samples.empty(); ++i) {
    const auto worst = std::max_element(samples.begin(), samples.end(), nearer);
    if (!(worst->gap > 1e-3 * size)) break;
    const InnerBalls::Ball ball = shrink(model, *worst, size);
    worst->gap = 0;
    if (!(ball.radius > 0)) continue;
    found.balls.push_back(ball);
    for (Sample& s : samples) {
      s.gap = std::min(s.gap, std::max(0.0, (s.point - ball.center).norm() - ball.radius));
    }
  }
  if (found.balls.empty()) return found;
  for (const Sample& s : samples) found.gap += s.gap / static_cast<double>(samples.size());
  return found;
}

template InnerBalls innerBalls(const Model<double>&);
template InnerBalls innerBalls(const Model<float>&);

}  // namespace kios
