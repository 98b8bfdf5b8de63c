// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// python-fcl's DynamicAABBTreeCollisionManager.
#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "fcl_kios/overloads.h"
#include "results.h"

namespace kios::python {
namespace {

using Tree = fcl::DynamicAABBTreeCollisionManagerd;

struct Manager {
  std::vector<py::object> objects;  ///< the caller's own, in their order; outlive the tree
  std::unordered_set<Object*> registered;
  Tree tree;
  Readers readers = 0;

  Tree& changed() {
    requireUnread(readers, "manager");
    return tree;
  }
  bool has(Object& object) const { return registered.count(&object) > 0; }
};

Object& objectOf(py::handle object) {
  if (!py::isinstance<Object>(object)) throw py::type_error("a CollisionObject is needed.");
  return object.cast<Object&>();
}

/// FCL would lose track of an object that it gets twice, and keep it when it is gone.
bool enter(Manager& m, py::handle object) {
  if (!m.registered.insert(&objectOf(object)).second) return false;
  m.objects.push_back(py::reinterpret_borrow<py::object>(object));
  return true;
}

/// FCL's tree of boxes divides for ever where one isn't finite.
void requireBox(Object& object) {
  const fcl::AABBd& box = object.object.getAABB();
  if (box.min_.allFinite() && box.max_.allFinite()) return;
  throw std::invalid_argument(
      "DynamicAABBTreeCollisionManager: an object's pose or geometry is not finite.");
}

void requireBoxes(const Manager& m) {
  for (Object* const object : m.registered) requireBox(*object);
}

void registerObject(Manager& m, py::handle object) {
  requireBox(objectOf(object));
  Tree& tree = m.changed();
  if (enter(m, object)) tree.registerObject(&objectOf(object).object);
}

void registerObjects(Manager& m, const py::iterable& objects) {
  std::vector<py::object> given;
  for (const py::handle object : objects) {
    requireBox(objectOf(object));
    given.push_back(py::reinterpret_borrow<py::object>(object));
  }
  Tree& tree = m.changed();
  std::vector<fcl::CollisionObjectd*> entered;
  for (const py::object& object : given) {
    if (enter(m, object)) entered.push_back(&objectOf(object).object);
  }
  if (!entered.empty()) tree.registerObjects(entered);
}

void unregisterObject(Manager& m, py::handle object) {
  Object& found = objectOf(object);
  Tree& tree = m.changed();
  if (m.registered.erase(&found) == 0) return;
  tree.unregisterObject(&found.object);
  m.objects.erase(std::find_if(m.objects.begin(), m.objects.end(),
                               [&](const py::object& o) { return o.is(object); }));
}

void update(Manager& m, py::handle arg) {
  requireBoxes(m);
  if (arg.is_none()) {
    m.changed().update();
  } else if (py::hasattr(arg, "__len__")) {
    std::vector<fcl::CollisionObjectd*> moved;
    for (const py::handle object : arg) {
      if (m.has(objectOf(object))) moved.push_back(&objectOf(object).object);
    }
    m.changed().update(moved);
  } else if (m.has(objectOf(arg))) {
    m.changed().update(&objectOf(arg).object);
  }
}

void clear(Manager& m) {
  m.changed().clear();
  m.registered.clear();
  std::exchange(m.objects, {}).clear();
}

/// What is asked of a manager: all its pairs, those with an object, or with another manager.
struct Question {
  Manager& manager;
  Object* object;
  Manager* other;
  py::object asked_of;  ///< keeps them alive, whatever a callback deletes
  py::object data, callback;

  template <typename Run>
  void run(const Run& collideOrDistance) const {
    if (object) {
      collideOrDistance(&object->object);
    } else if (other) {
      collideOrDistance(&other->tree);
    } else {
      collideOrDistance();
    }
  }

