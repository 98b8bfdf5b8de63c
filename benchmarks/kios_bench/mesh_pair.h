// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>

#include "competitor.h"

namespace kios::bench {

/// A query that the volume does not serve.
struct NoNode {};

/// A Competitor over Traits:
///   BV             the bounding volume
///   DistanceNode   FCL traversal node of the distance query, or NoNode
///   CollisionNode  FCL traversal node of the collision query, or NoNode
///   kName          name in rows
///   distance(a, b, request, result), collide(...)  the call a user makes on two objects
///   simdTarget()
template <typename Traits>
class MeshPair final : public Competitor {
 public:
  using BV = typename Traits::BV;
  using Model = fcl::BVHModel<BV>;

  const char* name() const override { return Traits::kName; }

  bool serves(Query query) const override {
    switch (query) {
      case Query::kDistance:
        return kHasDistance;
      case Query::kCollide:
        return kHasCollision;
      case Query::kBuild:
        return true;
    }
    return false;
  }

  void build(const scenes::Mesh& a, const scenes::Mesh& b) override {
    scenes::buildModel<BV>(a);
    scenes::buildModel<BV>(b);
  }

  void load(const scenes::Mesh& a, const scenes::Mesh& b) override {
    model_a_ = scenes::buildModel<BV>(a);
    model_b_ = scenes::buildModel<BV>(b);
    object_a_ = std::make_unique<fcl::CollisionObjectd>(model_a_);
    object_b_ = std::make_unique<fcl::CollisionObjectd>(model_b_);
  }

  void answer(Query query, const std::vector<scenes::Frame>& frames, std::size_t begin,
              std::size_t end, std::vector<double>& answers) override {
    for (std::size_t i = begin; i < end; ++i) {
      object_a_->setTransform(frames[i].X_WA);
      object_b_->setTransform(frames[i].X_WB);
      answers[i] = query == Query::kDistance ? distance() : collide();
    }
  }

  TestCounts count(Query query, const std::vector<scenes::Frame>& frames) const override {
    TestCounts counts;
    for (const scenes::Frame& frame : frames) {
      if (query == Query::kDistance) {
        if constexpr (kHasDistance) {
          fcl::DistanceResultd result;
          typename Traits::DistanceNode node;
          start(node, frame, fcl::DistanceRequestd(), result);
          fcl::detail::distance(&node);
          add(node, counts);
        }
      } else if (query == Query::kCollide) {
        if constexpr (kHasCollision) {
          fcl::CollisionResultd result;
          typename Traits::CollisionNode node;
          start(node, frame, fcl::CollisionRequestd(), result);
          fcl::detail::collide(&node);
          add(node, counts);
        }
      }
    }
    return counts;
  }

  std::size_t bytes() const override { return modelBytes(*model_a_) + modelBytes(*model_b_); }

  std::optional<std::string> simdTarget() const override { return Traits::simdTarget(); }

 private:
  static constexpr bool kHasDistance = !std::is_same_v<typename Traits::DistanceNode, NoNode>;
  static constexpr bool kHasCollision = !std::is_same_v<typename Traits::CollisionNode, NoNode>;

  double distance() const {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    Traits::distance(object_a_.get(), object_b_.get(), request, result);
    return result.min_distance;
  }

  // First contact: the default request asks for one, without its geometry.
  double collide() const {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    Traits::collide(object_a_.get(), object_b_.get(), request, result);
    return result.isCollision() ? 1 : 0;
  }

  template <typename Node, typename Request, typename Result>
  void start(Node& node, const scenes::Frame& frame, const Request& request, Result& result) const {
    const Model& a = *model_a_;
    const Model& b = *model_b_;
    if (!initialize(node, a, frame.X_WA, b, frame.X_WB, request, result)) {
      throw std::runtime_error(std::string(Traits::kName) + ": the traversal refused the models");
    }
    node.enable_statistics = true;
  }

  template <typename Node>
  static void add(const Node& node, TestCounts& counts) {
    counts.bv_tests += node.num_bv_tests;
    counts.leaf_tests += node.num_leaf_tests;
  }

  static std::size_t modelBytes(const Model& model) {
    const std::size_t nodes = model.getNumBVs();
    return nodes * (sizeof(fcl::BVNode<BV>) + sizeof(unsigned int)) +
           model.num_vertices * sizeof(fcl::Vector3d) + model.num_tris * sizeof(fcl::Triangle);
  }

  std::shared_ptr<Model> model_a_;
  std::shared_ptr<Model> model_b_;
  std::unique_ptr<fcl::CollisionObjectd> object_a_;
  std::unique_ptr<fcl::CollisionObjectd> object_b_;
};

}  // namespace kios::bench
