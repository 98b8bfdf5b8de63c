// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "body.h"
#include "box_lanes.h"
#include "fcl_kios/linkage/linkage.h"
#include "fcl_kios/robot/answers.h"
#include "kinematic_tree.h"

namespace kios::robot {

struct Nearness;

/// An obstacle (node -1, X in the world), or what is attached (X in its link's frame).
struct Object {
  std::string name;
  int link = -1;  ///< of the URDF
  fcl::Transform3d X = fcl::Transform3d::Identity();
  std::vector<Element> elements;
};

/// A robot as its files describe it: the same for all copies.
struct Arm {
  Description description;
  KinematicTree tree;
  Linkage linkage;  ///< with the links' bodies
  std::vector<Body> bodies;
  std::vector<std::string> links;
};

/// A robot among its obstacles, made for queries. Bodies of links come first, then those of
/// attached objects, then obstacles; entities likewise. Immutable.
class Cell {
 public:
  Cell(std::shared_ptr<const Arm> arm, const std::vector<Object>& objects,
       const std::set<NamePair>& allowed, const std::map<std::string, double>& paddings);

  const Arm& arm() const { return *arm_; }
  const std::string& nameOf(int entity) const { return names_[entity]; }

  std::optional<RobotContact> contact(const Eigen::VectorXd& q) const;
  bool inContact(const Eigen::VectorXd& q) const;
  RobotClearance clearance(const Eigen::VectorXd& q, const ClearanceOptions& options) const;
  std::vector<RobotClearance> clearances(const Eigen::VectorXd& q, double within) const;
  /// The proofs' linkages; copies are for threads of their own.
  struct Proof {
    double separation;  ///< the sum of the paddings of all its pairs
    Linkage linkage;
  };
  const std::vector<Proof>& proofs() const { return proofs_; }
  RobotMotion checkMotion(const std::vector<Proof>& proofs, const Eigen::VectorXd& q0,
                          const Eigen::VectorXd& q1, const MotionRequest& request) const;

 private:
  struct Pair {
    int a, b;  ///< bodies, a < b
  };
  /// A pair and a lower bound of its clearance.
  struct Candidate {
    double bound;
    int a, b;
    bool operator<(const Candidate& o) const { return bound > o.bound; }  // the least on top
  };
  struct Placed;

  bool checked(const Body& a, const Body& b, const std::set<NamePair>& allowed) const;
  bool isChecked(int carried, int other) const {
    return checked_[static_cast<std::size_t>(carried) * bodies_.size() +
                    static_cast<std::size_t>(other)] != 0;
  }
  void addProofs();
  /// Bounds the distance of the ball of body a from the box of body b.
  double ballToBox(const Placed& placed, int a, int b) const;
  double boundOf(const Placed& placed, int a, int b) const;
  bool findContact(Placed& placed, Pair& found) const;
  /// With `contact`, it is filled in for a pair that is known to be near.
  bool touch(const Placed& placed, int a, int b, RobotContact* contact) const;
  /// Pairs whose bound is at most `within`.
  void candidates(const Placed& placed, double within, RobotPairs among,
                  std::vector<Candidate>& found) const;
  RobotClearance answer(const Placed& placed, const Candidate& pair, const Nearness& near,
                        bool gradient) const;
  void addGradient(const Placed& placed, const Body& a, const Body& b, Nearness& near,
                   RobotClearance& answer) const;

  std::shared_ptr<const Arm> arm_;
  std::vector<std::string> names_;
  std::vector<Body> bodies_;
  int carried_ = 0;                       ///< bodies that links carry; obstacles follow
  std::vector<std::vector<int>> among_;   ///< by carried body: carried ones before it to be checked
  std::vector<std::vector<int>> around_;  ///< by carried body: obstacles to be checked
  std::vector<char> checked_;             ///< by carried body and body
  std::vector<fcl::Vector3d> middles_;    ///< of obstacles, in the world
  BoxLanes boxes_;                        ///< of obstacles
  std::vector<Proof> proofs_;
};

}  // namespace kios::robot
