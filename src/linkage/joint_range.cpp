// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/linkage.h"

#include <algorithm>
#include <cmath>

#include "linkage/box_search.h"
#include "linkage/motion_search.h"
#include "volume/errors.h"

namespace kios {
namespace {

using articulated::Configuration;
using articulated::Pair;
using articulated::Path;
using Eigen::VectorXd;

/// The bodies of a linkage, or two of them, along a path.
class AlongPath final : public continuous::MovingBodies {
 public:
  AlongPath(const Path& path, const Pair* only, const RangeRequest& request)
      : path_(path), nearest_(only), request_(request), at_(path, 0) {}

  continuous::Sight look(double s, double far, double rel_err) override {
    const long long before = nearest_.queries();
    at_.set(path_, s);
    const continuous::Sight sight = nearest_.at(at_, far, rel_err);
    queries += nearest_.queries() - before;
    return sight;
  }
  Proof prove(double separation, double& place) override {
    MotionRequest request;
    request.min_separation = separation;
    request.max_queries = request_.max_queries - queries;
    const MotionResult answer = articulated::MotionSearch(path_, request, nearest_.only()).run();
    queries += answer.counts.queries;
    const bool contact = answer.verdict == MotionVerdict::kContact;
    place = contact ? answer.to : 0.5 * (answer.from + answer.to);
    if (answer.verdict == MotionVerdict::kClear) return Proof::kClear;
    return answer.verdict == MotionVerdict::kBudgetSpent ? Proof::kSpent : Proof::kRefuted;
  }

 private:
  const Path& path_;
  articulated::Nearest nearest_;
  const RangeRequest& request_;
  Configuration at_;
};

/// A path, or a box by its ends.
struct Range {
  VectorXd from, to;
  bool box = false;
};

/// Asks about all pairs, or only one.
RangeResult leastOf(const Linkage::Impl& linkage, const Range& range, const Pair* only,
                    const RangeRequest& request) {
  if (range.box) return articulated::BoxSearch(linkage, only, request).run(range.from, range.to);
  const Path path(linkage, range.from, range.to);
  AlongPath bodies(path, only, request);
  RangeResult result = continuous::searchThresholds(bodies, request);
  if (result.at.empty()) return result;
  const double s = result.at[0];
  result.at.clear();
  for (int k = 0; k < linkage.coordinates; ++k) result.at.push_back(path.coordinate(k, s));
  return result;
}

/// The range of a coordinate; over one turn, where that is all.
std::pair<double, double> rangeOf(const Linkage::Impl& linkage, const JointBox& box, int k) {
  double low = box.lower[static_cast<std::size_t>(k)],
         high = box.upper[static_cast<std::size_t>(k)];
  if (!(low <= high)) {
    refuse("the range of coordinate ", k, " is from ", low, " to ", high,
           ", but must be from its lower end to its upper one.");
  }
  // All that it turns has turned fully once the slowest has, if the others are multiples of it.
  double slowest = kInfinity;
  bool slides = false, periodic = true;
  const auto forJoints = [&](const auto& visit) {
    for (const articulated::LinkData& link : linkage.links) {
      const double rate = std::abs(link.multiplier) * link.unit;
      if (link.coordinate == k && rate > 0) visit(link, rate);
    }
  };
  forJoints([&](const auto& link, double rate) {
    slowest = std::min(slowest, rate);
    slides |= link.type == JointType::kPrismatic;
  });
  if (slowest == kInfinity) return {std::clamp(0.0, low, high), std::clamp(0.0, low, high)};
  forJoints([&](const auto&, double rate) { periodic &= std::fmod(rate, slowest) == 0; });
  const double turn = 6.283185307179586 / slowest * (1 + 0x1p-45);
  if (!slides && periodic && high - low > turn) {  // ends are rounded outwards
    low = std::max(low, std::min(-0.5 * turn, std::nextafter(high - turn, -kInfinity)));
    high = std::min(high, std::nextafter(low + turn, kInfinity));
  }
  if (!std::isfinite(low) || !std::isfinite(high)) {
    refuse("the range of coordinate ", k,
           " is infinite, which only one that turns links, all by "
           "multiples of one angle, may be.");
  }
  return {low, high};
}

Range rangeOf(const Linkage::Impl& linkage, const JointBox& box) {
  const auto size = static_cast<std::size_t>(linkage.coordinates);
  if (box.lower.size() != size || box.upper.size() != size) {
    refuse("a box has ", box.lower.size(), " lower and ", box.upper.size(),
           " upper ends, but the linkage ", size, " coordinates.");
  }
  Range range = {VectorXd(linkage.coordinates), VectorXd(linkage.coordinates)};
  for (int k = 0; k < linkage.coordinates; ++k) {
    std::tie(range.from[k], range.to[k]) = rangeOf(linkage, box, k);
  }
  range.box = (range.from.array() < range.to.array()).count() > 1;
  return range;
}

/// Asks about each pair that is checked. Of one that isn't served nothing is known.
std::vector<RangeResult> ofEach(const Linkage::Impl& linkage, const Range& range,
                                const RangeRequest& request) {
  const continuous::Seen nothing(request);
  const Path valid(linkage, range.from, range.to);
  std::vector<Pair> pairs;
  articulated::NearPairs().forEach(valid, Configuration(valid, 0), kInfinity, 0,
                                   [&](const Pair& pair) { pairs.push_back(pair); });
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::make_pair(x.a, x.b) < std::make_pair(y.a, y.b);
  });
  std::vector<RangeResult> results;
  for (const Pair& pair : pairs) {
    const bool served = articulated::isServed(linkage.bodies[pair.a], linkage.bodies[pair.b]);
    results.push_back(served ? leastOf(linkage, range, &pair, request) : nothing.result(0, 0));
    results.back().body_a = pair.a;
    results.back().body_b = pair.b;
  }
  return results;
}

}  // namespace

RangeResult leastClearance(const Linkage& linkage, const VectorXd& q0, const VectorXd& q1,
                           const RangeRequest& request) {
  return leastOf(*linkage.impl().current(), {q0, q1}, nullptr, request);
}

RangeResult leastClearance(const Linkage& linkage, const JointBox& box,
                           const RangeRequest& request) {
  const auto impl = linkage.impl().current();
  return leastOf(*impl, rangeOf(*impl, box), nullptr, request);
}

std::vector<RangeResult> leastClearances(const Linkage& linkage, const VectorXd& q0,
                                         const VectorXd& q1, const RangeRequest& request) {
  return ofEach(*linkage.impl().current(), {q0, q1}, request);
}

std::vector<RangeResult> leastClearances(const Linkage& linkage, const JointBox& box,
                                         const RangeRequest& request) {
  const auto impl = linkage.impl().current();
  return ofEach(*impl, rangeOf(*impl, box), request);
}

}  // namespace kios
