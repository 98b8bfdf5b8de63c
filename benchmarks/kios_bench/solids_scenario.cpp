// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Penetration and local depth of solids.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcl/math/bv/OBBRSS.h>

#include "contest.h"
#include "fcl_kios/fcl_kios.h"
#include "scenario.h"
#include "scenes/arms.h"
#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

using scenes::Frame;
using scenes::Mesh;

/// Overlapping frames of two solids: penetration() beside fcl::collide for one contact, of ours,
/// and for the deepest of a hundred contacts over OBBRSS, which is what users of FCL take for a
/// depth.
class Overlaps {
 public:
  /// Holds the depth of a frame, where it is known: at least and at most.
  struct Known {
    double least, most;
  };
  using Depth = std::function<Known(const Frame&)>;

  Overlaps(const Mesh& a, const Mesh& b)
      : a_(scenes::buildModel<kIOSd>(a)),
        b_(scenes::buildModel<kIOSd>(b)),
        fcl_a_(scenes::buildModel<fcl::OBBRSSd>(a)),
        fcl_b_(scenes::buildModel<fcl::OBBRSSd>(b)),
        meshes_{a, b} {
    markSolid(*a_);
    markSolid(*b_);
  }

  void run(const std::string& name, const std::vector<Frame>& frames, const Depth& known,
           const Options& options, Report& report) {
    std::vector<Frame> overlapping;
    const std::size_t most = options.quick ? 3 : 300;
    for (const Frame& frame : frames) {
      if (overlapping.size() < most && collide(frame)) overlapping.push_back(frame);
    }
    if (overlapping.empty()) return;
    const std::size_t n = overlapping.size();
    std::vector<PenetrationResult> found(n);
    std::vector<double> deepest(n);
    std::vector<Competitor> competitors = {
        {"penetration", each([&](std::size_t i) { found[i] = depthOf(overlapping[i]); })},
        {"collide", each([&](std::size_t i) { collide(overlapping[i]); })},
        {"contacts", each([&](std::size_t i) { deepest[i] = deepestContact(overlapping[i]); })}};
    Race{n, options.repeats, 8, 8, true}.run(competitors);
    std::vector<Row> rows;
    for (const Competitor& competitor : competitors) {
      Row& row = rows.emplace_back(baseRow(name, competitor.name, n, meshes_).of(competitor));
      row.bv = competitor.name == "contacts" ? "fcl_obbrss" : "kios";
    }
    std::vector<double> ratios;
    std::size_t wrong = 0;
    double off = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const PenetrationResult& p = found[i];
      ratios.push_back(p.lower > 0 ? p.upper / p.lower : std::numeric_limits<double>::infinity());
      off += std::abs(deepest[i] - p.upper) / p.upper / static_cast<double>(n);
      bool holds = partsThem(overlapping[i], p);
      if (known) {
        const Known depth = known(overlapping[i]);
        holds &= p.lower <= depth.most * (1 + 1e-9) && p.upper >= depth.least * (1 - 1e-9);
      }
      wrong += holds ? 0 : 1;
    }
    rows[0].errors.wrong = wrong;
    rows[0].errors.bracket_ratio = median(ratios);
    rows[0].errors.max_bracket_ratio = *std::max_element(ratios.begin(), ratios.end());
    rows[2].errors.mean_rel = off;
    report.add(rows);
  }

 private:
  std::size_t collide(const Frame& f) const {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(a_.get(), f.X_WA, b_.get(), f.X_WB, request, result);
  }

  PenetrationResult depthOf(const Frame& f) const {
    return penetration<double>(*a_, f.X_WA, *b_, f.X_WB);
  }

  double deepestContact(const Frame& f) const {
    const fcl::CollisionRequestd request(100, true);
    fcl::CollisionResultd result;
    fcl::collide(fcl_a_.get(), f.X_WA, fcl_b_.get(), f.X_WB, request, result);
    double depth = 0;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      depth = std::max(depth, result.getContact(i).penetration_depth);
    }
    return depth;
  }

  /// By FCL's own volume, and by our verdicts about containment.
  bool partsThem(Frame f, const PenetrationResult& p) const {
    f.X_WB.translation() += p.translation;
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if (fcl::collide(fcl_a_.get(), f.X_WA, fcl_b_.get(), f.X_WB, request, result) > 0) return false;
    return collide(f) == 0;
  }

  const std::shared_ptr<Modeld> a_, b_;
  const std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> fcl_a_, fcl_b_;
  const std::vector<Mesh> meshes_;
};

