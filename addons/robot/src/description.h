// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fcl/geometry/collision_geometry.h>
#include "fcl_kios/linkage.h"

namespace kios::robot {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

/// A collision element: its pose in the frame of its link or object.
struct Element {
  Geometry geometry;
  fcl::Transform3d X = fcl::Transform3d::Identity();
  /// Has the geometry for its body 0, measured once for all linkages.
  std::shared_ptr<const Linkage> measured = nullptr;
};

enum class UrdfJointType { kFixed, kRevolute, kContinuous, kPrismatic, kPlanar, kFloating };

struct UrdfJoint {
  std::string name;
  UrdfJointType type = UrdfJointType::kFixed;
  int parent = -1, child = -1;  ///< links
  fcl::Transform3d X_PJ = fcl::Transform3d::Identity();
  fcl::Vector3d axis = fcl::Vector3d::UnitX();  ///< of length 1
  double lower = 0, upper = 0;
  int mimics = -1;  ///< a joint that mimics nobody
  double multiplier = 1, offset = 0;

  bool moves() const { return type != UrdfJointType::kFixed; }
};

struct UrdfLink {
  std::string name;
  std::vector<Element> elements;
};

/// Two names, the lesser first.
using NamePair = std::pair<std::string, std::string>;
inline NamePair namePair(const std::string& a, const std::string& b) {
  return a < b ? NamePair(a, b) : NamePair(b, a);
}

/// A planning group: joints, with the links that they carry.
struct UrdfGroup {
  std::set<int> joints, links;
  std::vector<std::string> end_effectors;  ///< groups
};

/// What URDF and SRDF say. Links form a tree of one root.
struct Description {
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::set<NamePair> allowed;
  std::map<NamePair, std::string> reasons;  ///< why the SRDF allows them
  std::vector<std::string> srdf;            ///< its elements that are not of pairs, as XML
  /// Values by joint, by group state.
  std::map<std::string, std::map<std::string, std::vector<double>>> states;
  std::map<std::string, UrdfGroup> groups;
  std::vector<std::string> warnings;  ///< what the files say of what isn't there

  int linkOf(const std::string& name) const;  ///< -1 if there is none
  int root() const;
};

}  // namespace kios::robot
