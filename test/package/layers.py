#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: layers.py SOURCE_DIR
# The folders of src and include/fcl_kios are layers: a file includes files of its own layer and of
# those below it only (docs/how-it-works.md). Addons are libraries of their own, which nothing
# includes but they themselves, and fcl_kios.h; of addons, those in ADDONS are checked. No two folders
# have files of one name, but those of public headers. FCL's headers are included as <fcl/...> and
# ours as "...", and every "..." names one file, whichever include directory is searched first.
# What include/fcl_kios/x.h declares is defined in src/x.cpp, or addons/x.cpp. A file of under thirty
# lines, but for the header of a longer .cpp, and a header without a .cpp that one file includes stand
# below, with their reason.
import pathlib
import re
import sys

LAYERS = ["volume", "triangle", "shape", "build", "tree", "search", "model", "query", "solid",
          "continuous", "linkage", "fcl", "scene", "clearance", "paper", "preload"]
# In addons; all others in src.
ADDONS = [LAYERS.index(addon) for addon in ("clearance", "paper", "preload")]
# Headers of include/fcl_kios itself.
TOP = {"fcl_own.h": -1, "overloads.h": LAYERS.index("fcl"), "fcl_kios.h": len(LAYERS),
       "version.h": -1, "compiler.h": -1}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.M)

root = pathlib.Path(sys.argv[1])
roots = [root / "src", root / "addons", root / "include"]
faults = []


def layer(path):
    """Returns the layer of a file by its path in an include directory; None if that isn't ours."""
    parts = path.removeprefix("fcl_kios/").split("/")
    if len(parts) == 1:
        return TOP.get(parts[0])
    return LAYERS.index(parts[0]) if parts[0] in LAYERS else None


def check(path, own):
    text = path.read_text(encoding="utf-8")
    lines[path] = text.count("\n")
    for quote, name in INCLUDE.findall(text):
        ours = [r for r in roots if (r / name).is_file()]
        if name in ("fcl_kios/version.h", "fcl_kios/compiler.h"):  # made by CMake
            ours = [None]
        if quote == "<":
            if ours:
                faults.append(f"{path}: <{name}> is ours: write it in quotes")
            continue
        if quote == '"':
            users.setdefault(name, set()).add(path)
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


# Public headers that share a name with another layer's file; and the constants of each folder.
NAMED_TWICE = {"distance", "fit", "intersection", "prepare", "tuning"}
# Public headers without a .cpp of their path.
DEFINED_ELSEWHERE = {
    "model/motion_bounds.h": "continuous/fcl_motion.cpp",
    "model/prepare.h": "model/prepared.cpp", "solid/solids.h": "solid/solid_mark.cpp",
    "model/convert.h": "a template", "volume/rigid.h": "templates",
    "scene/scene_types.h": "values", "search/counts.h": "values", "triangle/triangle.h": "types",
    "volume/specialisations.h": "model/bvh_build.cpp and its neighbours"}
SMALL_OR_USED_ONCE = {
    "clearance/exact_pair.h": "what two .cpp share",
    "fcl/holds_model.cpp": "asked without the queries of the other .cpp",
    "continuous/tuning.h": "a table of constants", "scene/tuning.h": "a table of constants",
    "linkage/local_slabs.h": "tested alone",
    "linkage/near_pairs.h": "tested alone", "model/stored_format.h": "also what tests alter",
    "search/pairs_apart.h": "memory of exact answers, beside the evaluators that ask for them",
    "tree/compress_table.h": "a table that no target needs twice",
    "tree/weld.h": "one function",
    "triangle/common_point.h": "what two .cpp share",
    "triangle/integer.h": "Boost's integers, which take long to compile",
    "volume/ball_lanes.h": "tested alone", "volume/errors.h": "the one way to refuse",
    "volume/instantiate.h": "macros",
    "volume/simd_targets.h": "before Highway's headers",
    "volume/unit_vector.h": "one function",
    "fcl_kios/search/counts.h": "values",
    "fcl_kios/solid/self_intersections.h": "one function", "fcl_kios/triangle/triangle.h": "types",
    "fcl_kios/volume/specialisations.h": "declared with the volume"}
count, homes, lines, users, listed = 0, {}, {}, {}, set()
addons = [root / "addons" / LAYERS[addon] for addon in ADDONS]
for folder in (root / "src", *addons, root / "include" / "fcl_kios"):
    for path in sorted(folder.rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        base = next(base for base in roots if path.is_relative_to(base))
        own = layer(path.relative_to(base).as_posix())
        if own is None or (base.name != "include" and (base.name == "addons") != (own in ADDONS)):
            faults.append(f"{path}: is in no layer")
            continue
        count += 1
        check(path, own)
        home = homes.setdefault(path.stem, own)
        if home != own and path.stem not in NAMED_TWICE:
            faults.append(f"{path}: {LAYERS[home]} has files of this name too")
for path, length in lines.items():
    name = path.relative_to(next(base for base in roots if path.is_relative_to(base))).as_posix()
    if name.endswith("-inl.h") or name.count("/") == name.startswith("fcl_kios/"):
        continue
    sources = root / ("addons" if layer(name) in ADDONS else "src")
    own_cpp = sources / name.removeprefix("fcl_kios/").replace(".h", ".cpp")
    is_header, has_cpp = path.suffix == ".h", own_cpp in lines
    if name.startswith("fcl_kios/") and not has_cpp and name[9:] not in DEFINED_ELSEWHERE:
        faults.append(f"{path}: {own_cpp}, which would define it, isn't there")
    small = length < 30 and not (is_header and has_cpp and lines[own_cpp] >= 60)
    used_once = is_header and not has_cpp and len(users.get(name, ())) == 1
    if small or used_once:
        listed.add(name)
        if name not in SMALL_OR_USED_ONCE:
            faults.append(f"{path}: has {length} lines, or one user; give the reason in {__file__}")
for name in sorted(SMALL_OR_USED_ONCE.keys() - listed):
    faults.append(f"{name} is listed, but neither small nor used once")
if count < 100:
    faults.append(f"only {count} files were found")
print("\n".join(faults) if faults else f"{count} files include downwards only")
sys.exit(bool(faults))
