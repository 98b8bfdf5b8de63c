// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rrt_connect.h"

#include <algorithm>
#include <chrono>
#include <random>

namespace kios::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::VectorXd;

struct Tree {
  std::vector<VectorXd> nodes;
  std::vector<int> parents;

  int nearest(const VectorXd& q) const {
    int best = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      if ((nodes[i] - q).squaredNorm() <
          (nodes[static_cast<std::size_t>(best)] - q).squaredNorm()) {
        best = static_cast<int>(i);
      }
    }
    return best;
  }
  /// From the root to a node.
  std::vector<VectorXd> pathTo(int node) const {
    std::vector<VectorXd> path;
    for (; node >= 0; node = parents[static_cast<std::size_t>(node)]) {
      path.push_back(nodes[static_cast<std::size_t>(node)]);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }
};

}  // namespace

Plan rrtConnect(const PlanRequest& request, const IsFreeEdge& is_free) {
  const auto begin = Clock::now();
  Plan plan;
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::mt19937_64 random(request.seed);
  Tree trees[2];
  trees[0].nodes = {request.start};
  trees[1].nodes = {request.goal};
  trees[0].parents = trees[1].parents = {-1};
  bool reached = false;
  // One step of a tree towards q; -1 if it is blocked.
  const auto extend = [&](Tree& tree, const VectorXd& q) {
    const int near = tree.nearest(q);
    const VectorXd from = tree.nodes[static_cast<std::size_t>(near)];
    const double length = (q - from).norm();
    reached = length <= request.range;
    const VectorXd to = reached ? q : VectorXd(from + request.range / length * (q - from));
    ++plan.edges;
    if (!is_free(from, to)) return -1;
    tree.nodes.push_back(to);
    tree.parents.push_back(near);
    return static_cast<int>(tree.nodes.size()) - 1;
  };
  for (int turn = 0; elapsed() < request.seconds; turn = 1 - turn) {
    VectorXd q(request.start.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      q[k] = std::uniform_real_distribution<double>(request.lower[k], request.upper[k])(random);
    }
    // The very first goal is the other tree's root, which solves what is easy.
    if (trees[0].nodes.size() + trees[1].nodes.size() == 2) q = request.goal;
    Tree &tree = trees[turn], &other = trees[1 - turn];
    const int added = extend(tree, q);
    if (added < 0) continue;
    const VectorXd target = tree.nodes[static_cast<std::size_t>(added)];
    int last = extend(other, target);
    while (last >= 0 && !reached && elapsed() < request.seconds) last = extend(other, target);
    if (last < 0 || !reached) continue;
    std::vector<VectorXd> first = trees[0].pathTo(turn == 0 ? added : last);
    std::vector<VectorXd> second = trees[1].pathTo(turn == 0 ? last : added);
    first.insert(first.end(), second.rbegin() + 1, second.rend());
    plan.path = std::move(first);
    break;
  }
  plan.seconds = elapsed();
  return plan;
}

}  // namespace kios::bench
