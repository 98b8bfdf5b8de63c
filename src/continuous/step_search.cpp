// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/step_search.h"

#include <algorithm>

#include "model/kios_model.h"

namespace kios::continuous {

double reachOf(const Modeld& model) {
  requireFinished(model);
  const kIOSd& root = model.getBV(0).bv;
  return (root.center0.norm() + root.radius0) * (1 + 0x1p-50);
}

void StepSearch::setLimits(double end, long long most_tests) {
  end_ = end;
  most_tests_ = most_tests;
  slide_ = 1;
  most_turn_ = 0x1p-3;
}

// Long steps have many triangles in each other's reach, short ones advance little: a step is halved
// whenever it has cost its budget of tests. What was pruned before stays apart. The budget doubles
// with each halving, and for the next step: else pairs of which no step is cheap would get ever
// shorter ones, never reach the end, and count as contact. Before a step is halved, other orders
// are tried. What the pair as a whole is proven apart for tells how long a step should be looked
// for: more of it as long as that costs little. Where a search gets no farther than as many of
// those short steps as it costs, some of them are taken instead, more each time.
double StepSearch::apartFor(double t, double required) {
  if (motion_.still()) return 1;
  const double left = end_ - t;
  const double window = motion_.steady() ? left : std::min(left, window_);
  const RelativeVelocities v = motion_.at(t, window);

  const double whole = std::min(window, wholeApart(t, v));
  if (whole >= left) return left;
  constexpr double kShortest = 0x1p-13;  // so that steps stay few
  if (spared_ > 0 && whole >= std::max(required, kShortest)) {
    --spared_;
    window_ = std::min(1.0, std::max(window_, 8 * whole));
    return whole;
  }
  const double most = whole > 0 ? std::max(slide_, reach_ * whole) : window;

  // The pair that ended the last step will probably end this one: it gives a first upper bound.
  NodePair parts[kMostParts];
  if (last_.a < 0) {
    for (last_ = {0, 0}; split(last_, v, parts) > 0;) last_ = parts[0];
  }
  double h = std::min({window, 4 * last_step_, most});
  if (h * v.turn() > most_turn_) h = most_turn_ / v.turn();
  h = std::min(h, leavesApart(last_, v, h));
  const long long before = cost();
  long long budget = budget_, budget_ends = counts_.volume_tests + budget;
  stack_.assign(1, {0, 0});
  while (!stack_.empty() && h > 0) {
    if (counts_.volume_tests >= budget_ends && changeOrder(h, cost() - before)) {
      budget_ends += budget;
      stack_.assign(1, {0, 0});
    }
    if (counts_.volume_tests >= budget_ends) {
      h *= 0.5;
      budget *= 2;
      budget_ends += budget;
    }
    if (cost() - before > most_tests_) {
      h = 0;
      break;
    }
    const NodePair pair = stack_.back();
    stack_.pop_back();
    ++counts_.volume_tests;
    if (nodesApart(pair, v, h)) continue;
    if (const int count = split(pair, v, parts); count > 0) {
      for (int i = count; i-- > 0;) stack_.push_back(parts[i]);
      continue;
    }
    ++counts_.leaf_tests;
    const double apart = leavesApart(pair, v, h);
    if (apart < h) {
      h = apart;
      last_ = pair;
    }
  }
  budget_ = budget > budget_ ? budget : std::max(kLeastBudget, budget / 2);
  constexpr long long kCheap = 300;
  const long long cost = this->cost() - before;
  noteStep(h, cost);
  if (h >= 0.7 * most && (most == slide_ || cost < kCheap)) {
    (most == slide_ ? slide_ : reach_) *= 2;
  }
  constexpr double kCostOfWhole = 20;  // in tests
  constexpr int kLongestPause = 31;
  const bool paid = !(whole * static_cast<double>(cost) > h * kCostOfWhole);
  spared_ = pause_ = paid ? 0 : std::min(2 * pause_ + 1, kLongestPause);
  h = std::max(h, whole);
  window_ = std::min(1.0, 8 * h);
  last_step_ = h;
  return h;
}

}  // namespace kios::continuous
