// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What fcl_kios.Scene, which knows objects by names, is made of.
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "arrays.h"
#include "fcl_kios/scene/scene_distance.h"
#include "mesh.h"
#include "objects.h"

namespace kios::python {
namespace {

using Pairs = std::vector<ScenePaird>;

/// A scene that threads take turns with.
class Scene {
  /// Runs without the GIL, alone.
  template <typename Do>
  auto change(const Do& what) {
    const WithoutGil released;
    const std::lock_guard<std::mutex> lock(mutex_);
    return what();
  }

 public:
  int add(py::handle geometry, py::handle X, bool obstacle) {
    const Role role = obstacle ? Role::kObstacle : Role::kBody;
    const fcl::Transform3d pose = Poses(X, "X").only("X");
    std::shared_ptr<const fcl::CollisionGeometryd> shared;
    if (py::isinstance<Mesh>(geometry)) {
      shared = geometry.cast<const Mesh&>().share();
    } else if (py::isinstance<fcl::CollisionGeometryd>(geometry)) {
      shared = geometry.cast<std::shared_ptr<fcl::CollisionGeometryd>>();
    } else {
      throw py::type_error("geometry must be a Mesh or a geometry of fcl_kios.fcl.");
    }
    const int id = change([&] { return scene_.add(shared, pose, role); });
    geometries_[id] = shared;
    return id;
  }

  void remove(int id) {
    change([&] { scene_.remove(id); });
    geometries_.erase(id);
  }

  void move(const std::vector<int>& ids, py::handle X) {
    const Poses poses(X, "X");
    if (poses.size != ids.size()) {
      throw std::invalid_argument("fcl_kios: there are " + std::to_string(ids.size()) +
                                  " names, but " + std::to_string(poses.size) + " poses.");
    }
    change([&] {
      for (std::size_t i = 0; i < ids.size(); ++i) scene_.move(ids[i], poses[i]);
    });
  }

  void changed(int id) {
    change([&] { scene_.changed(id); });
  }
  void exclude(int a, int b, bool excluded) {
    change([&] { scene_.exclude(a, b, excluded); });
  }

  py::tuple closest(bool points) {
    return asTuple(ask([&] {
      const std::optional<ScenePaird> pair = scene_.closestPair({points, true});
      return pair ? Pairs{*pair} : Pairs();
    }));
  }
  py::tuple within(double margin, bool points) {
    return asTuple(ask([&] { return scene_.pairsWithin(margin, {points, true}); }));
  }
  py::tuple clearances(bool points) {
    return asTuple(ask([&] { return scene_.clearances({points, true}); }));
  }

  std::pair<long long, long long> counts() {
    return change([&] { return std::make_pair(scene_.counts().total, scene_.counts().skipped()); });
  }

 private:
  template <typename Query>
  Pairs ask(const Query& query) {
    std::vector<ReadingGeometry> reading;
    reading.reserve(geometries_.size());
    for (const auto& of_id : geometries_) reading.emplace_back(*of_id.second);
    return change(query);
  }

  static py::tuple asTuple(const Pairs& pairs) {
    const auto n = static_cast<py::ssize_t>(pairs.size());
    py::array_t<std::int64_t> ids({n, py::ssize_t{2}}), triangles({n, py::ssize_t{2}});
    py::array_t<double> distances(n), points({n, py::ssize_t{2}, py::ssize_t{3}});
    for (py::ssize_t i = 0; i < n; ++i) {
      const ScenePaird& pair = pairs[static_cast<std::size_t>(i)];
      ids.mutable_at(i, 0) = pair.a;
      ids.mutable_at(i, 1) = pair.b;
      distances.mutable_at(i) = pair.distance;
      triangles.mutable_at(i, 0) = pair.triangle_a;
      triangles.mutable_at(i, 1) = pair.triangle_b;
      for (int c = 0; c < 3; ++c) {
        points.mutable_at(i, 0, c) = pair.nearest_a[c];
        points.mutable_at(i, 1, c) = pair.nearest_b[c];
      }
    }
    return py::make_tuple(ids, distances, triangles, points);
  }

  SceneDistanced scene_;
  std::mutex mutex_;
  std::unordered_map<int, std::shared_ptr<const fcl::CollisionGeometryd>> geometries_;
};

}  // namespace

void bindScene(py::module_& m) {
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
      .def("counts", &Scene::counts);
}

}  // namespace kios::python
