// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// the implementation's entry: its four calls, of which the interposer chooses none and FCL's own
// all.
#include "preload/call_recorder.h"
#include "preload/implementation.h"
#include "preload/layout.h"

namespace kios::preload {
namespace {

// Never destroyed: objects that outlive it may still be asked about.
Implementation* implementation = nullptr;
CallRecorder* recorder = nullptr;

bool isServed(const Object* a, const Object* b) {
  return a && b && preload::isServed(a->collisionGeometry().get(), b->collisionGeometry().get());
}

PosedPair pairOf(const Object& a, const Object& b) {
  return {a.collisionGeometry().get(), a.getTransform(), b.collisionGeometry().get(),
          b.getTransform()};
}

std::size_t collideObjects(const Object* a, const Object* b, const CollisionRequest& request,
                           CollisionResult& result) {
  if (!isServed(a, b) ||
      implementation->collide(pairOf(*a, *b), request, result) == By::kHandedOn) {
    return implementation->start.fcl.collide_objects(a, b, request, result);
  }
  return result.numContacts();
}

std::size_t collide(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                    const CollisionRequest& request, CollisionResult& result) {
  if (!preload::isServed(a, b) ||
      implementation->collide({a, X_WA, b, X_WB}, request, result) == By::kHandedOn) {
    return implementation->start.fcl.collide(a, X_WA, b, X_WB, request, result);
  }
  return result.numContacts();
}

double distanceObjects(const Object* a, const Object* b, const DistanceRequest& request,
                       DistanceResult& result) {
  if (!isServed(a, b) ||
      implementation->distance(pairOf(*a, *b), request, result) == By::kHandedOn) {
    return implementation->start.fcl.distance_objects(a, b, request, result);
  }
  return result.min_distance;
}

double distance(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                const DistanceRequest& request, DistanceResult& result) {
  if (!preload::isServed(a, b) ||
      implementation->distance({a, X_WA, b, X_WB}, request, result) == By::kHandedOn) {
    return implementation->start.fcl.distance(a, X_WA, b, X_WB, request, result);
  }
  return result.min_distance;
}

// These do the same, and record it.

std::size_t collideObjectsRecorded(const Object* a, const Object* b,
                                   const CollisionRequest& request, CollisionResult& result) {
  const auto ask_fcl = [&](CollisionResult& r) {
    return implementation->start.fcl.collide_objects(a, b, request, r);
  };
  return isServed(a, b) ? recorder->collide(pairOf(*a, *b), request, result, ask_fcl)
                        : ask_fcl(result);
}

std::size_t collideRecorded(const Geometry* a, const Pose& X_WA, const Geometry* b,
                            const Pose& X_WB, const CollisionRequest& request,
                            CollisionResult& result) {
  const auto ask_fcl = [&](CollisionResult& r) {
    return implementation->start.fcl.collide(a, X_WA, b, X_WB, request, r);
  };
  if (!preload::isServed(a, b)) return ask_fcl(result);
  return recorder->collide({a, X_WA, b, X_WB}, request, result, ask_fcl);
}

double distanceObjectsRecorded(const Object* a, const Object* b, const DistanceRequest& request,
                               DistanceResult& result) {
  const auto ask_fcl = [&](DistanceResult& r) {
    return implementation->start.fcl.distance_objects(a, b, request, r);
  };
  return isServed(a, b) ? recorder->distance(pairOf(*a, *b), request, result, ask_fcl)
                        : ask_fcl(result);
}

double distanceRecorded(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                        const DistanceRequest& request, DistanceResult& result) {
  const auto ask_fcl = [&](DistanceResult& r) {
    return implementation->start.fcl.distance(a, X_WA, b, X_WB, request, r);
  };
  if (!preload::isServed(a, b)) return ask_fcl(result);
  return recorder->distance({a, X_WA, b, X_WB}, request, result, ask_fcl);
}

struct ReportAtExit {
  ~ReportAtExit() {
    if (recorder) recorder->report();
  }
} report_at_exit;

constexpr Calls kCalls = {&collideObjects, &collide, &distanceObjects, &distance};
constexpr Forks kForks = {[] { implementation->copies.beforeFork(); },
                          [] { implementation->copies.afterFork(); },
                          [] { implementation->copies.afterForkInChild(); }};
constexpr Calls kRecorded = {&collideObjectsRecorded, &collideRecorded, &distanceObjectsRecorded,
                             &distanceRecorded};

}  // namespace
}  // namespace kios::preload

/// Is called once.
extern "C" __attribute__((visibility("default"))) kios::preload::Opened fcl_kios_preload_open(
    const kios::preload::Start* start) {
  using namespace kios::preload;
  if (const char* const difference = differenceOf(start->fcl)) return {nullptr, {}, difference};
  implementation = new Implementation(*start);
  if (start->mode != Mode::kVerify && start->mode != Mode::kStats)
    return {&kCalls, kForks, nullptr};
  recorder = new CallRecorder(*implementation);
  return {&kRecorded, kForks, nullptr};
}
