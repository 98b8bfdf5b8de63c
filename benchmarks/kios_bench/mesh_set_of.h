// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <fcl_kios/fcl_kios.h>
#include "fcl_models.h"
#include "mesh_set.h"

namespace kios::bench {

/// A set over a volume, by the calls that answer for it and the volume's traversal nodes; void
/// where FCL has none. Our volume under our own calls counts volumes and pairs
/// of leaves (of up to eight triangles each) in its prepared trees.
template <typename BV, typename Calls, typename DistanceNode, typename CollisionNode>
class MeshSetOf final : public MeshSet {
 public:
  using Model = fcl::BVHModel<BV>;
  using Object = fcl::CollisionObjectd;
  using MakeFitter = std::shared_ptr<fcl::detail::BVFitterBase<BV>> (*)();

  /// Every model has a fitter of its own, FCL's default for nullptr.
  explicit MeshSetOf(MakeFitter make_fitter) : make_fitter_(make_fitter) {}

  bool serves(Query query) const override {
    if (query == Query::kBuild) return true;
    return query == Query::kCollide || query == Query::kContacts ? kCollision : kDistance;
  }

  void build(const std::vector<scenes::Mesh>& meshes) const override {
    for (const scenes::Mesh& mesh : meshes) built(mesh);
  }

  void load(const std::vector<scenes::Mesh>& meshes) override {
    bodies_.clear();
    for (const scenes::Mesh& mesh : meshes) {
      const std::shared_ptr<Model> model = built(mesh);
      if constexpr (kPrepared) prepare(*model);
      add(model);
      bodies_.back().model = model;
    }
  }

  void add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry) override {
    bodies_.push_back(
        {nullptr, std::make_unique<Object>(geometry), std::make_unique<Object>(geometry)});
  }

