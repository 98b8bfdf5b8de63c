#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: robot_files.sh RUN_SH PROGRAM WORK_DIR
# robot_planner over a URDF and a scene: an arm must fold to pass a post.
set -euo pipefail

run=("$(realpath "$1")" "$2" libompl-dev)
work=$3
mkdir -p "$work"
cd "$work"

cat >arm.urdf <<'END'
<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.25 0 0"/><geometry><box size="0.4 0.05 0.05"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.25 0 0"/><geometry><box size="0.4 0.05 0.05"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/><limit lower="-1.5" upper="1.5"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/><limit lower="-2.6" upper="2.6"/></joint>
</robot>
END
cat >scene.yaml <<'END'
name: post
world:
  collision_objects:
    - id: post
      primitives: [{type: cylinder, dimensions: [0.5, 0.03]}]
      primitive_poses: [{position: [0.75, 0, 0], orientation: [0, 0, 0, 1]}]
END
"${run[@]}" arm.urdf - scene.yaml 0.6,0 -0.6,0 >path.txt
cat path.txt
[[ $(head -n 1 path.txt) == 0.6,0 ]]
[[ $(tail -n 1 path.txt) == -0.6,0 ]]
# The straight path meets the post: there is a configuration between.
(($(wc -l <path.txt) > 2))
"${run[@]}" arm.urdf - - 0.6,0 -0.6,0 >straight.txt
(($(wc -l <straight.txt) >= 2))
status=0
"${run[@]}" arm.urdf - scene.yaml 0,0 -0.6,0 2>message.txt || status=$?
((status == 1))
grep -q 'lower and post are in contact at 0,0' message.txt
