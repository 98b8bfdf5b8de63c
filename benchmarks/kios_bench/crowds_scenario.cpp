// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Many different small bodies in FCL's manager, the first time that anyone asks about them and
// again; and the smallest bodies there are.
#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl_kios/fcl_kios.h>

#include "contest.h"
#include "fcl_models.h"
#include "scenario.h"
#include "scenes/robots.h"
#include "scenes/shapes.h"
#include "scenes/unlike.h"

namespace kios::bench {
namespace {

using Object = fcl::CollisionObjectd;

/// Queries of a manager whose models are fresh, in turn.
constexpr const char* kQueries[] = {"/cold", "/again", "/third"};

struct BodyPair {
  int a, b;
  bool hit;
};

/// Bodies in FCL's manager.
class Crowd {
 public:
  virtual ~Crowd() = default;
  virtual std::string name() const = 0;
  /// Makes models that share nothing with those before, and a manager for them.
  virtual void make(const std::vector<scenes::Mesh>& meshes,
                    const std::vector<fcl::Transform3d>& poses) = 0;
  /// Every pair that the manager brings, first contact.
  virtual void collide(std::vector<BodyPair>& pairs) = 0;
  /// Returns the least distance.
  virtual double distance() = 0;
};

template <typename BV, typename Calls>
class CrowdOf final : public Crowd {
 public:
  explicit CrowdOf(std::string name) : name_(std::move(name)) {}
  std::string name() const override { return name_; }

  void make(const std::vector<scenes::Mesh>& meshes,
            const std::vector<fcl::Transform3d>& poses) override {
    manager_ = std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
    objects_.clear();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      objects_.emplace_back(scenes::buildModel<BV>(meshes[i]), poses[i]);
    }
    for (Object& object : objects_) manager_->registerObject(&object);
    manager_->setup();
  }

  void collide(std::vector<BodyPair>& pairs) override {
    struct Pass {
      const Object* first;
      std::vector<BodyPair>& pairs;
    } pass{objects_.data(), pairs};
    pairs.clear();
    manager_->collide(&pass, [](Object* a, Object* b, void* data) {
      Pass& to = *static_cast<Pass*>(data);
      const fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      Calls::collide(a, b, request, result);
      to.pairs.push_back(
          {static_cast<int>(a - to.first), static_cast<int>(b - to.first), result.isCollision()});
      return false;
    });
  }

  double distance() override {
    fcl::DistanceResultd result;
    manager_->distance(&result, [](Object* a, Object* b, void* data, double& distance) {
      fcl::DistanceResultd& least = *static_cast<fcl::DistanceResultd*>(data);
      const fcl::DistanceRequestd request;
      distance = least.min_distance;
      if (distance <= 0) return true;
      Calls::distance(a, b, request, least);
      distance = least.min_distance;
      return distance <= 0;
    });
    return result.min_distance;
  }

 private:
  std::string name_;
  std::vector<Object> objects_;
  std::unique_ptr<fcl::DynamicAABBTreeCollisionManagerd> manager_;
};

double trueDistance(const scenes::BodyScene& scene) {
  const auto& poses = scene.frames[0];
  std::vector<std::pair<double, std::pair<int, int>>> bounds;
  std::vector<double> radii;
  for (const scenes::Mesh& mesh : scene.meshes) {
    double radius = 0;
    for (const fcl::Vector3d& p : mesh.vertices) radius = std::max(radius, p.norm());
    radii.push_back(radius);
  }
  for (int a = 0; a < scene.size(); ++a) {
    for (int b = a + 1; b < scene.size(); ++b) {
      const double apart = (poses[a].translation() - poses[b].translation()).norm();
      bounds.push_back({apart - radii[a] - radii[b], {a, b}});
    }
  }
  std::sort(bounds.begin(), bounds.end());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [bound, pair] : bounds) {
    if (bound > least) break;
    const auto& [a, b] = pair;
    const scenes::MeshOracle oracle(scene.meshes[a], scene.meshes[b]);
    least = std::min(least, oracle.distance(poses[a], poses[b]));
  }
  return least;
}

/// Wrong verdicts among some of the pairs.
std::size_t wrongOf(const std::vector<BodyPair>& pairs, const scenes::BodyScene& scene,
                    int judged) {
  const std::size_t count =
      judged == 0 ? pairs.size() : std::min(pairs.size(), static_cast<std::size_t>(judged));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [a, b, hit] = pairs[i * pairs.size() / count];
    const scenes::MeshOracle oracle(scene.meshes[a], scene.meshes[b]);
    if (oracle.collide(scene.frames[0][a], scene.frames[0][b]) != hit) ++wrong;
  }
  return wrong;
}

