// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "preload/back.h"

namespace kios::preload {

/// Mode::kVerify asks both, gives the program FCL's answer and says on stderr where the other
/// differs. Mode::kStats counts who answers, and asks FCL, too, once in a hundred times.
class Watch {
 public:
  explicit Watch(Back& back) : back_(back), verify_(back.start.mode == Mode::kVerify) {}

  template <typename AskFcl>
  std::size_t collide(const Pair& pair, const CollisionRequest& request, CollisionResult& result,
                      const AskFcl& ask_fcl) {
    return watch(
        result, counts_[0], ask_fcl,
        [&](CollisionResult& r) { return back_.collide(pair, request, r); },
        [](const CollisionResult& r) { return r.numContacts(); },
        [&](const CollisionResult& ours, const CollisionResult& fcls) {
          compare(pair, request, ours, fcls);
        });
  }

  template <typename AskFcl>
  double distance(const Pair& pair, const DistanceRequest& request, DistanceResult& result,
                  const AskFcl& ask_fcl) {
    return watch(
        result, counts_[1], ask_fcl,
        [&](DistanceResult& r) { return back_.distance(pair, request, r); },
        [](const DistanceResult& r) { return r.min_distance; },
        [&](const DistanceResult& ours, const DistanceResult& fcls) {
          compare(pair, request, ours, fcls);
        });
  }

  /// Prints the counts.
  void report() const;

 private:
  struct Counts {
    std::atomic<std::uint64_t> queries[3] = {};        ///< by who answered
    std::atomic<std::uint64_t> probes{0};              ///< of which both were timed
    std::atomic<std::uint64_t> ours_ns{0}, fcl_ns{0};  ///< of those
    std::atomic<std::uint64_t> differences{0};
  };

  template <typename Result, typename AskFcl, typename AskBack, typename Value, typename Compare>
  auto watch(Result& result, Counts& counts, const AskFcl& ask_fcl, const AskBack& ask_back,
             const Value& value, const Compare& differ) {
    using Clock = std::chrono::steady_clock;
    constexpr std::uint64_t kProbeEvery = 100;
    Result ours = result;
    const Clock::time_point start = Clock::now();
    const By by = ask_back(ours);
    const Clock::time_point end = Clock::now();
    const std::uint64_t n =
        counts.queries[static_cast<int>(by)].fetch_add(1, std::memory_order_relaxed);
    if (by == By::kHandedOn) return ask_fcl(result);
    const bool probes = by == By::kTwins && n % kProbeEvery == kProbeEvery / 2;
    if (!verify_ && !probes) {
      result = ours;
      return value(ours);
    }
    Result fcls = result;
    const Clock::time_point fcl_start = Clock::now();
    const auto fcls_value = ask_fcl(fcls);
    if (probes) {
      add(counts.fcl_ns, Clock::now() - fcl_start);
      add(counts.ours_ns, end - start);
      counts.probes.fetch_add(1, std::memory_order_relaxed);
    }
    if (!verify_) {
      result = ours;
      return value(ours);
    }
    differ(ours, fcls);
    result = fcls;
    return fcls_value;
  }

  static void add(std::atomic<std::uint64_t>& sum, std::chrono::nanoseconds time) {
    sum.fetch_add(static_cast<std::uint64_t>(time.count()), std::memory_order_relaxed);
  }

  void compare(const Pair& pair, const CollisionRequest& request, const CollisionResult& ours,
               const CollisionResult& fcls);
  void compare(const Pair& pair, const DistanceRequest& request, const DistanceResult& ours,
               const DistanceResult& fcls);

  Back& back_;
  const bool verify_;
  Counts counts_[2];
};

}  // namespace kios::preload
