// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pqp_data.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace kios::scenes {
namespace {

namespace fs = std::filesystem;

/// Reads how many records follow, and `size` numbers of each.
std::vector<Eigen::VectorXd> readRecords(const fs::path& file, int size) {
  std::ifstream stream(file);
  std::size_t count = 0;
  stream >> count;
  std::vector<Eigen::VectorXd> records;
  for (std::size_t i = 0; i < count && stream; ++i) {
    for (double& number : records.emplace_back(size)) stream >> number;
  }
  if (!stream || count == 0) {
    throw std::runtime_error(file.string() + ": doesn't hold as many records of " +
                             std::to_string(size) + " numbers as it announces");
  }
  return records;
}

/// Returns the soup of a `.tris` file: the number of triangles, then three vertices of each.
Mesh loadTris(const fs::path& file) {
  Mesh mesh;
  for (const Eigen::VectorXd& corners : readRecords(file, 9)) {
    const std::size_t first = mesh.vertices.size();
    for (int c = 0; c < 3; ++c) mesh.vertices.emplace_back(corners.segment<3>(3 * c));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

/// Returns the poses of a `.path` file: the number of frames, then a row-major rotation of six
/// digits and a translation of each.
std::vector<fcl::Transform3d> loadPath(const fs::path& file) {
  std::vector<fcl::Transform3d> poses;
  for (const Eigen::VectorXd& pose : readRecords(file, 12)) {
    fcl::Transform3d& X = poses.emplace_back(fcl::Transform3d::Identity());
    for (int row = 0; row < 3; ++row) X.linear().row(row) = pose.segment<3>(3 * row).transpose();
    X.translation() = pose.tail<3>();
  }
  return poses;
}

bool holdsData(const fs::path& folder) {
  std::error_code ignored;  // an unreadable folder is an absent one
  return fs::is_directory(folder / "pqp", ignored);
}

}  // namespace

std::optional<fs::path> findData() {
  if (const char* named = std::getenv("KIOS_DATA"); named != nullptr && *named != '\0') {
    if (holdsData(named)) return fs::path(named);
    return std::nullopt;
  }
  for (const fs::path& base : {fs::current_path(), fs::path(KIOS_SOURCE_DIR)}) {
    const fs::path folder = base / ".." / "shared" / "data";
    if (holdsData(folder)) return folder.lexically_normal();
  }
  return std::nullopt;
}

MovingPair loadFalling(const fs::path& data) {
  const fs::path folder = data / "pqp";
  MovingPair pair{loadTris(folder / "torus1.tris"), loadTris(folder / "torus2.tris"), {}};
  const auto path_a = loadPath(folder / "torus1.path"), path_b = loadPath(folder / "torus2.path");
  for (std::size_t i = 0; i < path_a.size(); ++i) pair.frames.push_back({path_a[i], path_b.at(i)});
  return pair;
}

MovingPair loadSpinning(const fs::path& data, int frames) {
  const fs::path folder = data / "pqp" / "spinning";
  return {loadTris(folder / "bunny.tris"), loadTris(folder / "torus.tris"), spinningMotion(frames)};
}

}  // namespace kios::scenes
