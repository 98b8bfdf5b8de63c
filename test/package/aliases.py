#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: aliases.py SOURCE_DIR
# Every public template of the scalar has its names for double and float, as in FCL: kIOSd, kIOSf.
import pathlib
import re
import sys

DEFINED = re.compile(r"^template <typename S_?>\n(?:(?:class|struct) (\w+)(?: :[^{;]*)? \{|"
                     r"using (\w+) =)", re.M)

faults = []
count = 0
for path in sorted((pathlib.Path(sys.argv[1]) / "include/fcl_kios").rglob("*.h")):
    text = path.read_text(encoding="utf-8")
    for match in DEFINED.finditer(text):
        name = match[1] or match[2]
        count += 1
        for letter, scalar in (("d", "double"), ("f", "float")):
            if f"using {name}{letter} = {name}<{scalar}>;" not in text:
                faults.append(f"{path}: no {name}{letter}")
if count < 15:
    faults.append(f"only {count} templates were found")
print("\n".join(faults) if faults else f"{count} templates have their names")
sys.exit(bool(faults))
