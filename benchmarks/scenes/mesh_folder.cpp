// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_folder.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

#include "cad_shapes.h"
#include "files/read_mesh.h"
#include "placement.h"

namespace kios::scenes {
namespace {

namespace fs = std::filesystem;
using fcl::Transform3d;
using fcl::Vector3d;

std::string lowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// Stands the mesh on the origin with the longest side of its box along z.
Transform3d upright(const Eigen::AlignedBox3d& box) {
  int longest = 0;
  box.sizes().maxCoeff(&longest);
  Transform3d X = Transform3d::Identity();
  if (longest == 0) X = turn(-kPi / 2, Vector3d::UnitY());
  if (longest == 1) X = turn(kPi / 2, Vector3d::UnitX());
  const Vector3d middle = box.center();
  return shift(0, 0, 0.5 * box.sizes()[longest]) * X * shift(-middle.x(), -middle.y(), -middle.z());
}

}  // namespace

Mesh loadMesh(const fs::path& file) {
  const files::Mesh read = files::readMesh(file.string());
  return welded({read.vertices, read.triangles});
}

std::vector<Mesh> loadMeshes(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = lowerExtension(entry.path());
    if (extension == ".stl" || extension == ".obj") names.push_back(entry.path());
  }
  std::sort(names.begin(), names.end());
  std::vector<Mesh> meshes;
  for (const fs::path& file : names) {
    meshes.push_back(loadMesh(file));
  }
  if (meshes.empty()) {
    throw std::runtime_error(folder.string() + ": holds no .stl and no .obj file");
  }
  return meshes;
}

Robot chainOf(const std::vector<Mesh>& meshes) {
  constexpr double kCentre = 0.4, kTwist = 1.5, kBend = 0.7;
  Robot arm;
  double reach = 0;  // of the link before
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const bool across = i % 2 == 1;
    const Eigen::AlignedBox3d box = boxOf(meshes[i]);
    addToChain(arm, reach, across ? kCentre : 0, across ? kBend : kTwist, upright(box), meshes[i]);
    reach = box.sizes().maxCoeff();
  }
  return arm;
}

double chainLength(const Robot& chain) {
  double length = 0;
  for (const Link& link : chain.links) length += boxOf(link.mesh).sizes().maxCoeff();
  return length;
}

}  // namespace kios::scenes
