// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <utility>

#include "fcl_kios/robot/robot.h"
#include "text_file.h"

namespace kios::robot {
namespace {

using Eigen::Vector3d;

struct Soup {
  std::vector<Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
};

Eigen::Affine3d toTransform(const aiMatrix4x4& m) {
  Eigen::Matrix4d result;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) result(row, column) = m[row][column];
  }
  return Eigen::Affine3d(result);
}

void append(const std::string& file, const aiMesh& part, const Eigen::Affine3d& X, Soup& soup) {
  const std::size_t first = soup.vertices.size();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    soup.vertices.push_back(X * Vector3d(p.x, p.y, p.z));
    if (!soup.vertices.back().allFinite()) {
      refuse(file + ": vertex " + std::to_string(i) + " is not finite; repair the mesh.");
    }
  }
  const bool mirrored = X.linear().determinant() < 0;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    std::size_t corners[3];
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices) {
        refuse(file + ": face " + std::to_string(i) + " refers to vertex " +
               std::to_string(face.mIndices[k]) + ", but there are " +
               std::to_string(part.mNumVertices) + ".");
      }
      corners[k] = first + face.mIndices[k];
    }
    if (mirrored) std::swap(corners[1], corners[2]);
    soup.triangles.emplace_back(corners[0], corners[1], corners[2]);
  }
}

struct Hash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double x : p) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

}  // namespace

std::shared_ptr<Modeld> weld(const std::vector<Vector3d>& vertices,
                             const std::vector<fcl::Triangle>& triangles) {
  std::unordered_map<std::array<double, 3>, std::size_t, Hash> known;
  std::vector<Vector3d> welded;
  std::vector<fcl::Triangle> corners;
  corners.reserve(triangles.size());
  const auto idOf = [&](std::size_t vertex) {
    const Vector3d& p = vertices[vertex];
    const std::array<double, 3> key = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // -0 is 0
    const auto [at, added] = known.emplace(key, welded.size());
    if (added) welded.emplace_back(key[0], key[1], key[2]);
    return at->second;
  };
  for (const fcl::Triangle& t : triangles) {
    const std::size_t a = idOf(t[0]), b = idOf(t[1]), c = idOf(t[2]);
    corners.emplace_back(a, b, c);
  }
  return makeModel(welded, corners);
}

std::shared_ptr<Modeld> readMesh(const std::string& file, const Vector3d& scale) {
  contentOf(file, std::size_t{1} << 32);  // assimp says little of files that can't be read
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* const scene = importer.ReadFile(file, aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) {
    refuse(file + ": it can't be read as a mesh: " + importer.GetErrorString());
  }
  Soup soup;
  std::vector<std::pair<const aiNode*, Eigen::Affine3d>> waiting;
  waiting.emplace_back(scene->mRootNode, Eigen::Affine3d(Eigen::Scaling(scale)));
  while (!waiting.empty()) {
    const auto [node, X_P] = waiting.back();
    waiting.pop_back();
    const Eigen::Affine3d X = X_P * toTransform(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      append(file, *scene->mMeshes[node->mMeshes[i]], X, soup);
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) waiting.emplace_back(node->mChildren[i], X);
  }
  if (soup.triangles.empty()) refuse(file + ": it holds no triangle.");
  try {
    return weld(soup.vertices, soup.triangles);
  } catch (const std::exception& error) {
    refuse(file + ": " + error.what());
  }
}

}  // namespace kios::robot

namespace kios {

std::shared_ptr<Modeld> loadMesh(const std::string& file, double scale) {
  if (!(std::abs(scale) > 0 && std::isfinite(scale))) {
    robot::refuse("the scale of " + file + " must be finite and not 0.");
  }
  return robot::readMesh(file, Eigen::Vector3d::Constant(scale));
}

}  // namespace kios
