// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "text_file.h"

namespace kios::robot {

/// What nodes of a YAML file hold. Whatever is missing or wrong is refused with the file and the
/// line.
class YamlFile {
 protected:
  explicit YamlFile(const std::string& file) : file_(file) {}

  [[noreturn]] void refuseHere(const YAML::Node& node, const std::string& what) const {
    refuseAt(file_, node.Mark().line + 1, what);
  }

  /// `node`, which must be a map of some of these keys, each once.
  YAML::Node map(const YAML::Node& node, const std::vector<std::string>& keys) const {
    if (!node.IsMap()) refuseHere(node, "a map of names and values should stand here.");
    std::set<std::string> met;
    for (const auto& entry : node) {
      const std::string key = scalar(entry.first, node);
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        std::string known = keys[0];
        for (std::size_t i = 1; i < keys.size(); ++i) known += ", " + keys[i];
        refuseHere(entry.first, "'" + key + "' isn't known here; these are: " + known + ".");
      }
      if (!met.insert(key).second) refuseHere(entry.first, "'" + key + "' is there twice.");
    }
    return node;
  }

  std::vector<YAML::Node> list(const YAML::Node& node) const {
    std::vector<YAML::Node> items;
    if (!node || node.IsNull()) return items;
    if (!node.IsSequence()) refuseHere(node, "a list should stand here.");
    for (const YAML::Node& item : node) items.push_back(item);
    return items;
  }

  std::string scalar(const YAML::Node& node, const YAML::Node& parent) const {
    if (!node) refuseHere(parent, "a name is missing.");
    if (!node.IsScalar() || node.Scalar().empty()) refuseHere(node, "a name should stand here.");
    return node.Scalar();
  }

  double number(const YAML::Node& node, const YAML::Node& parent) const {
    double x = 0;
    if (!node) refuseHere(parent, "a number is missing.");
    if (!node.IsScalar() || !parseNumbers(node.Scalar(), 1, &x)) {
      refuseHere(node, "a finite number should stand here.");
    }
    return x;
  }

  bool truth(const YAML::Node& node) const {
    bool value = false;
    if (node.IsScalar() && YAML::convert<bool>::decode(node, value)) return value;
    if (node.IsScalar() && (node.Scalar() == "1" || node.Scalar() == "0")) {
      return node.Scalar() == "1";
    }
    refuseHere(node, "true or false should stand here.");
  }

  /// [x, y, z] or {x: , y: , z: }.
  std::vector<double> numbers(const YAML::Node& node, const char* names) const {
    std::vector<double> values;
    if (node.IsMap()) {
      std::vector<std::string> keys;
      for (const char* name = names; *name != '\0'; ++name) keys.emplace_back(1, *name);
      for (const std::string& key : keys) values.push_back(number(map(node, keys)[key], node));
      return values;
    }
    for (const YAML::Node& item : list(node)) values.push_back(number(item, node));
    if (*names != '\0' && values.size() != std::char_traits<char>::length(names)) {
      refuseHere(node, "the numbers " + std::string(names) + " should stand here.");
    }
    return values;
  }

  fcl::Transform3d pose(const YAML::Node& position, const YAML::Node& orientation,
                        const YAML::Node& parent) const {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    if (position)
      X.translation() = Eigen::Map<const fcl::Vector3d>(numbers(position, "xyz").data());
    if (orientation) {
      const std::vector<double> q = numbers(orientation, "xyzw");
      const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
      const double norm = turn.norm();
      // All zeros stand for no turn, as in MoveIt.
      if (norm != 0) {
        if (!(norm > 0.9 && norm < 1.1))
          refuseHere(orientation, "the quaternion isn't of length 1.");
        X.linear() = turn.normalized().toRotationMatrix();
      }
    }
    try {
      return rigid(X, "an object");
    } catch (const std::exception&) {
      refuseHere(parent, "the pose is too large.");
    }
  }

  fcl::Transform3d pose(const YAML::Node& node) const {
    map(node, {"position", "orientation"});
    return pose(node["position"], node["orientation"], node);
  }

  const std::string& file_;
};

}  // namespace kios::robot
