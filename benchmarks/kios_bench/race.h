// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace kios::bench {

/// Holds one way to answer the questions of a task: with a bounding volume, a library, a call.
struct Competitor {
  std::string name;  ///< `bv` of its rows
  /// Answers questions [begin, end), each with a fresh request and result. This alone is timed.
  std::function<void(std::size_t begin, std::size_t end)> answer;
  /// Called before each block, outside of the time; may be empty.
  std::function<void(std::size_t begin, std::size_t end)> before = {};
  /// A slow competitor answers one step in so many.
  std::size_t stride = 1;
  /// It answers so many times in a repeat, and the least time of each step counts: noise that comes
  /// and goes is left out.
  int rounds = 1;
  /// Microseconds by repeat and step, 0 where it did not answer.
  std::vector<std::vector<double>> us = {};
};

/// Returns an answer that asks about one question after the other.
template <typename Ask>
auto each(Ask ask) {
  return [ask](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ask(i);
  };
}

/// Competitors take turns: in each repeat at blocks of questions, each block with another one
/// first. The clock is read at every step, at most a block long.
struct Race {
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  std::size_t questions = 1;
  int repeats = 1;
  std::size_t block = kAll;
  std::size_t step = kAll;
  /// Each competitor answers all once before: what models leave to their first query belongs to no
  /// repeat.
  bool warm_up = false;
  bool wall_clock = false;  ///< where answers take several threads; else this thread's CPU time

  /// Sets `us` of the competitors.
  void run(std::vector<Competitor>& competitors) const;
};

/// The times of a row are those of a frame.
struct Times {
  double median_us = 0, min_us = 0;           ///< over repeats
  std::optional<double> ratio_to_fcl_obbrss;  ///< above 1: faster than FCL's OBBRSS
  std::vector<double> repeats_us = {};        ///< by repeat
};

/// Returns the time of each repeat by the number of frames that it answers. The ratio is to the
/// reference, if there is one: its time by the competitor's, in steps that both answered, median
/// over repeats.
Times timesOf(const Competitor& competitor, std::size_t frames, const Competitor* reference);

/// Returns the competitor of this name, nullptr if there is none.
const Competitor* named(const std::string& name, const std::vector<Competitor>& competitors);

/// Returns this thread's CPU time where the system has it, so that other programs disturb it least.
double nowMicroseconds();

double median(std::vector<double> values);

}  // namespace kios::bench
