// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rrt_connect.h"

#include <optional>
#include <random>

#include "race.h"

namespace kios::bench {
namespace {

using Eigen::VectorXd;

/// Nodes side by side in memory, as all are looked at to find the nearest.
class Tree {
 public:
  explicit Tree(const VectorXd& root) : size_(root.size()) { add(root); }

  void add(const VectorXd& q) {
    coordinates_.insert(coordinates_.end(), q.data(), q.data() + size_);
    ++count_;
  }
  Eigen::Index count() const { return count_; }
  VectorXd nearest(const VectorXd& q) const {
    const Eigen::Map<const Eigen::MatrixXd> nodes(coordinates_.data(), size_, count_);
    Eigen::Index best = 0;
    (nodes.colwise() - q).colwise().squaredNorm().minCoeff(&best);
    return nodes.col(best);
  }

 private:
  Eigen::Index size_, count_ = 0;
  std::vector<double> coordinates_;
};

}  // namespace

Plan rrtConnect(const PlanRequest& request, const IsFreeEdge& is_free) {
  const double begin = nowMicroseconds();
  Plan plan;
  const auto elapsed = [&] { return 1e-6 * (nowMicroseconds() - begin); };
  std::mt19937_64 random(request.seed);
  Tree trees[2] = {Tree(request.start), Tree(request.goal)};
  // Where one step of a tree towards q ends; nothing if it is blocked.
  const auto extend = [&](Tree& tree, const VectorXd& q) -> std::optional<VectorXd> {
    const VectorXd from = tree.nearest(q);
    const double length = (q - from).norm();
    const VectorXd to =
        length <= request.range ? q : VectorXd(from + request.range / length * (q - from));
    if (!is_free(from, to)) return std::nullopt;
    tree.add(to);
    plan.free_edges.emplace_back(from, to);
    return to;
  };
  for (int turn = 0; !plan.solved && elapsed() < request.seconds; turn = 1 - turn) {
    VectorXd q(request.start.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      q[k] = std::uniform_real_distribution<double>(request.lower[k], request.upper[k])(random);
    }
    // The very first goal is the other tree's root, which solves what is easy.
    if (trees[0].count() + trees[1].count() == 2) q = request.goal;
    const auto target = extend(trees[turn], q);
    if (!target) continue;
    std::optional<VectorXd> last;
    do {
      last = extend(trees[1 - turn], *target);
      plan.solved = last && *last == *target;
    } while (last && !plan.solved && elapsed() < request.seconds);
  }
  plan.seconds = elapsed();
  return plan;
}

}  // namespace kios::bench
