// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
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

/// The counts of FCL's traversal over its nodes.
template <typename DistanceNode_, typename CollisionNode_>
struct CountedByNodes {
  using DistanceNode = DistanceNode_;
  using CollisionNode = CollisionNode_;

  template <typename Model>
  static void countDistance(const Model& a, const Model& b, const scenes::Frame& poses,
                            fcl::DistanceResultd& result, TestCounts& counts) {
    if constexpr (!std::is_same_v<DistanceNode, NoNode>) {
      DistanceNode node;
      start(node, a, b, poses, fcl::DistanceRequestd(), result);
      fcl::detail::distance(&node);
      add(node, counts);
    }
  }
  template <typename Model>
  static void countCollide(const Model& a, const Model& b, const scenes::Frame& poses,
                           fcl::CollisionResultd& result, TestCounts& counts) {
    if constexpr (!std::is_same_v<CollisionNode, NoNode>) {
      CollisionNode node;
      start(node, a, b, poses, fcl::CollisionRequestd(), result);
      fcl::detail::collide(&node);
      add(node, counts);
    }
  }
  template <typename Model>
  static std::size_t preparedBytes(const Model& /*model*/) {
    return 0;
  }

 private:
  template <typename Node, typename Model, typename Request, typename Result>
  static void start(Node& node, const Model& a, const Model& b, const scenes::Frame& poses,
                    const Request& request, Result& result) {
    if (!initialize(node, a, poses.X_WA, b, poses.X_WB, request, result)) {
      throw std::runtime_error("the traversal refused the models");
    }
    node.enable_statistics = true;
  }
  template <typename Node>
  static void add(const Node& node, TestCounts& counts) {
    counts.bv_tests += node.num_bv_tests;
    counts.leaf_tests += node.num_leaf_tests;
  }
};

/// A Competitor over Traits:
///   BV             the bounding volume
///   DistanceNode   FCL traversal node of the distance query, or NoNode
///   CollisionNode  FCL traversal node of the collision query, or NoNode
///   kName          name in rows
///   distance(a, b, request, result), collide(...)  the call a user makes on two objects
///   countDistance(a, b, poses, result, counts), countCollide(...)  the same for two models,
///   counted
///   fitter()              what fits the nodes, or nullptr
///   preparedBytes(model)  what queries made of a model
///   simdTarget()
template <typename Traits>
class MeshSet final : public Competitor {
 public:
  using BV = typename Traits::BV;
  using Model = fcl::BVHModel<BV>;

  const char* name() const override { return Traits::kName; }

  bool serves(Query query) const override {
    switch (query) {
      case Query::kDistance:
      case Query::kThreshold:
      case Query::kPrepare:
      case Query::kRefit:
        return kHasDistance;
      case Query::kCollide:
        return kHasCollision;
      case Query::kBuild:
        return true;
    }
    return false;
  }

  void build(const std::vector<scenes::Mesh>& meshes) override {
    for (const scenes::Mesh& mesh : meshes) scenes::buildModel<BV>(mesh, Traits::fitter());
  }

  void prepare(const std::vector<scenes::Mesh>& meshes, const Question& question) override {
    MeshSet fresh;
    fresh.load(meshes);
    std::vector<double> answer(1);
    fresh.answer(Query::kDistance, {question}, 0, 1, answer);
  }

  void load(const std::vector<scenes::Mesh>& meshes) override {
    bodies_.clear();
    for (const scenes::Mesh& mesh : meshes) {
      const std::shared_ptr<Model> model = scenes::buildModel<BV>(mesh, Traits::fitter());
      bodies_.push_back({model, std::make_unique<fcl::CollisionObjectd>(model),
                         std::make_unique<fcl::CollisionObjectd>(model)});
    }
  }

  void refit(const std::vector<scenes::Mesh>& meshes, Refit how,
             const Question& question) override {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      Model& model = *bodies_[i].model;
      if (model.beginReplaceModel() != fcl::BVH_OK ||
          model.replaceSubModel(meshes[i].vertices) != fcl::BVH_OK ||
          model.endReplaceModel(how != Refit::kRebuild, how == Refit::kBottomUp) != fcl::BVH_OK) {
        throw std::runtime_error("FCL refused to refit a mesh.");
      }
    }
    std::vector<double> answer_to(1);
    answer(Query::kDistance, {question}, 0, 1, answer_to);
  }

  void answer(Query query, const std::vector<Question>& questions, std::size_t begin,
              std::size_t end, std::vector<double>& answers) override {
    for (std::size_t i = begin; i < end; ++i) {
      const Question& question = questions[i];
      fcl::CollisionObjectd& a = *bodies_[question.a].as_first;
      fcl::CollisionObjectd& b = *bodies_[question.b].as_second;
      a.setTransform(question.poses.X_WA);
      b.setTransform(question.poses.X_WB);
      switch (query) {
        case Query::kCollide:
          answers[i] = collide(a, b);
          break;
        case Query::kThreshold:
          answers[i] = distanceBelow(a, b, question.threshold);
          break;
        default:
          answers[i] = distance(a, b);
      }
    }
  }

  TestCounts count(Query query, const std::vector<Question>& questions) const override {
    TestCounts counts;
    for (const Question& question : questions) {
      const Model &a = *bodies_[question.a].model, &b = *bodies_[question.b].model;
      if (query == Query::kCollide) {
        fcl::CollisionResultd result;
        Traits::countCollide(a, b, question.poses, result, counts);
      } else {
        fcl::DistanceResultd result;
        if (query == Query::kThreshold) result.min_distance = question.threshold;
        Traits::countDistance(a, b, question.poses, result, counts);
      }
    }
    return counts;
  }

  std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const Body& body : bodies_) sum += modelBytes(*body.model);
    return sum;
  }

  std::optional<std::string> simdTarget() const override { return Traits::simdTarget(); }

 private:
  static constexpr bool kHasDistance = !std::is_same_v<typename Traits::DistanceNode, NoNode>;
  static constexpr bool kHasCollision = !std::is_same_v<typename Traits::CollisionNode, NoNode>;

  // A mesh and its objects as either argument: two bodies of one shape share its model.
  struct Body {
    std::shared_ptr<Model> model;
    std::unique_ptr<fcl::CollisionObjectd> as_first;
    std::unique_ptr<fcl::CollisionObjectd> as_second;
  };

  static double distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    Traits::distance(&a, &b, request, result);
    return result.min_distance;
  }

  static double distanceBelow(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b,
                              double threshold) {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    result.min_distance = threshold;
    Traits::distance(&a, &b, request, result);
    return std::min(result.min_distance, threshold);
  }

  // First contact: the default request asks for one, without its geometry.
  static double collide(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    Traits::collide(&a, &b, request, result);
    return result.isCollision() ? 1 : 0;
  }

  static std::size_t modelBytes(const Model& model) {
    const std::size_t nodes = model.getNumBVs();
    return nodes * (sizeof(fcl::BVNode<BV>) + sizeof(unsigned int)) +
           model.num_vertices * sizeof(fcl::Vector3d) + model.num_tris * sizeof(fcl::Triangle) +
           Traits::preparedBytes(model);
  }

  std::vector<Body> bodies_;
};

}  // namespace kios::bench
