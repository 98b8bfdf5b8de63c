#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: layers.py SOURCE_DIR
# The folders of src and include/fcl_kios are layers: a file includes files of its own layer and of
# those below it only (docs/how-it-works.md, "The folders"). Addons are libraries of their own, which
# nothing includes but they themselves, and fcl_kios.h. No two folders have files of one name, but
# those of public headers. FCL's headers are included as <fcl/...>
# and ours as "...", and every "..." names one file, whichever include directory is searched first.
import pathlib
import re
import sys

LAYERS = ["volume", "triangle", "shape", "build", "tree", "search", "model", "query", "solid",
          "continuous", "linkage", "fcl", "scene", "clearance", "preload"]
ADDONS = [LAYERS.index("clearance"), LAYERS.index("preload")]
# Public headers of 0.2 that only include their new places.
MOVED = {"build": ["volume/fit.h"], "clearance": ["query/clearance.h", "volume/exact_distance.h"],
         "continuous": ["motion/continuous.h"], "linkage": ["motion/linkage.h"],
         "search": ["engine/counts.h"],
         "solid": ["interior/closedness.h", "interior/penetration.h", "interior/solids.h"]}
# Headers of include/fcl_kios itself.
TOP = {"fcl_own.h": -1, "overloads.h": LAYERS.index("fcl"), "fcl_kios.h": len(LAYERS),
       "version.h": -1, "compiler.h": -1}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.M)

root = pathlib.Path(sys.argv[1])
roots = [root / "src", root / "include"]
faults = []


def layer(path):
    """Returns the layer of a file by its path in an include directory; None if that isn't ours."""
    parts = path.removeprefix("fcl_kios/").split("/")
    for room, headers in MOVED.items():
        if "/".join(parts) in headers:
            return LAYERS.index(room)
    if len(parts) == 1:
        return TOP.get(parts[0])
    return LAYERS.index(parts[0]) if parts[0] in LAYERS else None


def check(path, own):
    for quote, name in INCLUDE.findall(path.read_text(encoding="utf-8")):
        ours = [r for r in roots if (r / name).is_file()]
        if name in ("fcl_kios/version.h", "fcl_kios/compiler.h"):  # made by CMake
            ours = [None]
        if quote == "<":
            if ours:
                faults.append(f"{path}: <{name}> is ours: write it in quotes")
            continue
        if len(ours) != 1:
            faults.append(f'{path}: "{name}" names {len(ours)} files of ours')
            continue
        of = layer(name)
        if of is None:
            faults.append(f'{path}: "{name}" is in no layer')
        elif of in ADDONS and own not in (of, TOP["fcl_kios.h"]):
            faults.append(f'{path} includes "{name}", of an addon')
        elif of > own:
            faults.append(f'{path} ({LAYERS[own]}) includes "{name}", of a layer above it')


# Public headers that share a name with another layer's file; that of motion bounds is defined where
# motions are.
NAMED_TWICE = {"distance", "intersection", "motion_bounds", "prepare"}
count, homes = 0, {}
for base in (root / "src", root / "include" / "fcl_kios"):
    for path in sorted(base.rglob("*")):
        relative = path.relative_to(base).as_posix()
        if path.suffix not in (".h", ".cpp") or relative.startswith("tools/"):
            continue
        own = layer(relative)
        if own is None:
            faults.append(f"{path}: is in no layer")
            continue
        count += 1
        check(path, own)
        home = homes.setdefault(path.stem, own)
        if home != own and path.stem not in NAMED_TWICE:
            faults.append(f"{path}: {LAYERS[home]} has files of this name too")
if count < 100:
    faults.append(f"only {count} files were found")
print("\n".join(faults) if faults else f"{count} files include downwards only")
sys.exit(bool(faults))