  void replace(const std::vector<scenes::Mesh>& meshes, Refit how) override {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      Model& model = *bodies_[i].model;
      if (model.beginReplaceModel() != fcl::BVH_OK ||
          model.replaceSubModel(meshes[i].vertices) != fcl::BVH_OK ||
          model.endReplaceModel(how != Refit::kRebuild, how == Refit::kBottomUp) != fcl::BVH_OK) {
        throw std::runtime_error("FCL refused to refit a mesh.");
      }
    }
  }

  void answer(Query query, const std::vector<Question>& questions, std::size_t begin,
              std::size_t end, std::vector<double>& answers) override {
    for (std::size_t i = begin; i < end; ++i) {
      const Question& question = questions[i];
      Object& a = *bodies_[question.a].as_first;
      Object& b = *bodies_[question.b].as_second;
      a.setTransform(question.poses.X_WA);
      b.setTransform(question.poses.X_WB);
      switch (query) {
        case Query::kCollide:
          answers[i] = collide(a, b);
          break;
        case Query::kContacts:
          answers[i] = contacts(a, b, question.max_contacts);
          break;
        case Query::kCloserThan:
          answers[i] = closer(a, b, question) ? 1 : 0;
          break;
        default:
          answers[i] = distanceBelow(a, b, std::numeric_limits<double>::max());
      }
    }
  }

  Tests count(Query query, const std::vector<Question>& questions,
              std::size_t frames) const override {
    long long bvs = 0, leaves = 0, exact = 0;
    for (const Question& question : questions) {
      if (query == Query::kCollide || query == Query::kContacts) {
        fcl::CollisionRequestd request;
        if (query == Query::kContacts) request.num_max_contacts = question.max_contacts;
        fcl::CollisionResultd result;
        if constexpr (kCollision) {
          count<CollisionNode>(question, request, result, bvs, leaves, exact);
        }
      } else {
        fcl::DistanceResultd result;
        if constexpr (kDistance) {
          count<DistanceNode>(question, fcl::DistanceRequestd(), result, bvs, leaves, exact);
        }
      }
    }
    const auto of_frame = [frames](long long sum) {
      return static_cast<double>(sum) / static_cast<double>(frames);
    };
    if (!kPrepared) return {of_frame(bvs), of_frame(leaves)};
    return {of_frame(bvs), of_frame(leaves), of_frame(exact)};
  }

  std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const Body& body : bodies_) {
      if (!body.model) continue;
      const Model& model = *body.model;
      sum += bytesOf(model);
      if constexpr (kPrepared) sum += preparedBytes(model);
    }
    return sum;
  }

 private:
  static constexpr bool kPrepared = std::is_same_v<Calls, KiosCalls>;
  static constexpr bool kDistance = kPrepared || !std::is_void_v<DistanceNode>;
  static constexpr bool kCollision = kPrepared || !std::is_void_v<CollisionNode>;

  // A body and its objects as either argument: two bodies of one shape share its model.
  struct Body {
    std::shared_ptr<Model> model;  // nullptr if it is no mesh
    std::unique_ptr<Object> as_first, as_second;
  };

  /// result.min_distance is FCL's own on entry, the largest double, if nothing bounds it.
  static double distanceBelow(const Object& a, const Object& b, double threshold) {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    result.min_distance = threshold;
    if constexpr (kDistance) Calls::distance(&a, &b, request, result);
    return std::min(result.min_distance, threshold);
  }

  // First contact: the default request asks for one, without its geometry.
  static double collide(const Object& a, const Object& b) {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if constexpr (kCollision) Calls::collide(&a, &b, request, result);
    return result.isCollision() ? 1 : 0;
  }

  static double contacts(const Object& a, const Object& b, std::size_t most) {
    fcl::CollisionRequestd request;
    request.num_max_contacts = most;
    fcl::CollisionResultd result;
    if constexpr (kCollision) Calls::collide(&a, &b, request, result);
    return static_cast<double>(result.numContacts());
  }

  // FCL's way: a bound on entry, the least positive number in place of 0.
  bool closer(const Object& a, const Object& b, const Question& question) const {
    if constexpr (kPrepared) {
      return closerThan<double>(*bodies_[question.a].model, question.poses.X_WA,
                                *bodies_[question.b].model, question.poses.X_WB,
                                question.threshold);
    } else {
      if (question.threshold == 0 && kCollision) return collide(a, b) == 1;
      const double bound = std::max(question.threshold, std::numeric_limits<double>::min());
      return distanceBelow(a, b, bound) < bound;
    }
  }

  template <typename Node, typename Request, typename Result>
  void count(const Question& question, const Request& request, Result& result, long long& bvs,
             long long& leaves, long long& exact) const {
    const Model &a = *bodies_[question.a].model, &b = *bodies_[question.b].model;
    const auto& [X_WA, X_WB] = question.poses;
    constexpr bool kAsksDistance = std::is_same_v<Result, fcl::DistanceResultd>;
    if constexpr (kPrepared) {
      SearchCounts counts;
      if constexpr (kAsksDistance) {
        distanceMeshes(a, X_WA, b, X_WB, request, result, &counts);
      } else {
        collideMeshes(a, X_WA, b, X_WB, request, result, &counts);
      }
      bvs += counts.volume_tests;
      leaves += counts.leaf_pairs;
      exact += counts.exact;
    } else {
      Node node;
      start(node, a, X_WA, b, X_WB, request, result);
      node.enable_statistics = true;
      if constexpr (kAsksDistance) {
        fcl::detail::distance(&node);
      } else {
        fcl::detail::collide(&node);
      }
      bvs += node.num_bv_tests;
      leaves += node.num_leaf_tests;
    }
  }

  std::shared_ptr<Model> built(const scenes::Mesh& mesh) const {
    return scenes::buildModel<BV>(mesh, make_fitter_ ? make_fitter_() : nullptr);
  }

  MakeFitter make_fitter_;
  std::vector<Body> bodies_;
};

/// Our volume as a user has it.
using KiosSet = MeshSetOf<kIOSd, KiosCalls, void, void>;

/// FCL's recursion over our volume, by the model's own fitter or another.
inline std::unique_ptr<MeshSet> makeKiosTree(
    std::shared_ptr<fcl::detail::BVFitterBase<kIOSd>> (*make_fitter)()) {
  using Distance = MeshDistanceTraversalNode<double>;
  using Collision = MeshCollisionTraversalNode<double>;
  return std::make_unique<
      MeshSetOf<kIOSd, NodeCalls<kIOSd, Distance, Collision>, Distance, Collision>>(make_fitter);
}

}  // namespace kios::bench
