// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace kios::inspect {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw InputError(file.string() + ": " + what);
}

/// assimp says "unable to open" and "no suitable reader" of many things; what the system knows
/// comes first.
void requireReadable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) refuse(file, "there is no such file.");
  if (fs::is_directory(status)) refuse(file, "this is a directory, not a mesh.");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, std::string("it can't be opened: ") + std::strerror(errno) + ".");
  if (stream.peek() == std::ifstream::traits_type::eof()) refuse(file, "the file is empty.");
}

fcl::Transform3d toTransform(const aiMatrix4x4& m) {
  Eigen::Matrix4d result;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) result(row, column) = m[row][column];
  }
  return fcl::Transform3d(result);
}

std::string nameOf(const aiMesh& mesh, unsigned index) {
  std::string name = "mesh " + std::to_string(index);
  if (mesh.mName.length > 0) name += std::string(" '") + mesh.mName.C_Str() + "'";
  return name;
}

void append(const fs::path& file, const aiScene& scene, unsigned index,
            const fcl::Transform3d& X_WM, Mesh& result) {
  const aiMesh& part = *scene.mMeshes[index];
  const std::size_t first = result.vertices.size();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    const fcl::Vector3d placed = X_WM * fcl::Vector3d(p.x, p.y, p.z);
    if (!placed.allFinite()) {
      std::ostringstream message;
      message << "vertex " << i << " of " << nameOf(part, index) << " is not finite: (" << p.x
              << ", " << p.y << ", " << p.z << ")";
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) {
        message << " before the scene's transforms, which are not finite";
      }
      refuse(file, message.str() + ". Repair the mesh: no query can answer for it.");
    }
    result.vertices.push_back(placed);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) {
      ++result.other_faces;
      continue;
    }
    for (unsigned corner = 0; corner < 3; ++corner) {
      if (face.mIndices[corner] < part.mNumVertices) continue;
      refuse(file, "face " + std::to_string(i) + " of " + nameOf(part, index) +
                       " refers to vertex " + std::to_string(face.mIndices[corner]) +
                       ", but there are " + std::to_string(part.mNumVertices) + ".");
    }
    result.triangles.emplace_back(first + face.mIndices[0], first + face.mIndices[1],
                                  first + face.mIndices[2]);
  }
  ++result.parts;
}

}  // namespace

Mesh readMesh(const fs::path& file) {
  requireReadable(file);
  Assimp::Importer importer;
  // Coordinates as the file has them, whatever axis it calls up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* const scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) {
    refuse(file, std::string("assimp can't read it as a mesh: ") + importer.GetErrorString());
  }

  Mesh result;
  std::vector<std::pair<const aiNode*, fcl::Transform3d>> waiting;
  waiting.emplace_back(scene->mRootNode, fcl::Transform3d::Identity());
  while (!waiting.empty()) {
    const auto [node, X_WP] = waiting.back();
    waiting.pop_back();
    const fcl::Transform3d X_WN = X_WP * toTransform(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      append(file, *scene, node->mMeshes[i], X_WN, result);
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) {
      waiting.emplace_back(node->mChildren[i], X_WN);
    }
  }
  if (result.triangles.empty()) {
    refuse(file, "it holds no triangles (" + std::to_string(result.vertices.size()) +
                     " vertices, " + std::to_string(result.other_faces) + " points or lines).");
  }
  return result;
}

}  // namespace kios::inspect
