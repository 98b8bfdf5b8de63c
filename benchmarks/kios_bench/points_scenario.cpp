// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Points in solids; nearest points, signed distances and winding numbers of points.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/math/bv/OBBRSS.h>

#include "contest.h"
#include "fcl_kios/fcl_kios.h"
#include "scenario.h"
#include "scenes/containment_oracle.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

using scenes::Mesh;

/// As a scanner sees a torus: the depth of each vertex is off a little.
Mesh scanned(Mesh mesh, std::uint64_t seed) {
  scenes::Random random(seed);
  for (fcl::Vector3d& p : mesh.vertices) p *= 1 + random.uniform(-2e-4, 2e-4);
  return mesh;
}

/// Points in and about the box of a solid.
class PointContest {
 public:
  PointContest(const std::string& name, const Mesh& mesh, int count, const Options& options)
      : mesh_(mesh), model_(scenes::buildModel<kIOSd>(mesh)), options_(options) {
    markSolid(*model_);
    model_->computeLocalAABB();
    const fcl::Vector3d center = model_->aabb_center;
    const fcl::Vector3d half = 0.6 * (model_->aabb_local.max_ - model_->aabb_local.min_);
    if (options.frames > 0) count = options.frames;
    if (options.frames == 0 && options.quick) count = 500;
    scenes::Random random(options.seed);
    points_.resize(3, count);
    for (auto p : points_.colwise()) p = center + half.cwiseProduct(random.inCube(-1, 1));
    base_ = baseRow(name, "", 0, {mesh});
  }

  /// Judged by rational arithmetic.
  void containment(Report& report) {
    const auto count = static_cast<std::size_t>(points_.cols());
    std::vector<char> inside(count);
    const fcl::Transform3d here = fcl::Transform3d::Identity();
    run("contains", "kios", count, each([&](Eigen::Index i) {
          inside[static_cast<std::size_t>(i)] = contains<double>(*model_, here, points_.col(i));
        }));
    const scenes::ContainmentOracle oracle(mesh_);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 300); ++i) {
      const auto place = oracle.placeOf(points_.col(static_cast<Eigen::Index>(i)));
      wrong += (place != scenes::ContainmentOracle::Place::kOutside) != (inside[i] != 0);
    }
    rows_[0].errors.wrong = wrong;
    report.add(rows_);
    rows_.clear();
  }

  /// All points at once, and one after the other: FCL's nearest query is that of a ball of radius
  /// 0, over our volume and over OBBRSS.
  void distances(Report& report) {
    const auto obbrss = scenes::buildModel<fcl::OBBRSSd>(mesh_);
    const fcl::Sphered ball(0);
    const fcl::Transform3d here = fcl::Transform3d::Identity();
    const auto all = static_cast<std::size_t>(points_.cols());
    const std::size_t some = std::max<std::size_t>(1, all / (options_.quick ? 5 : 100));
    Eigen::VectorXd signed_distances(points_.cols()), nearest(points_.cols());
    Eigen::VectorXd by_ball(points_.cols());
    const auto asked = [&](const auto& model) {
      return each([&](Eigen::Index i) {
        fcl::Transform3d X = here;
        X.translation() = points_.col(i);
        fcl::DistanceResultd result;
        by_ball[i] = fcl::distance(model.get(), here, &ball, X, fcl::DistanceRequestd(), result);
      });
    };
    run("signed", "kios", all,
        [&](std::size_t, std::size_t) { signedDistances(*model_, points_, signed_distances); });
    Eigen::Matrix3Xd at(3, points_.cols());
    Eigen::VectorXi triangles(points_.cols());
    run("nearest", "kios", all,
        [&](std::size_t, std::size_t) { nearestPoints(*model_, points_, nearest, at, triangles); });
    run("ball", "kios", some, asked(model_));
    run("ball", "fcl_obbrss", some, asked(obbrss));
    // Each row is judged by another's way to the answer: balls against points, rays against signs.
    std::size_t wrong = 0;
    for (Eigen::Index i = 0; i < points_.cols(); ++i) {
      wrong += (signed_distances[i] <= 0) != contains<double>(*model_, here, points_.col(i));
      wrong += std::abs(signed_distances[i]) != nearest[i];
      if (i < static_cast<Eigen::Index>(some)) wrong += std::abs(by_ball[i] - nearest[i]) > 1e-6;
    }
    rows_[0].errors.wrong = wrong;
    report.add(rows_);
    rows_.clear();
  }

  /// Time against error of winding numbers; the error is the largest against sums of all triangles.
  void windings(Report& report) {
    const WindingTree tree(*model_);
    const Eigen::Index count = std::min<Eigen::Index>(points_.cols(), options_.quick ? 100 : 500),
                       judged = std::min<Eigen::Index>(count, 100);
    Eigen::VectorXd exact(judged), numbers(count);
    for (Eigen::Index i = 0; i < judged; ++i) exact[i] = tree.at(points_.col(i), 0);
    for (const double error : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
      char name[32];
      std::snprintf(name, sizeof(name), "winding %g", error);
      run(name, "kios", static_cast<std::size_t>(count),
          each([&](Eigen::Index i) { numbers[i] = tree.at(points_.col(i), error); }));
      const double worst = (numbers.head(judged) - exact).cwiseAbs().maxCoeff();
      rows_.back().asked.abs_err = error;
      rows_.back().errors.max_abs = worst;
      rows_.back().errors.wrong = worst > error ? 1 : 0;
    }
    report.add(rows_);
    rows_.clear();
  }

 private:
  template <typename Answer>
  void run(const std::string& query, const char* bv, std::size_t count, const Answer& answer) {
    std::vector<Competitor> competitors = {{bv, answer}};
    Race{count, options_.repeats, Race::kAll, Race::kAll, true}.run(competitors);
    base_.frames = count;
    Row& row = rows_.emplace_back(base_.of(competitors[0]));
    row.query = query;
    row.bv = bv;
  }

  const Mesh& mesh_;
  const std::shared_ptr<Modeld> model_;
  const Options& options_;
  Eigen::Matrix3Xd points_;
  Row base_;
  std::vector<Row> rows_;
};

}  // namespace

void reportPoints(const Options& options, Report& report) {
  if (wanted(options, "contains")) {
    const std::pair<const char*, Mesh> solids[] = {
        {"torus", scenes::bumpyTorus(options.quick ? 1000 : 20000)},
        {"box", scenes::subdividedBox({1, 2, 3}, options.quick ? 5 : 41)},
        {"ball", scenes::icosphere(1, options.quick ? 2 : 5)}};
    for (const auto& [name, mesh] : solids) {
      PointContest(std::string("solids/contains/") + name, mesh, 20000, options)
          .containment(report);
    }
  }
  if (!wanted(options, "points")) return;
  const std::pair<const char*, Mesh> meshes[] = {
      {"torus", scenes::bumpyTorus(options.quick ? 1000 : 84000)},
      {"scan", scanned(scenes::bumpyTorus(options.quick ? 2000 : 500000), options.seed)}};
  for (const auto& [name, mesh] : meshes) {
    PointContest contest(std::string("points/") + name, mesh, 100000, options);
    contest.distances(report);
    contest.windings(report);
  }
}

}  // namespace kios::bench
