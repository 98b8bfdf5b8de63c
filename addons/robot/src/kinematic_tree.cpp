// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kinematic_tree.h"

#include <Eigen/Geometry>

#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios::robot {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Joint movingJoint(JointType type, const Vector3d& axis, int coordinate) {
  Joint joint;
  joint.type = type;
  joint.axis = axis;
  joint.coordinate = coordinate;
  return joint;
}

/// The shortest turn of z to a unit vector.
Matrix3d turnFromZ(const Vector3d& n) {
  if (n.z() == 1) return Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), n).toRotationMatrix();
}

std::vector<std::string> coordinatesOf(const UrdfJoint& joint) {
  switch (joint.type) {
    case UrdfJointType::kFixed:
      return {};
    case UrdfJointType::kPlanar:
      return {joint.name + "/x", joint.name + "/y", joint.name + "/theta"};
    case UrdfJointType::kFloating:
      return {joint.name + "/x",    joint.name + "/y",     joint.name + "/z",
              joint.name + "/roll", joint.name + "/pitch", joint.name + "/yaw"};
    default:
      return {joint.name};
  }
}

}  // namespace

KinematicTree::KinematicTree(const Description& robot) {
  std::vector<int> first(robot.joints.size(), -1);
  std::vector<double> low, high;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const UrdfJoint& joint = robot.joints[i];
    if (joint.mimics >= 0) continue;
    first[i] = static_cast<int>(names.size());
    const bool single =
        joint.type != UrdfJointType::kPlanar && joint.type != UrdfJointType::kFloating;
    for (const std::string& name : coordinatesOf(joint)) {
      names.push_back(name);
      low.push_back(single ? joint.lower : -kInfinity);
      high.push_back(single ? joint.upper : kInfinity);
    }
  }
  lower = Eigen::Map<const Eigen::VectorXd>(low.data(), coordinates());
  upper = Eigen::Map<const Eigen::VectorXd>(high.data(), coordinates());

  std::vector<std::vector<int>> children(robot.links.size());
  std::vector<char> carried(robot.links.size(), 0);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    children[robot.joints[i].parent].push_back(static_cast<int>(i));
    carried[robot.joints[i].child] = 1;
  }
  node_of_link_.assign(robot.links.size(), -1);
  std::vector<int> waiting;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (carried[i] != 0) continue;
    node_of_link_[i] = add(-1, Joint());
    waiting.push_back(static_cast<int>(i));
  }
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    for (const int i : children[waiting[next]]) {
      const UrdfJoint& joint = robot.joints[i];
      node_of_link_[joint.child] =
          addJoint(node_of_link_[joint.parent], joint, first[joint.mimics >= 0 ? joint.mimics : i]);
      waiting.push_back(joint.child);
    }
  }
}

int KinematicTree::add(int parent, const Joint& joint) {
  Node node;
  node.parent = parent;
  node.joint = joint;
  node.unit = joint.type == JointType::kFixed ? 0 : joint.axis.stableNorm();
  if (node.unit > 0) node.axis = (joint.axis / node.unit).normalized();
  if (parent >= 0) node.moving = nodes_[parent].moving;
  const int number = static_cast<int>(nodes_.size());
  if (joint.type != JointType::kFixed) node.moving.push_back(number);
  nodes_.push_back(std::move(node));
  return number;
}

int KinematicTree::addJoint(int parent, const UrdfJoint& joint, int coordinate) {
  std::vector<Joint> parts;
  switch (joint.type) {
    case UrdfJointType::kFixed:
      parts.emplace_back();
      break;
    case UrdfJointType::kRevolute:
    case UrdfJointType::kContinuous:
      parts.push_back(movingJoint(JointType::kRevolute, joint.axis, coordinate));
      break;
    case UrdfJointType::kPrismatic:
      parts.push_back(movingJoint(JointType::kPrismatic, joint.axis, coordinate));
      break;
    case UrdfJointType::kPlanar: {
      const Matrix3d R = turnFromZ(joint.axis);
      parts = {movingJoint(JointType::kPrismatic, R.col(0), coordinate),
               movingJoint(JointType::kPrismatic, R.col(1), coordinate + 1),
               movingJoint(JointType::kRevolute, joint.axis, coordinate + 2)};
      break;
    }
    case UrdfJointType::kFloating:  // turned about the fixed axes x, y, z, as a URDF's rpy
      for (int i = 0; i < 3; ++i) {
        parts.push_back(movingJoint(JointType::kPrismatic, Vector3d::Unit(i), coordinate + i));
      }
      for (int i = 3; i-- > 0;) {
        parts.push_back(movingJoint(JointType::kRevolute, Vector3d::Unit(i), coordinate + 3 + i));
      }
      break;
  }
  parts.front().X_PJ = joint.X_PJ;
  parts.front().multiplier = joint.multiplier;
  parts.front().offset = joint.offset;
  for (const Joint& part : parts) parent = add(parent, part);
  return parent;
}

Linkage KinematicTree::linkage() const {
  Linkage linkage;
  for (const Node& node : nodes_) linkage.addLink(node.parent, node.joint);
  return linkage;
}

void KinematicTree::place(const Eigen::VectorXd& q, std::vector<PlacedLink>& placed) const {
  placed.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Joint& joint = node.joint;
    PlacedLink& link = placed[i];
    if (node.parent < 0) {
      link.R = joint.X_PJ.linear();
      link.t = joint.X_PJ.translation();
    } else {
      const PlacedLink& parent = placed[node.parent];
      link.R.noalias() = parent.R * joint.X_PJ.linear();
      link.t = parent.t + parent.R * joint.X_PJ.translation();
    }
    if (joint.type == JointType::kFixed) continue;
    link.axis = link.R * node.axis;
    const double value = (joint.multiplier * q[joint.coordinate] + joint.offset) * node.unit;
    if (joint.type == JointType::kPrismatic) {
      link.t += value * link.axis;
    } else {
      turnAbout(node.axis, value, link.R);
    }
  }
}

void KinematicTree::addGradient(int node, const Vector3d& x, const Vector3d& n, double factor,
                                const std::vector<PlacedLink>& placed,
                                UnalignedVector& gradient) const {
  for (const int i : nodes_[node].moving) {
    const Joint& joint = nodes_[i].joint;
    const PlacedLink& link = placed[i];
    const Vector3d velocity =
        joint.type == JointType::kPrismatic ? link.axis : Vector3d(link.axis.cross(x - link.t));
    gradient[joint.coordinate] += factor * joint.multiplier * nodes_[i].unit * n.dot(velocity);
  }
}

}  // namespace kios::robot
