#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files for kios_clash, made from a seed, with clashes that are planted and known.

    clash_files.py building DIR [--bays 8] [--floors 6] [--seed 1] [--site]
    kios_clash DIR/building.obj --clearance 0.05

    clash_files.py assembly DIR
    kios_clash DIR/assembly.json

The building has slabs, columns, walls and pipes, in metres, as objects of one OBJ; with --site it is
turned and stands at coordinates of a map. The assembly has plates, bolts and nuts, in millimetres,
by a manifest. DIR/expected.json has the status of each pair that has one: of axis-aligned boxes by
arithmetic that shares nothing with the library, of all else as it was planted.
"""
import argparse
import json
import math
import os
import random

TOUCH, CLEARANCE = 1e-6, 0.05
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def box_mesh(low, high):
    corners = [tuple((high if i >> c & 1 else low)[c] for c in range(3)) for i in range(8)]
    return corners, QUADS


def prism(outline, z0, z1, hole=()):
    """An outline, counter-clockwise, from z0 to z1; a hole has as many corners."""
    n = len(outline)
    points = [(x, y, z) for ring in ([outline, hole] if hole else [outline])
              for z in (z0, z1) for x, y in ring]
    around = [(i, (i + 1) % n) for i in range(n)]
    faces = [(i, j, n + j, n + i) for i, j in around]
    if not hole:
        return points, faces + [tuple(reversed(range(n))), tuple(range(n, 2 * n))]
    for i, j in around:
        faces += [(2 * n + j, 2 * n + i, 3 * n + i, 3 * n + j),  # the hole's wall
                  (j, i, 2 * n + i, 2 * n + j), (n + i, n + j, 3 * n + j, 3 * n + i)]
    return points, faces


def circle(radius, n=24):
    return [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n))
            for i in range(n)]


def write_obj(path, objects, place=lambda p: p):
    base = 1
    with open(path, "w", encoding="ascii") as file:
        for name, (points, faces) in objects:
            print("o", name, file=file)
            for p in points:
                print("v %r %r %r" % tuple(place(p)), file=file)
            for face in faces:
                print("f", *(base + i for i in face), file=file)
            base += len(points)


def write_expected(folder, pairs):
    with open(os.path.join(folder, "expected.json"), "w", encoding="ascii") as file:
        json.dump(sorted([*sorted(pair), status] for pair, status in pairs.items()), file, indent=0)


def status_of(a, b):
    """Of two boxes (low, high); None if they are farther than the clearance."""
    if all(abs(x - y) <= TOUCH for p, q in zip(a, b) for x, y in zip(p, q)):
        return "duplicate"
    gaps = [max(a[0][c] - b[1][c], b[0][c] - a[1][c]) for c in range(3)]
    if max(gaps) < -TOUCH:
        for inner, outer in ((a, b), (b, a)):
            if all(outer[0][c] < inner[0][c] and inner[1][c] < outer[1][c] for c in range(3)):
                return "inside"
        return "overlap"
    apart = math.sqrt(sum(max(gap, 0) ** 2 for gap in gaps))
    return "touch" if apart <= TOUCH else "clearance" if apart <= CLEARANCE else None


def pairs_of_boxes(boxes):
    cells = {}
    for name, (low, high) in boxes.items():
        ranges = [range(int((low[c] - 1) // 4), int((high[c] + 1) // 4) + 1) for c in range(3)]
        for cell in ((x, y, z) for x in ranges[0] for y in ranges[1] for z in ranges[2]):
            cells.setdefault(cell, []).append(name)
    pairs = {}
    for names in cells.values():
        for i, a in enumerate(names):
            for b in names[i + 1:]:
                status = status_of(boxes[a], boxes[b])
                if status:
                    pairs[frozenset((a, b))] = status
    return pairs


def building(folder, bays, floors, seed, site):
    rng = random.Random(seed)
    boxes, pipes, planted = {}, {}, {}
    dx, dy, height, thick, col, wall = 6.0, 5.0, 3.0, 0.2, 0.4, 0.15
    rooms = [(x, y, f) for f in range(floors) for y in range(bays) for x in range(bays)]
    for x, y, f in rooms:
        at, z = "_%d_%d_%d" % (x, y, f), f * height + thick
        boxes["slab" + at] = ((x * dx, y * dy, f * height), ((x + 1) * dx, (y + 1) * dy, z))
        top = (f + 1) * height if f + 1 < floors else z + 2.8
        boxes["column" + at] = ((x * dx, y * dy, z), (x * dx + col, y * dy + col, top))
        boxes["wall" + at] = ((x * dx + col, y * dy, z), ((x + 1) * dx, y * dy + wall, top))
        # Along the room, an octagon of radius 0.1, farther from all than the clearance.
        pipes["pipe" + at] = [(x * dx + 1.0, y * dy + 2.0 + 0.6 * rng.random(), z + 2.3), 4.0]
    chosen = rng.sample(rooms, min(len(rooms), 6 * max(1, len(rooms) // 60)))
    for i, (x, y, f) in enumerate(chosen):
        at = "_%d_%d_%d" % (x, y, f)
        low, high = boxes["wall" + at]
        pipe = pipes["pipe" + at]
        kind = i % 6
        if kind == 0:  # the same wall again, a hair away
            boxes["again" + at] = tuple((p[0], p[1] + 3e-7, p[2]) for p in (low, high))
        elif kind == 1:  # a column sunk into the slab below
            low, high = boxes["column" + at]
            boxes["column" + at] = ((low[0], low[1], low[2] - 0.02), high)
        elif kind == 2:  # an anchor cast into the slab
            low = boxes["slab" + at][0]
            boxes["anchor" + at] = (tuple(c + 0.06 for c in low), tuple(c + 0.14 for c in low))
        elif kind == 3:  # a duct below the ceiling, too near to it
            if f + 1 == floors:
                continue
            z = (f + 1) * height - 0.03
            boxes["duct" + at] = ((low[0] + 2, low[1] + 3.5, z - 0.1), (low[0] + 4, low[1] + 4, z))
        elif kind == 4:  # a box on the floor
            z = boxes["slab" + at][1][2]
            boxes["crate" + at] = ((low[0] + 2, low[1] + 3.5, z), (low[0] + 3, low[1] + 4.2, z + 1))
        else:  # a cupboard where the pipe goes
            z = boxes["slab" + at][1][2]
            begin = pipe[0]
            boxes["cupboard" + at] = ((begin[0] + 1, begin[1] - 0.3, z),
                                      (begin[0] + 1.5, begin[1] + 0.3, z + 2.5))
            planted[frozenset(("pipe" + at, "cupboard" + at))] = "overlap"
    objects = [(name, box_mesh(*box)) for name, box in boxes.items()]
    for name, ((x, y, z), length) in pipes.items():
        points, faces = prism(circle(0.1, 8), 0, length)
        objects.append((name, ([(x + w, y + u, z + v) for u, v, w in points], faces)))
    rng.shuffle(objects)
    c, s = (math.cos(0.3), math.sin(0.3)) if site else (1, 0)
    east, north = (355000.0, 5653000.0) if site else (0, 0)
    write_obj(os.path.join(folder, "building.obj"), objects,
              lambda p: (c * p[0] - s * p[1] + east, s * p[0] + c * p[1] + north, p[2]))
    write_expected(folder, {**pairs_of_boxes(boxes), **planted})
    return len(objects)


def assembly(folder):
    square = [(20 * math.cos(a) / max(abs(math.cos(a)), abs(math.sin(a))),
               20 * math.sin(a) / max(abs(math.cos(a)), abs(math.sin(a))))
              for a in (2 * math.pi * i / 24 for i in range(24))]
    hexagon = [(x, y) for x, y in circle(9, 6) for _ in range(4)]
    hexagon = [tuple(p + (q - p) * (i % 4) / 4 for p, q in zip(hexagon[i], hexagon[(i + 4) % 24]))
               for i in range(24)]
    shaft, neck = circle(4.9), 24
    # A bolt: the hexagonal head above z = 0, the shaft below, from -25.
    head, head_faces = prism(hexagon, 0, 6)
    ring = [(x, y, 0) for x, y in shaft] + [(x, y, -25) for x, y in shaft]
    around = [(i, (i + 1) % neck) for i in range(neck)]
    faces = [f for f in head_faces if f != tuple(reversed(range(neck)))]
    faces += [(j, i, 48 + i, 48 + j) for i, j in around]
    faces += [(72 + i, 72 + j, 48 + j, 48 + i) for i, j in around]
    faces += [tuple(72 + i for i in reversed(range(neck)))]
    meshes = {"bolt": (head + ring, faces), "nut": prism(hexagon, 0, 8, circle(5.0)),
              "plate": prism(square, 0, 8, circle(5.0))}
    for name, mesh in meshes.items():
        write_obj(os.path.join(folder, name + ".obj"), [(name, mesh)])
    parts, expected = [], {}

    def part(kind, x, y, z, group):
        parts.append({"name": kind, "file": kind + ".obj", "group": group,
                      "pose": [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]})
        n = sum(p["name"] == kind for p in parts)
        return kind if n == 1 else "%s#%d" % (kind, n)

    def expect(a, b, status):
        expected[frozenset((a, b))] = status

    # Joints of two plates, a bolt and a nut below. Their tiles lie apart.
    for joint, wrong in enumerate(("", "shifted bolt", "sunk bolt", "nut too high", "two bolts")):
        x = 100.0 * joint
        lower, upper = part("plate", x, 0, 0, "plates"), part("plate", x, 0, 8, "plates")
        bolt = part("bolt", x + (0.5 if wrong == "shifted bolt" else 0), 0,
                    16 - (0.4 if wrong == "sunk bolt" else 0), "fasteners")
        nut = part("nut", x, 0, -8 + (0.25 if wrong == "nut too high" else 0), "fasteners")
        shifted, high = wrong == "shifted bolt", wrong == "nut too high"
        expect(lower, upper, "touch")
        expect(upper, bolt, "overlap" if shifted or wrong == "sunk bolt" else "touch")
        expect(lower, nut, "overlap" if high else "touch")
        if shifted:
            expect(lower, bolt, "overlap")
            expect(nut, bolt, "overlap")
        if wrong == "two bolts":
            second = part("bolt", x, 0, 16, "fasteners")
            expect(bolt, second, "duplicate")
            expect(upper, second, "touch")
    with open(os.path.join(folder, "assembly.json"), "w", encoding="ascii") as file:
        json.dump({"parts": parts}, file, indent=1)
    write_expected(folder, expected)
    return len(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("building", "assembly"))
    parser.add_argument("folder")
    parser.add_argument("--bays", type=int, default=8)
    parser.add_argument("--floors", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--site", action="store_true")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    if options.what == "building":
        parts = building(options.folder, options.bays, options.floors, options.seed, options.site)
    else:
        parts = assembly(options.folder)
    print("%d parts" % parts)


if __name__ == "__main__":
    main()
