// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// SceneDistance over frames, its calls in any order, against fcl::distance of every pair, bit by
// bit, which the question "distance" judges.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/overloads.h"
#include "fcl_kios/scene.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

template <typename S>
class SceneQuestion {
 public:
  explicit SceneQuestion(const Case& c) : random_(c.draw), case_(c) {
    for (const Mesh& mesh : c.meshes) models_.push_back(modelOf<S>(mesh, c.foreign));
    setUp_ = "kios::SceneDistance<S> scene; kios::SceneRequest no; no.exact = false; ";
    for (std::size_t m = 0; m < models_.size(); ++m) {
      const bool obstacle = chance(random_, 0.1);
      obstacles_.push_back(obstacle);
      scene_.add(models_[m], pose(m, 0), obstacle ? Role::kObstacle : Role::kBody);
      setUp_ += std::string("scene.add(") + static_cast<char>('A' + m) + ", X[" +
                std::to_string(m) + (obstacle ? "], kios::Role::kObstacle); " : "]); ");
    }
  }

  Verdict run() {
    for (std::size_t f = 0; f < case_.frames.size(); ++f) {
      for (std::size_t m = 0; f > 0 && m < models_.size(); ++m) {
        if (case_.frames[f][m].matrix() == case_.frames[f - 1][m].matrix()) continue;
        scene_.move(static_cast<int>(m), pose(m, f));
        setUp_ += "scene.move(" + std::to_string(m) + ", X" + std::to_string(f) + "[" +
                  std::to_string(m) + "]); ";
      }
      computeTruth(f);
      for (int i = scenes::integer(random_, 1, 4); i > 0; --i) {
        if (auto wrong = call()) return wrong;
      }
    }
    return std::nullopt;
  }

 private:
  using Ids = std::pair<int, int>;

  fcl::Transform3<S> pose(std::size_t m, std::size_t f) const {
    return case_.pose(m, f).template cast<S>();
  }

  /// All pairs of triangles of two objects in this frame.
  const BruteForce<S>& judgeOf(const Ids& ids) {
    auto& judge = judges_[ids];
    if (!judge) {
      const auto a = static_cast<std::size_t>(ids.first), b = static_cast<std::size_t>(ids.second);
      judge = std::make_unique<BruteForce<S>>(case_.meshes[a], pose(a, frame_), case_.meshes[b],
                                              pose(b, frame_));
    }
    return *judge;
  }

  void computeTruth(std::size_t f) {
    frame_ = f;
    truth_.clear();
    judges_.clear();
    for (std::size_t a = 0; a < models_.size(); ++a) {
      for (std::size_t b = a + 1; b < models_.size(); ++b) {
        if (obstacles_[a] && obstacles_[b]) continue;
        fcl::DistanceResult<S> result;
        fcl::distance(models_[a].get(), pose(a, f), models_[b].get(), pose(b, f),
                      fcl::DistanceRequest<S>(), result);
        truth_[{static_cast<int>(a), static_cast<int>(b)}] = result;
      }
    }
  }

  /// Returns a length at which something happens.
  S threshold() {
    if (truth_.empty()) return 1;
    auto it = truth_.begin();
    std::advance(it, below(random_, static_cast<int>(truth_.size())));
    const S d = it->second.min_distance;
    if (chance(random_, 0.4)) return ulps(d, scenes::integer(random_, -30, 30));
    if (chance(random_, 0.4)) {  // distances of other triangles, as a search passes them
      const BruteForce<S>& all = judgeOf(it->first);
      const int i = below(random_, static_cast<int>(all.distances().size()));
      const S other = all.distances()[static_cast<std::size_t>(i)];
      // The scene asks for what is nearer than the margin less rounding: 64 eps of the bodies.
      const double rounding = chance(random_, 0.5) ? roundingOf(it->first, other) : 0;
      return ulps(static_cast<S>(double{other} + rounding), scenes::integer(random_, -24, 24));
    }
    return static_cast<S>(double{d} * random_.uniform(0.1, 3));
  }
  double roundingOf(const Ids& ids, S d) const {
    const auto radius = [&](int i) {
      return double{models_[static_cast<std::size_t>(i)]->getBV(0).bv.radius0};
    };
    return 64 * BruteForce<S>::kEps * (double{d} + 2 * radius(ids.first) + 2 * radius(ids.second));
  }

