#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: test_names.py SOURCE_DIR
# The test files of a folder are one program: no two of them name a test alike, or --only would run
# both (test/main.cpp).
import collections
import pathlib
import re
import sys

TEST = re.compile(r"^(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", re.M)

tests = pathlib.Path(sys.argv[1]) / "test"
files_of = collections.defaultdict(set)
for path in sorted(tests.rglob("*_test.cpp")):
    for suite, name in TEST.findall(path.read_text(encoding="utf-8")):
        files_of[path.parent.relative_to(tests), f"{suite}.{name}"].add(path.name)

faults = [f"test/{folder}: {name} is in {' and '.join(sorted(files))}"
          for (folder, name), files in sorted(files_of.items()) if len(files) > 1]
if len(files_of) < 500:
    faults.append(f"only {len(files_of)} tests were found")
print("\n".join(faults) if faults else f"{len(files_of)} tests have names of their own")
sys.exit(bool(faults))
