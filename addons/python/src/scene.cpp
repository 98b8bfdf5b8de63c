// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What fcl_kios.Scene is made of. An object has a handle, which no other ever gets.
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "batch.h"
#include "fcl_kios/scene.h"
#include "mesh.h"
#include "objects.h"
#include "without_gil.h"

namespace kios::python {
namespace {

using Handle = long long;
using Pairs = std::vector<ScenePaird>;

/// The objects of a scene that threads take turns with. `mutex_` is never waited for with the GIL,
/// and no code of Python's runs while it is held, where the GIL is taken for references alone.
class Scene {
  struct Entry {
    Entry(py::object of, py::handle geometry, const fcl::Transform3d& pose, bool fixed)
        : name(std::move(of)),
          X(pose),
          obstacle(fixed),
          unchanging(py::isinstance<Mesh>(geometry)) {
      if (unchanging) {
        shared = geometry.cast<const Mesh&>().share();
      } else {
        shared = geometry.cast<std::shared_ptr<fcl::CollisionGeometryd>>();
        ++turnsOf(*shared).placed;
      }
    }
    Entry(const Entry&) = delete;
    ~Entry() {
      if (!unchanging) --turnsOf(*shared).placed;
    }

    py::object name;
    fcl::Transform3d X;
    const bool obstacle, unchanging;
    std::shared_ptr<const fcl::CollisionGeometryd> shared;
    int id = -1;
  };

  /// Runs without the GIL, alone.
  template <typename Do>
  auto alone(const Do& what) {
    const WithoutGil released;
    const std::lock_guard<std::mutex> lock(mutex_);
    return what();
  }
  /// Throws KeyError; needs the mutex.
  Entry& entry(Handle handle) {
    const auto at = entries_.find(handle);
    if (at != entries_.end()) return *at->second;
    throw py::key_error("the scene has lost that object meanwhile.");
  }

 public:
  /// Takes the name for its answers' sake.
  Handle add(py::object name, py::handle geometry, py::handle X, bool obstacle) {
    if (!py::isinstance<Mesh>(geometry) && !py::isinstance<fcl::CollisionGeometryd>(geometry)) {
      throw py::type_error("geometry must be a Mesh or a geometry of fcl_kios.fcl.");
    }
    auto made =
        std::make_unique<Entry>(std::move(name), geometry, Poses(X, "X").only("X"), obstacle);
    return alone([&] {
      made->id = scene_.add(made->shared, made->X, obstacle ? Role::kObstacle : Role::kBody);
      handles_[made->id] = ++last_;
      entries_[last_] = std::move(made);
      return last_;
    });
  }

  void remove(Handle handle) {
    std::unique_ptr<Entry> removed;  // which goes with the GIL
    alone([&] {
      const int id = entry(handle).id;
      scene_.remove(id);
      handles_.erase(id);
      removed = std::move(entries_.extract(handle).mapped());
    });
  }

  /// All or none.
  void move(const std::vector<Handle>& handles, py::handle X) {
    const Poses poses(X, "X");
    if (poses.size != handles.size()) {
      throw std::invalid_argument("fcl_kios: there are " + std::to_string(handles.size()) +
                                  " names, but " + std::to_string(poses.size) + " poses.");
    }
    alone([&] {
      std::vector<Entry*> moved;
      for (const Handle handle : handles) moved.push_back(&entry(handle));
      std::size_t i = 0;
      try {
        for (; i < moved.size(); ++i) scene_.move(moved[i]->id, poses[i]);
      } catch (...) {
        while (i-- > 0) scene_.move(moved[i]->id, moved[i]->X);
        throw;
      }
      for (i = 0; i < moved.size(); ++i) moved[i]->X = poses[i];
    });
  }

  void changed(Handle handle) {
    alone([&] { scene_.changed(entry(handle).id); });
  }
  void exclude(Handle a, Handle b, bool excluded) {
    alone([&] { scene_.ignorePair(entry(a).id, entry(b).id, excluded); });
  }

  py::list closest(bool points) {
    return ask(points, [&] {
      const std::optional<ScenePaird> pair = scene_.closestPair({points, true});
      return pair ? Pairs{*pair} : Pairs();
    });
  }
  py::list within(double margin, bool points) {
    return ask(points, [&] { return scene_.pairsWithin(margin, {points, true}); });
  }
  py::list clearances(bool points) {
    return ask(points, [&] { return scene_.clearances({points, true}); });
  }
  std::pair<long long, long long> counts() {
    return alone([&] { return std::make_pair(scene_.counts().total, scene_.counts().skipped()); });
  }

