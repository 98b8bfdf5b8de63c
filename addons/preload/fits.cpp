// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Stands in for libfcl's functions that fit volumes and end geometries, counts their calls and
// hands them on. Only pointers and numbers pass through, so that no type of FCL is needed.

#include <cstddef>

#include "preload/names.h"
#include "preload/reach.h"
#include "preload/sites.h"

namespace kios::preload {
namespace {

std::atomic<bool> counting{false};

/// Vertices of which a build was seen, each at a place that its address gives; a later one may
/// take it.
constexpr std::size_t kPlaces = 1 << 14;
std::atomic<const void*> builds[kPlaces];

std::atomic<const void*>& placeOf(const void* vertices) {
  const auto address = reinterpret_cast<std::uintptr_t>(vertices);
  return builds[(address * 0x9E3779B97F4A7C15U) >> 40 & (kPlaces - 1)];
}

bool seen(const void* vertices) {
  return placeOf(vertices).load(std::memory_order_relaxed) == vertices;
}

Fits& ofProcess() {
  static Fits fits{{}, &seen};  // constant, so that no guard is needed
  return fits;
}

void count() {
  if (counting.load(std::memory_order_relaxed)) {
    ofProcess().count.fetch_add(1, std::memory_order_release);
  }
}

Sites sites;

/// Returns FCL's function of that name for calls from there: one for all if it is in the global
/// scope.
template <typename Function>
Function* next(std::atomic<Function*>& of_all, const char* name, const void* caller) {
  if (Function* const function = of_all.load(std::memory_order_acquire)) return function;
  const void* const known = sites.find(caller, name);
  void* const found = known ? const_cast<void*>(known) : nextDefinition(name, caller);
  auto* const function = reinterpret_cast<Function*>(found);
  if (known) return function;
  if (isGlobal(name)) {
    of_all.store(function, std::memory_order_release);
  } else {
    sites.keep(caller, name, found);
  }
  return function;
}

}  // namespace

const Fits& fits() { return ofProcess(); }

void countFits() { counting.store(true, std::memory_order_relaxed); }

// NOLINTBEGIN(bugprone-macro-parentheses): names of functions and their parameters stand in none.
#define KIOS_NEXT(function, name)                   \
  static constexpr const char* fcl_name = name;     \
  static std::atomic<decltype(function)*> of_all{}; \
  const auto fcl = next(of_all, fcl_name, __builtin_return_address(0))

void getCovariance(const void* vertices, const void* previous, void* triangles,
                   unsigned int* primitives, int n, void* covariance)
    KIOS_STANDS_FOR(KIOS_GET_COVARIANCE);
void getCovariance(const void* vertices, const void* previous, void* triangles,
                   unsigned int* primitives, int n, void* covariance) {
  if (counting.load(std::memory_order_relaxed)) {
    placeOf(vertices).store(vertices, std::memory_order_relaxed);
    count();
  }
  KIOS_NEXT(getCovariance, KIOS_GET_COVARIANCE);
  fcl(vertices, previous, triangles, primitives, n, covariance);
}

#define KIOS_COUNTED(function, name, parameters, arguments) \
  void function parameters KIOS_STANDS_FOR(name);           \
  void function parameters {                                \
    count();                                                \
    KIOS_NEXT(function, name);                              \
    fcl arguments;                                          \
  }
#define KIOS_FIT(function, name) \
  KIOS_COUNTED(function, name, (const void* points, void* volume), (points, volume))
#define KIOS_FITN(function, name) \
  KIOS_COUNTED(function, name, (const void* points, int n, void* volume), (points, n, volume))

KIOS_COUNTED(endOfGeometry, KIOS_END_OF_GEOMETRY, (void* geometry), (geometry))

KIOS_FIT(fit3OBB, KIOS_FIT_FUNCTION("17OBB_fit_functions", "fit3", "3OBB"))
KIOS_FIT(fit6OBB, KIOS_FIT_FUNCTION("17OBB_fit_functions", "fit6", "3OBB"))
KIOS_FITN(fitnOBB, KIOS_FITN_FUNCTION("17OBB_fit_functions", "3OBB"))
KIOS_FIT(fit3RSS, KIOS_FIT_FUNCTION("17RSS_fit_functions", "fit3", "3RSS"))
KIOS_FIT(fit6RSS, KIOS_FIT_FUNCTION("17RSS_fit_functions", "fit6", "3RSS"))
KIOS_FITN(fitnRSS, KIOS_FITN_FUNCTION("17RSS_fit_functions", "3RSS"))
KIOS_FIT(fit3KIOS, KIOS_FIT_FUNCTION("18kIOS_fit_functions", "fit3", "4kIOS"))
KIOS_FITN(fitnKIOS, KIOS_FITN_FUNCTION("18kIOS_fit_functions", "4kIOS"))
KIOS_FIT(fit3OBBRSS, KIOS_FIT_FUNCTION("20OBBRSS_fit_functions", "fit3", "6OBBRSS"))
KIOS_FITN(fitnOBBRSS, KIOS_FITN_FUNCTION("20OBBRSS_fit_functions", "6OBBRSS"))
KIOS_FITN(fitterOBB, KIOS_FITTER("3OBB"))
KIOS_FITN(fitterRSS, KIOS_FITTER("3RSS"))
KIOS_FITN(fitterKIOS, KIOS_FITTER("4kIOS"))
KIOS_FITN(fitterOBBRSS, KIOS_FITTER("6OBBRSS"))

// NOLINTEND(bugprone-macro-parentheses)

}  // namespace kios::preload
