#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/images/solids.svg: the two bounds of a penetration, in the plane.

usage: plot_solids.py [FILE]
A bent bar B lies in a block A. The upper bound is a translation after which both are apart. The
lower bound is r + s, of two discs about one point, one in each: computed here from the outlines.
"""
import math
import sys

SCALE = 110
A = [(-2.2, -1.4), (1.0, -1.4), (1.0, 1.4), (-2.2, 1.4)]


def bar():
    """A closed outline: a thick arc that opens to the right."""
    outer, inner = [], []
    for i in range(61):
        t = math.radians(100 + 160 * i / 60)
        outer.append((1.65 + 1.25 * math.cos(t), 1.25 * math.sin(t)))
        inner.append((1.65 + 0.65 * math.cos(t), 0.65 * math.sin(t)))
    return outer + inner[::-1]


def moved(points, dx):
    return [(x + dx, y) for x, y in points]


def inside(p, outline):
    odd = False
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
        if (ay > p[1]) != (by > p[1]) and p[0] < (bx - ax) * (p[1] - ay) / (by - ay) + ax:
            odd = not odd
    return odd


def distance(p, outline):
    def to_segment(a, b):
        dx, dy = b[0] - a[0], b[1] - a[1]
        t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy)
        t = min(1, max(0, t))
        return math.dist(p, (a[0] + t * dx, a[1] + t * dy))
    return min(to_segment(a, b) for a, b in zip(outline, outline[1:] + outline[:1]))


def common_center(b):
    """The point of a grid with the largest r + s."""
    best = (0, None)
    for i in range(-100, 100):
        for j in range(-60, 61):
            p = (i * 0.02, j * 0.02)
            if inside(p, A) and inside(p, b):
                best = max(best, (distance(p, A) + distance(p, b), p))
    return best


def polygon(points, style):
    text = " ".join(f"{SCALE * x:.1f},{-SCALE * y:.1f}" for x, y in points)
    return f'<polygon points="{text}" {style}/>'


def circle(p, r, style):
    return f'<circle cx="{SCALE * p[0]:.1f}" cy="{-SCALE * p[1]:.1f}" r="{SCALE * r:.1f}" {style}/>'


def label(x, y, text):
    return (f'<text x="{SCALE * x:.0f}" y="{-SCALE * y:.0f}" font-family="sans-serif" '
            f'font-size="17" text-anchor="middle">{text}</text>')


def main():
    file = sys.argv[1] if len(sys.argv) > 1 else "docs/images/solids.svg"
    b = moved(bar(), -0.3)
    lower, c = common_center(b)
    r, s = distance(c, A), distance(c, b)
    left = min(b)
    upper = 1.0 - left[0]  # B leaves A through the right wall
    assert lower <= upper
    after = moved(b, upper)
    parts = [
        polygon(A, 'fill="#56B4E9" fill-opacity="0.35" stroke="#0072B2" stroke-width="2"'),
        polygon(after, 'fill="none" stroke="#D55E00" stroke-width="1.5" stroke-dasharray="7 5"'),
        polygon(b, 'fill="#E69F00" fill-opacity="0.45" stroke="#D55E00" stroke-width="2"'),
        circle(c, r, 'fill="none" stroke="#0072B2" stroke-width="2"'),
        circle(c, s, 'fill="none" stroke="#D55E00" stroke-width="2"'),
        circle(c, 0.03, 'fill="black"'),
        f'<line x1="{SCALE * left[0]:.1f}" y1="{-SCALE * left[1]:.1f}" '
        f'x2="{SCALE * 1.0:.1f}" y2="{-SCALE * left[1]:.1f}" stroke="black" stroke-width="2.5"/>',
        label(-1.4, 1.1, "solid 1"), label(1.75, 1.5, "solid 2"),
        label(3.0, 1.5, "after the translation"),
        label(0.6, -1.75, f"lower = r + s = {lower:.2f}, upper = |t| = {upper:.2f}"),
    ]
    box = f"{-2.4 * SCALE:.0f} {-1.8 * SCALE:.0f} {6.6 * SCALE:.0f} {3.7 * SCALE:.0f}"
    with open(file, "w", encoding="utf-8") as out:
        out.write('<svg xmlns="http://www.w3.org/2000/svg" '
                  f'viewBox="{box}" width="{6.6 * SCALE:.0f}" height="{3.7 * SCALE:.0f}">\n'
                  "<!-- Written by scripts/plot_solids.py -->\n"
                  '<rect x="-1000" y="-1000" width="3000" height="3000" fill="white"/>\n'
                  + "\n".join(parts) + "\n</svg>\n")
    print(f"{file}: lower {lower:.4f}, upper {upper:.4f}")


if __name__ == "__main__":
    main()
