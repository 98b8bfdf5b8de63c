// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "fcl_kios/paper.h"

namespace kios::testing {

/// Returns every method with every choice of k, own and shared radii, and two other angles.
inline std::vector<FitOptions> allFits() {
  std::vector<FitOptions> fits;
  for (const auto method :
       {FitMethod::kTuned, FitMethod::kMethodI, FitMethod::kMethodIAtAngle, FitMethod::kMethodII}) {
    for (const auto count : {SphereCount::kByRatio, SphereCount::kAll, SphereCount::kByGain}) {
      for (const bool shared : {false, true}) {
        FitOptions options = method;
        options.count = count;
        options.shared_radius = shared;
        fits.push_back(options);
      }
    }
  }
  for (const double angle : {0.004, 1.3}) {
    for (const auto method :
         {FitMethod::kTuned, FitMethod::kMethodIAtAngle, FitMethod::kMethodII}) {
      fits.emplace_back(method);
      fits.back().angle = angle;
    }
  }
  return fits;
}

inline std::string nameOf(const FitOptions& options) {
  const char* const methods[] = {"tuned", "Method I", "Method I at angle", "Method II"};
  const char* const counts[] = {"by ratio", "all", "by gain"};
  return std::string(methods[static_cast<int>(options.method)]) + ", k " +
         counts[static_cast<int>(options.count)] +
         (options.shared_radius ? ", shared radius" : "") + ", angle " +
         std::to_string(options.angle);
}

}  // namespace kios::testing
