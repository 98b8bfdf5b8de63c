#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: version.sh VERSION. The manifest and the newest entry of the changelog must name it.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
manifest=$(sed -n 's|.*<version>\(.*\)</version>.*|\1|p' "$root/package.xml")
changelog=$(sed -n 's|^## \[\([0-9][^]]*\)\].*|\1|p' "$root/CHANGELOG.md" | sed -n 1p)

status=0
for found in "package.xml:$manifest" "CHANGELOG.md:$changelog"; do
  if [[ ${found#*:} != "$1" ]]; then
    echo "${found%%:*} says '${found#*:}', VERSION says '$1'"
    status=1
  fi
done
exit "$status"
