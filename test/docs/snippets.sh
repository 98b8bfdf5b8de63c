#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: snippets.sh SOURCE_DIR OUTPUT FILE...
# Writes a program of all blocks marked `cpp` in the Markdown files: each becomes a function, its
# includes go to the top, and a block with a main() is also run. The blocks of a page `tutorial.md`,
# given alone, are one program as they stand. Compilers name the Markdown line. FENCE names other
# blocks to be taken: `c++` are those of the addon fcl_kios::robot.
set -euo pipefail

source_dir=$1 output=$2
shift 2
cd "$source_dir"

one_program=0
if [[ $# == 1 && $1 == *tutorial.md ]]; then one_program=1; fi

awk -v one_program=$one_program -v fence="^\`\`\`${FENCE:-cpp}\$" '
  function fail(where, what) {
    print where ": " what > "/dev/stderr"
    failed = 1
  }
  BEGIN { gsub(/\+/, "[+]", fence) }
  $0 ~ fence { inside = 1; ++blocks; file = FILENAME; body = ""; whole = 0; next }
  /^```/ && inside {
    inside = 0
    if (one_program) code = code body
    else code = code (whole ? "namespace block_" blocks " {\n" body "}\n" \
                            : "void block_" blocks "() {\n" body "}\n")
    if (whole) calls = calls "  block_" blocks "::program();\n"
    next
  }
  inside && /^#include/ { includes = includes $0 "\n"; next }
  inside {
    if (!one_program && sub(/^int main\(\) \{/, "void program() {")) whole = 1
    body = body "#line " FNR " \"" FILENAME "\"\n" $0 "\n"
  }
  END {
    if (inside) fail(file, "an open block")
    if (!blocks) fail("snippets.sh", "no block found")
    if (failed) exit 1
    if (one_program) print includes code
    else print "#include \"docs/prelude.h\"\n" includes code "int main() {\n" calls "}"
  }
' "$@" >"$output"