  Verdict call() {
    SceneRequest request;
    request.nearest_points = chance(random_, 0.2);
    switch (below(random_, 4)) {
      case 0: {
        setUp_ += "scene.closestPair(); ";
        const auto pair = scene_.closestPair(request);
        const fcl::DistanceResult<S>* least = nullptr;
        Ids ids;
        for (const auto& [key, result] : truth_) {
          if (least && !(result.min_distance < least->min_distance)) continue;
          least = &result;
          ids = key;
        }
        if (pair.has_value() != (least != nullptr)) return failure(Words() << "no pair", setUp_);
        if (!least) return std::nullopt;
        const Ids found(pair->a, pair->b);
        if ((pair->distance != least->min_distance || found != ids) &&
            !(isTie(found, pair->distance) && isTie(ids, pair->distance))) {
          return failure(Words() << "closestPair() gives " << pair->distance << " of "
                                 << text(found) << ", fcl::distance " << least->min_distance
                                 << " of " << text(ids),
                         setUp_);
        }
        return judge(*pair, true, 0);
      }
      case 1: {
        setUp_ += "scene.clearances(); ";
        const auto pairs = scene_.clearances(request);
        return judgeAll(pairs, std::numeric_limits<S>::infinity(), true);
      }
      default: {
        const S margin = threshold();
        request.exact = chance(random_, 0.5);
        setUp_ += "scene.pairsWithin(" + literal(margin) + (request.exact ? "); " : ", no); ");
        return judgeAll(scene_.pairsWithin(margin, request), margin, request.exact);
      }
    }
  }

  /// Whether hundreds of pairs of triangles are as near, as far as rounding can tell: the search
  /// that began elsewhere then names another, within 16 eps of their extent (docs/guarantees.md).
  bool isTie(const Ids& ids, S found) {
    constexpr std::ptrdiff_t kMany = 100;
    const S d = truth_.at(ids).min_distance;
    const BruteForce<S>& truth = judgeOf(ids);
    const double error = 16 * BruteForce<S>::kEps * truth.extentOf(truth.nearest);
    const auto& all = truth.distances();
    return std::abs(double{found} - double{d}) <= error &&
           std::count_if(all.begin(), all.end(),
                         [&](S x) { return double{x} <= double{d} + error; }) >= kMany;
  }

  Verdict judgeAll(const std::vector<ScenePair<S>>& pairs, S margin, bool exact) {
    std::size_t i = 0;
    for (const auto& [ids, result] : truth_) {
      const bool listed = i < pairs.size() && Ids(pairs[i].a, pairs[i].b) == ids;
      if (listed != (result.min_distance <= margin) && isTie(ids, margin)) {
        i += listed ? 1 : 0;
        continue;
      }
      if (!(result.min_distance <= margin)) continue;
      if (!listed) {
        return failure(Words() << "pair " << text(ids) << " at " << result.min_distance
                               << " is missing within " << margin,
                       setUp_);
      }
      if (auto wrong = judge(pairs[i], exact, margin)) return wrong;
      ++i;
    }
    if (i == pairs.size()) return std::nullopt;
    return failure(Words() << "pair " << text({pairs[i].a, pairs[i].b}) << " at "
                           << pairs[i].distance << " is not within " << margin,
                   setUp_);
  }

  /// The distance is fcl::distance's, or any below the margin; the triangles realise it.
  Verdict judge(const ScenePair<S>& pair, bool exact, S margin) {
    const S d = truth_.at({pair.a, pair.b}).min_distance;
    if (exact ? pair.distance != d && !isTie({pair.a, pair.b}, pair.distance)
              : !(pair.distance >= 0 && pair.distance <= margin)) {
      return failure(Words() << "pair " << text({pair.a, pair.b}) << " at " << pair.distance
                             << ", fcl::distance " << d,
                     setUp_);
    }
    const BruteForce<S>& truth = judgeOf({pair.a, pair.b});
    const Ids ids = {static_cast<int>(pair.triangle_a), static_cast<int>(pair.triangle_b)};
    if (truth.contains(ids) && truth.distanceOf(ids) == pair.distance) return std::nullopt;
    return failure(Words() << "pair " << text({pair.a, pair.b}) << " at " << pair.distance
                           << " of triangles " << text(ids) << ", which the kernel doesn't give",
                   setUp_);
  }

  Random random_;
  const Case& case_;
  std::vector<std::shared_ptr<Model<S>>> models_;
  std::vector<bool> obstacles_;
  SceneDistance<S> scene_;
  std::map<Ids, fcl::DistanceResult<S>> truth_;
  std::map<Ids, std::unique_ptr<BruteForce<S>>> judges_;
  std::size_t frame_ = 0;
  std::string setUp_;  ///< all calls so far
};

}  // namespace

Verdict askScene(const Case& c) {
  return c.in_float ? SceneQuestion<float>(c).run() : SceneQuestion<double>(c).run();
}

}  // namespace kios::fuzz
