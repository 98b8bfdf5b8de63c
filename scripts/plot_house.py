#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/images/layers.svg, the folders of src in layers, and query.svg, the way of a query.

usage: plot_house.py [FOLDER]
"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# From the roof down: what a row is for, and its folders with what they hold.
LAYERS = [
    ("calls and scenes", "#fde7d3", [("fcl", "the overloads"), ("scene", "scenes of bodies")]),
    ("more than a pose", "#fde7d3", [("solid", "closed meshes"), ("continuous", "moving pairs"),
                                     ("linkage", "robots, paths")]),
    ("one pair", "#f6efc7", [("model", "BVHModel over k-IOS"), ("query", "a question on a pair")]),
    ("trees", "#d6e8f5", [("build", "mesh to volumes"), ("tree", "8 children a node"),
                          ("search", "SIMD kernels")]),
    ("ground", "#d5efe3", [("volume", "k-IOS, error bounds"), ("triangle", "exact kernels"),
                           ("shape", "FCL's nine shapes")]),
]
STEPS = [
    ("the call", "fcl::distance(&amp;a, &amp;b, request, result)", "include/fcl_kios/overloads.h",
     "#f2f2f2"),
    ("checks", "finished models? rigid poses? one frame for both", "src/query/mesh_queries.cpp",
     "#fde7d3"),
    ("roots", "balls, boxes, edge products: far pairs end here", "src/search/root_body.cpp",
     "#f6efc7"),
    ("floats", "the pose in float, and what its rounding can cost", "src/search/float_frame.cpp",
     "#d6e8f5"),
    ("search", "pairs of nodes, then of leaves, the nearest first", "src/search/distance_kernel.cpp",
     "#d6e8f5"),
    ("triangles", "what floats leave undecided, in double, certified", "src/triangle/distance.cpp",
     "#d5efe3"),
]


def box(x, y, width, height, colour):
    return (f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="5" fill="{colour}" '
            'stroke="#444"/>')


def text(x, y, words, size=12, style="", anchor="middle"):
    return f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}" {style}>{words}</text>'


def write(file, width, height, parts):
    body = "\n".join(parts)
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="DejaVu Sans, sans-serif">\n'
        "<!-- Written by scripts/plot_house.py -->\n"
        f'<rect width="{width}" height="{height}" fill="white"/>\n{body}\n</svg>\n',
        encoding="utf-8")


def house():
    folders = {name for _, _, row in LAYERS for name, _ in row}
    assert folders == {path.name for path in (ROOT / "src").iterdir() if path.is_dir()}, folders
    left, right, top, row_height = 150, 740, 60, 56
    middle = (left + right) / 2
    parts = [f'<polygon points="{left - 14},{top - 6} {middle},8 {right + 14},{top - 6}" '
             'fill="#f2f2f2" stroke="#444"/>',
             text(middle, 44, "include/fcl_kios: what users call", 13, 'font-weight="bold"')]
    for i, (purpose, colour, row) in enumerate(LAYERS):
        y, width = top + i * row_height, (right - left) / len(row)
        parts.append(text(left - 10, y + 29, purpose, 12, 'font-style="italic"', "end"))
        for k, (name, holds) in enumerate(row):
            x = round(left + k * width, 1)
            parts += [box(x, y, round(width, 1), row_height - 4, colour),
                      text(round(x + width / 2, 1), y + 22, name, 14, 'font-weight="bold"'),
                      text(round(x + width / 2, 1), y + 40, holds)]
    return 770, top + len(LAYERS) * row_height + 4, parts


def query():
    parts = ['<defs><marker id="tip" markerWidth="9" markerHeight="8" refX="8" refY="4" '
             'orient="auto"><path d="M0,0 L9,4 L0,8 z" fill="#444"/></marker></defs>']
    for i, (name, what, where, colour) in enumerate(STEPS):
        y = 8 + 52 * i
        parts += [box(8, y, 754, 38, colour),
                  text(20, y + 24, name, 14, 'font-weight="bold"', "start"),
                  text(125, y + 24, what, 12, "", "start"),
                  text(750, y + 24, where, 11, 'font-family="DejaVu Sans Mono, monospace"', "end")]
        if i:
            parts.append(f'<line x1="60" y1="{y - 14}" x2="60" y2="{y - 1}" stroke="#444" '
                         'stroke-width="1.5" marker-end="url(#tip)"/>')
    return 770, 8 + 52 * len(STEPS), parts


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/images"
    write(folder / "layers.svg", *house())
    write(folder / "query.svg", *query())


if __name__ == "__main__":
    main()
