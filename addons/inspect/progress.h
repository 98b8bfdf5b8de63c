// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace kios::inspect {

/// Says on stderr what the program is at: on a terminal at once, on a line that the next step
/// overwrites; elsewhere, once more than a second has passed since it last said something, when a
/// step ends.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress() { done(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Ends the step before, and begins this one: "reading a.stl".
  void step(const std::string& what);
  /// Ends the last step; returns its seconds.
  double done();

 private:
  using Clock = std::chrono::steady_clock;
  const bool quiet_, terminal_;
  std::string what_;
  Clock::time_point begun_, said_;
};

}  // namespace kios::inspect
