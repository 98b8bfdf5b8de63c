// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A plug-in with an FCL of its own, of which it has every function that the preloaded library
// stands before. All take pointers and numbers, and give a number or nothing.
#include <cstdio>

#include "preload/names.h"

namespace {
int calls = 0;
}

#define OWN(function, name)                                                                     \
  unsigned long function(const void*, const void*, const void*, const void*, int,               \
                         void*) __asm__(name) __attribute__((visibility("default"), noinline)); \
  unsigned long function(const void*, const void*, const void*, const void*, int, void*) {      \
    ++calls;                                                                                    \
    return 42;                                                                                  \
  }
// Those that give a double: nothing but a call is checked.
#define FUNCTIONS(DO)                                                            \
  DO(collideObjects, KIOS_COLLIDE_OBJECTS)                                       \
  DO(collide, KIOS_COLLIDE)                                                      \
  DO(distanceObjects, KIOS_DISTANCE_OBJECTS)                                     \
  DO(distance, KIOS_DISTANCE)                                                    \
  DO(getCovariance, KIOS_GET_COVARIANCE)                                         \
  DO(endOfGeometry, KIOS_END_OF_GEOMETRY)                                        \
  DO(fit3OBB, KIOS_FIT_FUNCTION("17OBB_fit_functions", "fit3", "3OBB"))          \
  DO(fit6OBB, KIOS_FIT_FUNCTION("17OBB_fit_functions", "fit6", "3OBB"))          \
  DO(fitnOBB, KIOS_FITN_FUNCTION("17OBB_fit_functions", "3OBB"))                 \
  DO(fit3RSS, KIOS_FIT_FUNCTION("17RSS_fit_functions", "fit3", "3RSS"))          \
  DO(fit6RSS, KIOS_FIT_FUNCTION("17RSS_fit_functions", "fit6", "3RSS"))          \
  DO(fitnRSS, KIOS_FITN_FUNCTION("17RSS_fit_functions", "3RSS"))                 \
  DO(fit3KIOS, KIOS_FIT_FUNCTION("18kIOS_fit_functions", "fit3", "4kIOS"))       \
  DO(fitnKIOS, KIOS_FITN_FUNCTION("18kIOS_fit_functions", "4kIOS"))              \
  DO(fit3OBBRSS, KIOS_FIT_FUNCTION("20OBBRSS_fit_functions", "fit3", "6OBBRSS")) \
  DO(fitnOBBRSS, KIOS_FITN_FUNCTION("20OBBRSS_fit_functions", "6OBBRSS"))        \
  DO(fitterOBB, KIOS_FITTER("3OBB"))                                             \
  DO(fitterRSS, KIOS_FITTER("3RSS"))                                             \
  DO(fitterKIOS, KIOS_FITTER("4kIOS"))                                           \
  DO(fitterOBBRSS, KIOS_FITTER("6OBBRSS"))

FUNCTIONS(OWN)

/// Calls each once; 0 if each call came here, and no other did.
extern "C" int ask() {
  alignas(16) static char place[1024];
  int asked = 0, wrong = 0;
#define ASK(function, name)                                 \
  function(place, place, place, place, 1, place);           \
  if (++asked != calls) {                                   \
    std::fprintf(stderr, "%s went to another FCL\n", name); \
    asked = calls;                                          \
    ++wrong;                                                \
  }
  const int before = calls;
  calls = 0;
  FUNCTIONS(ASK)
  calls = 0;
  return before == 0 ? wrong : -1;
}
