// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.h"

#include <algorithm>
#include <utility>

#include "scene/content.h"
#include "volume/errors.h"

namespace kios::scene {

int Scene::add(Body body, Role role) {
  int id = static_cast<int>(bodies_.size());
  if (!free_.empty()) {
    id = *free_.begin();
    free_.erase(free_.begin());
  } else {
    bodies_.emplace_back();
  }
  bodies_[id] = std::move(body);
  bodies_[id].role = role;
  tree_stale_ = true;
  return id;
}

void Scene::remove(int id) {
  body(id);
  free_.insert(id);
  bodies_[id] = Body();
  for (auto it = excluded_.begin(); it != excluded_.end();) {
    const int a = static_cast<int>(*it >> 32), b = static_cast<int>(*it & 0xffffffffU);
    it = a == id || b == id ? excluded_.erase(it) : std::next(it);
  }
  tree_stale_ = true;
}

Body& Scene::body(int id) {
  if (!contains(id)) refuse("the scene has no object ", id, ".");
  return bodies_[id];
}

void Scene::ignorePair(int a, int b, bool ignored) {
  body(a);
  body(b);
  if (a == b) {
    refuse("the object ", a, " makes no pair with itself, which could be ignored.");
  }
  if (ignored) {
    excluded_.insert(keyOfEither(a, b));
  } else {
    excluded_.erase(keyOfEither(a, b));
  }
}

bool Scene::admissible(int a, int b) const {
  if (bodies_[a].role == Role::kObstacle && bodies_[b].role == Role::kObstacle) return false;
  if (!excluded_.empty() && excluded_.count(keyOfEither(a, b)) != 0) return false;
  return !filter || filter(a, b);
}

void Scene::beginQuery() {
  counts = SceneCounts();
  counts.total = static_cast<long long>(size()) * (static_cast<long long>(size()) - 1) / 2;
  double error = 0;
  num_obstacles_ = 0;
  for (Body& body : bodies_) {
    if (!body.used()) continue;
    body.content->refresh(body);
    error = std::max(error, body.rotation_error);
    num_obstacles_ += body.role == Role::kObstacle ? 1 : 0;
  }
  box_share_ = 1 - boxShare(error);
  near_.follow(bodies_, tree_stale_);
  memory.beginQuery();
}

void Scene::updateTree() {
  if (!tree_stale_) {
    tree_stale_ = !tree_.refit([this](int id) -> const Box& { return bodies_[id].box; });
  }
  if (tree_stale_) {
    std::vector<BoxTree::Leaf> leaves;
    leaves.reserve(size());
    for (int id = 0; id < static_cast<int>(bodies_.size()); ++id) {
      const Body& body = bodies_[id];
      if (body.used()) leaves.push_back({id, body.box, body.role == Role::kObstacle});
    }
    tree_.build(std::move(leaves));
  }
  tree_stale_ = false;
}

}  // namespace kios::scene
