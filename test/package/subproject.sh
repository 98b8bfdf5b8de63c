#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: subproject.sh SOURCE_DIR BUILD_DIR CMAKE CXX
# A project that takes the sources by FetchContent gets the library's target, its own compiler
# flags as they were, and none of our tests, benchmarks, examples and programs.
set -euo pipefail

source_dir=$1 work=$2/subproject_check cmake=$3 cxx=$4
rm -rf "$work"
mkdir -p "$work"
cat >"$work/CMakeLists.txt" <<PROJECT
cmake_minimum_required(VERSION 3.22)
project(mine LANGUAGES CXX)
include(FetchContent)
FetchContent_Declare(fcl_kios SOURCE_DIR $source_dir)
FetchContent_MakeAvailable(fcl_kios)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_executable(mine main.cpp)
target_link_libraries(mine PRIVATE fcl_kios::fcl_kios)
PROJECT
printf '#include <fcl_kios/fcl_kios.h>\nint main() { return kios::kIOSd().size() > 1; }\n' \
  >"$work/main.cpp"
"$cmake" -S "$work" -B "$work/build" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_BUILD_TYPE=Release \
  >"$work/log"
if [[ -d $work/build/_deps/fcl_kios-build/test || -d $work/build/_deps/fcl_kios-build/benchmarks ]]; then
  echo "a subproject brings its tests or benchmarks along"
  exit 1
fi
command=$(sed -n 's/^ *"command": "\(.*-c .*main.cpp\)",$/\1/p' "$work/build/compile_commands.json")
[[ -n $command && $command != *-Wall* && $command != *-ffp-contract* ]] ||
  { echo "a user's file is compiled with: $command" && exit 1; }
# What is linked is the library that other tests link: here the file only compiles.
(cd "$work/build" && mkdir -p CMakeFiles/mine.dir && ${command//\\\"/\"})
echo "a subproject's user compiles"
rm -rf "$work"
