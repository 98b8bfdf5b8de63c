#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: package.sh BUILD_DIR CMAKE CXX CXXFLAGS CONFIG
# Installs the build and uses the addon as use.sh does, and its program.
set -euo pipefail

build_dir=$1 cmake=$2 cxx=$3 flags=$4 config=$5
work=$build_dir/robot_consumer
rm -rf "$work"
mkdir -p "$work"
"$cmake" --install "$build_dir" --config "$config" --prefix "$work/prefix" >/dev/null
"$(dirname "$0")/use.sh" "$work" "$work/prefix" "$cmake" "$cxx" "$flags"
"$work/prefix/bin/kios_robot" clearance "$work/r.urdf"
