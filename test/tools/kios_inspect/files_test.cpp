// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pages hold what was inspected, and how tight its volumes are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "fcl_kios/clearance.h"
#include "inspection.h"
#include "page.h"
#include "sample_files.h"
#include "scenes/shapes.h"

namespace kios::inspect {
namespace {

Inspection inspected(const std::filesystem::path& file) {
  Progress progress(true);
  return inspect(file, true, progress);
}

std::vector<float> floatsOf(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xff);
  }
  std::vector<float> result(bytes.size() / sizeof(float));
  std::memcpy(result.data(), bytes.data(), result.size() * sizeof(float));
  return result;
}

TEST(Files, APageHoldsTheVolumesThatItDraws) {
  // The function that renderer.js evaluates is 0 on the surface of each volume, and negative
  // inside.
  std::vector<Inspection> inspections;
  inspections.push_back(inspected(writeStl("torus.stl", scenes::knobbyTorus())));
  const Inspection& inspection = inspections[0];
  const std::string html = page(inspections, nullptr, {});
  const std::string mark = "id=\"scene\">";
  const std::size_t begin = html.find(mark) + mark.size();
  const auto scene =
      nlohmann::json::parse(html.substr(begin, html.find('<', begin) - begin))["scene"];
  const auto& levels = scene["meshes"][0]["levels"];
  ASSERT_EQ(static_cast<int>(levels.size()), inspection.tree->depth() + 1);
  const double scale = inspection.box.diagonal().norm();
  std::vector<int> nodes = {0};
  for (std::size_t level = 0; level < levels.size(); ++level) {
    if (level > 0) nodes = inspection.tree->deeper(nodes);
    const std::vector<float> records = floatsOf(levels[level]);
    ASSERT_EQ(records.size(), 32 * nodes.size());
    for (std::size_t i = 0; i < nodes.size(); i += 1 + nodes.size() / 40) {
      const float* const r = &records[32 * i];
      const fcl::Vector3d middle(r[0], r[1], r[2]);
      const double kappa[5] = {r[7], r[8], r[9], r[10], r[11]};
      const kIOSd& volume = inspection.tree->volume(nodes[i]);
      for (int side = 0; side < 26; ++side) {
        fcl::Vector3d outwards(side / 9 - 1, side / 3 % 3 - 1, side % 3 - 1);
        if (outwards.isZero()) outwards.setOnes();
        const fcl::Vector3d v =
            nearestPoint(volume, fcl::Vector3d(volume.center0 + 3 * volume.radius0 * outwards)).p;
        const fcl::Vector3d x = (v - inspection.box.center()) / scale - middle;
        double f = -HUGE_VAL;
        for (int s = 0; s < 5; ++s) {
          const float* const u = r + 12 + 4 * s;
          f = std::max(
              f, 0.5 * kappa[s] * x.squaredNorm() - x.dot(fcl::Vector3d(u[0], u[1], u[2])) + u[3]);
        }
        EXPECT_NEAR(f, 0, 1e-6);
        for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(x[axis]), r[4 + axis] + 1e-6);
      }
    }
  }
}

TEST(Files, SlackIsWhatVolumesAddToTheirContents) {
  const Inspection inspection = inspected(writeStl("torus.stl", scenes::knobbyTorus()));
  ASSERT_EQ(inspection.levels.size(), static_cast<std::size_t>(inspection.tree->depth() + 1));
  for (const LevelTightness& level : inspection.levels) {
    EXPECT_EQ(level.k[0] + level.k[1] + level.k[2], level.volumes);
    EXPECT_GT(level.slack.mean, 0);
    EXPECT_LT(level.slack.mean, level.slack.mean_s0) << "caps make a volume tighter than S0";
    EXPECT_LT(level.slack.max, 0.5);
  }
  EXPECT_EQ(inspection.levels.back().leaves, inspection.mesh.triangles.size());

  // A ball's content that touches it everywhere leaves no slack.
  const Inspection sphere = inspected(writeStl("sphere.stl", scenes::icosphere(1, 4)));
  EXPECT_LT(sphere.levels[0].slack.mean, 0.005);
  EXPECT_NEAR(sphere.levels[0].slack.size, 2 * std::sqrt(3.0), 0.05);
}

}  // namespace
}  // namespace kios::inspect