void overlap(const std::string& name, const Mesh& a, const Mesh& b,
             const std::vector<Frame>& frames, const Overlaps::Depth& known, const Options& options,
             Report& report) {
  try {
    Overlaps(a, b).run("solids/" + name, frames, known, options, report);
  } catch (const std::invalid_argument& refused) {
    std::printf("solids/%s is left out: %s\n", name.c_str(), refused.what());
  }
}

/// Time against error of local depths of frames of one true depth, at least and at most, beside
/// fcl::collide of ours for one contact; and half and one and a half times it as thresholds.
void depths(const std::string& name, const Mesh& a, const Mesh& b, const std::vector<Frame>& frames,
            Overlaps::Known known, const Options& options, Report& report) {
  const auto model_a = scenes::buildModel<kIOSd>(a), model_b = scenes::buildModel<kIOSd>(b);
  markSolid(*model_a);
  markSolid(*model_b);
  const std::size_t n = frames.size();
  const Row base = baseRow("solids/depth/" + name, "depth", n, {a, b});
  std::vector<Row> rows;
  const auto race = [&](const char* query, const std::function<void(std::size_t)>& ask) -> Row& {
    std::vector<Competitor> competitors = {{"kios", each(ask)}};
    Race{n, options.repeats, 8, 8, true}.run(competitors);
    Row& row = rows.emplace_back(base.of(competitors[0]));
    row.query = query;
    row.bv = "kios";
    return row;
  };
  race("collide", [&](std::size_t i) {
    fcl::CollisionResultd result;
    fcl::collide(model_a.get(), frames[i].X_WA, model_b.get(), frames[i].X_WB,
                 fcl::CollisionRequestd(), result);
  });
  std::vector<LocalDepthResult> found(n);
  LocalDepthRequest request;
  const auto ask = [&](std::size_t i) {
    found[i] = localDepth<double>(*model_a, frames[i].X_WA, *model_b, frames[i].X_WB, request);
  };
  const auto wrong = [&](const auto& is_right) {
    return static_cast<std::size_t>(n - std::count_if(found.begin(), found.end(), is_right));
  };
  constexpr double kRounding = 1e-13;
  for (const double rel_err : {0.3, 0.1, 0.03, 0.01, 0.001}) {
    request.rel_err = rel_err;
    Row& row = race("depth", ask);
    row.asked.rel_err = rel_err;
    std::vector<double> ratios;
    for (const LocalDepthResult& d : found) ratios.push_back(d.upper / d.lower);
    row.errors.bracket_ratio = median(ratios);
    row.errors.max_bracket_ratio = *std::max_element(ratios.begin(), ratios.end());
    row.errors.wrong = wrong([&](const LocalDepthResult& d) {
      return d.lower <= known.most + kRounding && d.upper >= known.least - kRounding && d.complete;
    });
  }
  for (const double share : {0.5, 1.5}) {
    request.threshold = share * known.most;
    Row& row = race("deeper", ask);
    row.asked.threshold = share;
    row.errors.wrong = wrong([&](const LocalDepthResult& d) {
      return share < 1 ? d.lower > request.threshold : d.upper <= request.threshold;
    });
  }
  report.add(rows);
}

/// Boxes let into each other at a face that both overhang, a sheet through a block, balls.
void depths(const Options& options, Report& report) {
  const std::vector<fcl::Transform3d> worlds =
      scenes::randomPoses(options.quick ? 2 : 20, 2, options.seed);
  const auto framesAt = [&](const fcl::Vector3d& T_AB) {
    std::vector<Frame> frames;
    for (const fcl::Transform3d& X : worlds) frames.push_back({X, X * Eigen::Translation3d(T_AB)});
    return frames;
  };
  const Mesh box = scenes::subdividedBox({1, 1.5, 0.7}, 1);
  const Mesh fine = scenes::subdividedBox({1, 1.5, 0.7}, options.quick ? 4 : 29);
  for (const double deep : {1e-1, 1e-3, 1e-6}) {
    char name[32];
    std::snprintf(name, sizeof name, "boxes/%g", deep);
    depths(name, box, box, framesAt({0.2, 0.3, 0.7 - deep}), {deep, deep}, options, report);
    std::snprintf(name, sizeof name, "flush/%g", deep);
    depths(name, fine, fine, framesAt({0.2, 0.3, 0.7 - deep}), {deep, deep}, options, report);
  }
  depths("sheet", scenes::subdividedBox({1, 1, 1}, options.quick ? 2 : 8),
         scenes::subdividedBox({2, 2, 0.02}, options.quick ? 2 : 20), framesAt({0, 0, 0}),
         {0.49, 0.49}, options, report);
  const Mesh ball = scenes::icosphere(0.8, options.quick ? 2 : 4);
  const double facets = options.quick ? 0.95 : 0.997;
  depths("balls", ball, ball, framesAt({0.3, 0.8, 0.9}),
         {1.6 * facets - std::sqrt(1.54), 1.6 - std::sqrt(1.54)}, options, report);
}

