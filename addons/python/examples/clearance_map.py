#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: clearance_map.py [PICTURE.png]

How near does a gripper come to a part, at each place of a plane and each angle? 25,600 poses, one
call. Draws the map where matplotlib is installed."""
import sys
import time

import numpy as np

import fcl_kios as kios


def ring(radius, thickness, nu=120, nv=60, knobs=6):
    """A closed ring with knobs: vertices and faces."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, nu, endpoint=False),
                       np.linspace(0, 2 * np.pi, nv, endpoint=False), indexing="ij")
    r = thickness * (1 + 0.4 * np.sin(knobs * u) * np.cos(v))
    points = np.stack([(radius + r * np.cos(v)) * np.cos(u), (radius + r * np.cos(v)) * np.sin(u),
                       r * np.sin(v)], -1).reshape(-1, 3)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(nu), np.arange(nv), indexing="ij"))
    k, l = (i + 1) % nu, (j + 1) % nv
    quads = np.stack([i * nv + j, k * nv + j, k * nv + l, i * nv + l], -1)
    return points, np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def gripper():
    """Two fingers and a palm: boxes side by side."""
    corners = np.array([(x, y, z) for x in (-.5, .5) for y in (-.5, .5) for z in (-.5, .5)])
    faces = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7),
                      (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])
    boxes = [((.16, .16, .8), (-.42, 0, 0)), ((.16, .16, .8), (.42, 0, 0)),
             ((1, .2, .16), (0, 0, .48))]
    vertices = np.vstack([corners * size + center for size, center in boxes])
    return vertices, np.vstack([faces + 8 * i for i in range(len(boxes))])


def main():
    part = kios.Mesh(*ring(1.0, 0.25), solid=True)
    hand = kios.Mesh(*gripper())
    n, angles = 80, np.radians([0, 30, 60, 90])
    x, y = np.meshgrid(np.linspace(-2, 2, n), np.linspace(-2, 2, n))
    poses = np.tile(np.eye(4), (len(angles), n, n, 1, 1))
    c, s = np.cos(angles)[:, None, None], np.sin(angles)[:, None, None]
    poses[..., 0, 0], poses[..., 0, 1], poses[..., 1, 0], poses[..., 1, 1] = c, -s, s, c
    poses[..., 0, 3], poses[..., 1, 3] = x, y
    start = time.perf_counter()
    d = part.distance(hand, poses.reshape(-1, 4, 4)).reshape(len(angles), n, n)
    took = time.perf_counter() - start
    print(f"{d.size} exact distances in {took:.2f} s; {np.mean(d == 0):.0%} of the poses touch")
    best = np.unravel_index(np.argmin(np.where(d > 0, d, np.inf)), d.shape)
    print(f"the nearest that doesn't touch: {d[best]:.4f} at ({x[best[1:]]:.2f}, {y[best[1:]]:.2f})")
    if len(sys.argv) < 2:
        return
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, len(angles), figsize=(12, 3.2), constrained_layout=True)
    for axis, angle, level in zip(axes, angles, d):
        image = axis.contourf(x, y, level, levels=np.linspace(0, 1.6, 17), extend="max")
        axis.contourf(x, y, level == 0, levels=[0.5, 1.5], colors=["black"])
        axis.set(title=f"turned by {np.degrees(angle):.0f} degrees", aspect="equal")
    figure.colorbar(image, ax=axes, label="clearance; black: contact")
    figure.savefig(sys.argv[1], dpi=80)


if __name__ == "__main__":
    main()
