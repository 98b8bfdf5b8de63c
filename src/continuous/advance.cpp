// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/advance.h"

#include <algorithm>
#include <cmath>

#include "volume/errors.h"

namespace kios::continuous {

FirstContact advance(MovingPair& pair, double toc_err, ContinuousCounts& counts) {
  require(toc_err >= 0, "ContinuousCollisionRequest::toc_err", toc_err, ">= 0");
  constexpr long long kMostSteps = 20000;
  constexpr double kSmall = 0.25, kShort = 0x1p-13;  // there are few longer steps
  const double tolerance = std::clamp(toc_err, 0x1p-48, 1.0);
  const double least = std::max(0x1p-20 * tolerance, 0x1p-52);

  const auto touching = [&](double t) {
    ++counts.collision_tests;
    return pair.touching(t);
  };
  if (touching(0)) return {true, 0};
  double t = 0, look_from = 0;
  for (long long short_steps = 0;;) {
    const double h = pair.apartFor(t, kSmall * tolerance);
    ++counts.steps;
    if (h >= 1 - t) return {false, 1};
    // Small steps: a contact is near, or the two pass each other closely.
    if (h < kSmall * tolerance && t >= look_from) {
      if (touching(std::min(1.0, t + tolerance))) return {true, t};
      look_from = t + 0.5 * tolerance;
    }
    short_steps += h < kShort ? 1 : 0;
    if (h < least || short_steps > kMostSteps) return {true, t};
    double next = t + h;
    if (next - t > h) next = std::nextafter(next, 0.0);
    t = next;
  }
}

}  // namespace kios::continuous
