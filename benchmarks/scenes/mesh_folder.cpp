// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_folder.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "cad_shapes.h"
#include "placement.h"
#include "ur5_data.h"

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

/// Returns the vertex that a corner of a face names: its first number, from 1, or from the end if
/// negative.
std::size_t vertexOf(const std::string& corner, std::size_t count) {
  std::size_t end = 0;
  long index = 0;
  try {
    index = std::stol(corner, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const bool number = end > 0 && (end == corner.size() || corner[end] == '/');
  const long vertex = index < 0 ? static_cast<long>(count) + index : index - 1;
  if (!number || vertex < 0 || vertex >= static_cast<long>(count)) {
    throw std::out_of_range("a face names the vertex '" + corner + "' of " + std::to_string(count));
  }
  return static_cast<std::size_t>(vertex);
}

struct Box {
  Vector3d low, high;
};

Box boxOf(const Mesh& mesh) {
  Box box = {mesh.vertices.at(0), mesh.vertices.at(0)};
  for (const Vector3d& p : mesh.vertices) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

/// Stands the mesh on the origin with the longest side of its box along z.
Transform3d upright(const Box& box) {
  int longest = 0;
  (box.high - box.low).maxCoeff(&longest);
  Transform3d X = Transform3d::Identity();
  if (longest == 0) X = turn(-kPi / 2, Vector3d::UnitY());
  if (longest == 1) X = turn(kPi / 2, Vector3d::UnitX());
  const Vector3d middle = 0.5 * (box.low + box.high);
  const double half = 0.5 * (box.high - box.low)[longest];
  return shift(0, 0, half) * X * shift(-middle.x(), -middle.y(), -middle.z());
}

}  // namespace

Mesh loadObj(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be opened for reading");
  Mesh mesh;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    std::istringstream words(line);
    std::string key;
    words >> key;
    try {
      if (key == "v") {
        Vector3d p;
        if (!(words >> p.x() >> p.y() >> p.z()) || !p.allFinite()) {
          throw std::runtime_error("a vertex has not three finite numbers");
        }
        mesh.vertices.push_back(p);
      } else if (key == "f") {
        std::vector<std::size_t> face;
        for (std::string corner; words >> corner;) {
          face.push_back(vertexOf(corner, mesh.vertices.size()));
        }
        if (face.size() < 3) throw std::runtime_error("a face has fewer than three corners");
        for (std::size_t i = 2; i < face.size(); ++i) {
          mesh.triangles.emplace_back(face[0], face[i - 1], face[i]);
        }
      }
    } catch (const std::exception& fault) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + fault.what());
    }
  }
  if (mesh.triangles.empty()) throw std::runtime_error(file.string() + ": has no faces");
  return mesh;
}

std::vector<Mesh> loadMeshes(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = lowerExtension(entry.path());
    if (extension == ".stl" || extension == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Mesh> meshes;
  for (const fs::path& file : files) {
    meshes.push_back(welded(lowerExtension(file) == ".stl" ? loadStl(file) : loadObj(file)));
    if (meshes.back().triangles.empty()) {
      throw std::runtime_error(file.string() + ": has no triangles");
    }
  }
  if (meshes.empty()) {
    throw std::runtime_error(folder.string() + ": holds no .stl and no .obj file");
  }
  return meshes;
}

Arm chainOf(const std::vector<Mesh>& meshes) {
  constexpr double kCentre = 0.4, kTwist = 1.5, kBend = 0.7;
  Arm arm;
  double reach = 0;  // of the link before
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    // Even links turn about the arm's direction, their z; odd ones bend about an axis across it,
    // with -y along the arm.
    const bool across = i % 2 == 1;
    const Box box = boxOf(meshes[i]);
    Link link;
    if (i > 0) {
      link.X_PL = across ? Transform3d(shift(0, 0, reach) * turn(-kPi / 2, Vector3d::UnitX()))
                         : Transform3d(shift(0, -reach, 0) * turn(kPi / 2, Vector3d::UnitX()));
      arm.centres.push_back(across ? kCentre : 0);
      arm.amplitudes.push_back(across ? kBend : kTwist);
    }
    link.X_LM = upright(box);
    if (across) link.X_LM = turn(kPi / 2, Vector3d::UnitX()) * link.X_LM;
    link.mesh = meshes[i];
    reach = (box.high - box.low).maxCoeff();
    arm.links.push_back(std::move(link));
  }
  return arm;
}

double chainLength(const Arm& chain) {
  double length = 0;
  for (const Link& link : chain.links) {
    const Box box = boxOf(link.mesh);
    length += (box.high - box.low).maxCoeff();
  }
  return length;
}

}  // namespace kios::scenes
