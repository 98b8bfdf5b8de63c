// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>
#include <vector>

namespace kios::bench {

/// Samples 0.01 rad apart in the largest joint, in the order of OMPL's discrete validator: the end,
/// then by halves. Returns the first that isn't free, or an empty vector.
template <typename IsFree>
Eigen::VectorXd sampleInContact(const IsFree& is_free, const Eigen::VectorXd& q0,
                                const Eigen::VectorXd& q1) {
  constexpr double kStep = 0.01;
  if (!is_free(q1)) return q1;
  const int steps = static_cast<int>(std::ceil((q1 - q0).lpNorm<Eigen::Infinity>() / kStep - 1e-9));
  std::vector<std::pair<int, int>> waiting = {{1, steps - 1}};
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    const auto [low, high] = waiting[next];
    if (low > high) continue;
    const int middle = (low + high) / 2;
    Eigen::VectorXd q = q0 + static_cast<double>(middle) / steps * (q1 - q0);
    if (!is_free(q)) return q;
    waiting.emplace_back(low, middle - 1);
    waiting.emplace_back(middle + 1, high);
  }
  return {};
}

}  // namespace kios::bench
