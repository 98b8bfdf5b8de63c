// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What python-fcl's DynamicAABBTreeCollisionManager is asked.
#include <chrono>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fcl_kios/overloads.h"
#include "manager.h"
#include "results.h"

namespace kios::python {
namespace {

py::handle default_collision, default_distance;  // the module's callbacks

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

  Reading reading() const {
    return Reading(manager.turns.get(), &crowdTurns(), object ? &object->turns : nullptr,
                   other ? other->turns.get() : nullptr);
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

/// Listens every 20 ms, within a query without the GIL.
class Listener {
 public:
  void operator()() {
    const auto now = std::chrono::steady_clock::now();
    if (now - listened_ < std::chrono::milliseconds(20)) return;
    listened_ = now;
    const WithGil gil;
    listen();
  }

 private:
  std::chrono::steady_clock::time_point listened_ = std::chrono::steady_clock::now();
};

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
  Listener listener{};
};

bool collideDefault(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  auto& all = *static_cast<Contacts*>(data);
  all.listener();
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
  Listener listener{};
};

bool distanceDefault(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data, double& dist) {
  auto& nearest = *static_cast<Nearest*>(data);
  nearest.listener();
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

}  // namespace

void collide(Manager& manager, const py::args& args) {
  const Question question = parse(manager, args);
  if (!question.callback.is(default_collision)) {
    const Reading reading = question.reading();
    PythonCallback callback{question, {}};
    question.run([&](auto*... of) { manager.tree.collide(of..., &callback, collidePython); });
    return callback.rethrow();
  }
  if (attribute<bool>(question.data, "done")) return;
  const py::object result = question.data.attr(interned("result"));
  Contacts all{collisionRequest(question.data.attr(interned("request"))),
               py::len(result.attr(interned("contacts"))),
               false,
               {}};
  std::vector<py::object> kept;  // numpy may let others go on, who take objects out
  {
    const Reading reading = question.reading();
    {
      const WithoutGil released;
      question.run([&](auto*... of) { manager.tree.collide(of..., &all, collideDefault); });
    }
    for (const Contacts::Pair& pair : all.pairs) {
      kept.push_back(pair.a->self());
      kept.push_back(pair.b->self());
    }
  }
  for (Contacts::Pair& pair : all.pairs) append(pair.found, *pair.a, *pair.b, result);
  if (all.done) question.data.attr(interned("done")) = true;
}

void distance(Manager& manager, const py::args& args) {
  const Question question = parse(manager, args);
  if (!question.callback.is(default_distance)) {
    const Reading reading = question.reading();
    PythonCallback callback{question, {}};
    question.run([&](auto*... of) { manager.tree.distance(of..., &callback, distancePython); });
    return callback.rethrow();
  }
  if (attribute<bool>(question.data, "done")) return;
  const py::object result = question.data.attr(interned("result"));
  Nearest nearest{distanceRequest(question.data.attr(interned("request"))),
                  emptyResult(minDistance(result))};
  py::object a, b;
  {
    const Reading reading = question.reading();
    {
      const WithoutGil released;
      question.run([&](auto*... of) { manager.tree.distance(of..., &nearest, distanceDefault); });
    }
    if (nearest.a) a = nearest.a->self(), b = nearest.b->self();
  }
  if (a) assign(nearest.found, *nearest.a, *nearest.b, result);
}

void noteDefaultCallbacks(py::module_& m) {
  default_collision = m.attr("defaultCollisionCallback");
  default_distance = m.attr("defaultDistanceCallback");
}

}  // namespace kios::python
