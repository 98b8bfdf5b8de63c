// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mesh_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

#include "scenes/cad_parts.h"
#include "scenes/cad_shapes.h"

namespace kios::scenes {
namespace {

namespace fs = std::filesystem;

class MeshFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("kios_mesh_folder_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const char* name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  static std::string binaryStl(const Mesh& mesh) {
    std::string bytes(80, ' ');
    const auto append = [&](const auto& value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const fcl::Triangle& t : mesh.triangles) {
      for (int i = 0; i < 3; ++i) append(0.0F);
      for (int k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) append(static_cast<float>(mesh.vertices[t[k]][c]));
      }
      append(std::uint16_t{0});
    }
    return bytes;
  }
  std::string fault() {
    try {
      loadMeshes(folder_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(MeshFolder, ReadsStlAndObjByName) {
  const Mesh bar = filletedBar(0.1, 0.1, 0.5, 0.02, 4);
  write("b.STL", binaryStl(bar));
  write("a.obj",
        "# a square, a triangle by its ends\nv 0 0 0\nv 1 0 0 1\nvn 0 0 1\nv 1 1 0\nv 0 1 0\n"
        "usemtl steel\nf 1/1/1 2//1 3/2 4\nf -4 -3 -2\n");
  write("notes.txt", "nothing");
  const std::vector<Mesh> meshes = loadMeshes(folder_);
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].vertices.size(), 4u);
  ASSERT_EQ(meshes[0].triangles.size(), 3u);
  EXPECT_EQ(meshes[0].triangles[2][0], 0u);
  EXPECT_EQ(meshes[0].triangles[2][2], 2u);
  EXPECT_EQ(meshes[1].triangles.size(), bar.triangles.size());
  EXPECT_EQ(meshes[1].vertices.size(), bar.vertices.size());
}

TEST_F(MeshFolder, NamesTheFileAndTheFault) {
  EXPECT_NE(fault().find("holds no .stl and no .obj"), std::string::npos);
  const struct {
    const char *text, *fault;
  } kFaults[] = {{"v 0 0\n", "bad.obj:1: a vertex has not three finite numbers"},
                 {"v 0 0 nan\n", "bad.obj:1: a vertex has not three finite numbers"},
                 {"v 0 0 0\nf 1 1 2\n", "bad.obj:2: a face names the vertex '2' of 1"},
                 {"v 0 0 0\nf 1 1 x\n", "bad.obj:2: a face names the vertex 'x' of 1"},
                 {"v 0 0 0\nf 1 1 0\n", "bad.obj:2: a face names the vertex '0' of 1"},
                 {"v 0 0 0\nf 1 1\n", "bad.obj:2: a face has fewer than three corners"},
                 {"v 0 0 0\n", "bad.obj: has no faces"}};
  for (const auto& [text, expected] : kFaults) {
    write("bad.obj", text);
    EXPECT_NE(fault().find(expected), std::string::npos) << fault();
  }
  fs::remove(folder_ / "bad.obj");
  write("short.stl", "solid");
  EXPECT_NE(fault().find("short.stl: is too short"), std::string::npos) << fault();
}

// A link's mesh reaches from its joint to the next, at any angles.
TEST(Chain, LinksReachFromJointToJoint) {
  std::vector<Mesh> meshes = {filletedBar(0.1, 0.05, 0.4, 0.01, 3), tube(0.02, 0.05, 0.3, 12),
                              boredBlock({0.5, 0.1, 0.1}, 0.01, 0.01, 0.03, 16)};
  meshes[1] =
      moved(fcl::Transform3d(fcl::AngleAxisd(std::acos(0.0), fcl::Vector3d::UnitX())), meshes[1]);
  const Arm chain = chainOf(meshes);
  EXPECT_NEAR(chainLength(chain), 1.2, 1e-12);
  ASSERT_EQ(chain.centres.size(), 2u);
  const auto poses = linkPoses(chain, fcl::Transform3d::Identity(), {0, 0});
  double top = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double low = 1e9, high = -1e9;
    for (const fcl::Vector3d& p : meshes[i].vertices) {
      low = std::min(low, (poses[i] * p).z());
      high = std::max(high, (poses[i] * p).z());
    }
    EXPECT_NEAR(low, top, 1e-12);
    top = high;
  }
  EXPECT_NEAR(top, 1.2, 1e-12);
}

}  // namespace
}  // namespace kios::scenes
