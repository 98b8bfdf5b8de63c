#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: program.sh KIOS_ROBOT DIR
# kios_robot as a script meets it: exit status, JSON of every command, and what it says of mistakes.
set -euo pipefail

robot=$(realpath "$1") dir=$2
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$dir"
mkdir -p "$dir"
cd "$dir"
sed 's:"tool":"tool\&lt;":' "$here/arm.urdf" >arm.urdf  # a name that XML escapes
cat >scene.yaml <<'END'
name: page
world:
  collision_objects:
    - id: post
      primitives: [{type: cylinder, dimensions: [1.5, 0.06]}]
      primitive_poses: [{position: [0.2, 0.2, 0], orientation: [0, 0, 0, 1]}]
END
printf -- '0,1\n\n-1, 0.5\n' >plan.txt

# expect STATUS WORDS ARGUMENT...: what it prints must contain the words.
expect() {
  local status=0 wanted=$1 words=$2
  shift 2
  "$robot" "$@" >out.txt 2>&1 </dev/null || status=$?
  if [[ $status != "$wanted" ]] || ! grep -F -e "$words" out.txt >/dev/null; then
    echo "kios_robot $*: exit status $status, expected $wanted and '$words':"
    cat out.txt
    exit 1
  fi
}
scene=(arm.urdf --scene scene.yaml)
expect 2 "'clearence' is no command; there are info, contact" clearence arm.urdf
expect 2 'a command is needed'
expect 2 'URDF is required' contact
expect 2 '--to or --path is required' motion arm.urdf
expect 2 'excludes' motion arm.urdf --path plan.txt --to 0,1
expect 2 'no.urdf' contact no.urdf
expect 2 "parted by commas, as in 0,0.5,-1; it is '0 0'" contact arm.urdf --at '0 0'
expect 2 '--to: it has 1 coordinates, but arm has 2' motion arm.urdf --to 1
expect 2 "--at: the SRDF has no group state 'home'" contact arm.urdf --at home
expect 2 'it is a URDF, but an SRDF is asked for' contact arm.urdf --srdf arm.urdf
expect 2 '--package a=nowhere: there is no such folder' contact arm.urdf --package a=nowhere
expect 2 'there is no folder' show arm.urdf --html nowhere/a.html
expect 2 'at least 2 are needed' motion arm.urdf --path /dev/null
expect 2 '--padding' contact arm.urdf --padding=-1
expect 0 'kios_robot' --version
expect 0 'radians' --help
expect 0 'free' contact "${scene[@]}" --at 3,0.5
expect 1 'contact of' contact "${scene[@]}" --at 0.785,1.2
expect 0 'to obstacles: ' clearance "${scene[@]}" --at 3,0.5
expect 1 'contact: ' motion "${scene[@]}" --from 0,1.2 --to 2,1.2 --first
expect 0 'clear, all along' motion "${scene[@]}" --path plan.txt
sed 's:<sphere radius="0.06"/>:<mesh filename="package\://arm_folder/tool.stl"/>:' arm.urdf >meshes.urdf
expect 2 "the folder of 'arm_folder' by --package NAME=FOLDER" contact meshes.urdf

"$robot" pairs arm.urdf --to-srdf >arm.srdf
expect 0 '"warnings": []' info arm.urdf --srdf arm.srdf --json --strict
python=$(command -v python3 || true)
[[ $python ]] || { echo "no python3: JSON isn't parsed"; exit 77; }
for arguments in "info" "contact --at 0.785,1.2" "clearance" "motion --to 2,1.2" "pairs" \
  "show --html a.html" "contact --path plan.txt" "clearance --path plan.txt"; do
  read -ra words <<<"$arguments"
  { "$robot" "${words[0]}" "${scene[@]}" "${words[@]:1}" --json || [[ $? == 1 ]]; } |
    "$python" -c 'import json, sys; json.load(sys.stdin)'
done
"$robot" clearance "${scene[@]}" --path - --json <plan.txt | "$python" -c '
import json, sys
both = json.load(sys.stdin)["configurations"]
assert len(both) == 2
for q in both:
    assert q["to_obstacles"]["b"] == "post" and q["to_itself"]["b"] == "tool<", q
    assert q["to_obstacles"]["clearance"] > 0 and len(q["to_obstacles"]["gradient"]) == 2'