  std::vector<ReadingObject> readingObjects() const {
    std::vector<ReadingObject> reading;
    const auto mark = [&](const Manager& m) {
      for (Object* const registered : m.registered) reading.emplace_back(*registered);
    };
    mark(manager);
    if (other) mark(*other);
    if (object) reading.emplace_back(*object);
    return reading;
  }
};

Question parse(Manager& manager, const py::args& args) {
  Question question{manager, nullptr, nullptr, {}, {}, {}};
  const std::size_t n = args.size();
  if ((n != 2 && n != 3) || PyCallable_Check(py::object(args[n - 1]).ptr()) == 0) {
    throw std::invalid_argument(
        "DynamicAABBTreeCollisionManager: (data, callback), (object, data, callback) or (manager, "
        "data, callback) are taken.");
  }
  question.data = args[n - 2];
  question.callback = args[n - 1];
  if (n == 2) return question;
  question.asked_of = args[0];
  if (py::isinstance<Manager>(args[0])) {
    question.other = &args[0].cast<Manager&>();
  } else {
    question.object = &objectOf(args[0]);
  }
  return question;
}

/// Calls back into Python; what that raises ends the query and is raised once, after it.
struct PythonCallback {
  const Question& question;
  std::exception_ptr raised;

  py::object call(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b) const {
    return question.callback(Object::of(*a).self(), Object::of(*b).self(), question.data);
  }
  template <typename Take>
  bool guarded(const Take& take) {
    if (raised) return true;
    try {
      return take();
    } catch (...) {
      raised = std::current_exception();
      return true;
    }
  }
  void rethrow() const {
    if (raised) std::rethrow_exception(raised);
  }
};

bool isTrue(py::handle value) {
  const int truth = PyObject_IsTrue(value.ptr());
  if (truth < 0) throw py::error_already_set();
  return truth != 0;
}

bool collidePython(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  auto& callback = *static_cast<PythonCallback*>(data);
  return callback.guarded([&] { return isTrue(callback.call(a, b)); });
}

bool distancePython(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data, double& dist) {
  auto& callback = *static_cast<PythonCallback*>(data);
  return callback.guarded([&] {
    const py::object answer = callback.call(a, b);
    if (!py::isinstance<py::sequence>(answer) || py::len(answer) != 2) {
      throw py::type_error("a distance callback must return (whether to stop, a distance), not " +
                           std::string(py::repr(answer)) + ".");
    }
    const py::sequence pair = answer;
    dist = PyFloat_AsDouble(py::object(pair[1]).ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
    return isTrue(py::object(pair[0]));
  });
}

/// The default callback, in C++: what it found of each pair.
struct Contacts {
  struct Pair {
    Object *a, *b;
    fcl::CollisionResultd found;
  };
  fcl::CollisionRequestd request;
  std::size_t contacts;
  bool done = false;
  std::vector<Pair> pairs;
};

bool collideDefault(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  auto& all = *static_cast<Contacts*>(data);
  requireServed(Query::kCollide, *a, *b);
  fcl::CollisionResultd found;
  fcl::collide(a, b, all.request, found);
  if (!found.isCollision() && found.numCostSources() == 0) return false;
  all.contacts += found.numContacts();
  all.pairs.push_back({&Object::of(*a), &Object::of(*b), std::move(found)});
  all.done = enough(all.request, all.contacts);
  return all.done;
}

struct Nearest {
  fcl::DistanceRequestd request;
  fcl::DistanceResultd found;
  Object *a = nullptr, *b = nullptr;
};

bool distanceDefault(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data, double& dist) {
  auto& nearest = *static_cast<Nearest*>(data);
  requireServed(Query::kDistance, *a, *b);
  const double before = nearest.found.min_distance;
  fcl::distance(a, b, nearest.request, nearest.found);
  dist = nearest.found.min_distance;
  if (dist < before) {
    nearest.a = &Object::of(*a);
    nearest.b = &Object::of(*b);
  }
  return dist <= 0;
}

void collide(Manager& manager, const py::args& args) {
  const Question question = parse(manager, args);
  const Reading reading(manager.readers);
  Readers ignored = 0;
  const Reading reading_other(question.other ? question.other->readers : ignored);
  if (!question.callback.is(ofFcl("defaultCollisionCallback"))) {
    PythonCallback callback{question, {}};
    question.run([&](auto*... of) { manager.tree.collide(of..., &callback, collidePython); });
    return callback.rethrow();
  }
  if (attribute<bool>(question.data, "done")) return;
  const py::object result = question.data.attr("result");
  Contacts all{
      collisionRequest(question.data.attr("request")), py::len(result.attr("contacts")), false, {}};
  {
    const auto objects = question.readingObjects();
    const WithoutGil released;
    question.run([&](auto*... of) { manager.tree.collide(of..., &all, collideDefault); });
  }
  for (Contacts::Pair& pair : all.pairs) append(pair.found, *pair.a, *pair.b, result);
  if (all.done) question.data.attr("done") = true;
}

void distance(Manager& manager, const py::args& args) {
  const Question question = parse(manager, args);
  const Reading reading(manager.readers);
  Readers ignored = 0;
  const Reading reading_other(question.other ? question.other->readers : ignored);
  if (!question.callback.is(ofFcl("defaultDistanceCallback"))) {
    PythonCallback callback{question, {}};
    question.run([&](auto*... of) { manager.tree.distance(of..., &callback, distancePython); });
    return callback.rethrow();
  }
  if (attribute<bool>(question.data, "done")) return;
  const py::object result = question.data.attr("result");
  Nearest nearest{distanceRequest(question.data.attr("request")), emptyResult(minDistance(result))};
  {
    const auto objects = question.readingObjects();
    const WithoutGil released;
    question.run([&](auto*... of) { manager.tree.distance(of..., &nearest, distanceDefault); });
  }
  if (nearest.a) assign(nearest.found, *nearest.a, *nearest.b, result);
}

struct VisitObjects {
  template <typename Each>
  void operator()(Manager& manager, const Each& each) const {
    for (py::object& object : manager.objects) each(object);
  }
  static void clear(Manager& manager) {
    manager.tree.clear();
    manager.registered.clear();
    std::exchange(manager.objects, {}).clear();
  }
};

template <typename T>
void property(py::class_<Manager>& c, const char* name, T Tree::*member) {
  c.def_property(
      name, [member](const Manager& m) { return m.tree.*member; },
      [member](Manager& m, T value) { m.changed().*member = value; });
}

}  // namespace

void bindManager(py::module_& m) {
  py::class_<Manager> c(m, "DynamicAABBTreeCollisionManager",
                        py::custom_type_setup([](PyHeapTypeObject* type) {
                          traverse<Manager>(type, VisitObjects());
                        }));
  c.def(py::init<>())
      .def("registerObjects", &registerObjects, py::arg("other_objs"))
      .def("registerObject", &registerObject, py::arg("obj"))
      .def("unregisterObject", &unregisterObject, py::arg("obj"))
      .def("setup", [](Manager& manager) { manager.changed().setup(); })
      .def("update", &update, py::arg("arg") = py::none())
      .def("getObjects",
           [](const Manager& manager) {
             py::list objects;
             for (const py::object& object : manager.objects) objects.append(object);
             return objects;
           })
      .def("collide", &collide)
      .def("distance", &distance)
      .def("clear", &clear)
      .def("empty", [](const Manager& manager) { return manager.tree.empty(); })
      .def("size", [](const Manager& manager) { return manager.tree.size(); });
  property(c, "max_tree_nonbalanced_level", &Tree::max_tree_nonbalanced_level);
  property(c, "tree_incremental_balance_pass", &Tree::tree_incremental_balance_pass);
  property(c, "tree_init_level", &Tree::tree_init_level);
  property(c, "octree_as_geometry_collide", &Tree::octree_as_geometry_collide);
  property(c, "octree_as_geometry_distance", &Tree::octree_as_geometry_distance);
  c.def_property(
      "tree_topdown_balance_threshold",
      [](const Manager& manager) { return manager.tree.tree_topdown_balance_threshold; },
      [](Manager& manager, int value) {
        manager.changed().tree_topdown_balance_threshold = value;
      });
  c.def_property(
      "tree_topdown_level", [](const Manager& manager) { return manager.tree.tree_topdown_level; },
      [](Manager& manager, int value) { manager.changed().tree_topdown_level = value; });
}

}  // namespace kios::python
