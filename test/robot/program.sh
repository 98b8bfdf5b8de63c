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
expect 2 '--octomap must be NAME=FILE' contact arm.urdf --octomap cells.bt
expect 2 'no octomap' contact arm.urdf --octomap cells=arm.urdf
# A scene lets the octomap be touched, which shapes aren't served against.
printf '# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\n' >full.bt
printf '\377\377%0.s' 1 >>full.bt
printf '\252\252%0.s' 1 2 3 4 5 6 7 8 >>full.bt
sed '$a allowed_collision_matrix: {default_entry_names: ["<octomap>"], default_entry_values: [true]}' scene.yaml >mapped.yaml
expect 2 'octree is served against meshes only' contact arm.urdf --octomap '<octomap>=full.bt' --at 3,0.5
expect 0 'free' contact arm.urdf --octomap '<octomap>=full.bt' --at 3,0.5 --scene mapped.yaml --strict
expect 2 'elbow is 3, but its limits are -2.5 and 2.5; --beyond-limits takes it' \
  motion arm.urdf --to 0,3
printf '0,0\n0,3\n' >beyond.txt
expect 2 'beyond.txt, line 2: elbow is 3' contact arm.urdf --path beyond.txt
expect 1 'contact' contact arm.urdf --at 0,3 --beyond-limits
expect 2 '--padding' contact arm.urdf --padding=-1
expect 0 'kios_robot' --version
expect 0 'radians' --help
expect 0 'free' contact "${scene[@]}" --at 3,0.5
expect 1 'contact of' contact "${scene[@]}" --at 0.785,1.2
expect 0 'to obstacles: ' clearance "${scene[@]}" --at 3,0.5
expect 1 'contact: ' motion "${scene[@]}" --from 0,1.2 --to 2,1.2 --first
expect 0 'clear, all along' motion "${scene[@]}" --path plan.txt
expect 2 '--joint, --to or --path is required' range arm.urdf
expect 2 "has no coordinate 'elbo'" range arm.urdf --joint elbo=0..1
expect 2 'as elbow=-1..2, but is elbow=1' range arm.urdf --joint elbow=1
expect 2 'elbow=0..3: elbow is 3, but its limits are -2.5 and 2.5; --beyond' range arm.urdf --joint elbow=0..3
expect 0 'least clearance' range "${scene[@]}" --at 3,-2.50001 --joint turn=2.9..3
expect 0 'least clearance' range "${scene[@]}" --at 3,0 --joint elbow=0..2.50001
expect 2 'shows the range of one joint' range arm.urdf --joint elbow --joint turn --html a.html
expect 0 'least clearance' range arm.urdf --joint elbow=-1..2
expect 0 'least clearance' range "${scene[@]}" --at 0,0 --joint turn
expect 1 'least clearance 0 to 0 m: ' range "${scene[@]}" --at 0,1.2 --joint turn
# Skins overlap in the first part, and more in the second one, whose least is that of the path.
printf -- '3,0.5\n3,0.4\n0.785,1.2\n' >skins.txt
deepest=$({ "$robot" range "${scene[@]}" --padding 0.5 --at 0.785,1.2 --to 0.785,1.2 || true; } |
  cut -d' ' -f3,5)
expect 1 "least clearance ${deepest/ / to } m" range "${scene[@]}" --padding 0.5 --path skins.txt
expect 0 'a.html' range "${scene[@]}" --path plan.txt --html a.html
grep -q '"band":' a.html
sed 's:<sphere radius="0.06"/>:<mesh filename="package\://arm_folder/tool.stl"/>:' arm.urdf >meshes.urdf
expect 2 "the folder of 'arm_folder' by --package NAME=FOLDER" contact meshes.urdf

"$robot" pairs arm.urdf --to-srdf >arm.srdf
sed -i 's:</robot>:<group name="all"><chain base_link="base" tip_link="tool\&lt;"/></group><group_state name="0,1" group="all"><joint name="elbow" value="0.5"/></group_state>&:' arm.srdf
expect 0 'state 0,1 ' info arm.urdf --srdf arm.srdf
grep -qE 'state 0,1 +0,0.5' out.txt
"$robot" pairs arm.urdf --srdf arm.srdf --to-srdf >again.srdf
expect 0 'group all' info arm.urdf --srdf again.srdf --strict
[[ $(grep -cE '^ *<(group|group_state|disable_collisions) .*>$' again.srdf) -gt 3 ]]
[[ -z $(sed -n '/./{/^ *<[^<]*>$/!p}' again.srdf) ]]  # an element a line
sed 's:"base":"b\xe9se":' arm.urdf >latin.urdf
expect 2 "latin.urdf:4: the attribute name isn't in UTF-8" info latin.urdf
expect 1 'open' pairs arm.urdf --seconds 0 --boxes 0
expect 0 '"warnings": []' info arm.urdf --srdf arm.srdf --json --strict
python=$(command -v python3 || true)
[[ $python ]] || { echo "no python3: JSON isn't parsed"; exit 77; }
for arguments in "info" "contact --at 0.785,1.2" "clearance" "motion --to 2,1.2" "pairs" \
  "show --html a.html" "range --joint elbow --joint turn=0..1 --each" "range --to 2,1.2" "contact --path plan.txt" "clearance --path plan.txt"; do
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
"$robot" range "${scene[@]}" --at 0,0 --joint elbow=-1..0.5 --each --json | "$python" -c '
import json, sys
range = json.load(sys.stdin)
assert range["complete"] and 0 < range["lower"] <= range["upper"] < 0.3, range
assert len(range["at"]) == 2 and range["at"][0] == 0 and -1 <= range["at"][1] <= 0.5, range
assert range["lower"] <= range["pairs"][0]["upper"] and len(range["pairs"]) > 3, range'
