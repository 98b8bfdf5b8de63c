// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Nearest points, signed distances and winding numbers of points.
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

class PointContest {
 public:
  PointContest(const std::string& name, const Mesh& mesh, const Options& options)
      : mesh_(mesh), model_(scenes::buildModel<kIOSd>(mesh)), options_(options) {
    markSolid(*model_);
    model_->computeLocalAABB();
    const fcl::Vector3d center = model_->aabb_center;
    const fcl::Vector3d half = 0.6 * (model_->aabb_local.max_ - model_->aabb_local.min_);
    const int count = options.frames > 0 ? options.frames : (options.quick ? 500 : 100000);
    scenes::Random random(options.seed);
    points_.resize(3, count);
    for (int i = 0; i < count; ++i) {
      for (int c = 0; c < 3; ++c) points_(c, i) = center[c] + half[c] * random.uniform(-1, 1);
    }
    base_ = baseRow(name, "", 0, {mesh});
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
      return [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          fcl::Transform3d X = here;
          const auto column = static_cast<Eigen::Index>(i);
          X.translation() = points_.col(column);
          fcl::DistanceResultd result;
          by_ball[column] =
              fcl::distance(model.get(), here, &ball, X, fcl::DistanceRequestd(), result);
        }
      };
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
    const std::size_t count = std::min<std::size_t>(points_.cols(), options_.quick ? 100 : 500),
                      judged = std::min<std::size_t>(count, 100);
    std::vector<double> exact;
    for (std::size_t i = 0; i < judged; ++i) {
      exact.push_back(tree.at(points_.col(static_cast<Eigen::Index>(i)), 0));
    }
    for (const double error : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
      std::vector<double> numbers(count);
      char name[32];
      std::snprintf(name, sizeof(name), "winding %g", error);
      run(name, "kios", count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          numbers[i] = tree.at(points_.col(static_cast<Eigen::Index>(i)), error);
        }
      });
      double worst = 0;
      for (std::size_t i = 0; i < judged; ++i) {
        worst = std::max(worst, std::abs(numbers[i] - exact[i]));
      }
      rows_.back().asked.abs_err = error;
      rows_.back().errors.max_abs = worst;
      rows_.back().errors.wrong = worst > error ? 1 : 0;
      rows_.back().volumes.bytes_per_triangle =
          static_cast<double>(tree.bytes()) / static_cast<double>(base_.triangles);
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
  const Mesh torus = scenes::bumpyTorus(options.quick ? 1000 : 84000);
  PointContest on_torus("points/torus", torus, options);
  on_torus.distances(report);
  on_torus.windings(report);
  const Mesh scan = scanned(scenes::bumpyTorus(options.quick ? 2000 : 500000), options.seed);
  PointContest on_scan("points/scan", scan, options);
  on_scan.distances(report);
  on_scan.windings(report);
}

}  // namespace kios::bench
