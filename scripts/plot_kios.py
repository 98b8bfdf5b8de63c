#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/images/kios.svg: a k-IOS in section, and the sphere pair that parts two of them.

usage: plot_kios.py [FILE]
The spheres are computed as the fit does (docs/how-it-works.md), in the plane: a minimal S0, and two
caps at 30 degrees along the shorter axis, with radii measured from their centres.
"""
import math
import sys

THETA = math.radians(30)


def content():
    """A closed outline, longer than high, not symmetric."""
    points = []
    for i in range(240):
        t = 2 * math.pi * i / 240
        r = 1 + 0.08 * math.sin(3 * t) + 0.06 * math.cos(5 * t + 1)
        points.append((1.55 * r * math.cos(t), 0.52 * r * math.sin(t) + 0.1 * math.cos(t)))
    return points


def minimal_circle(points):
    """Centre by steps towards the farthest point that shrink; the radius is measured."""
    cx, cy = points[0]
    for i in range(2, 20000):
        x, y = max(points, key=lambda p: math.hypot(p[0] - cx, p[1] - cy))
        cx, cy = cx + (x - cx) / i, cy + (y - cy) / i
    return cx, cy, radius((cx, cy), points)


def radius(centre, points):
    return max(math.hypot(x - centre[0], y - centre[1]) for x, y in points)


def kios(points):
    """[S0, S1, S2] as (x, y, r); the short axis is y."""
    low, high = min(y for _, y in points), max(y for _, y in points)
    left, right = min(x for x, _ in points), max(x for x, _ in points)
    ox, oy, half = (left + right) / 2, (low + high) / 2, (high - low) / 2
    width = max(abs(x - ox) for x, _ in points)
    height = width / math.tan(THETA) - half
    spheres = [minimal_circle(points)]
    for sign in (1, -1):
        # Re-centred sideways, at the same height: the lateral coordinate that makes it smallest.
        lateral = min(
            (ox + width * k / 200 for k in range(-40, 41)),
            key=lambda x: radius((x, oy + sign * height), points),
        )
        centre = (lateral, oy + sign * height)
        spheres.append((*centre, radius(centre, points)))
    for x, y, r in spheres:
        assert all(math.hypot(px - x, py - y) <= r * (1 + 1e-12) for px, py in points)
    return spheres


def moved(points, spheres, angle, tx, ty):
    c, s = math.cos(angle), math.sin(angle)

    def move(x, y):
        return c * x - s * y + tx, s * x + c * y + ty

    return [move(*p) for p in points], [(*move(x, y), r) for x, y, r in spheres]


class Drawing:
    SCALE = 80

    def __init__(self, width, height):
        self.size = (width, height)
        self.parts = []
        self.clips = 0

    def circle(self, sphere, style):
        x, y, r = (v * self.SCALE for v in sphere)
        self.parts.append(f'<circle cx="{x:.2f}" cy="{-y:.2f}" r="{r:.2f}" {style}/>')

    def outline(self, points, style):
        path = " ".join(f"{x * self.SCALE:.2f},{-y * self.SCALE:.2f}" for x, y in points)
        self.parts.append(f'<polygon points="{path}" {style}/>')

    def line(self, a, b, style):
        (ax, ay), (bx, by) = a, b
        s = self.SCALE
        self.parts.append(
            f'<line x1="{ax * s:.2f}" y1="{-ay * s:.2f}" x2="{bx * s:.2f}" y2="{-by * s:.2f}" '
            f"{style}/>"
        )

    def text(self, x, y, words, style=""):
        self.parts.append(
            f'<text x="{x * self.SCALE:.1f}" y="{-y * self.SCALE:.1f}" {style}>{words}</text>'
        )

    def intersection(self, spheres, style):
        """The exact intersection: a circle within groups that are clipped to the others."""
        for sphere in spheres[1:]:
            x, y, r = (v * self.SCALE for v in sphere)
            self.clips += 1
            self.parts.append(
                f'<clipPath id="c{self.clips}"><circle cx="{x:.2f}" cy="{-y:.2f}" r="{r:.2f}"/>'
                f'</clipPath><g clip-path="url(#c{self.clips})">'
            )
        self.circle(spheres[0], style)
        self.parts.append("</g>" * (len(spheres) - 1))

    def write(self, file, left, top):
        width, height = (v * self.SCALE for v in self.size)
        box = f"{left * self.SCALE:.0f} {-top * self.SCALE:.0f} {width:.0f} {height:.0f}"
        body = "\n".join(self.parts)
        with open(file, "w", encoding="utf-8") as out:
            out.write(
                f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" '
                f'height="{height:.0f}" viewBox="{box}" font-family="DejaVu Sans, sans-serif" '
                f'font-size="14">\n'
                "<!-- Written by scripts/plot_kios.py -->\n"
                f'<rect x="{left * self.SCALE:.0f}" y="{-top * self.SCALE:.0f}" '
                f'width="{width:.0f}" height="{height:.0f}" fill="white"/>\n{body}\n</svg>\n'
            )


def main():
    file = sys.argv[1] if len(sys.argv) > 1 else "docs/images/kios.svg"
    points = content()
    spheres = kios(points)
    drawing = Drawing(10.2, 4.6)
    blue, orange, green = "#0072B2", "#D55E00", "#009E73"
    body = 'fill="#999999" stroke="#555555"'
    volume = f'fill="{blue}" fill-opacity="0.2"'
    cap = f'fill="none" stroke="{orange}" stroke-width="1.2"'

    # Left: one volume.
    drawing.intersection(spheres, volume)
    drawing.outline(points, body)
    drawing.circle(spheres[0], f'fill="none" stroke="{green}" stroke-width="1.2"')
    for sphere in spheres[1:]:
        drawing.circle(sphere, cap)
    drawing.text(-0.1, 1.62, "S0", f'fill="{green}"')
    drawing.text(1.75, 1.2, "S1", f'fill="{orange}"')
    drawing.text(1.75, -1.3, "S2", f'fill="{orange}"')
    drawing.text(-0.35, -0.05, "content", 'fill="white"')
    drawing.text(-2.2, 2.05, "k-IOS: what lies in all spheres", 'fill="black"')

    # Right: two volumes and the pair of spheres whose distance bounds theirs from below.
    a = moved(points, spheres, 0.15, 4.2, 0.75)
    b = moved(points, spheres, -0.25, 5.3, -1.05)
    best = max(
        ((math.dist(p[:2], q[:2]) - p[2] - q[2], p, q) for p in a[1] for q in b[1]),
        key=lambda t: t[0],
    )
    bound, p, q = best
    exact = min(math.dist(u, v) for u in a[0] for v in b[0])
    assert 0 < bound <= exact
    drawing.parts.append(
        '<clipPath id="right"><rect x="210" y="-176" width="400" height="368"/></clipPath>'
    )
    for outline, of in (a, b):
        drawing.intersection(of, volume)
        drawing.outline(outline, body)
    for sphere in (p, q):
        drawing.circle(sphere, cap + ' clip-path="url(#right)"')
    ux, uy = ((q[i] - p[i]) / math.dist(p[:2], q[:2]) for i in (0, 1))
    on_p = (p[0] + ux * p[2], p[1] + uy * p[2])
    on_q = (q[0] - ux * q[2], q[1] - uy * q[2])
    drawing.line(on_p, on_q, 'stroke="black" stroke-width="2.5"')
    title = "distance ≥ |c − c′| − r − r′, of the best pair of spheres"
    drawing.text(2.75, 2.05, title, 'fill="black"')
    drawing.text(5.9, -0.12, f"{bound:.2f} of {exact:.2f}", 'fill="black"')
    drawing.write(file, -2.3, 2.3)
    print(f"{file}: bound {bound:.4f}, distance of the contents {exact:.4f}")


if __name__ == "__main__":
    main()
