// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/robot/robot.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "robot_impl.h"
#include "scene_file.h"
#include "text_file.h"
#include "urdf.h"

namespace kios {

using robot::namePair;
using robot::Object;
using robot::refuse;

Robot::Impl::Impl(const Impl& other)
    : arm(other.arm),
      objects(other.objects),
      allowed(other.allowed),
      paddings(other.paddings),
      warnings(other.warnings) {
  const std::lock_guard<std::mutex> lock(other.guard_);
  cell_ = other.cell_;
  ready_ = cell_ != nullptr;
}

const robot::Cell& Robot::Impl::cell() const {
  if (!ready_.load(std::memory_order_acquire)) {
    const std::lock_guard<std::mutex> lock(guard_);
    if (!cell_) cell_ = std::make_shared<const robot::Cell>(arm, objects, allowed, paddings);
    ready_.store(true, std::memory_order_release);
  }
  return *cell_;
}

int Robot::Impl::entityOf(const std::string& name) const {
  const int link = arm->description.linkOf(name);
  if (link >= 0) return link;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].name == name) return static_cast<int>(arm->links.size() + i);
  }
  return -1;
}

int Robot::Impl::requireEntity(const std::string& name) const {
  const int entity = entityOf(name);
  if (entity < 0) {
    refuse("there is no link, obstacle or attached object '" + name + "' of " +
           arm->description.name + ".");
  }
  return entity;
}

int Robot::Impl::requireLink(const std::string& name) const {
  const int link = arm->description.linkOf(name);
  if (link < 0) refuse("there is no link '" + name + "' of " + arm->description.name + ".");
  return link;
}

void Robot::Impl::requireConfiguration(const Eigen::VectorXd& q, const char* what) const {
  const int size = arm->tree.coordinates();
  if (q.size() != size) {
    refuse(std::string(what) + " has " + std::to_string(q.size()) + " coordinates, but " +
           arm->description.name + " has " + std::to_string(size) + ".");
  }
  for (int i = 0; i < size; ++i) {
    if (std::isfinite(q[i]) && std::abs(q[i]) <= 0x1p300) continue;
    refuse(std::string("the coordinate ") + arm->tree.names[static_cast<std::size_t>(i)] + " of " +
           what + " is NaN, infinite or too large.");
  }
}

void Robot::Impl::add(Object object) {
  if (object.name.empty()) refuse("an object needs a name.");
  if (entityOf(object.name) >= 0) {
    refuse("the name '" + object.name + "' is in use; remove what has it first.");
  }
  for (const robot::Element& element : object.elements) {
    if (!element.geometry) refuse("the geometry of '" + object.name + "' is null.");
    robot::requireServed(element.geometry);
    const auto type = element.geometry->getNodeType();
    const bool turns = object.link >= 0 && !arm->tree.moving(arm->tree.nodeOf(object.link)).empty();
    if (turns && (type == fcl::GEOM_HALFSPACE || type == fcl::GEOM_PLANE)) {
      refuse("'" + object.name + "' is a half-space or a plane, which can't be carried.");
    }
  }
  objects.push_back(std::move(object));
  changed();
}

void Robot::Impl::forget(const std::string& name) {
  objects.erase(std::remove_if(objects.begin(), objects.end(),
                               [&](const Object& object) { return object.name == name; }),
                objects.end());
  changed();
}

void Robot::Impl::remove(const std::string& name) {
  forget(name);
  paddings.erase(name);
  for (auto at = allowed.begin(); at != allowed.end();) {
    at = at->first == name || at->second == name ? allowed.erase(at) : std::next(at);
  }
}

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

std::vector<std::string> Robot::states() const {
  std::vector<std::string> names;
  for (const auto& [name, values] : impl_->arm->description.states) names.push_back(name);
  return names;
}

UnalignedVector Robot::state(const std::string& name) const {
  const robot::Description& description = impl_->arm->description;
  const auto known = description.states.find(name);
  if (known == description.states.end()) {
    std::string names;
    for (const std::string& other : states()) names += (names.empty() ? "" : ", ") + other;
    refuse("the SRDF has no group state '" + name + "'" +
           (names.empty() ? "." : "; it has " + names + "."));
  }
  const std::vector<std::string>& joints = impl_->arm->tree.names;
  UnalignedVector q = lower().cwiseMax(0.0).cwiseMin(upper());
  for (const auto& [joint, values] : known->second) {
    const auto found = std::find_if(description.joints.begin(), description.joints.end(),
                                    [&name = joint](const auto& o) { return o.name == name; });
    if (found == description.joints.end()) {
      refuse("the group state '" + name + "' names the joint '" + joint + "', which " +
             description.name + " doesn't have.");
    }
    if (!found->moves() || found->mimics >= 0) continue;
    auto at = std::find(joints.begin(), joints.end(), joint) - joints.begin();
    const bool several = found->type == robot::UrdfJointType::kPlanar ||
                         found->type == robot::UrdfJointType::kFloating;
    if (several) at = std::find(joints.begin(), joints.end(), joint + "/x") - joints.begin();
    const std::size_t count = !several ? 1 : found->type == robot::UrdfJointType::kPlanar ? 3 : 6;
    if (values.size() != count) {
      refuse("the group state '" + name + "' gives the joint '" + joint + "' " +
             std::to_string(values.size()) + " values instead of " + std::to_string(count) + ".");
    }
    for (std::size_t i = 0; i < count; ++i) q[at + static_cast<std::ptrdiff_t>(i)] = values[i];
  }
  return q;
}

