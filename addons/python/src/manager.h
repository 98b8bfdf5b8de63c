// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <list>
#include <memory>
#include <unordered_map>
#include <utility>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "objects.h"
#include "turns.h"

namespace kios::python {

/// python-fcl's DynamicAABBTreeCollisionManager.
struct Manager {
  std::list<py::object> objects;  ///< the caller's own, in their order; outlive the tree
  std::unordered_map<Object*, std::list<py::object>::iterator> registered;
  fcl::DynamicAABBTreeCollisionManagerd tree;
  std::shared_ptr<Turns> turns = std::make_shared<Turns>();

  Manager() = default;
  Manager(const Manager&) = delete;
  ~Manager() { leaveObjects(); }

  /// The tree, once no query reads it.
  fcl::DynamicAABBTreeCollisionManagerd& changed() {
    awaitTurn([&] { return turns->readers > 0 ? turns : nullptr; }, "manager");
    return tree;
  }
  bool has(Object& object) const { return registered.count(&object) > 0; }
  void leaveObjects() {
    for (const auto& entry : registered) leave(*entry.first);
  }
  void leave(Object& object) const {
    auto& managers = object.managers;
    managers.erase(std::find(managers.begin(), managers.end(), turns));
  }
  void clear() {
    leaveObjects();
    registered.clear();
    tree.clear();
    std::exchange(objects, {}).clear();
  }
};

/// Throws a TypeError if it isn't one.
inline Object& objectOf(py::handle object) {
  if (!py::isinstance<Object>(object)) throw py::type_error("a CollisionObject is needed.");
  return object.cast<Object&>();
}

/// Answer manager.collide(*args) and distance(*args), as python-fcl does.
void collide(Manager& manager, const py::args& args);
void distance(Manager& manager, const py::args& args);
/// Notes the module's own callbacks, which the two answer without Python.
void noteDefaultCallbacks(py::module_& m);

}  // namespace kios::python
