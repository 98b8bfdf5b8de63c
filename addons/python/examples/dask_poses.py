#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: dask_poses.py [POSES [SCHEDULER_ADDRESS]]

Spreads poses over a Dask cluster: that at the address, or two local workers. The meshes travel once,
with their trees, so that no worker builds anything; a worker that dies has its poses asked again by
the others. The answers equal those of one process bit by bit. Debian: python3-distributed."""
import sys
import time

import numpy as np
from distributed import Client, LocalCluster

import fcl_kios as kios
from clearance_map import gripper, ring


def random_poses(n, random):
    q = random.normal(size=(n, 4))
    w, x, y, z = (q / np.linalg.norm(q, axis=1)[:, None]).T
    poses = np.tile(np.eye(4), (n, 1, 1))
    poses[:, :3, :3] = np.stack(
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
         1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x),
         1 - 2 * (x * x + y * y)], -1).reshape(-1, 3, 3)
    poses[:, :3, 3] = random.uniform(-3, 3, (n, 3))
    return poses


def distances(part, hand, poses):
    return part.distance(hand, poses, threads=1)  # a worker has a core


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    part, hand = kios.Mesh(*ring(1.0, 0.25)), kios.Mesh(*gripper())
    poses = random_poses(n, np.random.default_rng(1))
    cluster = sys.argv[2] if len(sys.argv) > 2 else LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        start = time.perf_counter()
        meshes = client.scatter([part, hand], broadcast=True)
        chunks = np.array_split(poses, max(1, n // 5000))
        answers = client.gather([client.submit(distances, *meshes, chunk) for chunk in chunks])
        found = np.concatenate(answers)
        print(f"{n} distances on {len(client.scheduler_info()['workers'])} workers in "
              f"{time.perf_counter() - start:.2f} s; {np.mean(found == 0):.0%} of the poses touch")
    sample = slice(None, None, max(1, n // 1000))
    assert np.array_equal(found[sample], part.distance(hand, poses[sample]))
    print("as in one process, bit by bit")


if __name__ == "__main__":
    main()
