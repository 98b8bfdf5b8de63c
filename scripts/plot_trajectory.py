#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: plot_trajectory.py TRAJECTORY.csv IMAGE.png

Plots what examples/optimise_trajectory wrote: the paths, the clearance along them and its slope,
beside FCL's RSS. Needs Debian's python3-matplotlib.
"""
import csv
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def read(name):
    paths = {}
    with open(name, newline="") as file:
        for row in csv.DictReader(file):
            columns = paths.setdefault(row.pop("path"), {})
            for key, value in row.items():
                columns.setdefault(key, []).append(float(value))
    return paths


def draw_scene(axes, paths):
    half = 0.45
    axes.fill([-half, half, half, -half], [-half, -half, half, half], color="0.75")
    for name, color in (("initial", "tab:gray"), ("optimised", "tab:blue")):
        path = paths[name]
        axes.plot(path["x"], path["y"], color=color, label=name)
        for i in range(0, len(path["x"]), 57):
            dx, dy = 0.6 * math.cos(path["angle"][i]), 0.6 * math.sin(path["angle"][i])
            x, y = path["x"][i], path["y"][i]
            axes.plot([x - dx, x + dx], [y - dy, y + dy], color=color, alpha=0.5, linewidth=2)
    axes.set_aspect("equal")
    axes.set_title("a rod turns over as it passes a block")
    axes.legend(loc="lower right")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    paths = read(sys.argv[1])
    figure, (scene, clearance, slope) = plt.subplots(1, 3, figsize=(15, 4.6))
    draw_scene(scene, paths)
    for name, style in (("initial", ":"), ("optimised", "-")):
        path = paths[name]
        clearance.plot(path["s"], path["smooth"], "tab:blue", linestyle=style,
                       label=f"k-IOS, smooth, {name}")
        clearance.plot(path["s"], path["rss"], "tab:red", linestyle=style, label=f"RSS, {name}")
    clearance.axhline(0.3, color="0.6", linewidth=0.8)
    clearance.set_title("clearance (0.3 is asked for)")
    clearance.legend(fontsize=8)
    path = paths["initial"]
    slope.plot(path["s"], path["smooth_slope"], "tab:blue", label="k-IOS, smooth minimum")
    slope.plot(path["s"], path["minimum_slope"], "tab:green", linewidth=0.8,
               label="k-IOS, plain minimum")
    slope.plot(path["s"], path["rss_slope"], "tab:red", label="RSS")
    slope.set_title("its slope along the initial path")
    slope.legend(fontsize=8)
    for axes in (clearance, slope):
        axes.set_xlabel("s")
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=90)


if __name__ == "__main__":
    main()
