// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "defects.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace kios::inspect {
namespace {

using Corners = std::array<std::size_t, 3>;

/// Returns the height over the longest edge, in units of it; 0 if all corners coincide.
double relativeHeight(const fcl::Vector3d& a, const fcl::Vector3d& b, const fcl::Vector3d& c) {
  const fcl::Vector3d edges[3] = {b - a, c - b, a - c};
  double longest = 0;
  for (const fcl::Vector3d& edge : edges) longest = std::max(longest, edge.cwiseAbs().maxCoeff());
  if (longest == 0) return 0;
  // Scaled, as the squares of tiny and of huge edges are out of range.
  const fcl::Vector3d u = edges[0] / longest, v = edges[2] / longest, w = edges[1] / longest;
  const double squared = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
  return u.cross(v).norm() / squared;
}

void countDuplicates(std::vector<Corners> corners, Defects& defects) {
  std::vector<std::size_t> order(corners.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
    std::sort(corners[i].begin(), corners[i].end());
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(corners[a], a) < std::tie(corners[b], b);
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (corners[order[i]] != corners[order[i - 1]]) continue;
    if (defects.duplicates == 0 || order[i] < defects.first_duplicate) {
      defects.first_duplicate = order[i];
    }
    ++defects.duplicates;
  }
}

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}
std::string triangles(std::size_t n) { return counted(n, "triangle", "triangles"); }

}  // namespace

Defects findDefects(const Mesh& mesh) {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  Defects result;
  std::vector<bool> used(mesh.vertices.size());
  for (const fcl::Triangle& t : mesh.triangles) used[t[0]] = used[t[1]] = used[t[2]] = true;
  result.unreferenced = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));

  Mesh welded = mesh;
  files::weld(welded);
  std::vector<bool> distinct(welded.vertices.size());
  std::vector<Corners> corners;
  corners.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const fcl::Triangle& t = mesh.triangles[i];
    const fcl::Triangle& w = welded.triangles[i];
    corners.push_back({w[0], w[1], w[2]});
    distinct[w[0]] = distinct[w[1]] = distinct[w[2]] = true;
    const double height =
        relativeHeight(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    if (height <= kRounding) {
      if (result.zero_area++ == 0) result.first_zero_area = i;
    } else if (height < kSliverHeight) {
      if (result.slivers++ == 0) result.first_sliver = i;
    }
  }
  result.distinct_vertices =
      static_cast<std::size_t>(std::count(distinct.begin(), distinct.end(), true));
  result.surface = inspectClosedness<double>(mesh.vertices, mesh.triangles);
  countDuplicates(std::move(corners), result);
  return result;
}

std::vector<std::string> warnings(const Mesh& mesh, const Defects& defects) {
  std::vector<std::string> result = mesh.warnings;
  if (defects.zero_area > 0) {
    result.push_back(triangles(defects.zero_area) + " of no area, the first is " +
                     std::to_string(defects.first_zero_area) +
                     ": corners coincide or lie on a line");
  }
  if (defects.slivers > 0) {
    result.push_back(triangles(defects.slivers) +
                     " more than 1000 times as long as high, the first is " +
                     std::to_string(defects.first_sliver) + ": spheres fit slivers badly");
  }
  if (defects.duplicates > 0) {
    result.push_back(triangles(defects.duplicates) +
                     " with the corners of an earlier one, the first is " +
                     std::to_string(defects.first_duplicate));
  }
  if (defects.unreferenced > 0) {
    result.push_back(std::to_string(defects.unreferenced) + " of " +
                     std::to_string(mesh.vertices.size()) + " vertices in no triangle");
  }
  const Closedness& surface = defects.surface;
  if (surface.branching_edges > 0) {
    const auto n = static_cast<std::size_t>(surface.branching_edges);
    result.push_back(counted(n, "edge", "edges") + " of more than two triangles");
  }
  if (surface.closed && !surface.oriented) {
    result.push_back("closed, but no solid: " + faultsOf(surface));
  }
  return result;
}

}  // namespace kios::inspect