std::vector<std::unique_ptr<Crowd>> crowdsOf(const Options& options) {
  std::vector<std::unique_ptr<Crowd>> crowds;
  for (const std::string& bv : options.bvs) {
    if (bv == "kios") crowds.push_back(std::make_unique<CrowdOf<kIOSd, KiosCalls>>(bv));
    if (bv == "fcl_obbrss") {
      crowds.push_back(std::make_unique<CrowdOf<fcl::OBBRSSd, FclCalls>>(bv));
    }
  }
  return crowds;
}

/// Returns the times of one query of each repeat.
Competitor part(const Competitor& of, std::size_t query) {
  Competitor one{of.name, {}};
  for (const std::vector<double>& us : of.us) one.us.push_back({us[query]});
  return one;
}

/// Rows of the first query of a fresh crowd, `/cold`, of the next, `/again`, and of the one after
/// that, `/third`: models may prepare at any of them. Whoever comes first in a repeat finds the
/// caches no better: making the models comes between.
void reportCrowd(const std::string& scenario, const scenes::BodyScene& scene, Query query,
                 const Options& options, Report& report) {
  const std::vector<std::unique_ptr<Crowd>> crowds = crowdsOf(options);
  std::vector<std::vector<BodyPair>> pairs(crowds.size());
  std::vector<double> distances(crowds.size());
  std::vector<Competitor> competitors;
  for (std::size_t i = 0; i < crowds.size(); ++i) {
    const auto answer = [&, i, query](std::size_t, std::size_t) {
      if (query == Query::kCollide) {
        crowds[i]->collide(pairs[i]);
      } else {
        distances[i] = crowds[i]->distance();
      }
    };
    const auto before = [&, i](std::size_t, std::size_t) {
      std::vector<scenes::Mesh> meshes = scene.meshes;
      std::transform(meshes.begin(), meshes.end(), meshes.begin(), scenes::unlike);
      crowds[i]->make(meshes, scene.frames[0]);
    };
    competitors.push_back({crowds[i]->name(), answer, before});
  }
  Race{std::size(kQueries), options.repeats, Race::kAll, 1}.run(competitors);

  Row base;
  base.query = name(query);
  base.seed = options.seed;
  for (const scenes::Mesh& mesh : scene.meshes) {
    base.triangles += mesh.triangles.size();
    base.extent = std::max(base.extent, scenes::extent(mesh));
  }
  const double truth = query == Query::kDistance ? trueDistance(scene) : 0;
  std::vector<Row> rows;
  base.frames = 1;
  for (std::size_t number = 0; number < std::size(kQueries); ++number) {
    std::vector<Competitor> parts;
    for (const Competitor& all : competitors) parts.push_back(part(all, number));
    base.scenario = scenario + kQueries[number];
    for (std::size_t i = 0; i < crowds.size(); ++i) {
      Row row = base.of(parts[i], named("fcl_obbrss", parts));
      if (query == Query::kCollide) {
        row.errors.wrong = wrongOf(pairs[i], scene, options.oracle_frames);
        row.pairs.total = pairs[i].size();
        row.pairs.skipped = 0;
      } else {
        row.asked.rel_err = row.asked.abs_err = 0;
        row.errors.max_abs = std::abs(distances[i] - truth);
        row.errors.wrong = (distances[i] == 0) == (truth == 0) ? 0 : 1;
      }
      if (row.bv == "kios") row.simd_target = simdTarget();
      rows.push_back(std::move(row));
    }
  }
  report.add(rows);
}

/// One triangle against one, near and touching.
void reportTriangles(const Options& options, Report& report) {
  const scenes::Mesh a = scenes::singleTriangle({0, 0, 0}, {1, 0, 0}, {0, 0.7, 0});
  const scenes::Mesh b = scenes::singleTriangle({0, 0, 0}, {0.8, 0, 0}, {0.3, 0.9, 0.2});
  const int frames = options.quick ? 50 : 1000;
  Contest contest({a, b}, options);
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    append(contest.queryRows(pairTask("crowds/one_triangle", query,
                                      scenes::farMotion(frames, 0.05, 1.5, options.seed))),
           rows);
  }
  report.add(rows);
}

}  // namespace

void runCrowds(const Options& options, Report& report) {
  constexpr double kTouching = 0.28, kApart = 0.6;  // spacing
  const int count = options.quick ? 200 : 2000;
  Options ours = options;
  if (options.bvs == defaultVolumeNames()) ours.bvs = {"kios", "fcl_obbrss"};
  for (const int triangles : {12, 100, 900}) {
    const std::string size = std::to_string(triangles);
    reportCrowd("crowds/" + size, scenes::packedCrowd(count, triangles, kTouching, options.seed),
                Query::kCollide, ours, report);
    reportCrowd("crowds/" + size, scenes::packedCrowd(count, triangles, kApart, options.seed),
                Query::kDistance, ours, report);
  }
  reportTriangles(ours, report);
}

}  // namespace kios::bench
