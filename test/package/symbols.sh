#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: symbols.sh LIBRARY. Every symbol that the shared library exports must be ours: a weak
# symbol of FCL or Eigen among them would replace libfcl's in the whole process.
set -euo pipefail

symbols=$(nm -D --defined-only "$1" | awk '{ print $NF }')
ours=$(grep -cE '4kios|kios_overloads' <<<"$symbols" || true)
foreign=$(grep -vE '4kios|kios_overloads' <<<"$symbols" || true)
if [[ -n $foreign ]]; then
  echo "exported, but not ours:"
  c++filt <<<"$foreign"
  exit 1
fi
if ((ours == 0)); then
  echo "the library exports nothing"
  exit 1
fi
echo "$ours symbols exported, all ours"
