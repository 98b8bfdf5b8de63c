// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What kios_inspect writes, read back by assimp, and what assimp's formats become.
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "inspection.h"
#include "mesh_file.h"
#include "page.h"
#include "painted_mesh.h"
#include "sample_files.h"
#include "scenes/shapes.h"
#include "surface.h"
#include "surface_check.h"
#include "volume_file.h"

namespace kios::inspect {
namespace {

Inspection inspected(const std::filesystem::path& file) {
  Progress progress(true);
  return inspect(file, true, progress);
}

std::vector<fcl::Vector3d> contentOf(const Inspection& inspection, int node) {
  std::vector<fcl::Vector3d> content;
  const VolumeTree& tree = *inspection.tree;
  for (int i = tree.first(node); i < tree.last(node); ++i) {
    const fcl::Triangle& t = inspection.mesh.triangles[tree.triangles()[i]];
    for (int c = 0; c < 3; ++c) content.push_back(inspection.mesh.vertices[t[c]]);
  }
  return content;
}

double sizeOf(const std::vector<fcl::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& p : points) box.extend(p);
  return box.diagonal().norm();
}

Polyhedron polyhedronOf(const aiMesh& mesh) {
  Polyhedron result;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    result.vertices.emplace_back(v.x, v.y, v.z);
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    EXPECT_EQ(face.mNumIndices, 3u);
    result.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return result;
}

// Floats of the files round coordinates of up to 2 by 2^-24 of them; the rest is the surface's own.
constexpr double kRounding = 4e-7;

TEST(Files, EachVolumeOfAGlbIsThatOfItsNode) {
  const auto file = writeStl("volumes.stl", scenes::knobbyTorus());
  const Inspection inspection = inspected(file);
  for (const int level : {0, 3, 6}) {
    const std::vector<int> nodes = inspection.tree->level(level);
    const auto out = sampleFile("level.glb");
    writeMeshes(out, paintLevel(*inspection.tree, level, 3));
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(out.string(), 0);
    ASSERT_TRUE(scene) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, nodes.size());
    std::set<std::string> colors;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const aiMesh& mesh = *scene->mMeshes[i];
      const kIOSd& volume = inspection.tree->volume(nodes[i]);
      const std::vector<fcl::Vector3d> content = contentOf(inspection, nodes[i]);
      const Polyhedron surface = polyhedronOf(mesh);
      expectClosed(surface);
      EXPECT_LT(worstExcess(surface, volume), kRounding);
      EXPECT_LT(worstUncovered(surface, content), 0.01 * sizeOf(content));
      ASSERT_TRUE(mesh.HasNormals());
      double area = 0, turned_away = 0;
      for (const auto& t : surface.triangles) {
        const auto& v = surface.vertices;
        const fcl::Vector3d face = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
        for (const std::uint32_t corner : t) {
          const aiVector3D& n = mesh.mNormals[corner];
          EXPECT_NEAR(n.Length(), 1, 1e-5);
          area += face.norm();
          if (face.dot(fcl::Vector3d(n.x, n.y, n.z)) < 0) turned_away += face.norm();
        }
      }
      // A few tiny faces, where three spheres meet.
      EXPECT_LT(turned_away, 5e-4 * area);
      aiColor4D color;
      scene->mMaterials[mesh.mMaterialIndex]->Get("$clr.base", 0, 0, color);
      colors.insert(std::to_string(color.r) + std::to_string(color.g) + std::to_string(color.b));
    }
    EXPECT_EQ(colors.size(), nodes.size()) << "one colour a volume";
  }
}

