// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "painted_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "surface.h"

namespace kios::inspect {
namespace {

std::array<float, 3> toFloat(const fcl::Vector3d& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

PaintedMesh paint(const kIOSd& volume, int detail) {
  const std::vector<Ball> balls = ballsOf(volume);
  const Surface surface = triangulate(volume, detail);
  PaintedMesh result;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> corners;
  for (const Surface::Face& face : surface.faces) {
    std::array<std::uint32_t, 3> triangle;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = face.corners[i];
      const auto [found, added] =
          corners.try_emplace({v, face.ball}, static_cast<std::uint32_t>(result.vertices.size()));
      triangle[i] = found->second;
      if (!added) continue;
      const fcl::Vector3d& x = surface.vertices[v];
      result.vertices.push_back(toFloat(x + volume.center0));
      result.normals.push_back(toFloat((x - balls[face.ball].center).normalized()));
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace

// OKLCH, in which equal steps look equal; B. Ottosson, "A perceptual color space for image
// processing", 2020.
Color colorOf(const VolumeTree& tree, int node, std::size_t place) {
  constexpr double kTurn = 6.283185307179586, kChroma = 0.125;
  const double lightness = place % 2 == 0 ? 0.74 : 0.64;
  const double hue = kTurn * (0.5 * (tree.first(node) + tree.last(node)) /
                                  static_cast<double>(tree.triangles().size()) +
                              0.2);
  const double a = kChroma * std::cos(hue), b = kChroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const double rgb[3] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                         -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                         -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  Color color;
  for (int i = 0; i < 3; ++i) {
    const double linear = std::clamp(rgb[i], 0.0, 1.0);
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    color[i] = static_cast<std::uint8_t>(std::lround(255 * encoded));
  }
  return color;
}

Color meshColor(int which) { return which == 0 ? Color{214, 218, 224} : Color{226, 196, 150}; }

std::vector<PaintedMesh> paintLevel(const VolumeTree& tree, int level, int detail) {
  std::vector<PaintedMesh> result;
  const std::vector<int> nodes = tree.level(level);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    PaintedMesh painted = paint(tree.volume(nodes[i]), detail);
    if (painted.triangles.empty()) continue;
    painted.name = "level " + std::to_string(level) + ", node " + std::to_string(nodes[i]);
    painted.color = colorOf(tree, nodes[i], i);
    result.push_back(std::move(painted));
  }
  return result;
}

PaintedMesh paintMesh(const Inspection& inspection) {
  PaintedMesh result;
  result.name = std::filesystem::path(inspection.file).filename().string();
  result.color = meshColor(0);
  for (const fcl::Vector3d& v : inspection.mesh.vertices) result.vertices.push_back(toFloat(v));
  for (const fcl::Triangle& t : inspection.mesh.triangles) {
    result.triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                                static_cast<std::uint32_t>(t[2])});
  }
  return result;
}

}  // namespace kios::inspect
