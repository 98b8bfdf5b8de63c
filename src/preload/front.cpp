// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The four functions that stand in for libfcl's.
#include <pthread.h>

#include "preload/calls.h"
#include "preload/fits.h"
#include "preload/names.h"
#include "preload/reach.h"

namespace kios::preload {
namespace {

std::atomic<const Calls*> calls{nullptr};
pthread_mutex_t choosing = PTHREAD_MUTEX_INITIALIZER;
Forks forks = {};  // guarded by it
Mode mode = Mode::kOff;

pthread_once_t started = PTHREAD_ONCE_INIT;

// Forks wait for the choice, and then for what the back does.
void beforeFork() {
  pthread_mutex_lock(&choosing);
  if (forks.before) forks.before();
}
void afterForkInParent() {
  if (forks.in_parent) forks.in_parent();
  pthread_mutex_unlock(&choosing);
}
void afterForkInChild() {
  if (forks.in_child) forks.in_child();
  pthread_mutex_unlock(&choosing);
}

void readEnvironment() {
  pthread_atfork(&beforeFork, &afterForkInParent, &afterForkInChild);
  mode = modeOfEnvironment();
  if (mode != Mode::kOff) reportReach();
  if (mode == Mode::kTrust) countFits();
}

/// Also called by the first query, which another library's constructor may make before this one.
__attribute__((constructor)) void start() { pthread_once(&started, &readEnvironment); }

template <typename Call>
void find(Call& call, const char* name, const void* caller) {
  call = reinterpret_cast<Call>(nextDefinition(name, caller));
}

/// At the first query: FCL's own functions, and the back's unless FCL is another one.
const Calls* choose(const void* caller) {
  start();
  pthread_mutex_lock(&choosing);
  const Calls* chosen = calls.load(std::memory_order_relaxed);
  if (!chosen) {
    static Start back;
    find(back.fcl.collide_objects, KIOS_COLLIDE_OBJECTS, caller);
    find(back.fcl.collide, KIOS_COLLIDE, caller);
    find(back.fcl.distance_objects, KIOS_DISTANCE_OBJECTS, caller);
    find(back.fcl.distance, KIOS_DISTANCE, caller);
    back.mode = mode;
    back.fits = &fits();
    const void* const all[] = {reinterpret_cast<const void*>(back.fcl.collide_objects),
                               reinterpret_cast<const void*>(back.fcl.collide),
                               reinterpret_cast<const void*>(back.fcl.distance_objects),
                               reinterpret_cast<const void*>(back.fcl.distance)};
    bool reached = mode != Mode::kOff;
    for (const void* const definition : all) reached = reached && isOfLibfcl(definition);
    if (reached) {
      const Opened opened = openBack(back);
      chosen = opened.calls;
      forks = opened.forks;
    }
    if (!chosen) chosen = &back.fcl;
    calls.store(chosen, std::memory_order_release);
  }
  pthread_mutex_unlock(&choosing);
  return chosen;
}

}  // namespace

// Written out where the caller's place is known; it is asked for once.
#define KIOS_CALLS()                                           \
  const Calls* chosen = calls.load(std::memory_order_acquire); \
  if (__builtin_expect(!chosen, 0)) chosen = choose(__builtin_return_address(0))

#define KIOS_STANDS_FOR(name) __asm__(name) __attribute__((visibility("default"), used))

std::size_t collideObjects(const Object*, const Object*, const CollisionRequest&, CollisionResult&)
    KIOS_STANDS_FOR(KIOS_COLLIDE_OBJECTS);
std::size_t collide(const Geometry*, const Pose&, const Geometry*, const Pose&,
                    const CollisionRequest&, CollisionResult&) KIOS_STANDS_FOR(KIOS_COLLIDE);
double distanceObjects(const Object*, const Object*, const DistanceRequest&, DistanceResult&)
    KIOS_STANDS_FOR(KIOS_DISTANCE_OBJECTS);
double distance(const Geometry*, const Pose&, const Geometry*, const Pose&, const DistanceRequest&,
                DistanceResult&) KIOS_STANDS_FOR(KIOS_DISTANCE);

std::size_t collideObjects(const Object* a, const Object* b, const CollisionRequest& request,
                           CollisionResult& result) {
  KIOS_CALLS();
  return chosen->collide_objects(a, b, request, result);
}

std::size_t collide(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                    const CollisionRequest& request, CollisionResult& result) {
  KIOS_CALLS();
  return chosen->collide(a, X_WA, b, X_WB, request, result);
}

double distanceObjects(const Object* a, const Object* b, const DistanceRequest& request,
                       DistanceResult& result) {
  KIOS_CALLS();
  return chosen->distance_objects(a, b, request, result);
}

double distance(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                const DistanceRequest& request, DistanceResult& result) {
  KIOS_CALLS();
  return chosen->distance(a, X_WA, b, X_WB, request, result);
}

}  // namespace kios::preload
