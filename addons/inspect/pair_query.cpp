// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair_query.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace kios::inspect {

fcl::Transform3d parsePose(const std::string& text) {
  std::vector<double> numbers;
  const auto refuse = [&](const std::string& what) {
    return std::invalid_argument("'" + text + "' is no pose: " + what);
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    std::size_t read = 0;
    try {
      numbers.push_back(std::stod(part, &read));
    } catch (const std::exception&) {
      read = std::string::npos;
    }
    if (read != part.size() || !std::isfinite(numbers.back())) {
      throw refuse("'" + part + "' is not a finite number.");
    }
    begin = end + 1;
  }
  if (numbers.size() != 3 && numbers.size() != 7) {
    throw refuse("write x,y,z or x,y,z,qw,qx,qy,qz, without spaces.");
  }
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = fcl::Vector3d(numbers[0], numbers[1], numbers[2]);
  if (numbers.size() == 7) {
    fcl::Quaterniond q(numbers[3], numbers[4], numbers[5], numbers[6]);
    if (std::abs(q.norm() - 1) > 0.01) {
      throw refuse("its quaternion has length " + std::to_string(q.norm()) + ", not 1.");
    }
    pose.linear() = q.normalized().toRotationMatrix();
  }
  return pose;
}

PairQuery queryPair(const Modeld& a, const fcl::Transform3d& X_WA, const Modeld& b,
                    const fcl::Transform3d& X_WB, int repeats) {
  using Clock = std::chrono::steady_clock;
  PairQuery result;
  result.X_WA = X_WA;
  result.X_WB = X_WB;
  result.repeats = repeats;
  std::vector<double> seconds;
  try {
    // The first one touches what the others find in the caches.
    result.answer = distanceBracket(a, X_WA, b, X_WB);
    for (int i = 0; i < repeats; ++i) {
      const Clock::time_point begin = Clock::now();
      result.answer = distanceBracket(a, X_WA, b, X_WB);
      seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  }
  std::sort(seconds.begin(), seconds.end());
  result.min_seconds = seconds.front();
  result.median_seconds = seconds[seconds.size() / 2];
  return result;
}

}  // namespace kios::inspect
