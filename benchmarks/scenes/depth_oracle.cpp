// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "depth_oracle.h"

#include <algorithm>
#include <limits>

#include "rational_oracle.h"

namespace kios::scenes {

using Eigen::Vector3d;

DepthOracle::DepthOracle(const Mesh& of) : mesh(of), sides_(of) {
  for (const fcl::Triangle& t : mesh.triangles) {
    Eigen::AlignedBox3d& around = boxes_.emplace_back();
    for (int k = 0; k < 3; ++k) around.extend(mesh.vertices[t[k]]);
    box.extend(around);
  }
}

double DepthOracle::distance(const Vector3d& p, double enough) const {
  constexpr double kRounding = 1 + 0x1p-50;
  double least = std::numeric_limits<double>::infinity();
  for (const fcl::Triangle& t : mesh.triangles) {
    least = std::min(least, kRounding * (mesh.vertices[t[0]] - p).stableNorm());
    if (least <= enough) return least;
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Vector3d gap =
        (boxes_[i].min() - p).cwiseMax(p - boxes_[i].max()).cwiseMax(Vector3d::Zero());
    if (gap.stableNorm() > kRounding * least) continue;
    const fcl::Triangle& t = mesh.triangles[i];
    const auto d = static_cast<double>(
        rationalDistance(p, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}));
    least = std::min(least, d);
    if (least <= enough) break;
  }
  return least;
}

double DepthOracle::depth(const Vector3d& p, double enough) const {
  if (!box.contains(p)) return 0;
  const double d = distance(p, enough);
  return d > enough && holds(p) ? d : 0;
}

double deepestSample(const DepthOracle& a, const DepthOracle& b, int steps) {
  const double aside =
      0x1p-46 * a.box.min().cwiseAbs().cwiseMax(a.box.max().cwiseAbs()).maxCoeff() +
      1e-9 * a.box.sizes().maxCoeff();
  double deepest = 0;
  for (const fcl::Triangle& t : a.mesh.triangles) {
    const Vector3d &p = a.mesh.vertices[t[0]], u = a.mesh.vertices[t[1]] - p,
                   v = a.mesh.vertices[t[2]] - p;
    const Vector3d n = u.stableNormalized().cross(v.stableNormalized());
    if (!(n.norm() > 0)) continue;  // it may belong to no solid
    const Vector3d to = aside * n.normalized();
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps - i; ++j) {
        const Vector3d x = p + (i * u + j * v) / steps;
        const double depth = b.depth(x, deepest);
        if (depth > deepest && !(a.holds(x + to) && a.holds(x - to))) deepest = depth;
      }
    }
  }
  return deepest;
}

double largestBall(const DepthOracle& a, const DepthOracle& b, int count, Random& random) {
  double largest = 0;
  const Eigen::AlignedBox3d box = a.box.intersection(b.box);
  for (int i = 0; i < count && !box.isEmpty(); ++i) {
    Vector3d x;
    for (int c = 0; c < 3; ++c) x[c] = random.uniform(box.min()[c], box.max()[c]);
    const double in_a = a.depth(x, largest);
    if (in_a > largest) largest = std::max(largest, std::min(in_a, b.depth(x, largest)));
  }
  return largest;
}

double provenDepth(const DepthOracle& a, const DepthOracle& b, const Vector3d& p,
                   double tolerance) {
  const double in_a = a.depth(p), in_b = b.depth(p);
  return std::max({std::min(in_a, in_b), a.distance(p) <= tolerance ? in_b : 0,
                   b.distance(p) <= tolerance ? in_a : 0});
}

}  // namespace kios::scenes
