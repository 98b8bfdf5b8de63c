#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: spdx.sh SOURCE_DIR. Every tracked file has the two SPDX lines; left out are text for
# readers, JSON, pictures and stored hashes. Exit code 77: not a git checkout.
set -euo pipefail

cd "$1"
if ! git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
  echo "skipped: not a git checkout"
  exit 77
fi
mapfile -t files < <(git ls-files --cached --others --exclude-standard |
  grep -vE '\.(md|jsonl?|png|svg|gif|stl)$|_(targets|answers)\.txt$|^(LICENSE|VERSION|\.gitignore|\.clang-format)$')
without=$(
  for line in 'SPDX-FileCopyrightText: ' 'SPDX-License-Identifier: BSD-3-Clause'; do
    grep -L -F -e "$line" "${files[@]}" || true
  done
)
if [[ -n $without ]]; then
  echo "no SPDX header: $without"
  exit 1
fi
echo "${#files[@]} files have SPDX headers"
((${#files[@]} > 100))
