// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ur5_data.h"

#include <string>

#include "mesh_folder.h"
#include "placement.h"

namespace kios::scenes {
namespace {

namespace fs = std::filesystem;

struct Origin {
  fcl::Vector3d xyz, rpy;
};

fcl::Transform3d pose(const Origin& origin) {
  return shift(origin.xyz.x(), origin.xyz.y(), origin.xyz.z()) *
         turn(origin.rpy.z(), fcl::Vector3d::UnitZ()) *
         turn(origin.rpy.y(), fcl::Vector3d::UnitY()) *
         turn(origin.rpy.x(), fcl::Vector3d::UnitX());
}

// The joint in the frame of the link before, by Universal Robots' published lengths, and the mesh
// in its link's.
struct LinkData {
  const char* mesh;
  Origin joint, origin;
};

const LinkData kLinks[] = {
    {"base", {{0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, kPi}}},
    {"shoulder", {{0, 0, 0.089159}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, kPi}}},
    {"upperarm", {{0, 0, 0}, {kPi / 2, 0, 0}}, {{0, 0, 0.13585}, {kPi / 2, 0, -kPi / 2}}},
    {"forearm", {{-0.425, 0, 0}, {0, 0, 0}}, {{0, 0, 0.0165}, {kPi / 2, 0, -kPi / 2}}},
    {"wrist1", {{-0.39225, 0, 0.10915}, {0, 0, 0}}, {{0, 0, -0.093}, {kPi / 2, 0, 0}}},
    {"wrist2", {{0, -0.09465, 0}, {kPi / 2, 0, 0}}, {{0, 0, -0.095}, {0, 0, 0}}},
    {"wrist3", {{0, 0.0823, 0}, {kPi / 2, kPi, kPi}}, {{0, 0, -0.0818}, {kPi / 2, 0, 0}}},
};

// Joint centres and amplitudes of an arm that works over a table before it.
constexpr double kCentres[] = {0, -1.3, 1.5, -1.2, -kPi / 2, 0};
constexpr double kAmplitudes[] = {1.3, 0.6, 0.8, 1.0, 1.0, 2.5};

}  // namespace

bool holdsUr5(const fs::path& data) {
  std::error_code ignored;  // an unreadable folder is an absent one
  return fs::is_regular_file(data / "ur5" / "base.stl", ignored);
}

Robot loadUr5(const fs::path& data) {
  Robot arm;
  for (const LinkData& from : kLinks) {
    arm.parents.push_back(static_cast<int>(arm.links.size()) - 1);
    arm.links.push_back({pose(from.joint), pose(from.origin),
                         loadMesh(data / "ur5" / (std::string(from.mesh) + ".stl"))});
  }
  arm.centres.assign(std::begin(kCentres), std::end(kCentres));
  arm.amplitudes.assign(std::begin(kAmplitudes), std::end(kAmplitudes));
  return arm;
}

}  // namespace kios::scenes
