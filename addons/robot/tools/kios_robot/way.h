// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fcl_kios/robot/robot.h"

namespace kios::robot_tool {

/// A path through configurations, from 0 to 1, each part as long as the others.
class Way {
 public:
  explicit Way(const std::vector<Eigen::VectorXd>& stops) : stops_(stops) {}

  int parts() const { return static_cast<int>(stops_.size()) - 1; }
  double timeOf(int stop) const { return static_cast<double>(stop) / parts(); }
  Eigen::VectorXd at(double s) const {
    const int part = std::clamp(static_cast<int>(s * parts()), 0, std::max(parts() - 1, 0));
    if (parts() == 0 || s <= timeOf(part)) return stops_[part];
    if (s >= timeOf(part + 1)) return stops_[part + 1];
    return stops_[part] + (s * parts() - part) * (stops_[part + 1] - stops_[part]);
  }
  /// Returns the answer of the first part that isn't clear, its times those of the whole path; its
  /// counts are those of all parts up to it.
  RobotMotion check(const Robot& robot, const MotionRequest& request) const {
    RobotMotion answer;
    long long configurations = 0, narrow_queries = 0;
    for (int part = 0; part < parts(); ++part) {
      answer = robot.checkMotion(stops_[part], stops_[part + 1], request);
      configurations += answer.counts.configurations;
      narrow_queries += answer.counts.narrow_queries;
      if (answer.verdict == MotionVerdict::kClear) continue;
      answer.from = (part + answer.from) / parts();
      answer.to = (part + answer.to) / parts();
      break;
    }
    answer.counts.configurations = configurations;
    answer.counts.narrow_queries = narrow_queries;
    return answer;
  }

 private:
  const std::vector<Eigen::VectorXd>& stops_;
};

/// In words, as pages and JSON have them.
inline const char* nameOf(MotionVerdict verdict) {
  constexpr const char* kNames[] = {"clear", "contact", "unresolved", "budget spent"};
  return kNames[static_cast<std::size_t>(verdict)];
}

}  // namespace kios::robot_tool
