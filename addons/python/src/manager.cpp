// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// python-fcl's DynamicAABBTreeCollisionManager.
#include "manager.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "results.h"

namespace kios::python {
namespace {

using Tree = fcl::DynamicAABBTreeCollisionManagerd;

/// FCL would lose track of an object that it gets twice, and keep it when it is gone.
bool enter(Manager& m, py::handle object) {
  Object& entered = objectOf(object);
  if (m.has(entered)) return false;
  m.registered[&entered] =
      m.objects.insert(m.objects.end(), py::reinterpret_borrow<py::object>(object));
  entered.managers.push_back(m.turns);
  return true;
}

/// FCL's tree of boxes divides for ever where one isn't finite.
void requireBox(Object& object) {
  const fcl::AABBd& box = object.object.getAABB();
  if (box.min_.allFinite() && box.max_.allFinite()) return;
  throw std::invalid_argument(
      "DynamicAABBTreeCollisionManager: an object's pose or geometry is not finite.");
}

std::vector<py::object> listed(const py::iterable& objects) {
  std::vector<py::object> all;
  for (const py::handle object : objects) {
    objectOf(object);
    all.push_back(py::reinterpret_borrow<py::object>(object));
  }
  return all;
}

void registerObject(Manager& m, py::handle object) {
  Object& given = objectOf(object);
  Tree& tree = m.changed();
  requireBox(given);
  if (enter(m, object)) tree.registerObject(&given.object);
}

void registerObjects(Manager& m, const py::iterable& objects) {
  const std::vector<py::object> given = listed(objects);
  Tree& tree = m.changed();
  for (const py::object& object : given) requireBox(objectOf(object));
  std::vector<fcl::CollisionObjectd*> entered;
  for (const py::object& object : given) {
    if (enter(m, object)) entered.push_back(&objectOf(object).object);
  }
  if (!entered.empty()) tree.registerObjects(entered);
}

void unregisterObject(Manager& m, py::handle object) {
  Object& found = objectOf(object);
  Tree& tree = m.changed();
  const auto at = m.registered.find(&found);
  if (at == m.registered.end()) return;
  tree.unregisterObject(&found.object);
  m.leave(found);
  const auto kept = at->second;
  m.registered.erase(at);
  m.objects.erase(kept);
}

/// All objects, one, or those of an iterable.
void update(Manager& m, const py::object& arg) {
  const bool all = arg.is_none();
  const std::vector<py::object> given = all                           ? std::vector<py::object>()
                                        : py::isinstance<Object>(arg) ? std::vector{arg}
                                                                      : listed(arg);
  Tree& tree = m.changed();
  std::vector<fcl::CollisionObjectd*> moved;
  for (const py::object& object : given) {
    Object& found = objectOf(object);
    if (!m.has(found)) continue;
    requireBox(found);
    moved.push_back(&found.object);
  }
  if (!moved.empty()) tree.update(moved);
  if (!all) return;
  for (const auto& entry : m.registered) requireBox(*entry.first);
  tree.update();
}

struct VisitObjects {
  template <typename Each>
  void operator()(Manager& manager, const Each& each) const {
    for (py::object& object : manager.objects) each(object);
  }
  static void clear(Manager& manager) { manager.clear(); }
};

/// A setting of FCL's tree, by a pointer to a member or a reference to it.
template <typename Get>
void setting(py::class_<Manager>& c, const char* name, Get get) {
  using T = std::decay_t<decltype(get(std::declval<Tree&>()))>;
  c.def_property(
      name, [get](Manager& m) { return T(get(m.tree)); },
      [get](Manager& m, T value) { get(m.changed()) = value; });
}

}  // namespace

void bindManager(py::module_& m) {
  noteDefaultCallbacks(m);
  py::class_<Manager> c(m, "DynamicAABBTreeCollisionManager",
                        "DynamicAABBTreeCollisionManager()\n--\n\n"
                        "FCL's tree of the objects' boxes in the world.",
                        py::custom_type_setup([](PyHeapTypeObject* type) {
                          traverse<Manager>(type, VisitObjects());
                        }));
  c.def(py::init<>(), "__init__(self)\n--\n\nAn empty manager.")
      .def("registerObjects", &registerObjects, py::arg("other_objs"),
           "registerObjects(self, other_objs)\n--\n\nTakes in all of an iterable.")
      .def("registerObject", &registerObject, py::arg("obj"),
           "registerObject(self, obj)\n--\n\nTakes in an object, once.")
      .def("unregisterObject", &unregisterObject, py::arg("obj"),
           "unregisterObject(self, obj)\n--\n\nTakes an object out, if it is in.")
      .def(
          "setup", [](Manager& manager) { manager.changed().setup(); },
          "setup(self)\n--\n\nBalances the tree.")
      .def("update", &update, py::arg("arg") = py::none(),
           "update(self, arg=None)\n--\n\nTo be called after objects moved: all, one, or those of "
           "an iterable.")
      .def(
          "getObjects",
          [](const Manager& manager) {
            py::list objects;
            for (const py::object& object : manager.objects) objects.append(object);
            return objects;
          },
          "getObjects(self)\n--\n\nThe objects, in the order in which they came.")
      .def("collide", &collide,
           "collide(self, *args)\n--\n\ncollide([object or manager,] data, callback): asks "
           "callback(o1, o2, data) about every\npair whose boxes overlap, until it returns True.")
      .def("distance", &distance,
           "distance(self, *args)\n--\n\ndistance([object or manager,] data, callback): asks "
           "callback(o1, o2, data), which returns\n(whether to stop, the least distance so far), "
           "about "
           "pairs whose boxes are nearer.")
      .def(
          "clear", [](Manager& manager) { manager.changed(), manager.clear(); },
          "clear(self)\n--\n\nTakes all objects out.")
      .def(
          "empty", [](const Manager& manager) { return manager.tree.empty(); },
          "empty(self)\n--\n\nWhether there is no object.")
      .def(
          "size", [](const Manager& manager) { return manager.tree.size(); },
          "size(self)\n--\n\nThe number of objects.");
  const auto member = [&](const char* name, auto Tree::*at) {
    setting(
        c, name, [at](Tree & tree) -> auto& { return tree.*at; });
  };
  member("max_tree_nonbalanced_level", &Tree::max_tree_nonbalanced_level);
  member("tree_incremental_balance_pass", &Tree::tree_incremental_balance_pass);
  member("tree_init_level", &Tree::tree_init_level);
  member("octree_as_geometry_collide", &Tree::octree_as_geometry_collide);
  member("octree_as_geometry_distance", &Tree::octree_as_geometry_distance);
  setting(
      c, "tree_topdown_level", [](Tree & tree) -> auto& { return tree.tree_topdown_level; });
  setting(
      c, "tree_topdown_balance_threshold",
      [](Tree & tree) -> auto& { return tree.tree_topdown_balance_threshold; });
}

}  // namespace kios::python
