#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: use.sh WORK PREFIX CMAKE CXX CXXFLAGS
# Uses the addon that is installed in PREFIX from a project of its own, in the folder WORK. A program
# that uses the library alone links none of the addon's packages.
set -euo pipefail

work=$1 prefix=$2 cmake=$3 cxx=$4 flags=$5
mkdir -p "$work/source"
cat >"$work/source/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.22...3.31)
project(robot_consumer LANGUAGES CXX)
find_package(fcl_kios REQUIRED)
if(TARGET fcl_kios::robot)
  message(FATAL_ERROR "the addon came unasked")
endif()
find_package(fcl_kios REQUIRED COMPONENTS robot)
add_executable(core core.cpp)
target_link_libraries(core PRIVATE fcl_kios::fcl_kios)
add_executable(robot robot.cpp)
target_link_libraries(robot PRIVATE fcl_kios::robot)
END
cat >"$work/source/core.cpp" <<'END'
#include <fcl_kios/fcl_kios.h>
int main() { return kios::Linkage().links(); }
END
cat >"$work/source/robot.cpp" <<'END'
#include <fcl_kios/robot/robot.h>
#include <iostream>
int main(int, char** argv) {
  const kios::Robot robot = kios::loadRobot(argv[1]);
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(robot.coordinates());
  std::cout << robot.clearance(q).clearance << kios::toSrdf(robot.linkPairs(), robot.name()).empty() << "\n";
}
END
cat >"$work/r.urdf" <<'END'
<robot name='r'>
  <link name='a'><collision><geometry><sphere radius='1'/></geometry></collision></link>
  <link name='b'/>
  <link name='c'><collision><geometry><sphere radius='1'/></geometry></collision></link>
  <joint name='j' type='fixed'><parent link='a'/><child link='b'/><origin xyz='3.5 0 0'/></joint>
  <joint name='k' type='continuous'><parent link='b'/><child link='c'/></joint>
</robot>
END
"$cmake" -S "$work/source" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_CXX_FLAGS="$flags" >/dev/null
"$cmake" --build "$work/cmake"
library=$(find "$prefix"/lib* -maxdepth 2 \( -name libfcl_kios.so -o -name libfcl_kios.a \) -print -quit)
export LD_LIBRARY_PATH=${library%/*}
answer=$("$work/cmake/robot" "$work/r.urdf")
[[ $answer == 1.50 ]] || { echo "expected 1.5 and a pair, got $answer"; exit 1; }
if ldd "$work/cmake/core" | grep -E 'assimp|tinyxml2|yaml|urdfdom|fcl_kios_robot'; then
  echo "the library alone links the addon's packages"
  exit 1
fi
