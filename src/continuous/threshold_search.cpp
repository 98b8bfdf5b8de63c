// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/threshold_search.h"

#include <algorithm>
#include <cmath>

#include "continuous/tuning.h"
#include "volume/errors.h"

namespace kios::continuous {
namespace {

using Proof = MovingBodies::Proof;

/// Returns the distance at s, if that is nearer than what was seen and `more`; keeps the least.
double look(MovingBodies& bodies, Seen& seen, double s, double more, double rel_err) {
  const Sight sight = bodies.look(s, seen.far() + more, rel_err);
  seen.keep(sight, {s});
  return sight.distance;
}

/// Steps down to both sides, halved where neither is nearer, until the distances there are about
/// the same: what is left to be gained is then a small part of the bracket.
void descend(MovingBodies& bodies, Seen& seen, double step, long long max_queries) {
  while (seen.distance() > 0 && seen.distance() < kInfinity && step > 0x1p-30 &&
         bodies.queries < max_queries) {
    const double from = seen.distance(), s = seen.at()[0], small = tuning::kLevel * seen.allowed();
    bool level = true;
    for (const double side : {-step, step}) {
      const double t = std::clamp(s + side, 0.0, 1.0);
      if (t != s) level &= look(bodies, seen, t, small, tuning::kCoarseError) <= from + small;
    }
    if (level && !(seen.distance() < from - small)) return;
    if (!(seen.distance() < from)) step *= 0.5;
  }
}

}  // namespace

Seen::Seen(const RangeRequest& request) : request_(request) {
  const auto finite = [](double x) { return x >= 0 && x <= 0x1p300; };
  require(finite(request.abs_err), "RangeRequest::abs_err", request.abs_err, "finite and >= 0");
  require(finite(request.rel_err), "RangeRequest::rel_err", request.rel_err, "finite and >= 0");
  require(finite(request.padding), "RangeRequest::padding", request.padding, "finite and >= 0");
  require(!std::isnan(request.ceiling), "RangeRequest::ceiling", request.ceiling, "a number");
  require(request.max_queries >= 0, "RangeRequest::max_queries", request.max_queries, ">= 0");
}

double Seen::allowed() const {
  return std::max(request_.abs_err, request_.rel_err * (far() - request_.padding));
}

double Seen::fineError() const {
  const double by_ratio = request_.rel_err * std::max(0.0, 1 - request_.padding / far());
  return 0.5 * tuning::kLevel * std::min(1.0, std::max(request_.abs_err / far(), by_ratio));
}

void Seen::keep(const Sight& sight, const std::vector<double>& at) {
  if (!(sight.distance < far())) return;
  best_ = sight;
  at_ = at;
}

double Seen::enough() const { return distance() < kInfinity ? distance() - allowed() : ceiling(); }

RangeResult Seen::result(double lower, long long queries) const {
  RangeResult result;
  result.upper = distance() - request_.padding;
  result.lower = std::min(lower - request_.padding, result.upper);
  result.at = at_;
  result.body_a = best_.a;
  result.body_b = best_.b;
  result.point_a = best_.point_a;
  result.point_b = best_.point_b;
  result.complete = lower >= enough();
  result.queries = queries;
  return result;
}

RangeResult searchThresholds(MovingBodies& bodies, const RangeRequest& request) {
  Seen seen(request);
  for (const double s : {0.5, 0.0, 1.0}) {
    if (seen.enough() > 0) look(bodies, seen, s, 0, tuning::kCoarseError);
  }
  descend(bodies, seen, 0.25, request.max_queries);
  double lower = 0, share = 0.5;
  bool limited = false;  // by rounding
  while (lower < seen.enough() && bodies.queries < request.max_queries) {
    const bool any = seen.distance() < kInfinity;
    if (!any && !(seen.far() <= 0x1p300)) {  // no pair
      lower = seen.far();
      break;
    }
    // The ceiling itself is tried first where nothing was seen, so that nothing need be.
    const double gap = any || limited ? std::max(seen.allowed(), share * seen.far()) : 0;
    const double separation = seen.far() - gap;
    double place = 0;
    const Proof proof = separation <= lower ? Proof::kClear : bodies.prove(separation, place);
    if (proof == Proof::kSpent) break;
    if (proof == Proof::kClear) {
      lower = std::max(lower, separation);
      if (limited) break;
      share *= 0.25;
    } else if (look(bodies, seen, place, 0, seen.fineError()) < separation + 0.5 * gap) {
      descend(bodies, seen, tuning::kNearby, request.max_queries);
    } else {
      limited = true;
      share = std::max(0x1p-40, 2 * gap / seen.far());
    }
  }
  return seen.result(lower, bodies.queries);
}

}  // namespace kios::continuous
