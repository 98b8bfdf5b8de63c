// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pqp_data.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace kios::scenes {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& fault) {
  throw std::runtime_error(file.string() + ": " + fault);
}

// Reads the count on the first line and then numbers one by one; every fault names the file.
class NumberFile {
 public:
  explicit NumberFile(const fs::path& file) : file_(file), stream_(file) {
    if (!stream_) refuse(file_, "cannot be opened for reading");
  }

  // `what` names the things counted, for the message.
  std::size_t count(const std::string& what) {
    constexpr long long kMost = 100'000'000;
    long long n = 0;
    if (!(stream_ >> n) || n < 1 || n > kMost) {
      refuse(file_,
             "must begin with the number of " + what + ", from 1 to " + std::to_string(kMost));
    }
    return static_cast<std::size_t>(n);
  }

  // `record` and `index` say where the file ended or went wrong.
  double number(const char* record, std::size_t index) {
    double value = 0;
    if (!(stream_ >> value) || !std::isfinite(value)) {
      refuse(file_, std::string(stream_.eof() ? "ends within " : "has no finite number in ") +
                        record + " " + std::to_string(index));
    }
    return value;
  }

  void expectEnd(const std::string& announced) {
    stream_ >> std::ws;
    if (!stream_.eof()) refuse(file_, "goes on after the " + announced + " it announces");
  }

 private:
  fs::path file_;
  std::ifstream stream_;
};

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

Mesh loadTris(const fs::path& file) {
  NumberFile numbers(file);
  const std::size_t triangles = numbers.count("triangles");
  Mesh mesh;
  for (std::size_t i = 0; i < triangles; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      fcl::Vector3d p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = numbers.number("triangle", i);
      mesh.vertices.push_back(p);
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  numbers.expectEnd("triangles");
  return mesh;
}

std::vector<fcl::Transform3d> loadPath(const fs::path& file) {
  NumberFile numbers(file);
  const std::size_t frames = numbers.count("frames");
  std::vector<fcl::Transform3d> poses;
  for (std::size_t i = 0; i < frames; ++i) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        pose.linear()(row, column) = numbers.number("frame", i);
      }
    }
    for (int row = 0; row < 3; ++row) pose.translation()(row) = numbers.number("frame", i);
    poses.push_back(pose);
  }
  numbers.expectEnd("frames");
  return poses;
}

MovingPair loadFalling(const fs::path& data) {
  const fs::path folder = data / "pqp";
  MovingPair pair{loadTris(folder / "torus1.tris"), loadTris(folder / "torus2.tris"), {}};
  const auto path_a = loadPath(folder / "torus1.path");
  const auto path_b = loadPath(folder / "torus2.path");
  if (path_a.size() != path_b.size()) {
    refuse(folder / "torus2.path", "has " + std::to_string(path_b.size()) +
                                       " frames where torus1.path has " +
                                       std::to_string(path_a.size()));
  }
  for (std::size_t i = 0; i < path_a.size(); ++i) pair.frames.push_back({path_a[i], path_b[i]});
  return pair;
}

MovingPair loadSpinning(const fs::path& data, int frames) {
  const fs::path folder = data / "pqp" / "spinning";
  return {loadTris(folder / "bunny.tris"), loadTris(folder / "torus.tris"), spinningMotion(frames)};
}

}  // namespace kios::scenes
