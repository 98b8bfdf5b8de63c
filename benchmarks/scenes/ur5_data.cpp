// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ur5_data.h"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "mesh_folder.h"

namespace kios::scenes {
namespace {

namespace fs = std::filesystem;

constexpr double kPi = 3.14159265358979323846;

[[noreturn]] void refuse(const fs::path& file, const std::string& fault) {
  throw std::runtime_error(file.string() + ": " + fault);
}

struct Origin {
  fcl::Vector3d xyz;
  fcl::Vector3d rpy;
};

fcl::Transform3d pose(const Origin& origin) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = (fcl::AngleAxisd(origin.rpy.z(), fcl::Vector3d::UnitZ()) *
                fcl::AngleAxisd(origin.rpy.y(), fcl::Vector3d::UnitY()) *
                fcl::AngleAxisd(origin.rpy.x(), fcl::Vector3d::UnitX()))
                   .toRotationMatrix();
  X.translation() = origin.xyz;
  return X;
}

// Name of the mesh, name of its joint in kinematics.yaml, and the mesh in its link's frame.
struct LinkData {
  const char* mesh;
  const char* joint;
  Origin origin;
};

const LinkData kLinks[] = {
    {"base", nullptr, {{0, 0, 0}, {0, 0, kPi}}},
    {"shoulder", "shoulder", {{0, 0, 0}, {0, 0, kPi}}},
    {"upperarm", "upper_arm", {{0, 0, 0.13585}, {kPi / 2, 0, -kPi / 2}}},
    {"forearm", "forearm", {{0, 0, 0.0165}, {kPi / 2, 0, -kPi / 2}}},
    {"wrist1", "wrist_1", {{0, 0, -0.093}, {kPi / 2, 0, 0}}},
    {"wrist2", "wrist_2", {{0, 0, -0.095}, {0, 0, 0}}},
    {"wrist3", "wrist_3", {{0, 0, -0.0818}, {kPi / 2, 0, 0}}},
};

// "joint/key" -> number, from lines "joint:" each followed by lines "key: number".
std::map<std::string, double> readKinematics(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) refuse(file, "cannot be opened for reading");
  std::map<std::string, double> numbers;
  std::string joint;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key;
    if (!(words >> key) || key.back() != ':') continue;
    key.pop_back();
    double number = 0;
    if (words >> number) {
      numbers[joint + "/" + key] = number;
    } else {
      joint = key;
    }
  }
  return numbers;
}

// Joint centres and amplitudes of an arm that works over a table before it.
constexpr double kCentres[] = {0, -1.3, 1.5, -1.2, -kPi / 2, 0};
constexpr double kAmplitudes[] = {1.3, 0.6, 0.8, 1.0, 1.0, 2.5};

}  // namespace

bool holdsUr5(const fs::path& data) {
  std::error_code ignored;  // an unreadable folder is an absent one
  return fs::is_regular_file(data / "ur5" / "kinematics.yaml", ignored);
}

Robot loadUr5(const fs::path& data) {
  const fs::path folder = data / "ur5";
  const fs::path kinematics = folder / "kinematics.yaml";
  const std::map<std::string, double> numbers = readKinematics(kinematics);
  const auto number = [&](const std::string& joint, const char* key) {
    const auto found = numbers.find(joint + "/" + key);
    if (found == numbers.end()) refuse(kinematics, "has no " + joint + "/" + key);
    return found->second;
  };
  Robot arm;
  for (const LinkData& from : kLinks) {
    Link link;
    if (from.joint != nullptr) {
      const auto vector = [&](const char* x, const char* y, const char* z) {
        return fcl::Vector3d(number(from.joint, x), number(from.joint, y), number(from.joint, z));
      };
      link.X_PL = pose({vector("x", "y", "z"), vector("roll", "pitch", "yaw")});
    }
    link.X_LM = pose(from.origin);
    link.mesh = loadMesh(folder / (std::string(from.mesh) + ".stl"));
    arm.parents.push_back(static_cast<int>(arm.links.size()) - 1);
    arm.links.push_back(std::move(link));
  }
  arm.centres.assign(std::begin(kCentres), std::end(kCentres));
  arm.amplitudes.assign(std::begin(kAmplitudes), std::end(kAmplitudes));
  return arm;
}

}  // namespace kios::scenes
