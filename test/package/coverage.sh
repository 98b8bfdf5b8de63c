#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: coverage.sh SOURCE_DIR
# Every test that docs/fcl-coverage.md names as `folder/file_test.cpp: Suite.Name, ...` exists, and
# each of its rows names one or says why there is none. Every path and header that any page names exists, but
# for placeholders (FOLDER/NAME) and other projects' files (swapping.md).
set -euo pipefail

cd "$1"
doc=docs/fcl-coverage.md
status=0
count=0
fail() {
  echo "$doc: $*"
  status=1
}

while IFS= read -r reference; do
  file=test/${reference%%:*}
  if [[ ! -f $file ]]; then
    fail "no file $file"
    continue
  fi
  IFS=', ' read -ra names <<<"${reference#*: }"
  for name in "${names[@]}"; do
    count=$((count + 1))
    # The macro may break its arguments over two lines.
    tr -s '\n ' '  ' <"$file" |
      grep -qE "(TEST|TEST_F|TEST_P|TYPED_TEST)\( ?${name%%.*}, ?${name##*.} ?\)" ||
      fail "no test $name in $file"
  done
done < <(grep -oE '`[a-z_/]+_test\.cpp: [^`]+`' "$doc" | tr -d '`')

while IFS= read -r row; do
  grep -qE '_test\.cpp: |not reachable' <<<"$row" || fail "a row without a test: $row"
done < <(grep -E '^\|' "$doc" | grep -vE '^\|[-:| ]+\|$|^\| (FCL entry point|#) ')

while IFS=: read -r page path; do
  compgen -G "${path#\`}*" >/dev/null || { echo "$page: no ${path#\`}" && status=1; }
done < <(grep -HoE '`(src|addons|include|test|benchmarks|scripts|cmake|examples)/[A-Za-z0-9_./-]+' \
  README.md CONTRIBUTING.md docs/*.md | grep -vE '^docs/swapping|NAME')

# So do the headers, wherever a page names them; version.h is made by CMake.
while IFS=: read -r page header; do
  [[ -f include/$header ]] || { echo "$page: no header $header" && status=1; }
done < <(grep -HoE 'fcl_kios/[a-z_/]+\.h' README.md CONTRIBUTING.md docs/*.md |
  grep -vE 'fcl_kios/(version|robot/.*)\.h')

if ((count < 30)); then fail "only $count tests are named"; fi
((status == 0)) && echo "$doc: $count named tests exist"
exit "$status"