  /// Pose and whether it is an obstacle, as add() takes them.
  py::tuple state(Handle handle) {
    const auto found = alone([&] {
      const Entry& of = entry(handle);
      return std::make_pair(of.X, of.obstacle);
    });
    py::array_t<double> pose({4, 4});
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(pose.mutable_data()) =
        found.first.matrix();
    return py::make_tuple(pose, found.second);
  }

 private:
  /// Tuples of two names, a distance, two triangles and, if asked for, two points.
  template <typename Query>
  py::list ask(bool points, const Query& query) {
    std::vector<py::object> names;
    const auto run = [&] {
      Pairs found = query();
      const WithGil gil;
      for (const ScenePaird& pair : found) {
        for (const int id : {pair.a, pair.b}) names.push_back(entry(handles_.at(id)).name);
      }
      return found;
    };
    const Pairs pairs = [&] {
      const Reading reading(&crowdTurns());
      return alone(run);
    }();
    py::list answer;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const ScenePaird& pair = pairs[i];
      if (i % 1024 == 1023) listen();
      answer.append(py::make_tuple(names[2 * i], names[2 * i + 1], pair.distance, pair.triangle_a,
                                   pair.triangle_b,
                                   points ? py::object(toArray(pair.nearest_a)) : py::none(),
                                   points ? py::object(toArray(pair.nearest_b)) : py::none()));
    }
    return answer;
  }

  SceneDistanced scene_;
  std::mutex mutex_;
  Handle last_ = 0;
  std::unordered_map<Handle, std::unique_ptr<Entry>> entries_;
  std::unordered_map<int, Handle> handles_;  ///< by ids of scene_
};

/// A part's; a box as it stands now.
std::shared_ptr<const fcl::CollisionGeometryd> geometryOf(py::handle part) {
  if (py::isinstance<Mesh>(part)) return part.cast<const Mesh&>().share();
  if (py::isinstance<fcl::Convexd>(part)) return part.cast<std::shared_ptr<fcl::Convexd>>();
  return std::make_shared<fcl::Boxd>(part.cast<const fcl::Boxd&>());
}

/// A list of tuples: two places in the list, status, whether it is decided and deep, two bounds,
/// three vectors. Parts are tuples of a name, a Mesh, Box or Convex, a pose and a group.
py::list clashes(const py::list& parts, double touch, double clearance,
                 std::vector<std::pair<std::string, std::string>> ignored, bool between_groups,
                 const py::object& threads) {
  std::vector<ClashPart> placed;
  for (const py::handle part : parts) {
    const auto entry = py::reinterpret_borrow<py::tuple>(part);
    ClashPart& added = placed.emplace_back();
    added.name = entry[0].cast<std::string>();
    added.geometry = geometryOf(entry[1]);
    const std::string X = "X of part '" + added.name + "'";
    added.X_WP = Poses(entry[2], X.c_str()).only(X.c_str());
    added.group = entry[3].cast<int>();
  }
  ClashRequest request;
  request.touch = touch;
  request.clearance = clearance;
  request.ignored = std::move(ignored);
  request.between_groups = between_groups;
  request.threads = threadsOf(threads);
  const auto found = std::make_shared<std::vector<ClashResult>>();
  runInterruptibly([placed = std::move(placed), request = std::move(request), found] {
    *found = findClashes(placed, request);
  });
  py::list list;
  for (const ClashResult& clash : *found) {
    const auto vector = [](const double(&p)[3]) { return toArray({p[0], p[1], p[2]}); };
    list.append(py::make_tuple(clash.a, clash.b, static_cast<int>(clash.status), clash.decided,
                               clash.deep, clash.lower, clash.upper, vector(clash.point_a),
                               vector(clash.point_b), vector(clash.way_out)));
  }
  return list;
}

}  // namespace

void bindScene(py::module_& m) {
  m.def("_clashes", &clashes);
  py::class_<Scene>(m, "_Scene")
      .def(py::init<>())
      .def("add", &Scene::add)
      .def("remove", &Scene::remove)
      .def("move", &Scene::move)
      .def("changed", &Scene::changed)
      .def("exclude", &Scene::exclude)
      .def("closest", &Scene::closest)
      .def("within", &Scene::within)
      .def("clearances", &Scene::clearances)
      .def("counts", &Scene::counts)
      .def("state", &Scene::state);
}

}  // namespace kios::python
