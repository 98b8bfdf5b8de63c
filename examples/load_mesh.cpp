// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Loads triangles from any file that assimp reads (STL, OBJ, PLY, COLLADA, ...) and asks for the
// distance of two of them, or of one and itself, a size aside.
//
// usage: load_mesh FILE [FILE]
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fcl_kios/fcl_kios.h>

#include <assimp/Importer.hpp>
#include <iostream>
#include <stdexcept>
#include <string>

#include "shapes.h"

namespace {

/// Throws std::runtime_error if the file can't be read or holds no triangle. Vertices are in the
/// file's units and the frame of its root; degenerate triangles stay.
shapes::Mesh<double> load(const std::string& file) {
  Assimp::Importer importer;
  // Points and lines are dropped; polygons are cut into triangles. Vertices are one if they have
  // the same place, whatever normal or texture they have in each triangle.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_BONEWEIGHTS);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(
      file, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType |
                aiProcess_JoinIdenticalVertices | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());

  shapes::Mesh<double> mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const std::size_t first = mesh.vertices.size();
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& v = part.mVertices[i];
      mesh.vertices.emplace_back(v.x, v.y, v.z);
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;
      mesh.triangles.emplace_back(first + face.mIndices[0], first + face.mIndices[1],
                                  first + face.mIndices[2]);
    }
  }
  if (mesh.triangles.empty()) throw std::runtime_error("there is no triangle in it");
  return mesh;
}

/// Refuses coordinates that are NaN or infinite, by std::invalid_argument.
std::shared_ptr<kios::Modeld> loadModel(const std::string& file) {
  try {
    const auto mesh = load(file);
    auto model = kios::makeModel(mesh.vertices, mesh.triangles);
    model->computeLocalAABB();
    std::cout << file << ": " << mesh.triangles.size() << " triangles, " << mesh.vertices.size()
              << " vertices, " << model->aabb_local.width() << " x " << model->aabb_local.height()
              << " x " << model->aabb_local.depth() << '\n';
    return model;
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: load_mesh FILE [FILE]\n";
    return 2;
  }
  try {
    const auto a = loadModel(argv[1]);
    const auto b = argc > 2 ? loadModel(argv[2]) : a;
    fcl::Transform3d aside = fcl::Transform3d::Identity();
    aside.translation().x() = 1.5 * a->aabb_local.width() + b->aabb_local.width() / 2 +
                              a->aabb_center.x() - b->aabb_center.x();
    const fcl::CollisionObjectd object_a(a), object_b(b, aside);
    fcl::DistanceResultd result;
    fcl::distance(&object_a, &object_b, fcl::DistanceRequestd(true), result);
    std::cout << "the second moved by " << aside.translation().x() << " along x: distance "
              << result.min_distance << ", triangles " << result.b1 << " and " << result.b2 << '\n';
  } catch (const std::exception& error) {
    std::cerr << "load_mesh: " << error.what() << '\n';
    return 1;
  }
}
