// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <ctime>
#include <iterator>

#include "preload/implementation.h"

namespace kios::preload {

/// Mode::kVerify asks both, gives the program FCL's answer and says on stderr where the other
/// differs. Mode::kStats counts who answers, and asks FCL, too, once in a hundred times.
class CallRecorder {
 public:
  explicit CallRecorder(Implementation& implementation)
      : implementation_(implementation), verify_(implementation.start.mode == Mode::kVerify) {}

  /// Returns what the program is told; ask_fcl(result) asks FCL.
  template <typename Request, typename Result, typename AskFcl>
  auto answer(const PosedPair& pair, const Request& request, Result& result,
              const AskFcl& ask_fcl) {
    Counts& counts = countsOf(result);
    constexpr std::uint64_t kProbeEvery = 100;
    const std::uint64_t n =
        counts.queries[static_cast<int>(By::kCopies)].load(std::memory_order_relaxed);
    const bool may_probe = !verify_ && n % kProbeEvery == kProbeEvery / 2;
    Result ours = result;
    const double start = may_probe ? cpuTime() : 0;
    const By by = implementation_.answer(pair, request, ours);
    const double time_of_ours = may_probe ? cpuTime() - start : 0;
    counts.queries[static_cast<int>(by)].fetch_add(1, std::memory_order_relaxed);
    if (by == By::kHandedOn) return ask_fcl(result);
    if (may_probe && by == By::kCopies) {
      // FCL's tree is in no cache, unlike in a program without us: the second time counts.
      double time_of_fcl = 0;
      for (int i = 0; i < 2; ++i) {
        Result fcls = result;
        const double fcl_start = cpuTime();
        ask_fcl(fcls);
        time_of_fcl = cpuTime() - fcl_start;
      }
      const std::uint64_t at = counts.probes.fetch_add(1, std::memory_order_relaxed);
      counts.times[at % std::size(counts.times)].store(
          {static_cast<float>(time_of_ours), static_cast<float>(time_of_fcl)},
          std::memory_order_relaxed);
    }
    if (!verify_) {
      result = ours;
      return valueOf(ours);
    }
    Result fcls = result;
    const auto fcls_value = ask_fcl(fcls);
    compare(pair, request, ours, fcls);
    result = fcls;
    return fcls_value;
  }

  /// Prints the counts.
  void report() const;

 private:
  /// Holds the times of one query by both, in nanoseconds of the thread's CPU.
  struct Times {
    float ours, fcl;
  };
  struct Counts {
    std::atomic<std::uint64_t> queries[3] = {};  ///< by who answered
    std::atomic<std::uint64_t> probes{0};        ///< of which both were timed; the last are kept
    std::atomic<Times> times[1 << 10] = {};
    std::atomic<std::uint64_t> differences{0};
  };

  Counts& countsOf(const CollisionResult&) { return counts_[0]; }
  Counts& countsOf(const DistanceResult&) { return counts_[1]; }

  static double cpuTime() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
  }

  void compare(const PosedPair& pair, const CollisionRequest& request, const CollisionResult& ours,
               const CollisionResult& fcls);
  void compare(const PosedPair& pair, const DistanceRequest& request, const DistanceResult& ours,
               const DistanceResult& fcls);

  Implementation& implementation_;
  const bool verify_;
  Counts counts_[2];
};

}  // namespace kios::preload
