// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The implementation's entry: its four calls, or FCL's own, of which the interposer chooses all or
// none.
#include "preload/call_recorder.h"
#include "preload/implementation.h"

namespace kios::preload {
namespace {

using preload::isServed;

// Never destroyed: objects that outlive it may still be asked about.
Implementation* implementation = nullptr;
CallRecorder* recorder = nullptr;

bool isServed(const Object* a, const Object* b) {
  return a && b && isServed(a->collisionGeometry().get(), b->collisionGeometry().get());
}

PosedPair pairOf(const Object& a, const Object& b) {
  return {a.collisionGeometry().get(), a.getTransform(), b.collisionGeometry().get(),
          b.getTransform()};
}

/// Answers about a pair that isServed(), by FCL where the implementation hands it on.
template <typename Request, typename Result, typename AskFcl>
auto answer(const PosedPair& pair, const Request& request, Result& result, const AskFcl& ask_fcl) {
  if (recorder) return recorder->answer(pair, request, result, ask_fcl);
  if (implementation->answer(pair, request, result) == By::kHandedOn) return ask_fcl(result);
  return valueOf(result);
}

template <auto kCall, typename Request, typename Result>
auto askObjects(const Object* a, const Object* b, const Request& request, Result& result) {
  const auto ask_fcl = [&](Result& r) {
    return (implementation->start.fcl.*kCall)(a, b, request, r);
  };
  if (!isServed(a, b)) return ask_fcl(result);
  return answer(pairOf(*a, *b), request, result, ask_fcl);
}

template <auto kCall, typename Request, typename Result>
auto ask(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
         const Request& request, Result& result) {
  const auto ask_fcl = [&](Result& r) {
    return (implementation->start.fcl.*kCall)(a, X_WA, b, X_WB, request, r);
  };
  if (!isServed(a, b)) return ask_fcl(result);
  return answer({a, X_WA, b, X_WB}, request, result, ask_fcl);
}

struct ReportAtExit {
  ~ReportAtExit() {
    if (recorder) recorder->report();
  }
} report_at_exit;

constexpr Calls kCalls = {&askObjects<&Calls::collide_objects, CollisionRequest, CollisionResult>,
                          &ask<&Calls::collide, CollisionRequest, CollisionResult>,
                          &askObjects<&Calls::distance_objects, DistanceRequest, DistanceResult>,
                          &ask<&Calls::distance, DistanceRequest, DistanceResult>};
constexpr Forks kForks = {[] { implementation->copies.beforeFork(); },
                          [] { implementation->copies.afterFork(); },
                          [] { implementation->copies.afterForkInChild(); }};

}  // namespace
}  // namespace kios::preload

/// Is called once.
extern "C" __attribute__((visibility("default"))) kios::preload::Opened fcl_kios_preload_open(
    const kios::preload::Start* start) {
  using namespace kios::preload;
  if (const char* const difference = differenceOf(start->fcl)) return {nullptr, {}, difference};
  implementation = new Implementation(*start);
  if (start->mode == Mode::kVerify || start->mode == Mode::kStats) {
    recorder = new CallRecorder(*implementation);
  }
  return {&kCalls, kForks, nullptr};
}
