// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "report.h"
#include "viewer/viewer.h"

namespace kios::inspect {
namespace {

using Color = std::array<std::uint8_t, 3>;  ///< sRGB

/// Gives one colour a node: hues go around the circle once, in the order of the content, so that a
/// volume's parts have colours like its own; neighbours differ in lightness. `place`: which of its
/// level's volumes it is.
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

/// Returns the colour of the first and the second mesh.
Color meshColor(int which) { return which == 0 ? Color{214, 218, 224} : Color{226, 196, 150}; }

/// Holds the page's units: each mesh about the middle of its box, lengths in parts of the largest
/// mesh, so that floats serve wherever the meshes are and whatever their size.
struct Units {
  double scale = 1;

  std::vector<float> positions(const Inspection& inspection) const {
    std::vector<float> result;
    for (const fcl::Vector3d& v : inspection.mesh.vertices) {
      const fcl::Vector3d p = (v - inspection.box.center()) / scale;
      for (int i = 0; i < 3; ++i) result.push_back(static_cast<float>(p[i]));
    }
    return result;
  }

  /// Appends the 32 numbers by which renderer.js draws a volume.
  void append(const kIOSd& volume, const Inspection& inspection, const Color& color,
              std::vector<float>& out) const {
    const auto put = [&](const fcl::Vector3d& v, double last) {
      for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(v[i]));
      out.push_back(static_cast<float>(last));
    };
    fcl::Vector3d lower, upper;
    volume.bounds(lower, upper);
    const fcl::Vector3d middle = (lower + upper) / 2;
    // Volumes of fewer spheres repeat the first. One of a single point would have no curvature that
    // floats can hold.
    const auto sphere = [&](int i) { return i < volume.k() ? i : 0; };
    const auto radius = [&](int i) {
      return std::max(volume.sphereRadius(sphere(i)) / scale, 1e-6);
    };
    put((middle - inspection.box.center()) / scale, color[0] << 16 | color[1] << 8 | color[2]);
    put((upper - lower) / (2 * scale), 1 / radius(0));
    for (int i = 1; i < kIOSd::kMaxSpheres; ++i) {
      out.push_back(static_cast<float>(1 / radius(i)));
    }
    for (int i = 0; i < kIOSd::kMaxSpheres; ++i) {
      const double r = radius(i);
      const fcl::Vector3d c = (volume.sphereCenter(sphere(i)) - middle) / scale;
      put(c / r, (c.norm() - r) * (c.norm() + r) / (2 * r));
    }
  }
};

Json columnMajor(const fcl::Transform3d& X) {
  const Eigen::Matrix4d& m = X.matrix();
  return std::vector<double>(m.data(), m.data() + m.size());
}

/// Adds `levels` from the root on, as many as fit into `budget` bytes, and their numbers of
/// `volumes`. The root's is there always.
void addLevels(const Inspection& inspection, const Units& units, double budget, Json& mesh) {
  constexpr double kBytes = 128 * 4 / 3.0;
  std::vector<int> nodes = {0};
  for (int level = 0; level <= inspection.tree->depth(); ++level) {
    if (level > 0) nodes = inspection.tree->deeper(nodes);
    budget -= kBytes * static_cast<double>(nodes.size());
    if (budget < 0 && level > 0) break;
    std::vector<float> records;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      units.append(inspection.tree->volume(nodes[i]), inspection,
                   colorOf(*inspection.tree, nodes[i], i), records);
    }
    mesh["levels"].push_back(viewer::base64(records));
    mesh["volumes"].push_back(nodes.size());
  }
}

