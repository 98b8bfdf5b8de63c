// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The back's entry: its four calls, of which the front chooses none and FCL's own all.
#include "preload/back.h"
#include "preload/layout.h"
#include "preload/watch.h"

namespace kios::preload {
namespace {

// Never destroyed: objects that outlive it may still be asked about.
Back* back = nullptr;
Watch* watch = nullptr;

bool isServed(const Object* a, const Object* b) {
  return a && b && preload::isServed(a->collisionGeometry().get(), b->collisionGeometry().get());
}

Pair pairOf(const Object& a, const Object& b) {
  return {a.collisionGeometry().get(), a.getTransform(), b.collisionGeometry().get(),
          b.getTransform()};
}

std::size_t collideObjects(const Object* a, const Object* b, const CollisionRequest& request,
                           CollisionResult& result) {
  if (!isServed(a, b) || back->collide(pairOf(*a, *b), request, result) == By::kHandedOn) {
    return back->start.fcl.collide_objects(a, b, request, result);
  }
  return result.numContacts();
}

std::size_t collide(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                    const CollisionRequest& request, CollisionResult& result) {
  if (!preload::isServed(a, b) ||
      back->collide({a, X_WA, b, X_WB}, request, result) == By::kHandedOn) {
    return back->start.fcl.collide(a, X_WA, b, X_WB, request, result);
  }
  return result.numContacts();
}

double distanceObjects(const Object* a, const Object* b, const DistanceRequest& request,
                       DistanceResult& result) {
  if (!isServed(a, b) || back->distance(pairOf(*a, *b), request, result) == By::kHandedOn) {
    return back->start.fcl.distance_objects(a, b, request, result);
  }
  return result.min_distance;
}

double distance(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                const DistanceRequest& request, DistanceResult& result) {
  if (!preload::isServed(a, b) ||
      back->distance({a, X_WA, b, X_WB}, request, result) == By::kHandedOn) {
    return back->start.fcl.distance(a, X_WA, b, X_WB, request, result);
  }
  return result.min_distance;
}

// These do the same, and are watched.

std::size_t collideObjectsWatched(const Object* a, const Object* b, const CollisionRequest& request,
                                  CollisionResult& result) {
  const auto ask_fcl = [&](CollisionResult& r) {
    return back->start.fcl.collide_objects(a, b, request, r);
  };
  return isServed(a, b) ? watch->collide(pairOf(*a, *b), request, result, ask_fcl)
                        : ask_fcl(result);
}

std::size_t collideWatched(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                           const CollisionRequest& request, CollisionResult& result) {
  const auto ask_fcl = [&](CollisionResult& r) {
    return back->start.fcl.collide(a, X_WA, b, X_WB, request, r);
  };
  if (!preload::isServed(a, b)) return ask_fcl(result);
  return watch->collide({a, X_WA, b, X_WB}, request, result, ask_fcl);
}

double distanceObjectsWatched(const Object* a, const Object* b, const DistanceRequest& request,
                              DistanceResult& result) {
  const auto ask_fcl = [&](DistanceResult& r) {
    return back->start.fcl.distance_objects(a, b, request, r);
  };
  return isServed(a, b) ? watch->distance(pairOf(*a, *b), request, result, ask_fcl)
                        : ask_fcl(result);
}

double distanceWatched(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                       const DistanceRequest& request, DistanceResult& result) {
  const auto ask_fcl = [&](DistanceResult& r) {
    return back->start.fcl.distance(a, X_WA, b, X_WB, request, r);
  };
  if (!preload::isServed(a, b)) return ask_fcl(result);
  return watch->distance({a, X_WA, b, X_WB}, request, result, ask_fcl);
}

struct ReportAtExit {
  ~ReportAtExit() {
    if (watch) watch->report();
  }
} report_at_exit;

constexpr Calls kCalls = {&collideObjects, &collide, &distanceObjects, &distance};
constexpr Forks kForks = {[] { back->twins.beforeFork(); }, [] { back->twins.afterFork(); },
                          [] { back->twins.afterForkInChild(); }};
constexpr Calls kWatched = {&collideObjectsWatched, &collideWatched, &distanceObjectsWatched,
                            &distanceWatched};

}  // namespace
}  // namespace kios::preload

/// Is called once.
extern "C" __attribute__((visibility("default"))) kios::preload::Opened fcl_kios_preload_open(
    const kios::preload::Start* start) {
  using namespace kios::preload;
  if (const char* const difference = differenceOf(start->fcl)) return {nullptr, {}, difference};
  back = new Back(*start);
  if (start->mode != Mode::kVerify && start->mode != Mode::kStats)
    return {&kCalls, kForks, nullptr};
  watch = new Watch(*back);
  return {&kWatched, kForks, nullptr};
}
