// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/call_recorder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace kios::preload {
namespace {

constexpr const char* kQuestions[] = {"collide", "distance"};

/// Returns the size of numbers that a distance is computed from.
double scaleOf(const PosedPair& pair) {
  return 1 + pair.X_WA.translation().norm() + pair.X_WB.translation().norm();
}

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool areMeshes(const PosedPair& pair) {
  return pair.a->getObjectType() == fcl::OT_BVH && pair.b->getObjectType() == fcl::OT_BVH;
}

}  // namespace

void CallRecorder::compare(const PosedPair& pair, const CollisionRequest& /*request*/,
                           const CollisionResult& ours, const CollisionResult& fcls) {
  const char* what = nullptr;
  if (ours.isCollision() != fcls.isCollision()) {
    what = "the verdict";
  } else if (ours.numContacts() != fcls.numContacts()) {
    what = "the number of contacts";
  } else if (ours.isCollision() && pair.a->getNodeType() != fcl::BV_RSS) {
    // FCL's models over RSS are copies, gone by now.
    const auto &mine = ours.getContact(0), &theirs = fcls.getContact(0);
    if (mine.o1 != theirs.o1 || mine.o2 != theirs.o2) what = "the order of the objects";
  }
  if (!what) return;
  countsOf(ours).differences.fetch_add(1, std::memory_order_relaxed);
  std::fprintf(stderr,
               "fcl_kios_preload: collide of %p and %p differs in %s: %zu contacts, FCL %zu.\n",
               static_cast<const void*>(pair.a), static_cast<const void*>(pair.b), what,
               ours.numContacts(), fcls.numContacts());
}

void CallRecorder::compare(const PosedPair& pair, const DistanceRequest& request,
                           const DistanceResult& ours, const DistanceResult& fcls) {
  // FCL's solvers for shapes are as exact as the request asks.
  const double tolerance =
      scaleOf(pair) * (areMeshes(pair) ? 1e-12 : std::max(1e-5, 10 * request.distance_tolerance));
  const double difference = std::abs(ours.min_distance - fcls.min_distance);
  const bool agree = difference <= tolerance || ours.min_distance == fcls.min_distance;
  // A bound on entry may be lowered by one of the two alone, by a rounding.
  const auto isAnswer = [&](const DistanceResult& result) {
    return (result.o1 == pair.a && result.o2 == pair.b) ||
           (result.o1 == pair.b && result.o2 == pair.a);
  };
  const bool ordered = ours.o1 == fcls.o1 || !isAnswer(ours) || !isAnswer(fcls);
  if (agree && ordered) return;
  countsOf(ours).differences.fetch_add(1, std::memory_order_relaxed);
  std::fprintf(stderr, "fcl_kios_preload: distance of %p and %p differs%s: %.17g, FCL %.17g.\n",
               static_cast<const void*>(pair.a), static_cast<const void*>(pair.b),
               agree ? " in its objects" : "", ours.min_distance, fcls.min_distance);
}

void CallRecorder::report() const {
  for (int i = 0; i < 2; ++i) {
    const Counts& counts = counts_[i];
    const auto queries = [&](By by) {
      return static_cast<unsigned long long>(
          counts.queries[static_cast<int>(by)].load(std::memory_order_relaxed));
    };
    std::fprintf(
        stderr, "fcl_kios_preload: %s: %llu by k-IOS, %llu by FCL's volumes, %llu handed to FCL",
        kQuestions[i], queries(By::kCopies), queries(By::kFclSearch), queries(By::kHandedOn));
    if (verify_) {
      std::fprintf(stderr, "; %llu differences",
                   static_cast<unsigned long long>(counts.differences.load()));
    }
    const auto probes = std::min<std::uint64_t>(counts.probes.load(), std::size(counts.times));
    if (!verify_ && probes > 0) {
      std::vector<double> ours, fcls, saved;
      for (std::uint64_t k = 0; k < probes; ++k) {
        const Times times = counts.times[k].load();
        ours.push_back(times.ours);
        fcls.push_back(times.fcl);
        saved.push_back(double{times.fcl} - double{times.ours});
      }
      std::fprintf(stderr,
                   "; %.3g us a query, FCL %.3g us, about %.3g s of CPU time saved (medians)",
                   medianOf(ours) * 1e-3, medianOf(fcls) * 1e-3,
                   medianOf(saved) * 1e-9 * static_cast<double>(queries(By::kCopies)));
    }
    std::fprintf(stderr, ".\n");
  }
  std::fprintf(stderr, "fcl_kios_preload: %zu copies of %.1f MiB.\n",
               implementation_.copies.count(),
               static_cast<double>(implementation_.copies.bytes()) / (1 << 20));
}

}  // namespace kios::preload
