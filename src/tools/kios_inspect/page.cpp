// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "page.h"

#include <algorithm>
#include <cstring>

#include "page_text.h"
#include "painted_mesh.h"
#include "report.h"
#include "surface.h"

namespace kios::inspect {
namespace {

/// Little-endian bytes in base64, as the page's script reads them.
template <typename T>
std::string base64(const std::vector<T>& values) {
  static_assert(sizeof(T) == 4);
  static const char* const digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size() + 2);
  for (const T& value : values) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  const std::size_t length = bytes.size();
  bytes.resize((length + 2) / 3 * 3);
  std::string text;
  text.reserve(bytes.size() / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2];
    for (int digit = 3; digit >= 0; --digit) text += digits[three >> (6 * digit) & 63];
  }
  std::fill(text.end() - static_cast<std::ptrdiff_t>(bytes.size() - length), text.end(), '=');
  return text;
}

/// The page's units: each mesh about the middle of its box, lengths in parts of the largest mesh,
/// so that floats serve wherever the meshes are and whatever their size.
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

  /// What renderer.js reads of a volume: 32 numbers.
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
  const Eigen::Matrix4d m = X.matrix();
  return std::vector<double>(m.data(), m.data() + m.size());
}

/// Levels from the root on, as long as they fit into `budget` bytes; what is left of it.
Json levels(const Inspection& inspection, const Units& units, double& budget, Json& volumes) {
  constexpr double kBytes = 128 * 4 / 3.0;
  Json result = Json::array();
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
    result.push_back(base64(records));
    volumes.push_back(nodes.size());
  }
  return result;
}

void replace(std::string& text, const std::string& mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
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
  int first_level = 0;
  for (std::size_t i = 0; i < inspections.size(); ++i) {
    const Inspection& inspection = inspections[i];
    fcl::Transform3d X = poses[i];
    X.translation() = (poses[i] * inspection.box.center() - world.center()) / units.scale;
    Json mesh = {{"color", meshColor(static_cast<int>(i))}, {"matrix", columnMajor(X)}};
    double budget = share;
    const double mesh_bytes = 16.0 * static_cast<double>(inspection.mesh.vertices.size() +
                                                         inspection.mesh.triangles.size());
    const std::string name = inspections.size() > 1 ? inspection.file + ": " : "";
    if (mesh_bytes <= share / 2) {
      budget -= mesh_bytes;
      mesh["positions"] = base64(units.positions(inspection));
      std::vector<std::uint32_t> corners;
      for (const fcl::Triangle& t : inspection.mesh.triangles) {
        for (int c = 0; c < 3; ++c) corners.push_back(static_cast<std::uint32_t>(t[c]));
      }
      mesh["triangles"] = base64(corners);
    } else {
      mesh["positions"] = nullptr;
      notes.push_back(name + "The mesh itself is left out, as the page would be too large: see " +
                      "--html-limit.");
    }
    Json volumes = Json::array();
    mesh["levels"] = levels(inspection, units, budget, volumes);
    const int last = static_cast<int>(volumes.size()) - 1;
    if (last < inspection.tree->depth()) {
      notes.push_back(name + "Levels " + std::to_string(last + 1) + " to " +
                      std::to_string(inspection.tree->depth()) +
                      " are left out, as the page would be too large: see --html-limit.");
    }
    for (int level = 0; level <= last; ++level) {
      if (volumes[level] <= 64) first_level = std::max(first_level, level);
    }
    mesh["volumes"] = volumes;
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
        {"level", options.level < 0 ? first_level : options.level},
        {"meshes", std::move(meshes)},
        {"segment",
         pair ? Json{placed(pair->answer.point1), placed(pair->answer.point2)} : Json(nullptr)}}}};
  std::string data = content.dump(-1, ' ', false, Json::error_handler_t::replace);
  // A file may be called </script>.
  for (std::size_t at = 0; (at = data.find('<', at)) != std::string::npos;) {
    data.replace(at, 1, "\\u003c");
  }

  std::string html = kPageHtml;
  replace(html, "@STYLE@", kPageStyle);
  replace(html, "@SCRIPT@", std::string(kPageRenderer) + kPageScript);
  replace(html, "@SCENE@", data);
  return html;
}

}  // namespace kios::inspect
