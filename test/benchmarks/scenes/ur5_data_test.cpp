// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/ur5_data.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/pqp_data.h"

namespace kios::scenes {
namespace {

namespace fs = std::filesystem;

std::string stlBytes(std::uint32_t announced, const std::vector<float>& corners) {
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&announced), sizeof announced);
  for (std::size_t i = 0; i + 9 <= corners.size(); i += 9) {
    bytes.append(3 * sizeof(float), '\0');
    bytes.append(reinterpret_cast<const char*>(&corners[i]), 9 * sizeof(float));
    bytes.append(2, '\0');
  }
  return bytes;
}

// Reads the bytes as a file; the fault that is found, or nothing.
std::string complaint(const std::string& bytes, Mesh& mesh) {
  const fs::path file = fs::temp_directory_path() / "kios_stl_loader_test.stl";
  std::ofstream(file, std::ios::binary) << bytes;
  std::string message;
  try {
    mesh = loadStl(file);
  } catch (const std::runtime_error& error) {
    message = error.what();
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
  }
  fs::remove(file);
  return message;
}

TEST(Ur5Data, ReadsStlAndNamesFaults) {
  const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  Mesh mesh;
  EXPECT_EQ(complaint(stlBytes(1, corners), mesh), "");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[1], fcl::Vector3d(1, 0, 0));
  EXPECT_NE(complaint("solid", mesh).find("too short"), std::string::npos);
  EXPECT_NE(complaint(stlBytes(2, corners), mesh).find("2 triangles"), std::string::npos);
  std::vector<float> infinite = corners;
  infinite[4] = std::numeric_limits<float>::infinity();
  EXPECT_NE(complaint(stlBytes(1, infinite), mesh).find("no finite number"), std::string::npos);
  EXPECT_THROW(loadStl("/nonexistent/mesh.stl"), std::runtime_error);
  EXPECT_THROW(loadUr5("/nonexistent"), std::runtime_error);
}

TEST(Ur5Data, ArmOfTheDataFolder) {
  const auto folder = findData();
  if (!folder || !holdsUr5(*folder)) GTEST_SKIP() << "no data folder: set KIOS_DATA";
  const Arm arm = loadUr5(*folder);
  ASSERT_EQ(arm.links.size(), 7u);
  const std::size_t triangles[] = {235, 674, 1176, 1050, 702, 702, 446};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(arm.links[i].mesh.triangles.size(), triangles[i]);
    EXPECT_LT(arm.links[i].mesh.vertices.size(), 3 * triangles[i] / 4);
  }
  // The wrist's centre with all joints at 0: UR's published lengths.
  const auto poses = linkPoses(arm, fcl::Transform3d::Identity(), std::vector<double>(6, 0));
  const fcl::Vector3d wrist = poses[6] * arm.links[6].X_LM.inverse() * fcl::Vector3d::Zero();
  EXPECT_LE((wrist - fcl::Vector3d(-0.81725, -0.19145, -0.005491)).norm(), 1e-9);
}

}  // namespace
}  // namespace kios::scenes
