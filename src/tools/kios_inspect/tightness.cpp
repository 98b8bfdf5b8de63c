// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tightness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface.h"

namespace kios::inspect {

Slack slackOf(const VolumeTree& tree, int node) {
  static const Directions directions = icosphere(2);
  const Modeld& model = tree.model();
  const kIOSd& volume = tree.volume(node);
  // Relative to S0, so that an offset costs no digits.
  std::vector<fcl::Vector3d> content;
  Eigen::AlignedBox3d box;
  for (int i = tree.first(node); i < tree.last(node); ++i) {
    const fcl::Triangle& t = model.tri_indices[tree.triangles()[i]];
    for (int corner = 0; corner < 3; ++corner) {
      const fcl::Vector3d p = model.vertices[t[corner]] - volume.center0;
      box.extend(p);
      content.push_back(p);
    }
  }
  Slack result;
  const double size = result.size = box.diagonal().norm();
  const Surface surface = triangulate(volume, 3);
  if (!(size > 0) || surface.vertices.empty()) return result;
  const auto support = [](const std::vector<fcl::Vector3d>& points, const fcl::Vector3d& n) {
    double h = -std::numeric_limits<double>::infinity();
    for (const fcl::Vector3d& p : points) h = std::max(h, n.dot(p));
    return h;
  };
  for (const fcl::Vector3d& n : directions.vertices) {
    const double h = support(content, n);
    // The surface is inscribed, and may end before its content in a direction where both touch.
    const double slack = std::max(support(surface.vertices, n) - h, 0.0) / size;
    result.mean += slack;
    result.max = std::max(result.max, slack);
    result.mean_s0 += (volume.radius0 - h) / size;
  }
  const double count = static_cast<double>(directions.vertices.size());
  result.mean /= count;
  result.mean_s0 /= count;
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
