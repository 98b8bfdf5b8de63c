// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/interior/penetration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "interior/common_center.h"
#include "interior/containment.h"
#include "interior/exit_search.h"
#include "interior/minkowski_hull.h"
#include "interior/solid_pair.h"
#include "interior/touching.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

void requireValid(const PenetrationOptions& options) {
  const auto refuse = [](const char* name, double value) {
    std::ostringstream message;
    message << "fcl_kios: PenetrationOptions::" << name << " is " << value << ", but must be >= 0.";
    throw std::invalid_argument(message.str());
  };
  if (!(options.rel_gap >= 0)) refuse("rel_gap", options.rel_gap);
  if (options.max_tests < 0) refuse("max_tests", options.max_tests);
}

template <typename S>
class PenetrationQuery {
 public:
  PenetrationQuery(SolidPair<S>& pair, const PenetrationOptions& options)
      : pair_(pair), options_(options) {}

  Penetration run() {
    const PairFrame<S>& frame = pair_.frame();
    const Convexity &shape_a = pair_.stateA().convexity(frame.a),
                    &shape_b = pair_.stateB().convexity(frame.b);
    const bool convex = shape_a.convex && shape_b.convex;
    const Differences<S> differences(frame.a, shape_a.graph, frame.b, shape_b.graph, pair_.R_AB(),
                                     pair_.T_AB());
    double lower = 0;
    Vec direction = Vec::Zero();
    if (convex) {
      constexpr int kPoints = 128;
      constexpr double kShare = 0.9;
      const HullDepth hull =
          hullDepth(differences, pair_.size(), kShare * options_.rel_gap, kPoints);
      direction = pair_.R_WA() * hull.normal;
      lower = hull.lower;
    }
    std::vector<Vec> directions;
    if (direction.isZero(0)) {
      directions = pair_.exitDirections();
      direction = shortest(differences, directions);
    }
    exit_ = leaveHull(pair_, differences, direction.normalized(), convex ? pair_.size() : 0);
    if (convex) lower_ = lowerOfHulls(lower);
    if (!closed()) {
      if (!convex) exit_ = shorten(pair_, exit_, directions, options_.max_tests);
      lower_ = std::max(lower_, inWorld(depthOfBalls(pair_, exit_.on_a, exit_.translation,
                                                     exit_.length / (1 + options_.rel_gap))));
    }
    Penetration result;
    if (partedByFace(pair_, exit_.length)) return result;
    result.upper = exit_.length;
    result.lower = std::min(lower_, exit_.length);
    result.translation = exit_.translation;
    result.point = exit_.on_a;
    return result;
  }

 private:
  /// Of the first few directions, that along which b leaves a's hull soonest.
  Vec shortest(const Differences<S>& differences, const std::vector<Vec>& directions) const {
    constexpr std::size_t kFew = 2;
    Vec best = Vec::UnitX();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < std::min(kFew, directions.size()); ++i) {
      const double height =
          differences.height((pair_.R_WA().transpose() * directions[i]).normalized());
      if (!(height < least)) continue;
      least = height;
      best = directions[i];
    }
    return best;
  }

  bool closed() const { return exit_.length <= (1 + options_.rel_gap) * lower_; }

  // The vertices of both hulls lie within `moved` of points of the solids, whose hulls are in the
  // solids: see Convexity. So does each difference of two vertices.
  double lowerOfHulls(double lower) const {
    const PairFrame<S>& frame = pair_.frame();
    return inWorld(lower - pair_.stateA().convexity(frame.a).moved -
                   1.01 * pair_.stateB().convexity(frame.b).moved - pair_.rounding());
  }

  /// A translation in the world has R_WA^T of it in a's frame, longer by the stretch at most.
  double inWorld(double lower) const {
    const double stretch = detail::boundsOf(pair_.frame().X_AB).stretch;
    return std::max(0.0, lower / (1 + 2.1 * stretch + 0x1p-48));
  }

  SolidPair<S>& pair_;
  const PenetrationOptions& options_;
  Exit exit_;
  double lower_ = 0;
};

}  // namespace

template <typename S>
Penetration penetration(const Model<S>& solid1, const fcl::Transform3<S>& X_W1,
                        const Model<S>& solid2, const fcl::Transform3<S>& X_W2,
                        const PenetrationOptions& options) {
  requireValid(options);
  SearchCounts unused;
  SearchCounts& counts = options.counts ? *options.counts : unused;
  SolidPair<S> pair(solid1, X_W1, solid2, X_W2, counts);
  const PairFrame<S>& frame = pair.frame();
  if (frame.rootBound(0) > 0) return {};
  if (!surfacesMeet(frame, counts) && !containedPoint(frame, counts)) return {};
  return PenetrationQuery<S>(pair, options).run();
}

template Penetration penetration(const Model<double>&, const fcl::Transform3<double>&,
                                 const Model<double>&, const fcl::Transform3<double>&,
                                 const PenetrationOptions&);
template Penetration penetration(const Model<float>&, const fcl::Transform3<float>&,
                                 const Model<float>&, const fcl::Transform3<float>&,
                                 const PenetrationOptions&);

}  // namespace kios
