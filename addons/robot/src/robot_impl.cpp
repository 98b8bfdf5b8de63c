// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a robot is told, and the cell that changes with it.

#include "robot_impl.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "text_file.h"
#include "urdf.h"

namespace kios {

using robot::Object;
using robot::refuse;

Robot::Impl::Impl(std::shared_ptr<const robot::Arm> the_arm) : arm(std::move(the_arm)) {
  for (const std::string& link : arm->links) {
    entities_.emplace(link, static_cast<int>(entities_.size()));
  }
}

Robot::Impl::Impl(const Impl& other)
    : arm(other.arm),
      warnings(other.warnings),
      objects_(other.objects_),
      free_(other.free_),
      orders_(other.orders_),
      entities_(other.entities_),
      ignored_(other.ignored_),
      paddings_(other.paddings_) {
  const std::lock_guard<std::mutex> lock(other.guard_);
  cell_ = other.cell_;
  ready_ = cell_ != nullptr;
  shared_ = ready_.load();
  other.shared_ = ready_.load();
}

const robot::Cell& Robot::Impl::cell() const {
  if (!ready_.load(std::memory_order_acquire)) {
    const std::lock_guard<std::mutex> lock(guard_);
    if (!cell_) {
      std::vector<robot::Entity> links;
      for (std::size_t i = 0; i < arm->links.size(); ++i) {
        links.push_back(entity(static_cast<int>(i)));
      }
      auto made = std::make_shared<robot::Cell>(arm, links);
      for (const Object* const object : ordered()) {
        const int id = entityOf(object->name);
        made->come(id, entity(id), *object);
      }
      cell_ = std::move(made);
    }
    ready_.store(true, std::memory_order_release);
  }
  return *cell_;
}

// Whoever shares the cell only reads it: a copy of it is changed.
template <typename Change>
void Robot::Impl::inCell(const Change& change) {
  if (!cell_) return;
  try {
    if (shared_) cell_ = std::make_shared<robot::Cell>(*cell_);
    shared_ = false;
    change(*cell_);
  } catch (...) {
    changed();
    throw;
  }
}

robot::Entity Robot::Impl::entity(int id) const {
  const auto num_links = static_cast<int>(arm->links.size());
  robot::Entity who;
  who.name = id < num_links ? arm->links[id] : objects_[id - num_links].name;
  const auto padding = paddings_.find(who.name);
  if (padding != paddings_.end()) who.padding = padding->second;
  const auto known = ignored_.find(who.name);
  if (known == ignored_.end()) return who;
  for (const auto& [other, by] : known->second) {
    const int with = entityOf(other);
    if (with >= 0 && with != id) who.ignored.push_back(with);
  }
  std::sort(who.ignored.begin(), who.ignored.end());
  return who;
}

int Robot::Impl::entityOf(const std::string& name) const {
  const auto known = entities_.find(name);
  return known == entities_.end() ? -1 : known->second;
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
  const int entity = entityOf(name);
  if (entity < 0 || entity >= static_cast<int>(arm->links.size())) {
    refuse("there is no link '" + name + "' of " + arm->description.name + ".");
  }
  return entity;
}

Object* Robot::Impl::objectOf(int entity) {
  const int place = entity - static_cast<int>(arm->links.size());
  return place < 0 ? nullptr : &objects_[place];
}

int Robot::Impl::requireObject(const std::string& name, bool attached, const char* done) const {
  const int entity = requireEntity(name), place = entity - static_cast<int>(arm->links.size());
  if (place < 0 || (objects_[place].link >= 0) != attached) {
    refuse("'" + name + (attached ? "' is not attached" : "' is no obstacle") +
           ", so it can't be " + done + ".");
  }
  return entity;
}

std::vector<const Object*> Robot::Impl::ordered() const {
  std::vector<const Object*> all;
  for (const Object& object : objects_) {
    if (!object.name.empty()) all.push_back(&object);
  }
  std::sort(all.begin(), all.end(), [](const Object* a, const Object* b) {
    return std::make_pair(a->link < 0, a->order) < std::make_pair(b->link < 0, b->order);
  });
  return all;
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

fcl::Transform3d Robot::Impl::poseOf(int link, const Eigen::VectorXd& q,
                                     const fcl::Transform3d& X_LB) const {
  std::vector<robot::PlacedLink> placed;
  arm->tree.place(q, placed);
  return placed[static_cast<std::size_t>(arm->tree.nodeOf(link))].pose(X_LB);
}

void Robot::Impl::add(Object object, const std::vector<std::string>& touched, double padding) {
  if (object.name.empty()) refuse("an object needs a name.");
  if (entityOf(object.name) >= 0) {
    const Object* const other = objectOf(entityOf(object.name));
    refuse("the name '" + object.name + "' is in use; " +
           (!other                                ? "it is a link's."
            : object.link >= 0 && other->link < 0 ? "attach the obstacle that has it."
                                                  : "remove what has it first."));
  }
  for (robot::Element& element : object.elements) {
    if (!element.geometry) refuse("the geometry of '" + object.name + "' is null.");
    if (!element.measured) element.measured = robot::measure(element.geometry);
  }
  requireCarried(object, object.link);
  requireReach(object, object.X);
  if (free_.empty()) {
    objects_.emplace_back();
    free_.push_back(static_cast<int>(objects_.size()) - 1);
  }
  const int place = free_.back(), id = static_cast<int>(arm->links.size()) + place;
  free_.pop_back();
  object.order = orders_++;
  objects_[place] = std::move(object);
  try {
    entities_.emplace(objects_[place].name, id);
    touch(objects_[place], touched);
    if (padding > 0) paddings_[objects_[place].name] = padding;
    inCell([&](robot::Cell& cell) { cell.come(id, entity(id), objects_[place]); });
  } catch (...) {
    untouch(objects_[place]);
    paddings_.erase(objects_[place].name);
    entities_.erase(objects_[place].name);
    objects_[place] = Object();
    free_.push_back(place);
    throw;
  }
}

void Robot::Impl::requireCarried(const Object& object, int link) const {
  if (link < 0 || arm->tree.moving(arm->tree.nodeOf(link)).empty()) return;
  for (const robot::Element& element : object.elements) {
    const auto type = element.geometry->getNodeType();
    if (type == fcl::GEOM_HALFSPACE || type == fcl::GEOM_PLANE) {
      refuse("'" + object.name + "' is a half-space or a plane, which can't be carried.");
    }
  }
}

// As the cell places elements.
void Robot::Impl::requireReach(const Object& object, const fcl::Transform3d& X) {
  for (const robot::Element& element : object.elements) {
    robot::rigid(robot::rigidProduct(X, element.X), "an element of '" + object.name + "'");
  }
}

void Robot::Impl::move(int entity, const fcl::Transform3d& X) {
  Object& object = *objectOf(entity);
  const fcl::Transform3d to = robot::rigid(X, "'" + object.name + "'"), from = object.X;
  requireReach(object, to);
  object.X = to;
  try {
    inCell([&](robot::Cell& cell) { cell.move(entity, object); });
  } catch (...) {
    object.X = from;
    throw;
  }
}

void Robot::Impl::carry(int id, int link, const fcl::Transform3d& X,
                        const std::vector<std::string>& touched) {
  Object& object = *objectOf(id);
  requireCarried(object, link);
  const fcl::Transform3d to = robot::rigid(X, "'" + object.name + "'");
  requireReach(object, to);
  const Object before = object;
  const auto set = [&](int on, const fcl::Transform3d& at, const std::vector<std::string>& names) {
    untouch(object);
    object.link = on;
    object.X = at;
    touch(object, names);
  };
  try {
    set(link, to, touched);
    inCell([&](robot::Cell& cell) { cell.change(id, entity(id), object); });
  } catch (...) {
    set(before.link, before.X, before.touch);
    throw;
  }
}

void Robot::Impl::setIgnored(const std::string& a, const std::string& b, unsigned by, bool on) {
  unsigned& known = ignored_[a][b];
  known = on ? known | by : known & ~by;
  if (known == 0) ignored_[a].erase(b);
}

void Robot::Impl::touch(Object& object, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name == object.name) continue;
    object.touch.push_back(name);
    setIgnored(object.name, name, kOwnTouch, true);
    setIgnored(name, object.name, kOthersTouch, true);
  }
}