TEST(Files, APlyHoldsAllVolumesInOneMesh) {
  const Inspection inspection = inspected(writeStl("volumes.stl", scenes::bumpyBlob()));
  const std::vector<PaintedMesh> painted = paintLevel(*inspection.tree, 4, 2);
  ASSERT_EQ(painted.size(), 16u);
  const auto out = sampleFile("level.ply");
  writeMeshes(out, painted);
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(out.string(), 0);
  ASSERT_TRUE(scene) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 1u);
  const aiMesh& mesh = *scene->mMeshes[0];
  ASSERT_TRUE(mesh.HasVertexColors(0));
  const Polyhedron whole = polyhedronOf(mesh);
  std::size_t vertex = 0, triangle = 0;
  const std::vector<int> nodes = inspection.tree->level(4);
  for (std::size_t i = 0; i < painted.size(); ++i) {
    Polyhedron part;
    const std::size_t first = vertex;
    for (; vertex < first + painted[i].vertices.size(); ++vertex) {
      part.vertices.push_back(whole.vertices[vertex]);
      for (unsigned channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(mesh.mColors[0][vertex][channel], painted[i].color[channel] / 255.0, 1e-6);
      }
    }
    for (std::size_t n = 0; n < painted[i].triangles.size(); ++n, ++triangle) {
      const auto& t = whole.triangles[triangle];
      const auto begin = static_cast<std::uint32_t>(first);
      ASSERT_GE(*std::min_element(t.begin(), t.end()), begin);
      ASSERT_LT(*std::max_element(t.begin(), t.end()), vertex);
      part.triangles.push_back({t[0] - begin, t[1] - begin, t[2] - begin});
    }
    expectClosed(part);
    EXPECT_LT(worstExcess(part, inspection.tree->volume(nodes[i])), kRounding);
    const std::vector<fcl::Vector3d> content = contentOf(inspection, nodes[i]);
    EXPECT_LT(worstUncovered(part, content), 0.03 * sizeOf(content));
  }
  EXPECT_EQ(vertex, whole.vertices.size());
  EXPECT_EQ(triangle, whole.triangles.size());
}

TEST(Files, TheMeshComesBackAsItWas) {
  const Inspection inspection = inspected(writeStl("mesh.stl", scenes::bentTorus()));
  for (const char* name : {"mesh.ply", "mesh.glb"}) {
    const auto out = sampleFile(name);
    writeMeshes(out, {paintMesh(inspection)});
    const Mesh mesh = readMesh(out);
    ASSERT_EQ(mesh.triangles.size(), inspection.mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(mesh.vertices[mesh.triangles[i][c]],
                  inspection.mesh.vertices[inspection.mesh.triangles[i][c]]);
      }
    }
  }
}

TEST(Files, ObjAndStlAgree) {
  const scenes::Mesh shape = scenes::knobbyTorus();
  const Inspection stl = inspected(writeStl("torus.stl", shape));
  const Inspection obj = inspected(writeObj("torus.obj", shape));
  EXPECT_EQ(stl.mesh.triangles.size(), shape.triangles.size());
  EXPECT_EQ(obj.mesh.triangles.size(), shape.triangles.size());
  EXPECT_EQ(stl.defects.distinct_vertices, shape.vertices.size());
  EXPECT_EQ(obj.defects.distinct_vertices, shape.vertices.size());
  EXPECT_TRUE(stl.defects.closed());
  EXPECT_EQ(stl.nodes(), 2 * static_cast<int>(shape.triangles.size()) - 1);
  EXPECT_EQ(stl.k[0] + stl.k[1] + stl.k[2], static_cast<std::size_t>(stl.nodes()));
  EXPECT_GT(stl.prepared_bytes, 100 * shape.triangles.size());
  EXPECT_TRUE(stl.box.isApprox(obj.box, 1e-6));
}

TEST(Files, ScenesAreFlattenedByTheirTransforms) {
  // One triangle, placed twice: moved, and turned about z and doubled below a moved parent.
  const Mesh mesh = readMesh(writeScene("scene.dae"));
  EXPECT_EQ(mesh.parts, 2);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  const fcl::Vector3d expected[2][3] = {{{10, 0, 0}, {11, 0, 0}, {10, 1, 0}},
                                        {{0, 0, 5}, {0, 2, 5}, {-2, 0, 5}}};
  for (int i = 0; i < 2; ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_LT((mesh.vertices[mesh.triangles[i][c]] - expected[i][c]).norm(), 1e-6) << i << c;
    }
  }
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
  // What renderer.js evaluates is 0 on the surface of each volume, and negative inside.
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
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const std::vector<float> records = floatsOf(levels[level]);
    const std::vector<int> nodes = inspection.tree->level(static_cast<int>(level));
    ASSERT_EQ(records.size(), 32 * nodes.size());
    for (std::size_t i = 0; i < nodes.size(); i += 1 + nodes.size() / 40) {
      const float* const r = &records[32 * i];
      const fcl::Vector3d middle(r[0], r[1], r[2]);
      const double kappa[5] = {r[7], r[8], r[9], r[10], r[11]};
      const kIOSd& volume = inspection.tree->volume(nodes[i]);
      for (const fcl::Vector3d& v : triangulate(volume, 1).vertices) {
        const fcl::Vector3d x = (v + volume.center0 - inspection.box.center()) / scale - middle;
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
