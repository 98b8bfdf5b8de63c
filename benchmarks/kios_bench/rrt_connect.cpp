// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rrt_connect.h"

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include "race.h"

namespace kios::bench {
namespace {

using Eigen::VectorXd;

/// Nodes side by side in memory, as all are looked at to find the nearest.
class Tree {
 public:
  explicit Tree(const VectorXd& root) : size_(root.size()) { add(root, -1); }

  int add(const VectorXd& q, int parent) {
    coordinates_.insert(coordinates_.end(), q.data(), q.data() + size_);
    parents_.push_back(parent);
    return static_cast<int>(parents_.size()) - 1;
  }
  std::size_t size() const { return parents_.size(); }
  Eigen::Map<const VectorXd> node(int i) const { return {coordinates_.data() + i * size_, size_}; }
  int nearest(const VectorXd& q) const {
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    const double* p = coordinates_.data();
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      double square = 0;
      for (Eigen::Index k = 0; k < size_; ++k, ++p) square += (*p - q[k]) * (*p - q[k]);
      if (square < least) {
        least = square;
        best = static_cast<int>(i);
      }
    }
    return best;
  }
  /// From the root to a node.
  std::vector<VectorXd> pathTo(int i) const {
    std::vector<VectorXd> path;
    for (; i >= 0; i = parents_[static_cast<std::size_t>(i)]) path.emplace_back(node(i));
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  Eigen::Index size_;
  std::vector<double> coordinates_;
  std::vector<int> parents_;
};

}  // namespace

Plan rrtConnect(const PlanRequest& request, const IsFreeEdge& is_free) {
  const double begin = nowMicroseconds();
  Plan plan;
  const auto elapsed = [&] { return 1e-6 * (nowMicroseconds() - begin); };
  std::mt19937_64 random(request.seed);
  Tree trees[2] = {Tree(request.start), Tree(request.goal)};
  bool reached = false;
  // One step of a tree towards q; -1 if it is blocked.
  const auto extend = [&](Tree& tree, const VectorXd& q) {
    const int near = tree.nearest(q);
    const VectorXd from = tree.node(near);
    const double length = (q - from).norm();
    reached = length <= request.range;
    VectorXd to = reached ? q : VectorXd(from + request.range / length * (q - from));
    ++plan.edges;
    if (!is_free(from, to)) return -1;
    const int added = tree.add(to, near);
    plan.free_edges.emplace_back(from, std::move(to));
    return added;
  };
  for (int turn = 0; elapsed() < request.seconds; turn = 1 - turn) {
    VectorXd q(request.start.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      q[k] = std::uniform_real_distribution<double>(request.lower[k], request.upper[k])(random);
    }
    // The very first goal is the other tree's root, which solves what is easy.
    if (trees[0].size() + trees[1].size() == 2) q = request.goal;
    Tree &tree = trees[turn], &other = trees[1 - turn];
    const int added = extend(tree, q);
    if (added < 0) continue;
    const VectorXd target = tree.node(added);
    int last = extend(other, target);
    while (last >= 0 && !reached && elapsed() < request.seconds) last = extend(other, target);
    if (last < 0 || !reached) continue;
    plan.path = trees[0].pathTo(turn == 0 ? added : last);
    const std::vector<VectorXd> second = trees[1].pathTo(turn == 0 ? last : added);
    plan.path.insert(plan.path.end(), second.rbegin() + 1, second.rend());
    break;
  }
  plan.seconds = elapsed();
  return plan;
}

}  // namespace kios::bench
