# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Large batches prove contacts by a grid about the first mesh; small ones search. Both must agree."""
import numpy as np
import pytest

import fcl_kios
import shapes

SMALL = 50  # batches of fewer than 64 poses are searched


def moved(part, by):
    return part[0] + by, part[1]


def together(*parts):
    at = np.cumsum([0] + [len(v) for v, _ in parts])
    return (np.vstack([v for v, _ in parts]),
            np.vstack([f + a for (_, f), a in zip(parts, at)]))


def turned_inside_out(part):
    return part[0], part[1][:, ::-1]


FIRST = {
    "torus": shapes.torus(60, 40),
    "ball": shapes.ball(16, 1.2),
    "large triangles": shapes.box(1.5),
    "turned box": (shapes.box(1.5)[0] @ shapes.random_rotations(1, np.random.default_rng(1))[0],
                   shapes.box()[1]),
    "open": (shapes.ball(12, 1.2)[0], shapes.ball(12, 1.2)[1][1:]),
    "inside out": turned_inside_out(shapes.ball(12, 1.2)),
    "cavity": together(shapes.ball(12, 1.3), turned_inside_out(shapes.ball(12, 1.0))),
    "two that overlap": together(shapes.ball(12), moved(shapes.ball(10), [0.4, 0.1, 0])),
    "far from its origin": moved(shapes.ball(12, 1.2), [400, 0, 0]),
    "very far": moved(shapes.ball(12, 1.2), [1e7, 0, 0]),
    "flat": (shapes.ball(12, 1.2)[0] * [1, 1, 1e-3], shapes.ball(12)[1]),
    "one triangle twice": (np.eye(3), np.array([[0, 1, 2], [0, 2, 1]])),
}
SECOND = {
    "torus": (shapes.torus(20, 12)[0] * [0.3, 0.3, 0.6], shapes.torus(20, 12)[1]),
    "needle": (shapes.ball(8)[0] * [0.02, 0.02, 2], shapes.ball(8)[1]),
    "two apart": together(shapes.ball(6, 0.2), moved(shapes.ball(8, 0.2), [2, 0, 0])),
    "triangle": (0.5 * np.eye(3), np.array([[0, 1, 2]])),
    "larger": shapes.ball(8, 3.0),
}


def one_by_one(mesh, other, poses):
    return np.concatenate([mesh.collides(other, poses[i:i + SMALL])
                           for i in range(0, len(poses), SMALL)])


@pytest.mark.parametrize("first", FIRST)
def test_large_batches_answer_as_small_ones(first):
    random = np.random.default_rng(11)
    v, f = FIRST[first]
    hits = 0
    for second, part in SECOND.items():
        mesh, other = fcl_kios.Mesh(v, f), fcl_kios.Mesh(*part)
        poses = shapes.random_poses(8000, 1.8, random)
        poses[::5, :3, 3] *= 0.2  # deep inside
        poses[:, :3, 3] += v[f].mean((0, 1)).round()
        want = one_by_one(fcl_kios.Mesh(v, f), other, poses)
        for _ in range(2):
            assert np.array_equal(mesh.collides(other, poses), want), second
        assert np.array_equal(mesh.distance(other, poses[::7], within=1e-300) == 0, want[::7])
        hits += want.sum()
    assert hits > 100


# Poses at which a ball's first vertex lies so far from the surface of another, or of its wall.
def test_grazing_poses():
    v, f = shapes.box(2.0)
    mesh, cube = fcl_kios.Mesh(v, f), fcl_kios.Mesh(*shapes.box(0.5))
    away = np.concatenate([s * 10.0 ** -np.arange(1, 17.0) for s in (-1, 1)] + [[0.0]])
    poses = np.tile(np.eye(4), (200 * len(away), 1, 1))
    poses[:, 0, 3] = np.tile(1.25 + away, 200)
    poses[:, 1:3, 3] = np.random.default_rng(3).uniform(-0.7, 0.7, (len(poses), 2))
    hits = mesh.collides(cube, poses)
    assert np.array_equal(hits, one_by_one(mesh, cube, poses))
    assert np.array_equal(hits, poses[:, 0, 3] <= 1.25)


@pytest.mark.parametrize("broken", ["reflected", "stretched", "infinite", "not a number"])
def test_poses_that_would_be_hits_are_refused_all_the_same(broken):
    ball, other = fcl_kios.Mesh(*shapes.ball()), fcl_kios.Mesh(*shapes.ball(8, 0.4))
    poses = np.tile(shapes.translation(0.4), (5000, 1, 1))
    assert ball.collides(other, poses).all() and ball.collides(other, poses).all()
    if broken == "reflected":
        poses[4321, :3, :3] = -np.eye(3)
    elif broken == "stretched":
        poses[4321, :3, :3] *= 1.01
    else:
        poses[4321, 0, 3] = np.inf if broken == "infinite" else np.nan
    with pytest.raises(ValueError, match=r"\[4321\]"):
        ball.collides(other, poses)
