#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: page.sh KIOS_CLASH SOURCE_DIR DIR
# A page of a building's clashes, and a dark one with a part whose name is markup, in headless
# Chromium: see page.py. Leaves pictures in DIR; docs/images/clash.png is DIR/building_clash.png.
# Skipped without Chromium or Python.
set -euo pipefail

clash=$1 source_dir=$2 dir=$3
here=$(cd "$(dirname "$0")" && pwd)
source "$here/../browser.sh"
mkdir -p "$dir"
cd "$dir"

browse() { "$python" "$here/page.py" "$chromium" "$@"; }
"$python" "$source_dir/examples/clash_files.py" building . --bays 4 --floors 3
"$clash" building.obj --clearance 0.05 --html building.html >building.txt || (($? == 1))
browse building.html building.png --size 1100x640
echo "== dark, with markup"
sed 's:^o again.*:o </script><b>again:' building.obj >markup.obj
"$clash" markup.obj --clearance 0.05 --html dark.html >dark.txt || (($? == 1))
grep -q 'script>.b>again' dark.html && exit 1
browse dark.html dark.png --size 1100x640 --dark
echo "== too large, and without a clash"
"$clash" building.obj --html few.html --html-limit 0.001 >few.txt || (($? == 1))
browse few.html few.png --size 1100x640 --no-test
grep -q '"left_out":[1-9]' few.html
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
"$clash" one.obj --html one.html
browse one.html one.png --size 1100x640 --no-test
