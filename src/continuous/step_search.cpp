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

// Long steps have many triangles in each other's reach, short ones advance little: a step is halved
// whenever it has cost its budget of tests. What was pruned before stays apart. The budget doubles
// with each halving, and for the next step: else pairs of which no step is cheap would get ever
// shorter ones, never reach the end, and count as contact. Before a step is halved, other orders
// are tried.
double StepSearch::apartFor(double t) {
  if (motion_.still()) return 1;
  const double left = end_ - t;
  const double window = motion_.steady() ? left : std::min(left, window_);
  const RelativeVelocities v = motion_.at(t, window);

  beginStep(t);
  // The pair that ended the last step will probably end this one: it gives a first upper bound.
  NodePair parts[kMostParts];
  if (last_.a < 0) {
    for (last_ = {0, 0}; split(last_, v, parts) > 0;) last_ = parts[0];
  }
  double h = std::min(window, tuning::kLonger * last_step_);
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
      noteStep(0, cost() - before);
      return 0;
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
  budget_ = budget > budget_ ? budget : std::max(tuning::kLeastBudget, budget / 2);
  noteStep(h, cost() - before);
  // One that ends at once, as the bodies touch there, says little of those from elsewhere.
  last_step_ = std::max(h, 0x1p-4 * last_step_);
  window_ = std::min(1.0, tuning::kWindow * last_step_);
  return h;
}

}  // namespace kios::continuous
