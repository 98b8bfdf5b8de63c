// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "fcl_kios/robot/robot.h"

namespace kios::bench {

/// A planning problem of MotionBenchMaker.
struct Problem {
  std::string name;             ///< its kind and number
  std::filesystem::path scene;  ///< MoveIt's planning scene
  Eigen::VectorXd start, goal;  ///< by the robot's coordinates
};

/// The problems of a folder of kinds, evenly chosen of each kind and the kinds in turn: so many, or
/// as few more as there are kinds. Throws std::runtime_error for a request that doesn't name every
/// coordinate.
std::vector<Problem> readProblems(const std::filesystem::path& folder, const Robot& robot,
                                  std::size_t wanted);

/// A folder of its own into which an archive is unpacked by tar, and which goes with it.
class Unpacked {
 public:
  /// Throws std::runtime_error if tar can't.
  explicit Unpacked(const std::filesystem::path& archive);
  ~Unpacked();
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace kios::bench
