// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/robot/robot.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "files/octomap.h"
#include "robot_impl.h"
#include "scene_file.h"
#include "text_file.h"
#include "urdf.h"

namespace kios {

using robot::namePair;
using robot::Object;
using robot::refuse;

Robot::Robot(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Robot::Robot(const Robot& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Robot::Robot(Robot&& other) noexcept = default;
Robot& Robot::operator=(Robot other) noexcept {
  impl_.swap(other.impl_);
  return *this;
}
Robot::~Robot() = default;

int Robot::coordinates() const { return impl_->arm->tree.coordinates(); }
const std::string& Robot::name() const { return impl_->arm->description.name; }
const std::vector<std::string>& Robot::joints() const { return impl_->arm->tree.names; }
const std::vector<std::string>& Robot::links() const { return impl_->arm->links; }
const Eigen::VectorXd& Robot::lower() const { return impl_->arm->tree.lower; }
const Eigen::VectorXd& Robot::upper() const { return impl_->arm->tree.upper; }

const std::vector<std::string>& Robot::warnings() const { return impl_->warnings; }

namespace {

/// The places of a joint's coordinates, none if it doesn't move or mimics another.
std::vector<int> placesOf(const robot::Arm& arm, const robot::UrdfJoint& joint) {
  std::vector<int> places;
  if (!joint.moves() || joint.mimics >= 0) return places;
  const bool several =
      joint.type == robot::UrdfJointType::kPlanar || joint.type == robot::UrdfJointType::kFloating;
  const std::vector<std::string>& names = arm.tree.names;
  const auto first =
      std::find(names.begin(), names.end(), several ? joint.name + "/x" : joint.name);
  const int count = !several ? 1 : joint.type == robot::UrdfJointType::kPlanar ? 3 : 6;
  for (int i = 0; i < count; ++i) places.push_back(static_cast<int>(first - names.begin()) + i);
  return places;
}

/// The names of a map, for a message.
template <typename Map>
std::string namesOf(const Map& map) {
  std::string names;
  for (const auto& [name, value] : map) names += (names.empty() ? "; it has " : ", ") + name;
  return names + ".";
}

}  // namespace

std::vector<std::string> Robot::groups() const {
  std::vector<std::string> names;
  for (const auto& [name, group] : impl_->arm->description.groups) names.push_back(name);
  return names;
}

RobotGroup Robot::group(const std::string& name) const {
  const robot::Description& description = impl_->arm->description;
  const auto known = description.groups.find(name);
  if (known == description.groups.end()) {
    refuse("the SRDF has no group '" + name + "'" + namesOf(description.groups));
  }
  RobotGroup group;
  group.name = name;
  for (const int joint : known->second.joints) {
    for (const int place : placesOf(*impl_->arm, description.joints[joint])) {
      group.coordinates.push_back(place);
    }
  }
  std::sort(group.coordinates.begin(), group.coordinates.end());
  for (const int place : group.coordinates) group.joints.push_back(joints()[place]);
  for (const int link : known->second.links) group.links.push_back(links()[link]);
  group.end_effectors = known->second.end_effectors;
  return group;
}

bool Robot::withinLimits(const Eigen::VectorXd& q, double slack) const {
  impl_->requireConfiguration(q, "q");
  if (!(slack >= 0)) refuse("the slack of limits must be >= 0.");
  return ((q - upper()).array() <= slack).all() && ((lower() - q).array() <= slack).all();
}

std::vector<std::string> Robot::states() const {
  std::vector<std::string> names;
  for (const auto& [name, values] : impl_->arm->description.states) names.push_back(name);
  return names;
}

UnalignedVector Robot::state(const std::string& name) const {
  const robot::Description& description = impl_->arm->description;
  const auto known = description.states.find(name);
  if (known == description.states.end()) {
    refuse("the SRDF has no group state '" + name + "'" + namesOf(description.states));
  }
  UnalignedVector q = lower().cwiseMax(0.0).cwiseMin(upper());
  for (const auto& [joint, values] : known->second) {
    const auto found = std::find_if(description.joints.begin(), description.joints.end(),
                                    [&name = joint](const auto& o) { return o.name == name; });
    if (found == description.joints.end()) {
      refuse("the group state '" + name + "' names the joint '" + joint + "', which " +
             description.name + " doesn't have.");
    }
    const std::vector<int> places = placesOf(*impl_->arm, *found);
    if (places.empty()) continue;
    if (values.size() != places.size()) {
      refuse("the group state '" + name + "' gives the joint '" + joint + "' " +
             std::to_string(values.size()) + " values instead of " + std::to_string(places.size()) +
             ".");
    }
    for (std::size_t i = 0; i < places.size(); ++i) q[places[i]] = values[i];
  }
  return q;
}

std::vector<RobotElement> Robot::elements() const {
  std::vector<RobotElement> all;
  for (const robot::Body& body : impl_->arm->bodies) {
    all.push_back({links()[static_cast<std::size_t>(body.entity)], body.element, false, false,
                   body.geometry, body.X_LB});
  }
  for (const Object* const object : impl_->ordered()) {
    const bool attached = object->link >= 0;
    int i = 0;
    for (const robot::Element& element : object->elements) {
      all.push_back({object->name, i++, !attached, attached, element.geometry, element.X});
    }
  }
  return all;
}

fcl::Transform3d Robot::pose(const std::string& name, const Eigen::VectorXd& q) const {
  impl_->requireConfiguration(q, "q");
  const int entity = impl_->requireEntity(name);
  const Object* const object = impl_->objectOf(entity);
  if (!object) return impl_->poseOf(entity, q);
  return object->link < 0 ? object->X : impl_->poseOf(object->link, q, object->X);
}

void Robot::addObstacle(const std::string& name,
                        std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                        const fcl::Transform3d& X_W) {
  impl_->add({name, -1, robot::rigid(X_W, "'" + name + "'"), {{std::move(geometry)}}});
}

void Robot::addPoints(const std::string& name, const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                      double radius) {
  if (!(radius >= 0 && radius <= 0x1p300)) refuse("the radius of points must be finite and >= 0.");
  if (points.cols() > std::numeric_limits<int>::max()) refuse("there are too many points.");
  std::vector<fcl::Vector3d> vertices;
  vertices.reserve(static_cast<std::size_t>(points.cols()));
  for (const auto& point : points.colwise()) vertices.emplace_back(point);
  impl_->add({name, -1, fcl::Transform3d::Identity(), {{makePointCloud(vertices)}}}, {}, radius);
}

void Robot::addOctomap(const std::string& name, const std::string& file,
                       const fcl::Transform3d& X_W) {
  std::shared_ptr<fcl::CollisionGeometryd> octree;
  try {
    octree = files::readOctomap(file);
  } catch (const std::exception& error) {
    refuse(error.what());
  }
  addObstacle(name, octree, X_W);
}

void Robot::attach(const std::string& name, const std::string& link,
                   std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                   const fcl::Transform3d& X_LB, const std::vector<std::string>& touch_links) {
  const int carrier = impl_->requireLink(link);
  impl_->add({name, carrier, robot::rigid(X_LB, "'" + name + "'"), {{std::move(geometry)}}},
             touch_links);
}

void Robot::moveObstacle(const std::string& name, const fcl::Transform3d& X_W) {
  impl_->move(impl_->requireObject(name, false, "moved"), X_W);
}

void Robot::attachObstacle(const std::string& name, const std::string& link,
                           const Eigen::VectorXd& q, const std::vector<std::string>& touch_links) {
  impl_->requireConfiguration(q, "q");
  const int entity = impl_->requireObject(name, false, "attached"),
            carrier = impl_->requireLink(link);
  const fcl::Transform3d X_WL = impl_->poseOf(carrier, q);
  impl_->carry(entity, carrier, X_WL.inverse() * impl_->objectOf(entity)->X, touch_links);
}

void Robot::attachObstacle(const std::string& name, const std::string& link,
                           const fcl::Transform3d& X_LB,
                           const std::vector<std::string>& touch_links) {
  const int entity = impl_->requireObject(name, false, "attached");
  impl_->carry(entity, impl_->requireLink(link), X_LB, touch_links);
}

void Robot::detach(const std::string& name, const Eigen::VectorXd& q) {
  const int entity = impl_->requireObject(name, true, "detached");
  impl_->carry(entity, -1, pose(name, q), {});
}

void Robot::remove(const std::string& name) {
  if (!impl_->objectOf(impl_->requireEntity(name))) {
    refuse("'" + name + "' is a link, which can't be removed.");
  }
  impl_->remove(name);
}

void Robot::ignorePair(const std::string& a, const std::string& b, bool ignored) {
  impl_->requireEntity(a);
  impl_->requireEntity(b);
  impl_->ignore(a, b, ignored);
}

bool Robot::allowed(const std::string& a, const std::string& b) const {
  impl_->requireEntity(a);
  impl_->requireEntity(b);
  return impl_->ignores(a, b);
}

void Robot::setPadding(const std::string& name, double metres) {
  impl_->requireEntity(name);
  if (!(metres >= 0 && metres <= 0x1p300)) {
    refuse("the padding of '" + name + "' must be finite and >= 0.");
  }
  impl_->setPadding(name, metres);
}

void Robot::addScene(const std::string& file) {
  robot::Scene scene = robot::readScene(file, impl_->arm->description);
  auto next = std::make_unique<Impl>(*impl_);
  next->changed();
  std::set<std::string> named;
  for (const std::string& name : scene.removed) next->remove(name);
  for (Object& object : scene.objects) {
    next->forget(object.name);
    const std::vector<std::string> touched = std::exchange(object.touch, {});
    named.insert(touched.begin(), touched.end());
    try {
      next->add(std::move(object), touched);
    } catch (const std::exception& error) {
      refuse(file + ": " + error.what());
    }
  }
  for (const auto& [name, may_touch] : scene.others) {
    if (!may_touch) continue;
    for (const std::string& link : links()) {
      if (link != name) next->ignore(name, link, true);
    }
    for (const Object* const object : next->ordered()) {
      if (object->name != name) next->ignore(name, object->name, true);
    }
  }
  for (const auto& [pair, allowed] : scene.pairs) next->ignore(pair.first, pair.second, allowed);
  for (const auto& [link, padding] : scene.paddings) next->setPadding(link, padding);
  for (const auto& [pair, allowed] : scene.pairs) named.insert({pair.first, pair.second});
  for (const auto& [name, may_touch] : scene.others) named.insert(name);
  for (const std::string& name : named) {
    if (next->entityOf(name) >= 0) continue;
    next->warnings.push_back(file + ": pairs may touch of '" + name +
                             "', which is no link, obstacle or attached object.");
  }
  impl_ = std::move(next);
}

Robot loadRobot(const std::string& urdf_file, const std::string& srdf_file,
                const RobotOptions& options) {
  if (!(options.padding >= 0 && options.padding <= 0x1p300)) {
    refuse("the padding must be finite and >= 0.");
  }
  auto arm = std::make_shared<robot::Arm>();
  arm->description = robot::readUrdf(urdf_file, options.packages);
  robot::Description& description = arm->description;
  if (srdf_file.empty()) {
    for (const robot::UrdfJoint& joint : description.joints) {
      description.allowed.insert(
          namePair(description.links[joint.parent].name, description.links[joint.child].name));
    }
  } else {
    robot::readSrdf(srdf_file, description);
  }
  arm->tree = robot::KinematicTree(description);
  arm->linkage = arm->tree.linkage();
  for (std::size_t i = 0; i < description.links.size(); ++i) {
    const robot::UrdfLink& link = description.links[i];
    arm->links.push_back(link.name);
    for (std::size_t k = 0; k < link.elements.size(); ++k) {
      robot::Body body;
      body.geometry = link.elements[k].geometry;
      body.entity = static_cast<int>(i);
      body.element = static_cast<int>(k);
      body.measure();
      body.put(arm->tree.nodeOf(static_cast<int>(i)), link.elements[k].X);
      arm->linkage.addBody(body.node, body.geometry, body.X_LB);
      arm->bodies.push_back(std::move(body));
    }
  }
  auto impl = std::make_unique<Robot::Impl>(arm);
  for (const auto& [a, b] : description.allowed) impl->ignore(a, b, true);
  impl->warnings = description.warnings;
  if (options.padding > 0) {
    for (const std::string& link : arm->links) impl->setPadding(link, options.padding);
  }
  return Robot(std::move(impl));
}

}  // namespace kios
