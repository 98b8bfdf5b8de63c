#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/images/motion.svg: an edge of a plan whose samples are free and whose path is not.

usage: plot_motion.py [FILE]
An arm of two bars in the plane turns both joints at constant rates; a thin plate stands in its way.
The script checks what it draws: no sample touches the plate, and a configuration between two does.
"""
import math
import sys

LENGTHS, HALF = (1.0, 0.8), 0.03  # of the bars, and half of their widths
START, END = (0.25, 0.35), (1.05, 0.75)
SAMPLES = 8
PLATE = 0.012  # half of its thickness


def joints(s):
    q = [a + s * (b - a) for a, b in zip(START, END)]
    points = [(0.0, 0.0)]
    angle = 0.0
    for turn, length in zip(q, LENGTHS):
        angle += turn
        x, y = points[-1]
        points.append((x + length * math.cos(angle), y + length * math.sin(angle)))
    return points


def to_segment(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy)
    t = min(1.0, max(0.0, t))
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


def crosses(a, b, c, d):
    def side(p, q, r):
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def distance(a, b, c, d):
    if crosses(a, b, c, d):
        return 0.0
    return min(to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b))


def gap(s, plate):
    """Of the arm and the plate; negative where they overlap."""
    points = joints(s)
    return min(distance(a, b, *plate) for a, b in zip(points, points[1:])) - HALF - PLATE


def svg(plate, between):
    scale, left, top = 240, 60, 470

    def at(p):
        return f"{left + scale * p[0]:.1f},{top - scale * p[1]:.1f}"

    def arm(s, color, opacity):
        path = " ".join(at(p) for p in joints(s))
        return (f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="'
                f'{2 * HALF * scale:.1f}" stroke-linejoin="round" stroke-linecap="round" '
                f'opacity="{opacity}"/>')
    trace = " ".join(at(joints(k / 200)[-1]) for k in range(201))
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 500" '
             'font-family="sans-serif" font-size="15">',
             "<!-- Written by scripts/plot_motion.py -->",
             '<rect width="640" height="500" fill="white"/>']
    lines += [arm(k / SAMPLES, "#3a6ea5", 0.35) for k in range(SAMPLES + 1)]
    lines.append(arm(between, "#c0392b", 0.85))
    lines.append(f'<polyline points="{trace}" fill="none" stroke="#555" stroke-dasharray="4 4"/>')
    a, b = (at(p).split(",") for p in plate)
    lines.append(f'<line x1="{a[0]}" y1="{a[1]}" x2="{b[0]}" y2="{b[1]}" stroke="black" '
                 f'stroke-width="{2 * PLATE * scale:.1f}"/>')
    lines.append('<text x="330" y="455" fill="#3a6ea5">samples: all free</text>')
    lines.append('<text x="330" y="478" fill="#c0392b">between two of them: in contact</text>')
    lines.append("</svg>")
    return "\n".join(lines) + "\n"


def main():
    # The plate stands across the way of the arm's tip, half way between two samples.
    between = 4.5 / SAMPLES
    tip, elbow = joints(between)[-1], joints(between)[-2]
    dx, dy = (tip[0] - elbow[0]) / LENGTHS[1], (tip[1] - elbow[1]) / LENGTHS[1]
    plate = [(tip[0] + t * dx, tip[1] + t * dy) for t in (-0.12, 0.45)]
    assert all(gap(k / SAMPLES, plate) > 0 for k in range(SAMPLES + 1)), "a sample touches"
    assert gap(between, plate) < 0, "nothing touches between the samples"
    file = sys.argv[1] if len(sys.argv) > 1 else "docs/images/motion.svg"
    with open(file, "w", encoding="utf-8") as out:
        out.write(svg(plate, between))


if __name__ == "__main__":
    main()
