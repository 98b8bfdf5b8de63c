// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "page.h"

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "viewer/viewer.h"

namespace kios::clash_tool {
namespace {

/// A model with its own middle, so that floats serve wherever it is.
struct Drawn {
  explicit Drawn(const Modeld& of) : model(of) {
    for (int i = 0; i < model.num_vertices; ++i) box.extend(model.vertices[i]);
  }

  double bytes() const { return 16.0 * (double{1} * model.num_vertices + model.num_tris); }

  Json toJson(double unit) const {
    std::vector<float> positions;
    for (int i = 0; i < model.num_vertices; ++i) {
      const fcl::Vector3d p = (model.vertices[i] - box.center()) / unit;
      for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(p[c]));
    }
    std::vector<std::uint32_t> corners;
    for (int t = 0; t < model.num_tris; ++t) {
      for (int c = 0; c < 3; ++c) {
        corners.push_back(static_cast<std::uint32_t>(model.tri_indices[t][c]));
      }
    }
    return {{"positions", viewer::base64(positions)}, {"triangles", viewer::base64(corners)}};
  }

  const Modeld& model;
  Eigen::AlignedBox3d box;
};

}  // namespace

std::string page(const Report& report, double limit_megabytes) {
  const std::vector<Part>& parts = report.assembly.parts;
  std::map<const Modeld*, std::pair<Drawn, int>> models;  // with their places in the page
  Eigen::AlignedBox3d world;
  for (const Part& part : parts) {
    auto known = models.find(part.model.get());
    if (known == models.end()) {
      known = models.emplace(part.model.get(), std::pair(Drawn(*part.model), -1)).first;
    }
    const Drawn& drawn = known->second.first;
    for (int corner = 0; corner < 8; ++corner) {
      using Corner = Eigen::AlignedBox3d::CornerType;
      world.extend(part.X_WP * drawn.box.corner(static_cast<Corner>(corner)));
    }
  }
  if (world.isEmpty()) world.extend(fcl::Vector3d::Zero());
  const double diagonal = world.diagonal().norm(), unit = diagonal > 0 ? diagonal : 1;

  std::vector<bool> clashes(parts.size());
  for (const ClashResult& clash : report.clashes) clashes[clash.a] = clashes[clash.b] = true;
  double budget = 1e6 * limit_megabytes;
  std::size_t left_out = 0;
  Json geometries = Json::array(), meshes(std::vector<Json>(parts.size()));
  for (const bool in_clash : {true, false}) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (clashes[i] != in_clash) continue;
      auto& [drawn, place] = models.at(parts[i].model.get());
      if (place < 0 && drawn.bytes() <= budget) {
        budget -= drawn.bytes();
        place = static_cast<int>(geometries.size());
        geometries.push_back(drawn.toJson(unit));
      }
      left_out += place < 0 ? 1 : 0;
      const fcl::Vector3d middle = (parts[i].X_WP * drawn.box.center() - world.center()) / unit;
      Eigen::Matrix4d matrix = parts[i].X_WP.matrix();
      matrix.topRightCorner<3, 1>() = middle;
      meshes[i] = {{"geometry", place},
                   {"size", drawn.box.diagonal().norm() / unit},
                   {"matrix", std::vector<double>(matrix.data(), matrix.data() + 16)}};
    }
  }
  const auto placed = [&](const double(&p)[3]) -> Json {
    const fcl::Vector3d q = (fcl::Vector3d(p[0], p[1], p[2]) - world.center()) / unit;
    return {q[0], q[1], q[2]};
  };
  Json segments = Json::array();
  for (const ClashResult& clash : report.clashes) {
    segments.push_back({placed(clash.point_a), placed(clash.point_b)});
  }
  const Json content = {{"report", toJson(report)},
                        {"order", report.bySeverity()},
                        {"left_out", left_out},
                        {"geometries", geometries},
                        {"segments", segments},
                        {"scene", {{"radius", 0.5}, {"segment", nullptr}, {"meshes", meshes}}}};
  return viewer::page(viewer::kPageText,
                      content.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace kios::clash_tool
