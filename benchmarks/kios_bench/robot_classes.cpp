// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "robot_classes.h"

#include <algorithm>

#include "fcl_kios/model/prepare.h"
#include "fcl_kios/query/mesh_queries.h"
#include "fcl_kios/volume/kios.h"
#include "scenes/mesh.h"

namespace kios::bench {

const char* name(PairClass pair_class) {
  constexpr const char* kNames[] = {"root_reject", "apart", "near", "hit"};
  return kNames[static_cast<int>(pair_class)];
}

std::vector<std::vector<Question>> byClass(const std::vector<scenes::Mesh>& meshes,
                                           const std::vector<Question>& questions) {
  constexpr double kNear = 0.02;
  std::vector<std::shared_ptr<fcl::BVHModel<kIOSd>>> models;
  for (const scenes::Mesh& mesh : meshes) {
    models.push_back(scenes::buildModel<kIOSd>(mesh));
    prepare(*models.back());
  }
  const auto classOf = [&](const Question& question) {
    const auto &a = *models[question.a], &b = *models[question.b];
    const auto& [X_WA, X_WB] = question.poses;
    SearchCounts counts;
    fcl::CollisionResultd contacts;
    collideMeshes(a, X_WA, b, X_WB, fcl::CollisionRequestd(), contacts, &counts);
    if (contacts.isCollision()) return PairClass::kHit;
    if (counts.expansions == 0 && counts.leaf_pairs == 0) return PairClass::kRootReject;
    fcl::DistanceResultd nearest;
    distanceMeshes(a, X_WA, b, X_WB, fcl::DistanceRequestd(), nearest);
    const double extent =
        std::max(scenes::extent(meshes[question.a]), scenes::extent(meshes[question.b]));
    return nearest.min_distance < kNear * extent ? PairClass::kNear : PairClass::kApart;
  };
  std::vector<std::vector<Question>> classes(4);
  for (const Question& question : questions) {
    classes[static_cast<std::size_t>(classOf(question))].push_back(question);
  }
  return classes;
}

}  // namespace kios::bench
