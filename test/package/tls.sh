#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: tls.sh LIBRARY. A process that opens the shared library at run time has next to no room for
# static thread-local storage, and destroys thread-local objects in an order that it doesn't choose:
# the library may ask for no such room, and its thread-local variables may have no destructors.
set -euo pipefail

if readelf -dW "$1" | grep STATIC_TLS; then
  echo "the library needs static thread-local storage: a thread_local variable has a TLS model, or"
  echo "a file was compiled without -fPIC"
  exit 1
fi
if nm -Du "$1" | grep -E '__cxa_thread_atexit|_tlv_atexit'; then
  echo "the library has a thread_local variable with a destructor"
  exit 1
fi
bytes=$(readelf -lW "$1" | awk '$1 == "TLS" { print $6 }')
echo "no static thread-local storage, no destructors; $((${bytes:-0})) bytes a thread"
