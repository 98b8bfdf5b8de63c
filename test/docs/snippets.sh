#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: snippets.sh SOURCE_DIR OUTPUT_DIR FILE...
# Writes the blocks marked `cpp` of the Markdown files as sources; compilers name the Markdown line.
#   PAGE_N.cpp      a block with a main(), as it stands: with the includes that it shows, no others
#   tutorial.cpp    the blocks of tutorial.md, which are one program
#   fragments.cpp   all others, a function each, which may use the declarations of prelude.h
# Names end in _robot where a block includes a header of the addon robot. C++ that is marked
# otherwise, or not at all, is an error. Files that stay as they were keep their times.
set -euo pipefail

source_dir=$1 output=$2
shift 2
new=$output.new
rm -rf "$new"
mkdir -p "$new" "$output"
cd "$source_dir"

awk -v out="$new" '
  function fail(what) {
    print FILENAME ":" FNR ": " what > "/dev/stderr"
    exit failed = 1
  }
  FNR == 1 {
    page = FILENAME
    gsub(/^.*\/|\.md$/, "", page)
    fence = ""
  }
  /^```/ && fence == "" {
    fence = $0
    if (fence !~ /^```(cpp|sh|python|cmake)?$/) fail("a block that is not cpp, sh, python or cmake")
    all = includes = rest = robot = ""
    whole = 0
    next
  }
  /^```/ {
    if (fence == "```cpp") {
      ++blocks
      if (page == "tutorial" && !robot) tutorial = tutorial all
      else if (whole) print all > (out "/" page "_" blocks robot ".cpp")
      else {
        included[robot] = included[robot] includes
        code[robot] = code[robot] "void block_" blocks "() {\n" rest "}\n"
      }
    }
    fence = ""
    next
  }
  fence == "```cpp" {
    line = "#line " FNR " \"" FILENAME "\"\n" $0 "\n"
    all = all line
    if (/^#include/) includes = includes line
    else rest = rest line
    if (/^#include <fcl_kios\/robot\//) robot = "_robot"
    if (/^int main\(/) whole = 1
    next
  }
  fence == "```" && /kios::|#include/ { fail("C++ that is not marked cpp") }
  END {
    if (failed) exit 1
    if (!blocks || !tutorial) fail("no block was found")
    print tutorial > (out "/tutorial.cpp")
    for (robot in code) {
      print "#include \"docs/prelude.h\"\n" included[robot] code[robot] > \
        (out "/fragments" robot ".cpp")
    }
  }
' "$@"
for old in "$output"/*.cpp; do
  [[ -e $new/${old##*/} ]] || rm -f "$old"
done
for file in "$new"/*.cpp; do
  cmp -s "$file" "$output/${file##*/}" || cp "$file" "$output"
done
rm -rf "$new"