void Robot::Impl::untouch(Object& object) {
  for (const std::string& name : object.touch) {
    setIgnored(object.name, name, kOwnTouch, false);
    setIgnored(name, object.name, kOthersTouch, false);
  }
  object.touch.clear();
}

void Robot::Impl::forget(const std::string& name) {
  const int entity = entityOf(name);
  if (entity < static_cast<int>(arm->links.size())) return;
  inCell([&](robot::Cell& cell) { cell.go(entity); });
  untouch(*objectOf(entity));
  entities_.erase(name);
  const int place = entity - static_cast<int>(arm->links.size());
  objects_[place] = Object();
  free_.push_back(place);
}

void Robot::Impl::remove(const std::string& name) {
  forget(name);
  paddings_.erase(name);
  const auto known = ignored_.find(name);
  if (known == ignored_.end()) return;
  for (const auto& [other, by] : known->second) {
    ignored_[other].erase(name);
    if ((by & kOthersTouch) != 0) dropTouch(other, name);
  }
  ignored_.erase(name);
}

void Robot::Impl::dropTouch(const std::string& of, const std::string& name) {
  const int entity = entityOf(of);
  Object* const object = entity < 0 ? nullptr : objectOf(entity);
  if (!object) return;
  auto& names = object->touch;
  names.erase(std::remove(names.begin(), names.end(), name), names.end());
}

bool Robot::Impl::ignores(const std::string& a, const std::string& b) const {
  const auto known = ignored_.find(a);
  return known != ignored_.end() && known->second.count(b) != 0;
}

void Robot::Impl::ignore(const std::string& a, const std::string& b, bool ignored) {
  if (a == b) return;  // never checked
  const int one = entityOf(a), other = entityOf(b);
  const bool was = ignores(a, b);
  const unsigned by = ignored ? kTold : kTold | kOwnTouch | kOthersTouch;
  setIgnored(a, b, by, ignored);
  setIgnored(b, a, by, ignored);
  if (!ignored) {
    dropTouch(a, b);
    dropTouch(b, a);
  }
  if (was == ignored) return;
  if (one >= 0 && other >= 0) refresh(objectOf(one) ? a : b);
}

void Robot::Impl::setPadding(const std::string& name, double metres) {
  paddings_[name] = metres;
  refresh(name);
}

void Robot::Impl::refresh(const std::string& name) {
  const int id = entityOf(name);
  const Object* const object = id < 0 ? nullptr : objectOf(id);
  if (object) {
    inCell([&](robot::Cell& cell) { cell.change(id, entity(id), *object); });
  } else {
    changed();
  }
}

}  // namespace kios
