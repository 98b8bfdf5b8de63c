// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>

#include "scene_competitor.h"

namespace kios::bench {

/// The bodies of a scene as collision objects over BV.
template <typename BV>
struct SceneObjects {
  std::vector<std::shared_ptr<fcl::BVHModel<BV>>> models;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  const scenes::BodyScene* scene = nullptr;

  void load(const scenes::BodyScene& from) {
    scene = &from;
    models.clear();
    objects.clear();
    for (const scenes::Mesh& mesh : from.meshes) models.push_back(scenes::buildModel<BV>(mesh));
    for (int body = 0; body < from.size(); ++body) {
      const auto& X =
          body < from.moving() ? from.frames[0][body] : from.places[body - from.moving()];
      objects.push_back(std::make_unique<fcl::CollisionObjectd>(models[from.mesh_of[body]], X));
    }
  }
  void place(int frame) {
    const auto& poses = scene->frames[frame];
    for (std::size_t body = 0; body < poses.size(); ++body)
      objects[body]->setTransform(poses[body]);
  }
  bool admissible(int a, int b) const {
    if (scene->obstacle[a] && scene->obstacle[b]) return false;
    return !std::binary_search(scene->excluded.begin(), scene->excluded.end(), std::minmax({a, b}));
  }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& model : models) {
      sum += model->getNumBVs() * (sizeof(fcl::BVNode<BV>) + sizeof(unsigned int)) +
             model->num_vertices * sizeof(fcl::Vector3d) + model->num_tris * sizeof(fcl::Triangle);
    }
    return sum;
  }
};

/// Every admissible pair in a loop, Distance::ask(a, b, request, result) each. If bounded, what is
/// known bounds the search: the best so far, or the margin.
template <typename BV, typename Distance>
class ScenePairs final : public SceneCompetitor {
 public:
  ScenePairs(const char* name, bool bounded) : name_(name), bounded_(bounded) {}

  const char* name() const override { return name_; }
  bool serves(SceneQuery query) const override {
    return !(bounded_ && query == SceneQuery::kClearances);
  }
  void load(const scenes::BodyScene& scene) override {
    bodies_.load(scene);
    pairs_.clear();
    for (int a = 0; a < scene.size(); ++a) {
      for (int b = a + 1; b < scene.size(); ++b) {
        if (bodies_.admissible(a, b)) pairs_.emplace_back(a, b);
      }
    }
  }

  std::vector<SceneAnswer> answer(SceneQuery query, int frame, double margin) override {
    bodies_.place(frame);
    std::vector<SceneAnswer> answers;
    SceneAnswer closest{-1, -1, std::numeric_limits<double>::max()};
    const fcl::DistanceRequestd request;
    for (const auto& [a, b] : pairs_) {
      fcl::DistanceResultd result;
      if (bounded_) result.min_distance = query == SceneQuery::kClosest ? closest.distance : margin;
      Distance::ask(bodies_.objects[a].get(), bodies_.objects[b].get(), request, result);
      const double distance = result.min_distance;
      if (query == SceneQuery::kClosest) {
        if (distance < closest.distance) closest = {a, b, distance};
      } else if (query == SceneQuery::kClearances || distance < margin) {
        answers.push_back({a, b, distance});
      }
    }
    if (query == SceneQuery::kClosest) answers.push_back(closest);
    return answers;
  }
  long long queried() const override { return static_cast<long long>(pairs_.size()); }
  std::size_t bytes() const override { return bodies_.bytes(); }

 private:
  const char* name_;
  bool bounded_;
  SceneObjects<BV> bodies_;
  std::vector<std::pair<int, int>> pairs_;
};

}  // namespace kios::bench
