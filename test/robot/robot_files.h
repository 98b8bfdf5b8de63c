// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "fcl_kios/robot/robot.h"
#include "scenes/random.h"

// Robot files that tests write themselves, those of MotionBenchMaker where they are, and contact
// and distance by FCL's own means.

namespace kios::testing {

using Eigen::VectorXd;
using fcl::Transform3d;
using fcl::Vector3d;
using scenes::Random;
namespace fs = std::filesystem;

/// Holds a folder that goes with the test.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = fs::temp_directory_path() /
            ("kios_robot_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    const fs::path file = path_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

inline std::string contentOf(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

/// Returns the folder of a MotionBenchMaker robot, empty if there is none.
inline std::string mbmFolder(const std::string& robot) {
  const char* const data = std::getenv("KIOS_DATA");
  for (const fs::path& base :
       {fs::path(data ? data : ""), fs::path(KIOS_SOURCE) / "../shared/data"}) {
    const fs::path folder = base / "mbm" / robot;
    if (fs::exists(folder / (robot + ".urdf"))) return folder.string();
  }
  return "";
}

inline Robot loadMbm(const std::string& robot, const RobotOptions& options = {}) {
  const std::string folder = mbmFolder(robot);
  return loadRobot(folder + "/" + robot + ".urdf", folder + "/" + robot + ".srdf", options);
}

inline VectorXd randomConfiguration(const Robot& robot, Random& random) {
  VectorXd q(robot.coordinates());
  for (int i = 0; i < q.size(); ++i) {
    q[i] = random.uniform(std::max(robot.lower()[i], -3.2), std::min(robot.upper()[i], 3.2));
  }
  return q;
}

inline Transform3d shifted(double x, double y, double z) {
  return Transform3d(Eigen::Translation3d(x, y, z));
}

/// Returns a box of 12 triangles as an OBJ file, one face to a line.
inline std::string boxObj(double x, double y, double z) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += "v " + std::to_string((i & 1) != 0 ? x : -x) + " " +
            std::to_string((i & 2) != 0 ? y : -y) + " " + std::to_string((i & 4) != 0 ? z : -z) +
            "\n";
  }
  return text +
         "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\n"
         "f 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
}

inline std::string link(const std::string& name, const std::string& geometry = "",
                        const std::string& origin = "") {
  std::string text = "<link name='" + name + "'>";
  if (!geometry.empty()) {
    text += "<collision>" + origin + "<geometry>" + geometry + "</geometry></collision>";
  }
  return text + "</link>\n";
}

inline std::string joint(const std::string& name, const std::string& type,
                         const std::string& parent, const std::string& child,
                         const std::string& inside = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + inside + "</joint>\n";
}

/// Returns an arm of shapes and meshes with every type of joint.
inline std::string manyJoints(const Folder& folder) {
  folder.write("meshes/rod.obj", boxObj(0.03, 0.02, 0.15));
  const std::string limit = "<limit lower='-2' upper='2.5' effort='1' velocity='1'/>";
  return folder.write(
      "arm.urdf",
      "<?xml version='1.0'?>\n<robot name='arm'>\n" + link("base", "<box size='0.3 0.3 0.1'/>") +
          link("cart", "<box size='0.2 0.2 0.1'/>") +
          link("turret", "<cylinder radius='0.06' length='0.1'/>") +
          link("upper", "<mesh filename='package://any/meshes/rod.obj'/>",
               "<origin xyz='0 0 0.17' rpy='0 0 0.3'/>") +
          link("lower", "<mesh filename='meshes/rod.obj' scale='1 -1 0.8'/>",
               "<origin xyz='0 0 0.15'/>") +
          link("slide", "<sphere radius='0.04'/>") + link("left", "<box size='0.02 0.03 0.1'/>") +
          link("right", "<capsule radius='0.012' length='0.08'/>") + link("tool") +
          joint("drive", "planar", "base", "cart", "<origin xyz='0 0 0.2'/><axis xyz='0 0 1'/>") +
          joint("turn", "continuous", "cart", "turret",
                "<origin xyz='0 0 0.11'/><axis xyz='0 0 2'/>") +
          joint("shoulder", "revolute", "turret", "upper",
                "<origin xyz='0 0 0.1'/><axis xyz='0 1 0'/>" + limit) +
          // Listed before the joint that it mimics, and that of its parent.
          joint("right_finger", "prismatic", "slide", "right",
                "<origin xyz='0 -0.06 0.1'/><axis xyz='0 1 0'/>"
                "<limit lower='0' upper='0.05'/><mimic joint='left_finger' multiplier='-1'/>") +
          joint("elbow", "revolute", "upper", "lower",
                "<origin xyz='0 0 0.34' rpy='0.2 0 0'/><axis xyz='0 1 0'/>" + limit) +
          joint("extend", "prismatic", "lower", "slide",
                "<origin xyz='0 0 0.32'/><axis xyz='0 0 1'/><limit lower='0' upper='0.2'/>") +
          joint("left_finger", "prismatic", "slide", "left",
                "<origin xyz='0 0.06 0.1'/><axis xyz='0 1 0'/>"
                "<limit lower='-0.05' upper='0.01'/>") +
          joint("wrist", "fixed", "slide", "tool", "<origin xyz='0 0 0.2'/>") + "</robot>\n");
}

/// A planning scene for that arm: objects of every kind, one of them attached, and allowed pairs.
inline const char* const kScene = R"(name: test
fixed_frame_transforms:
  - child_frame_id: hall
    transform: {translation: [1, 0, 0], rotation: [0, 0, 0, 1]}
robot_state:
  attached_collision_objects:
    - link_name: tool
      touch_links: [slide, left]
      object:
        id: cup
        header: {frame_id: tool}
        primitives: [{type: cylinder, dimensions: [0.1, 0.03]}]
        primitive_poses: [{position: [0, 0, 0.1], orientation: [0, 0, 0, 1]}]
link_padding:
  - {link_name: upper, padding: 0.01}
allowed_collision_matrix:
  entry_names: [base, cart, shelf, unknown]
  entry_values:
    - [false, false, true, true]
    - [false, false, false, false]
    - {enabled: [true, false, false, false]}
    - [true, false, false, false]
  default_entry_names: [wall]
  default_entry_values: [true]
world:
  collision_objects:
    - id: shelf
      header: {frame_id: hall}
      pose: {position: [0, 2, 0], orientation: [0, 0, 0.7071067811865476, 0.7071067811865476]}
      primitives:
        - {type: box, dimensions: [0.2, 0.4, 0.6]}
        - {type: 2, dimensions: [0.1]}
        - {type: cone, dimensions: [0.1, 0.2]}
      primitive_poses:
        - position: {x: 0, y: 0, z: 0}
          orientation: {x: 0, y: 0, z: 0, w: 1}
        - position: [1, 0, 0]
        - {position: [1, 1, 0], orientation: [0, 0, 0, 1]}
    - id: tent
      meshes:
        - vertices: [[0, 0, 0], [1, 0, 0], {x: 0, y: 1, z: 0}]
          triangles: [{vertex_indices: [0, 1, 2]}]
      mesh_poses: [{position: [5, 0, 0]}]
    - id: wall
      planes: [{coef: [0, 1, 0, 4]}]
      plane_poses: [{position: [0, 0, 0]}]
)";

}  // namespace kios::testing