std::vector<RobotElement> Robot::elements() const {
  std::vector<RobotElement> all;
  for (const robot::Body& body : impl_->arm->bodies) {
    all.push_back({links()[static_cast<std::size_t>(body.entity)], body.element, false, false,
                   body.geometry, body.X_LB});
  }
  for (const bool attached : {true, false}) {
    for (const Object& object : impl_->objects) {
      if ((object.link >= 0) != attached) continue;
      int i = 0;
      for (const robot::Element& element : object.elements) {
        all.push_back({object.name, i++, !attached, attached, element.geometry, element.X});
      }
    }
  }
  return all;
}

fcl::Transform3d Robot::pose(const std::string& name, const Eigen::VectorXd& q) const {
  impl_->requireConfiguration(q, "q");
  const int entity = impl_->requireEntity(name);
  const int num_links = static_cast<int>(impl_->arm->links.size());
  fcl::Transform3d X = fcl::Transform3d::Identity();
  int link = entity;
  if (entity >= num_links) {
    const Object& object = impl_->objects[static_cast<std::size_t>(entity - num_links)];
    X = object.X;
    link = object.link;
    if (link < 0) return X;
  }
  std::vector<robot::PlacedLink> placed;
  impl_->arm->tree.place(q, placed);
  return placed[static_cast<std::size_t>(impl_->arm->tree.nodeOf(link))].pose(X);
}

void Robot::addObstacle(const std::string& name,
                        std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                        const fcl::Transform3d& X_W) {
  impl_->add({name, -1, robot::rigid(X_W, "'" + name + "'"), {{std::move(geometry)}}});
}

void Robot::attach(const std::string& name, const std::string& link,
                   std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                   const fcl::Transform3d& X_LB, const std::vector<std::string>& touch_links) {
  const int carrier = impl_->requireLink(link);
  impl_->add({name, carrier, robot::rigid(X_LB, "'" + name + "'"), {{std::move(geometry)}}});
  for (const std::string& touched : touch_links) impl_->allowed.insert(namePair(name, touched));
}

void Robot::moveObstacle(const std::string& name, const fcl::Transform3d& X_W) {
  const int entity = impl_->requireEntity(name) - static_cast<int>(impl_->arm->links.size());
  if (entity < 0 || impl_->objects[static_cast<std::size_t>(entity)].link >= 0) {
    refuse("'" + name + "' is no obstacle, so it can't be moved.");
  }
  impl_->objects[static_cast<std::size_t>(entity)].X = robot::rigid(X_W, "'" + name + "'");
  impl_->changed();
}

void Robot::remove(const std::string& name) {
  if (impl_->requireEntity(name) < static_cast<int>(impl_->arm->links.size())) {
    refuse("'" + name + "' is a link, which can't be removed.");
  }
  impl_->remove(name);
}

void Robot::allow(const std::string& a, const std::string& b, bool allowed) {
  impl_->requireEntity(a);
  impl_->requireEntity(b);
  if (allowed) {
    impl_->allowed.insert(namePair(a, b));
  } else {
    impl_->allowed.erase(namePair(a, b));
  }
  impl_->changed();
}

bool Robot::allowed(const std::string& a, const std::string& b) const {
  impl_->requireEntity(a);
  impl_->requireEntity(b);
  return impl_->allowed.count(namePair(a, b)) != 0;
}

void Robot::setPadding(const std::string& name, double metres) {
  impl_->requireEntity(name);
  if (!(metres >= 0 && metres <= 0x1p300)) {
    refuse("the padding of '" + name + "' must be finite and >= 0.");
  }
  impl_->paddings[name] = metres;
  impl_->changed();
}

void Robot::addScene(const std::string& file) {
  robot::Scene scene = robot::readScene(file, impl_->arm->description);
  auto next = std::make_unique<Impl>(*impl_);
  for (const std::string& name : scene.removed) next->remove(name);
  for (Object& object : scene.objects) {
    next->forget(object.name);
    try {
      next->add(std::move(object));
    } catch (const std::exception& error) {
      refuse(file + ": " + error.what());
    }
  }
  for (const auto& [name, may_touch] : scene.others) {
    if (!may_touch) continue;
    for (const std::string& link : links()) {
      if (link != name) next->allowed.insert(namePair(name, link));
    }
    for (const Object& object : next->objects) {
      if (object.name != name) next->allowed.insert(namePair(name, object.name));
    }
  }
  for (const auto& [pair, allowed] : scene.pairs) {
    if (allowed) {
      next->allowed.insert(pair);
    } else {
      next->allowed.erase(pair);
    }
  }
  for (const auto& [link, padding] : scene.paddings) next->paddings[link] = padding;
  std::set<std::string> named;
  for (const auto& [pair, allowed] : scene.pairs) named.insert({pair.first, pair.second});
  for (const auto& [name, may_touch] : scene.others) named.insert(name);
  for (const std::string& name : named) {
    if (next->entityOf(name) >= 0) continue;
    next->warnings.push_back(file + ": pairs may touch of '" + name +
                             "', which is no link, obstacle or attached object.");
  }
  next->changed();
  impl_ = std::move(next);
}

Robot loadRobot(const std::string& urdf_file, const std::string& srdf_file,
                const RobotOptions& options) {
  if (!(options.padding >= 0 && options.padding <= 0x1p300)) {
    refuse("RobotOptions::padding must be finite and >= 0.");
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
      body.node = arm->tree.nodeOf(static_cast<int>(i));
      body.X_LB = link.elements[k].X;
      body.measure();
      arm->linkage.addBody(body.node, body.geometry, body.X_LB);
      arm->bodies.push_back(std::move(body));
    }
  }
  auto impl = std::make_unique<Robot::Impl>(arm);
  impl->allowed = description.allowed;
  impl->warnings = description.warnings;
  if (options.padding > 0) {
    for (const std::string& link : arm->links) impl->paddings[link] = options.padding;
  }
  return Robot(std::move(impl));
}

}  // namespace kios
