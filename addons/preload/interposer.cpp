// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The four functions that stand in for libfcl's.
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <pthread.h>

#include "preload/calls.h"
#include "preload/names.h"
#include "preload/reach.h"
#include "preload/sites.h"

namespace kios::preload {
namespace {

std::atomic<const Calls*> calls{nullptr};
pthread_mutex_t choosing = PTHREAD_MUTEX_INITIALIZER;
Forks forks = {};  // guarded by it
Mode mode = Mode::kOff;

pthread_once_t started = PTHREAD_ONCE_INIT;

// Forks wait for the choice, and then for what the implementation does.
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
  if (mode != Mode::kOff) reportReach(mode);
  if (mode == Mode::kTrust) countFits();
}

/// Is also called by the first query, which another library's constructor may make before this one.
__attribute__((constructor)) void start() { pthread_once(&started, &readEnvironment); }

/// Stands in the place of a function that nobody can call, as the caller's FCL has none.
void undefined() {
  say("a function of FCL is called that its library lacks.");
  std::abort();
}

template <typename Call>
void find(Call& call, const char* name, const void* caller) {
  void* const found = findDefinition(name, caller);
  call = reinterpret_cast<Call>(found ? found : reinterpret_cast<void*>(&undefined));
}

Sites sites;
constexpr const char* kCalls = KIOS_COLLIDE;

const Calls* callsOf(const void* caller) {
  return static_cast<const Calls*>(sites.find(caller, kCalls));
}

/// The calls of the FCL that a caller has; `choosing` is locked. There are as many as FCLs.
const Calls& fclOf(const void* caller) {
  struct Known {
    Calls calls;
    Known* next;
  };
  static Known* first = nullptr;
  Calls found;
  find(found.collide_objects, KIOS_COLLIDE_OBJECTS, caller);
  find(found.collide, KIOS_COLLIDE, caller);
  find(found.distance_objects, KIOS_DISTANCE_OBJECTS, caller);
  find(found.distance, KIOS_DISTANCE, caller);
  for (const Known* known = first; known; known = known->next) {
    if (std::memcmp(&known->calls, &found, sizeof(Calls)) == 0) return known->calls;
  }
  auto* const known = static_cast<Known*>(std::malloc(sizeof(Known)));
  if (!known) std::abort();
  *known = {found, first};
  first = known;
  return known->calls;
}

/// Returns the implementation's calls, opened at most once, if these are libfcl's and the mode
/// isn't kOff. Only the copy of libfcl that is asked first is served.
const Calls* implementationOf(const Calls& fcl) {
  static bool opened = false;
  static const Calls* of_implementation = nullptr;
  static Start start;
  if (mode == Mode::kOff) return nullptr;
  if (!isOfLibfcl(fcl)) return nullptr;
  if (!opened) {
    opened = true;
    start.fcl = fcl;
    start.mode = mode;
    start.fits = &fits();
    const Opened now = openImplementation(start);
    of_implementation = now.calls;
    forks = now.forks;
  }
  return std::memcmp(&start.fcl, &fcl, sizeof(Calls)) == 0 ? of_implementation : nullptr;
}

/// Whether the implementation is to be opened by now: for a few queries it doesn't pay.
bool isWorthOpening() {
  constexpr int kFirst = 32;
  static int queries = 0;
  return (mode != Mode::kOn && mode != Mode::kTrust) || queries++ >= kFirst;
}

/// Chooses at the first queries of a process, or of a place in it: FCL's own functions, or the
/// implementation's if they are libfcl's.
const Calls* choose(const void* caller) {
  start();
  pthread_mutex_lock(&choosing);
  const Calls* chosen = calls.load(std::memory_order_relaxed);
  if (!chosen) chosen = callsOf(caller);
  if (!chosen) {
    static Sites known;
    auto* fcl = static_cast<const Calls*>(known.find(caller, kCalls));
    if (!fcl) {
      fcl = &fclOf(caller);
      known.keep(caller, kCalls, fcl);
    }
    if (!isWorthOpening()) {
      pthread_mutex_unlock(&choosing);
      return fcl;
    }
    chosen = implementationOf(*fcl);
    if (!chosen) chosen = fcl;
    if (isGlobal(KIOS_COLLIDE)) {
      calls.store(chosen, std::memory_order_release);
    } else {
      sites.keep(caller, kCalls, chosen);
    }
  }
  pthread_mutex_unlock(&choosing);
  return chosen;
}

}  // namespace

// Written out where the caller's place is known.
#define KIOS_CALLS()                                           \
  const Calls* chosen = calls.load(std::memory_order_acquire); \
  if (__builtin_expect(!chosen, 0)) {                          \
    chosen = callsOf(__builtin_return_address(0));             \
    if (!chosen) chosen = choose(__builtin_return_address(0)); \
  }

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
  KIOS_CALLS()
  return chosen->collide_objects(a, b, request, result);
}

std::size_t collide(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                    const CollisionRequest& request, CollisionResult& result) {
  KIOS_CALLS()
  return chosen->collide(a, X_WA, b, X_WB, request, result);
}

double distanceObjects(const Object* a, const Object* b, const DistanceRequest& request,
                       DistanceResult& result) {
  KIOS_CALLS()
  return chosen->distance_objects(a, b, request, result);
}

double distance(const Geometry* a, const Pose& X_WA, const Geometry* b, const Pose& X_WB,
                const DistanceRequest& request, DistanceResult& result) {
  KIOS_CALLS()
  return chosen->distance(a, X_WA, b, X_WB, request, result);
}

}  // namespace kios::preload
