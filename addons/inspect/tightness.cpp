// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tightness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fcl_kios/clearance.h"

namespace kios::inspect {
namespace {

constexpr int kDirections = 162;

/// Returns directions spread evenly over the sphere, on a spiral of golden angles.
std::vector<fcl::Vector3d> spiral() {
  const double golden = (3 - std::sqrt(5.0)) * M_PI;
  std::vector<fcl::Vector3d> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  return directions;
}

}  // namespace

// From L n, far outside, the volume is L - h away, h its support: at least, as it lies below the
// plane at h; at most about r^2 / 2 L more, as the point of height h is within r of the ray.
double support(const kIOSd& volume, const fcl::Vector3d& n) {
  const double far = 1e5 * volume.radius0;
  kIOSd about_origin = volume;
  about_origin.center0.setZero();
  return far - nearestPoint(about_origin, fcl::Vector3d(far * n)).distance;
}

Slack slackOf(const VolumeTree& tree, int node) {
  static const std::vector<fcl::Vector3d> directions = spiral();
  const Modeld& model = tree.model();
  const kIOSd& volume = tree.volume(node);
  // Relative to S0, so that an offset costs no digits.
  std::vector<fcl::Vector3d> content;
  Eigen::AlignedBox3d box;
  for (int i = tree.first(node); i < tree.last(node); ++i) {
    const fcl::Triangle& t = model.tri_indices[tree.triangles()[i]];
    for (int corner = 0; corner < 3; ++corner) {
      content.emplace_back(model.vertices[t[corner]] - volume.center0);
      box.extend(content.back());
    }
  }
  Slack result;
  const double size = result.size = box.diagonal().norm();
  if (!(size > 0)) return result;
  for (const fcl::Vector3d& n : directions) {
    double h = -std::numeric_limits<double>::infinity();
    for (const fcl::Vector3d& p : content) h = std::max(h, n.dot(p));
    const double slack = std::max(support(volume, n) - h, 0.0) / size;
    result.mean += slack / kDirections;
    result.max = std::max(result.max, slack);
    result.mean_s0 += (volume.radius0 - h) / size / kDirections;
  }
  return result;
}

LevelTightness measure(const VolumeTree& tree, int level, const std::vector<int>& nodes) {
  constexpr std::size_t kMeasured = 100;
  LevelTightness result;
  result.level = level;
  result.volumes = nodes.size();
  for (const int node : nodes) {
    if (tree.isLeaf(node)) ++result.leaves;
    ++result.k[tree.volume(node).k() / 2];
  }
  result.measured = std::min(nodes.size(), kMeasured);
  for (std::size_t i = 0; i < result.measured; ++i) {
    const int node = nodes[i * nodes.size() / result.measured];
    const Slack slack = slackOf(tree, node);
    result.slack.size += slack.size;
    result.slack.mean += slack.mean;
    result.slack.mean_s0 += slack.mean_s0;
    result.slack.max = std::max(result.slack.max, slack.max);
  }
  const double count = static_cast<double>(result.measured);
  result.slack.size /= count;
  result.slack.mean /= count;
  result.slack.mean_s0 /= count;
  return result;
}

}  // namespace kios::inspect
