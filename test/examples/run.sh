#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: run.sh PROGRAM PACKAGE [ARGUMENT...]
# Runs an example that is built only where PACKAGE is installed.
set -euo pipefail

program=$1 package=$2
if [[ ! -x $program ]]; then
  echo "skipped: ${program##*/} wasn't built, as it needs Debian's $package"
  exit 77
fi
exec "$program" "${@:3}"
