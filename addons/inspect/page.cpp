// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "page.h"

#include <algorithm>
#include <cmath>

#include "colors.h"
#include "report.h"
#include "viewer/viewer.h"

namespace kios::inspect {
namespace {

struct Ball {
  fcl::Vector3d center;
  double radius;
};

/// Returns the spheres of a volume relative to the centre of S0, exactly as the volume stores them.
std::vector<Ball> ballsOf(const kIOSd& volume) {
  std::vector<Ball> balls = {{fcl::Vector3d::Zero(), volume.radius0}};
  for (int i = 0; i + 1 < volume.k(); ++i) {
    const auto scaled = [&](float x) {
      return std::ldexp(static_cast<double>(x), volume.exponent);
    };
    balls.push_back({{scaled(volume.cap_x[i]), scaled(volume.cap_y[i]), scaled(volume.cap_z[i])},
                     scaled(volume.cap_r[i])});
  }
  return balls;
}

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
    std::vector<Ball> balls = ballsOf(volume);
    balls.resize(kIOSd::kMaxSpheres, balls.front());
    // A volume of a single point would have no curvature that floats can hold.
    const auto radius = [&](const Ball& ball) { return std::max(ball.radius / scale, 1e-6); };
    put((middle - inspection.box.center()) / scale, color[0] << 16 | color[1] << 8 | color[2]);
    put((upper - lower) / (2 * scale), 1 / radius(balls[0]));
    for (int i = 1; i < kIOSd::kMaxSpheres; ++i) {
      out.push_back(static_cast<float>(1 / radius(balls[i])));
    }
    for (const Ball& ball : balls) {
      const double r = radius(ball);
      const fcl::Vector3d c = (volume.center0 - middle + ball.center) / scale;
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
