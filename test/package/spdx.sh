#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: spdx.sh SOURCE_DIR. Every tracked file begins with the two SPDX lines; left out are text for
# readers, JSON and pictures. Exit code 77: not a git checkout.
set -euo pipefail

cd "$1"
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || { echo "skipped: not a git checkout"; exit 77; }
count=0
status=0
while IFS= read -r file; do
  case $file in
    *.md | *.json | *.png | *.svg | *.gif | LICENSE | VERSION | .gitignore | .clang-format) continue ;;
  esac
  count=$((count + 1))
  head=$(sed -n 1,8p "$file")
  if [[ $head != *"SPDX-FileCopyrightText: "* || $head != *"SPDX-License-Identifier: BSD-3-Clause"* ]]
  then
    echo "$file: no SPDX header"
    status=1
  fi
done < <(git ls-files --cached --others --exclude-standard)
if ((count < 100)); then
  echo "only $count files were looked at"
  status=1
fi
((status == 0)) && echo "$count files have SPDX headers"
exit "$status"
