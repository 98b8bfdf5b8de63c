// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/inner_balls.h"

#include <algorithm>

#include <Eigen/Geometry>
#include "query/nearest_on_mesh.h"
#include "solid/containment.h"
#include "solid/tuning.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds a place of the surface.
struct Sample {
  Vec point, inwards;
  double gap = kInfinity;  ///< to the nearest ball
};

std::vector<Sample> samplesOf(const Mesh& mesh) {
  const std::size_t count = std::min(mesh.numTriangles(), tuning::kBalls * tuning::kBalls);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleVerticesd p = mesh.triangle(i * mesh.numTriangles() / count);
    const Vec n = (p[2] - p[0]).cross(p[1] - p[0]);
    const double length = n.norm();
    if (length > 0) samples.push_back({(p[0] + p[1] + p[2]) / 3, n / length});
  }
  return samples;
}

/// The largest ball that touches the surface in the sample, about: it shrinks until nothing is
/// within. Its radius is 0 if there is none.
InnerBalls::Ball shrink(const Mesh& mesh, const Sample& sample, double size) {
  double radius = size;
  for (int i = 0; i < tuning::kUphill; ++i) {
    const Vec center = sample.point + radius * sample.inwards;
    const NearestOnMesh near = nearestOnMesh(mesh, center, kInfinity);
    if (near.distance > tuning::kEnough * radius || i + 1 == tuning::kUphill) {
      SearchCounts unused;
      const bool inside = near.lower > 0 && placeOf(center, mesh, unused).inside();
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

InnerBalls innerBalls(const Mesh& mesh) {
  const double size = mesh.radius();
  std::vector<Sample> samples = samplesOf(mesh);
  InnerBalls found;
  const auto nearer = [](const Sample& a, const Sample& b) { return a.gap < b.gap; };
  for (std::size_t i = 0;
       i < 2 * tuning::kBalls && found.balls.size() < tuning::kBalls && !samples.empty(); ++i) {
    const auto worst = std::max_element(samples.begin(), samples.end(), nearer);
    if (!(worst->gap > 1e-3 * size)) break;
    const InnerBalls::Ball ball = shrink(mesh, *worst, size);
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

BallPairs::BallPairs(const InnerBalls& a, const InnerBalls& b, const RelativePose<double>& X_AB)
    : gap_(a.gap + b.gap) {
  for (const InnerBalls::Ball& in_b : b.balls) {
    const InnerBalls::Ball q = {X_AB * in_b.center, in_b.radius};
    for (const InnerBalls::Ball& p : a.balls) {
      const Vec between = q.center - p.center;
      pairs_.push_back({-between, p.radius + q.radius});
      const double apart = between.norm(), depth = p.radius + q.radius - apart;
      if (!(depth > depth_)) continue;
      depth_ = depth;
      // The middle of what they share of the line through the centres.
      const double near = std::max(-p.radius, apart - q.radius),
                   far = std::min(p.radius, apart + q.radius);
      const double share = apart > 0 ? 0.5 * (near + far) / apart : 0.0;
      common_ = p.center + share * between;
    }
  }
}

bool BallPairs::meet(const Vec& translation) const {
  constexpr double kSurely = 0.999;
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    return (translation - pair.center).squaredNorm() < kSurely * pair.radius * pair.radius;
  });
}

Vec BallPairs::escape(const Vec& from) const {
  constexpr double kBeyond = 1.02;  // so that rounding doesn't keep it within
  Vec at = from;
  for (int i = 0; i < tuning::kUphill; ++i) {
    const Pair* deepest = nullptr;
    double depth = 0;
    for (const Pair& pair : pairs_) {
      const double grown = pair.radius + gap_;
      const double here = grown * grown - (at - pair.center).squaredNorm();
      if (!(here > depth)) continue;
      depth = here;
      deepest = &pair;
    }
    const Vec way = deepest ? Vec(at - deepest->center) : Vec(Vec::Zero());
    const double apart = way.norm();
    if (!(apart > 0)) break;
    at = deepest->center + kBeyond * (deepest->radius + gap_) / apart * way;
  }
  return at;
}

}  // namespace kios