/// Returns a mesh of the scene in at most `budget` bytes, and sentences about what it leaves out.
Json sceneMesh(const Inspection& inspection, const Units& units, double budget, Json& notes) {
  const std::string what = inspection.file + ": ";
  const std::string why = " left out, as the page would be too large: see --html-limit.";
  Json mesh = {{"positions", nullptr}, {"triangles", nullptr}};
  const double bytes = 16.0 * static_cast<double>(inspection.mesh.vertices.size() +
                                                  inspection.mesh.triangles.size());
  if (bytes <= budget / 2) {
    budget -= bytes;
    mesh["positions"] = viewer::base64(units.positions(inspection));
    std::vector<std::uint32_t> corners;
    for (const fcl::Triangle& t : inspection.mesh.triangles) {
      for (int c = 0; c < 3; ++c) corners.push_back(static_cast<std::uint32_t>(t[c]));
    }
    mesh["triangles"] = viewer::base64(corners);
    std::vector<std::uint32_t> marked;  // corners of the triangles that meet others
    std::vector<bool> meets(inspection.mesh.triangles.size());
    for (const SelfIntersection& pair : inspection.self_intersections) {
      for (const int t : {pair.triangle_a, pair.triangle_b})
        meets[static_cast<std::size_t>(t)] = true;
    }
    for (std::size_t t = 0; t < meets.size(); ++t) {
      if (meets[t]) marked.insert(marked.end(), &corners[3 * t], &corners[3 * t] + 3);
    }
    mesh["marked"] = viewer::base64(marked);
  } else {
    notes.push_back(what + "the mesh itself is" + why);
  }
  addLevels(inspection, units, budget, mesh);
  const std::size_t first_missing = mesh["levels"].size();
  const int deepest = inspection.tree->depth();
  if (static_cast<int>(first_missing) <= deepest) {
    notes.push_back(what + "levels " + std::to_string(first_missing) + " to " +
                    std::to_string(deepest) + " are" + why);
  }
  return mesh;
}

/// The deepest level at which a mesh has at most 64 volumes: they can be told apart.
int levelToLookAt(const Json& meshes) {
  int result = 0;
  for (const Json& mesh : meshes) {
    for (std::size_t level = 0; level < mesh["volumes"].size(); ++level) {
      if (mesh["volumes"][level] <= 64) result = std::max(result, static_cast<int>(level));
    }
  }
  return result;
}

}  // namespace

std::string page(const std::vector<Inspection>& inspections, const PairQuery* pair,
                 const PageOptions& options) {
  std::vector<fcl::Transform3d> poses(inspections.size(), fcl::Transform3d::Identity());
  if (pair) poses = {pair->X_WA, pair->X_WB};
  Units units;
  units.scale = 0;
  Eigen::AlignedBox3d world;
  for (std::size_t i = 0; i < inspections.size(); ++i) {
    const Eigen::AlignedBox3d& box = inspections[i].box;
    units.scale = std::max(units.scale, box.diagonal().norm());
    for (int corner = 0; corner < 8; ++corner) {
      world.extend(poses[i] * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
  }
  if (!(units.scale > 0)) units.scale = 1;

  Json notes = Json::array();
  Json meshes = Json::array();
  const double share = 1e6 * options.limit_megabytes / static_cast<double>(inspections.size());
  for (std::size_t i = 0; i < inspections.size(); ++i) {
    fcl::Transform3d X = poses[i];
    X.translation() = (poses[i] * inspections[i].box.center() - world.center()) / units.scale;
    Json mesh = sceneMesh(inspections[i], units, share, notes);
    mesh["color"] = meshColor(static_cast<int>(i));
    mesh["matrix"] = columnMajor(X);
    meshes.push_back(std::move(mesh));
  }

  const auto placed = [&](const fcl::Vector3d& p) -> Json {
    const fcl::Vector3d q = (p - world.center()) / units.scale;
    return {q[0], q[1], q[2]};
  };
  Json report = {{"meshes", Json::array()}, {"pair", nullptr}};
  for (const Inspection& inspection : inspections) report["meshes"].push_back(toJson(inspection));
  if (pair) report["pair"] = toJson(*pair);
  Json content = {
      {"report", report},
      {"notes", notes},
      {"scene",
       {{"radius", world.diagonal().norm() / (2 * units.scale)},
        {"level", options.level < 0 ? levelToLookAt(meshes) : options.level},
        {"meshes", meshes},
        {"segment", pair ? Json{placed(pair->answer.point_a), placed(pair->answer.point_b)}
                         : Json(nullptr)}}}};
  return viewer::page(viewer::kPageText,
                      content.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace kios::inspect
