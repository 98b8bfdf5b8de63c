// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "description.h"
#include "fcl_kios/linkage.h"
#include "fcl_kios/robot/answers.h"

namespace kios::robot {

/// A link in the world, by the arithmetic of a Linkage, so that both have it at the same place, bit
/// for bit; and the axis of the joint that carries it.
struct PlacedLink {
  Eigen::Matrix3d R;
  Eigen::Vector3d t, axis;

  /// Places a body at X_LB, its rotation as rigid() leaves it.
  fcl::Transform3d pose(const fcl::Transform3d& X_LB) const {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear().noalias() = R * X_LB.linear();
    X.translation() = place(X_LB.translation());
    return X;
  }
  Eigen::Vector3d place(const Eigen::Vector3d& p_L) const { return t + R * p_L; }
};

/// The links of a URDF as those of a linkage: planar and floating joints become several, parents
/// come first, and the root link is fixed to the world.
class KinematicTree {
 public:
  KinematicTree() = default;
  explicit KinematicTree(const Description& robot);

  int coordinates() const { return static_cast<int>(names.size()); }
  /// The linkage's number of a link of the URDF.
  int nodeOf(int link) const { return node_of_link_[link]; }
  /// Numbers of the moving links from the root to this one, itself included.
  const std::vector<int>& moving(int node) const { return nodes_[node].moving; }
  int parent(int node) const { return nodes_[node].parent; }

  Linkage linkage() const;
  void place(const Eigen::VectorXd& q, std::vector<PlacedLink>& placed) const;
  /// Adds factor * n^T dx / dq to a gradient, x a point that moves with a link.
  void addGradient(int node, const Eigen::Vector3d& x, const Eigen::Vector3d& n, double factor,
                   const std::vector<PlacedLink>& placed, UnalignedVector& gradient) const;

  struct Node {
    int parent = -1;
    Joint joint;
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of length 1
    double unit = 0;                                  ///< length of the joint's axis
    std::vector<int> moving;
  };
  const Node& node(int i) const { return nodes_[i]; }
  std::size_t size() const { return nodes_.size(); }

  std::vector<std::string> names;  ///< by coordinate
  Eigen::VectorXd lower, upper;

 private:
  int add(int parent, const Joint& joint);
  int addJoint(int parent, const UrdfJoint& joint, int coordinate);

  std::vector<Node> nodes_;
  std::vector<int> node_of_link_;
};

}  // namespace kios::robot
