// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Models that were asked, then replaced or updated (rebuilt, refitted top-down or bottom-up), and
// their copies: every answer is that of the vertices as they now are.

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/overloads.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

template <typename S>
class RefitQuestion {
 public:
  explicit RefitQuestion(const Case& c) : random_(c.draw), case_(c), pair_(c) {}

  Verdict run() {
    Mesh mesh = case_.meshes[0];
    std::string history = "asked";
    if (auto wrong = check(*pair_.A, mesh, history)) return wrong;
    for (int i = 0; i < 3; ++i) {
      if (chance(random_, 0.3)) {  // the copy changes, or the original does
        const auto copy = std::make_shared<Model<S>>(*pair_.A);
        const Mesh before = mesh;
        deform(mesh);
        const bool original = chance(random_, 0.5);
        change(original ? *pair_.A : *copy, mesh, history);
        history += original ? " (copied first)" : " (a copy of it)";
        if (auto wrong = check(*copy, original ? before : mesh, history)) return wrong;
        if (auto wrong = check(*pair_.A, original ? mesh : before, history)) return wrong;
        if (!original) mesh = before;
      } else {
        deform(mesh);
        change(*pair_.A, mesh, history);
        if (auto wrong = check(*pair_.A, mesh, history)) return wrong;
      }
    }
    return std::nullopt;
  }

 private:
  void deform(Mesh& mesh) {
    double most = 0;
    for (const Vector3d& p : mesh.vertices) most = std::max(most, p.cwiseAbs().maxCoeff());
    switch (below(random_, 4)) {
      case 0: {
        const double noise = most * power(random_, -16, 0);
        for (Vector3d& p : mesh.vertices) p += noise * scenes::point(random_);
        break;
      }
      case 1: {  // one vertex goes far
        const int i = below(random_, static_cast<int>(mesh.vertices.size()));
        mesh.vertices[static_cast<std::size_t>(i)] *= random_.uniform(-4, 4);
        break;
      }
      case 2: {
        const Eigen::Matrix3d R = scenes::rotation(random_);
        for (Vector3d& p : mesh.vertices) p = R * p;
        break;
      }
      default: {
        const double scale = power(random_, -3, 1);
        for (Vector3d& p : mesh.vertices) p *= scale;
      }
    }
  }

  void change(Model<S>& model, const Mesh& mesh, std::string& history) {
    std::vector<fcl::Vector3<S>> vertices;
    for (const Vector3d& p : mesh.vertices) vertices.push_back(p.cast<S>());
    const bool refit = chance(random_, 0.7), bottomup = chance(random_, 0.5);
    // FCL refuses to replace what was updated.
    const bool replace = model.build_state != fcl::BVH_BUILD_STATE_UPDATED && chance(random_, 0.5);
    history += replace ? ", replaced" : ", updated";
    history += refit ? (bottomup ? " bottom-up" : " top-down") : " and rebuilt";
    if (replace) {
      model.beginReplaceModel();
      model.replaceSubModel(vertices);
      model.endReplaceModel(refit, bottomup);
    } else {
      model.beginUpdateModel();
      model.updateSubModel(vertices);
      model.endUpdateModel(refit, bottomup);
    }
  }

  Verdict check(const Model<S>& model, const Mesh& mesh, const std::string& history) {
    const BruteForce<S> truth(mesh, pair_.X, case_.meshes[1], pair_.Y);
    fcl::DistanceResult<S> result;
    const S d =
        fcl::distance(&model, pair_.X, pair_.B.get(), pair_.Y, fcl::DistanceRequest<S>(), result);
    const std::pair<int, int> ids = {static_cast<int>(result.b1), static_cast<int>(result.b2)};
    const std::string call = "fcl::distance of A, " + history + ", and B";
    if (!result.o1 || !truth.contains(ids) || d != truth.distanceOf(ids) ||
        (d == 0) == truth.hits.empty() ||
        !(double{d} - double{truth.distance} <= truth.tolerance(ids))) {
      return failure(Words() << d << " of " << text(ids) << "; brute force " << truth.distance
                             << " of " << text(truth.nearest),
                     call);
    }
    fcl::CollisionResult<S> contacts;
    const std::size_t n = fcl::collide(&model, pair_.X, pair_.B.get(), pair_.Y,
                                       fcl::CollisionRequest<S>(1 << 30, false), contacts);
    if (n != truth.hits.size()) {
      return failure(
          Words() << n << " contacts of A, " << history << "; brute force " << truth.hits.size(),
          call);
    }
    return std::nullopt;
  }

  Random random_;
  const Case& case_;
  const ModelPair<S> pair_;
};

}  // namespace

Verdict askRefit(const Case& c) {
  return c.in_float ? RefitQuestion<float>(c).run() : RefitQuestion<double>(c).run();
}

}  // namespace kios::fuzz
