#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: run.sh HOST LIBRARY PLUGIN TLS_USER WORK_DIR SANITIZED PYTHON
# The plug-in in a plain host, in one whose static thread-local storage is used up, and in Python.
set -euo pipefail

host=$1 library=$2 plugin=$3 tls_user=$4 work=$5 sanitized=$6 python=$7

if [[ $sanitized == 0 ]] && readelf -dW "$host" | grep -E 'libstdc\+\+|libc\+\+|libfcl'; then
  echo "the host is no plain program of C"
  exit 1
fi
"$host" "$library" "$plugin"

# Each copy of the file is another library to the loader.
rm -rf "$work"
mkdir -p "$work"
users=()
for i in {1..400}; do
  users+=("$work/tls_user_$i.so")
  cp "$tls_user" "${users[-1]}"
done
"$host" "$library" "$plugin" "${users[@]}"
rm -rf "$work"

if [[ $sanitized == 1 ]]; then
  echo "not asked from Python, which has no sanitizer's runtime"
elif [[ -z $python ]]; then
  echo "not asked from Python: there is no python3"
else
  "$python" "$(dirname "$0")/ask.py" "$plugin"
fi
