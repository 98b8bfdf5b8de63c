# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# How our own files are compiled. Nothing here reaches a consumer of the installed package.
# No -march or -mavx, ever: Eigen's alignment would differ from libfcl's.

if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(NOT CMAKE_BUILD_TYPE AND NOT multi_config)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  find_program(CCACHE ccache)
  if(CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    # ccache caches no file that uses a precompiled header unless it is told so. Paths relative to the
    # build directory, also that of the generated compiler.h, let presets share what they compile alike.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
      CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  endif()
endif()

set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" MATCHES
    "-Ofast|-f(fast|unsafe|associative|finite|reciprocal)-math")
  message(FATAL_ERROR "fcl_kios: bounds and predicates are proven for IEEE arithmetic; leave out "
    "${CMAKE_MATCH_0}.")
endif()

if(NOT MSVC)
  # Answers are bitwise reproducible only if no multiplication is fused with an addition.
  add_compile_options(-Wall -Wextra -Wpedantic -ffp-contract=off)
  # g++ 12 drops the rounding of doubles to floats and back where it packs pairs of scalars, and with
  # it the error of a value as stored. src, where it gains 5 %, rounds by roundedTo.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
  if(FCL_KIOS_WERROR)
    add_compile_options(-Werror)
  endif()
endif()