/// b within a cube about a.
std::vector<Frame> posesWithin(double half_width, int count, std::uint64_t seed) {
  std::vector<Frame> frames;
  for (const fcl::Transform3d& X : scenes::randomPoses(count, half_width, seed)) {
    frames.push_back({fcl::Transform3d::Identity(), X});
  }
  return frames;
}

/// Returns two boxes of these sizes: the least overlap along the axes of faces and crossed edges.
Overlaps::Depth depthOfBoxes(const fcl::Vector3d& size_a, const fcl::Vector3d& size_b) {
  return [size_a, size_b](const Frame& f) {
    const fcl::Matrix3d &A = f.X_WA.linear(), &B = f.X_WB.linear();
    const fcl::Vector3d d = f.X_WB.translation() - f.X_WA.translation();
    double depth = std::numeric_limits<double>::infinity();
    const auto along = [&](fcl::Vector3d n) {
      if (!(n.norm() > 1e-9)) return;
      n.normalize();
      const double reach = 0.5 * size_a.dot((A.transpose() * n).cwiseAbs()) +
                           0.5 * size_b.dot((B.transpose() * n).cwiseAbs());
      depth = std::min(depth, reach - std::abs(n.dot(d)));
    };
    for (int i = 0; i < 3; ++i) {
      along(A.col(i));
      along(B.col(i));
      for (int j = 0; j < 3; ++j) along(A.col(i).cross(B.col(j)));
    }
    return Overlaps::Known{depth, depth};
  };
}

void penetrate(const Options& options, Report& report) {
  const int count = options.quick ? 20 : 600;
  const auto box_size = fcl::Vector3d(1, 1.5, 0.7);
  const Mesh box = scenes::subdividedBox(box_size, 8), ball = scenes::icosphere(0.8, 4);
  overlap("boxes", box, box, posesWithin(0.8, count, options.seed),
          depthOfBoxes(box_size, box_size), options, report);
  constexpr double kFacets = 0.997;  // inner radius of the icosphere over its radius
  overlap(
      "balls", ball, ball, posesWithin(0.7, count, options.seed),
      [](const Frame& f) {
        const double apart = (f.X_WB.translation() - f.X_WA.translation()).norm();
        return Overlaps::Known{1.6 * kFacets - apart, 1.6 - apart};
      },
      options, report);

  overlap("blob_in_torus", scenes::knobbyTorus(), scenes::bumpyBlob(),
          posesWithin(0.5, count, options.seed), nullptr, options, report);

  const auto ur5 = findUr5(options);
  const scenes::Robot arm = ur5 ? *ur5 : scenes::cadArm();
  const Mesh table = scenes::subdividedBox({4, 4, 0.4}, 8);
  scenes::Random random(options.seed);
  for (std::size_t i = 1; i < arm.links.size(); ++i) {
    const Mesh& link = arm.links[i].mesh;
    std::vector<Frame> pressed;
    for (const fcl::Transform3d& turned :
         scenes::randomPoses(count / 6 + 1, 0.5, options.seed + i)) {
      Frame f = {fcl::Transform3d::Identity(), turned};
      double bottom = std::numeric_limits<double>::infinity();
      for (const fcl::Vector3d& p : link.vertices) bottom = std::min(bottom, (f.X_WB * p)[2]);
      // Pressed in by up to a twentieth of the link's size.
      f.X_WB.translation()[2] += 0.2 - bottom - random.uniform(0.002, 0.05) * scenes::extent(link);
      pressed.push_back(f);
    }
    overlap((ur5 ? "ur5_in_table/" : "arm_in_table/") + std::to_string(i), table, link, pressed,
            nullptr, options, report);
  }
}

}  // namespace

void runSolids(const Options& options, Report& report) {
  if (wanted(options, "penetration")) penetrate(options, report);
  if (wanted(options, "depth")) depths(options, report);
  reportPoints(options, report);
}

}  // namespace kios::bench
