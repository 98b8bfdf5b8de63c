#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: layers.py SOURCE_DIR
# The folders of src and include/fcl_kios are layers: a file includes files of its own layer and of
# those below it only (docs/how-it-works.md). Addons are libraries of their own, which nothing
# includes but they themselves; of addons, those in ADDONS are checked. docs/images/layers.svg shows
# the folders of src. No two folders have files of one name, but those of public headers. FCL's
# headers are included as <fcl/...> and ours as "...", and every "..." names one file, whichever
# include directory is searched first. A file of src under thirty lines, but for the header of a
# longer .cpp, and a header without a .cpp that one file includes stand below, with their reason.
import pathlib
import re
import sys

LAYERS = ["volume", "triangle", "shape", "build", "tree", "search", "model", "query", "solid",
          "continuous", "linkage", "fcl", "scene", "clearance", "paper", "preload"]
# In addons; all others in src.
ADDONS = [LAYERS.index(addon) for addon in ("clearance", "paper", "preload")]
# Headers of include/fcl_kios, with the folder of src, or the addon, that defines what they declare;
# -1: it needs none.
TOP = {
    "clearance.h": "clearance", "contact.h": "query", "detail/bv_traits.h": "model",
    "detail/bvh_build.h": "model", "detail/compiler.h": -1, "detail/counts.h": "search",
    "detail/fcl_own.h": -1, "detail/motion_bounds.h": "model", "detail/rigid.h": "volume",
    "detail/specialisations.h": "volume", "distance.h": "query", "fcl_nodes.h": "query",
    "linkage.h": "linkage", "model.h": "model", "motion.h": "continuous", "paper.h": "paper",
    "points.h": "query", "rays.h": "query", "repair.h": "solid", "scene.h": "scene",
    "solids.h": "solid", "storage.h": "model", "triangle.h": "triangle", "volume.h": "volume",
    "overloads.h": "fcl", "fcl_kios.h": len(LAYERS), "version.h": -1}
TOP = {name: LAYERS.index(of) if isinstance(of, str) else of for name, of in TOP.items()}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.M)

root = pathlib.Path(sys.argv[1])
roots = [root / "src", root / "addons", root / "include"]
faults = []


def layer(path):
    """Returns the layer of a file by its path in an include directory; None if that isn't ours."""
    if path.startswith("fcl_kios/"):
        return TOP.get(path.removeprefix("fcl_kios/"))
    folder = path.split("/")[0]
    return LAYERS.index(folder) if folder in LAYERS else None


def check(path, own):
    text = path.read_text(encoding="utf-8")
    lines[path] = text.count("\n")
    for quote, name in INCLUDE.findall(text):
        ours = [r for r in roots if (r / name).is_file()]
        if name in ("fcl_kios/version.h", "fcl_kios/detail/compiler.h"):  # made by CMake
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
        elif of in ADDONS and own != of:
            faults.append(f'{path} includes "{name}", of an addon')
        elif of > own:
            faults.append(f'{path} ({LAYERS[own]}) includes "{name}", of a layer above it')


# Public headers that share a name with another layer's file; and the constants of each folder.
NAMED_TWICE = {"contact", "distance", "fit", "intersection", "prepare", "tuning"}
SMALL_OR_USED_ONCE = {
    "fcl/holds_model.cpp": "asked without the queries of the other .cpp",
    "scene/tuning.h": "a table of constants",
    "tree/tuning.h": "a table of constants",
    "linkage/local_slabs.h": "tested alone",
    "shape/separating_slabs.h": "tested alone",
    "query/threads.h": "what two folders share",
    "model/stored_format.h": "also what tests alter",
    "tree/compress_table.h": "a table that no target needs twice",
    "triangle/integer.h": "Boost's integers, which take long to compile",
    "volume/ball_lanes.h": "tested alone", "volume/errors.h": "the one way to refuse",
    "volume/instantiate.h": "macros",
    "volume/unit_vector.h": "one function"}
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
    if name.endswith("-inl.h") or name.startswith("fcl_kios/"):
        continue
    sources = root / ("addons" if layer(name) in ADDONS else "src")
    own_cpp = sources / name.replace(".h", ".cpp")
    is_header, has_cpp = path.suffix == ".h", own_cpp in lines
    small = length < 30 and not (is_header and has_cpp and lines[own_cpp] >= 60)
    used_once = is_header and not has_cpp and len(users.get(name, ())) == 1
    if small or used_once:
        listed.add(name)
        if name not in SMALL_OR_USED_ONCE:
            faults.append(f"{path}: has {length} lines, or one user; give the reason in {__file__}")
for name in sorted(SMALL_OR_USED_ONCE.keys() - listed):
    faults.append(f"{name} is listed, but neither small nor used once")
umbrella = (root / "include/fcl_kios/fcl_kios.h").read_text(encoding="utf-8")
for path in sorted((root / "include/fcl_kios").glob("*.h")):
    includes = f'#include "fcl_kios/{path.name}"' in umbrella
    if path.name != "fcl_kios.h" and includes == (TOP.get(path.name) in ADDONS):
        faults.append(f"fcl_kios.h includes all public headers but those of addons: {path.name}")
picture = (root / "docs/images/layers.svg").read_text(encoding="utf-8")
drawn = re.findall(r'bold" text-anchor="middle">(\w+)<', picture)
if sorted(drawn) != sorted(path.name for path in (root / "src").iterdir() if path.is_dir()):
    faults.append("docs/images/layers.svg has other folders than src")
if count < 100:
    faults.append(f"only {count} files were found")
print("\n".join(faults) if faults else f"{count} files include downwards only")
sys.exit(bool(faults))
