#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: page.sh KIOS_ROBOT DIR
# Pages of an arm that swings into a post, one with a link whose name is markup, and of a plan past
# the post, in headless Chromium: see page.py and plan_page.py. Leaves their pictures in DIR;
# docs/images/robot.png is DIR/arm.png. Skipped without Chromium or Python.
set -euo pipefail

robot=$1 dir=$2
here=$(cd "$(dirname "$0")" && pwd)
source "$here/../tools/browser.sh"
mkdir -p "$dir"
cd "$dir"

cp "$here/arm.urdf" .
cat >scene.yaml <<'END'
name: page
world:
  collision_objects:
    - id: post
      primitives: [{type: cylinder, dimensions: [1.48, 0.06]}]
      primitive_poses: [{position: [0.32, 0.32, 0.16], orientation: [0, 0, 0, 1]}]
    - id: table
      primitives: [{type: box, dimensions: [1.2, 1.2, 0.04]}]
      primitive_poses: [{position: [0, 0, -0.6], orientation: [0, 0, 0, 1]}]
    - id: hat
      primitives: [{type: cone, dimensions: [0.2, 0.1]}]
      primitive_poses: [{position: [-0.4, 0.1, -0.48], orientation: [0, 0, 0, 1]}]
END
browse() { "$python" "$here/page.py" "$chromium" "$@"; }
"$robot" show arm.urdf --scene scene.yaml --from=-0.6,1.3 --to=2,1.3 --html arm.html
browse arm.html arm.png --size 1100x640
echo "== dark, with markup"
sed 's:"tool":"\&lt;/script\&gt;\&lt;b\&gt;tool":' arm.urdf >markup.urdf
"$robot" show markup.urdf --scene scene.yaml --from=-0.6,1.3 --to=2,1.3 --html dark.html
grep -q 'script>.b>tool' dark.html && exit 1
browse dark.html dark.png --size 1100x640 --dark
echo "== a plan, by examples/robot_planner"
cat >plan.txt <<'END'
-0.6,1.3
-0.683088,0.303458
-1.54347,-0.206187
-1.48965,-0.543545
-0.663049,-0.0592323
0.199761,0.446296
1.06257,0.951824
2,1.3
END
"$robot" show arm.urdf --scene scene.yaml --path plan.txt --html plan.html
"$python" "$here/plan_page.py" "$chromium" plan.html plan.png --size 1100x640
"$robot" show arm.urdf --path plan.txt --to=0,1 --html no.html 2>no.txt && exit 1
grep -q 'excludes' no.txt
printf '0,1\n\n0,1,2\n' >bad.txt
"$robot" show arm.urdf --path bad.txt --html no.html 2>no.txt && exit 1
grep -q 'bad.txt, line 3: it has 3 coordinates, but arm has 2' no.txt
echo "== one configuration"
"$robot" show arm.urdf --at=0.3,1 --html alone.html
browse alone.html alone.png --size 1100x640 --no-test
