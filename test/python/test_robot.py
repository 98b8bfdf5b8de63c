# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Robot: answers against geometry by hand and one by one, changes, threads, what is refused."""
import copy
import os
import pathlib
import threading

import numpy as np
import pytest

import fcl_kios
import shapes
from fcl_kios import fcl

URDF = pathlib.Path(__file__).resolve().parents[1] / "robot/arm.urdf"
SRDF = """<robot name="arm"><group name="all"><chain base_link="base" tip_link="tool"/></group>
<group_state name="ready" group="all"><joint name="elbow" value="1"/></group_state>
<disable_collisions link1="base" link2="upper" reason="Adjacent"/>
<disable_collisions link1="upper" link2="lower" reason="Adjacent"/>
<disable_collisions link1="lower" link2="tool" reason="Adjacent"/></robot>"""


def make():
    try:
        return fcl_kios.Robot(URDF)
    except ImportError as error:
        pytest.skip(str(error))


@pytest.fixture
def arm():
    robot = make()
    robot.add_box("post", [0.1, 0.1, 2], shapes.translation(0.45))
    return robot


@pytest.fixture(scope="module")
def configurations():
    return np.random.default_rng(1).uniform([-3, -2.4], [3, 2.4], (400, 2))


def test_what_it_is(tmp_path):
    make()
    (tmp_path / "arm.srdf").write_text(SRDF)
    robot = fcl_kios.Robot(URDF, tmp_path / "arm.srdf")
    assert robot.name == "arm" and repr(robot) == "<fcl_kios.Robot 'arm', 2 coordinates>"
    assert robot.joints == ["turn", "elbow"] and robot.links == ["base", "upper", "lower", "tool"]
    assert robot.lower.tolist() == [-np.inf, -2.5] and robot.upper.tolist() == [np.inf, 2.5]
    assert robot.states == ["ready"] and robot.state("ready").tolist() == [0, 1]
    group = robot.group("all")
    assert robot.groups == ["all"] and group.joints == robot.joints
    assert group.coordinates.tolist() == [0, 1] and "tool" in group.links
    assert robot.warnings == [] and robot.is_ignored("base", "upper")
    assert robot.within_limits([0, 2.6]) is False and robot.within_limits([0, 2.6], slack=0.2)
    assert robot.within_limits([[9, 0], [0, 3]]).tolist() == [True, False]
    X = robot.pose("tool", [np.pi / 2, np.pi / 2])
    assert np.allclose(X[:3, 3], [0, 0.45, 0.57]) and X.shape == (4, 4)
    assert robot.pose("tool", np.zeros((3, 2))).shape == (3, 4, 4)


def test_batches_answer_as_one_by_one(arm, configurations):
    hits = arm.contacts(configurations)
    assert 0.02 < hits.mean() < 0.9
    assert hits.tolist() == [arm.contact(q) is not None for q in configurations]
    assert arm.contacts(configurations[0]) is bool(hits[0])
    done = []
    all_of = arm.clearance(configurations, threads=2, progress=done.append)
    assert sum(done) == len(configurations) and all_of.gradient.shape == (400, 2)
    motions = arm.check_motion(configurations[:-1], configurations[1:], first_contact=True)
    assert set(motions.verdict) == {"clear", "contact"}
    for i in range(0, 399, 7):
        for one, batch in ((arm.clearance(configurations[i]), all_of),
                           (arm.check_motion(configurations[i], configurations[i + 1],
                                             first_contact=True), motions)):
            for value, column in zip(one[:5], batch[:5]):
                assert np.array_equal(value, column[i])
        assert np.array_equal(arm.clearance(configurations[i]).gradient, all_of.gradient[i])
    assert len(arm.check_motion(configurations[0], configurations[:5]).verdict) == 5
    for empty in (arm.contacts(np.empty((0, 2))), arm.clearance(np.empty((0, 2))).gradient,
                  arm.check_motion(np.empty((0, 2)), np.empty((0, 2))).verdict):
        assert len(empty) == 0


def test_clearance_and_gradient(arm):
    q = np.array([0.3, 0.8])
    here = arm.clearance(q, among="obstacles")
    assert here.b == "post" and here.lower_bound <= here.clearance
    assert np.isclose(np.linalg.norm(here.point_b - here.point_a), here.clearance)
    assert here.gradient.shape == (2,) and np.isfinite(here.gradient).all()
    assert arm.clearance(q, among="itself").b in arm.links
    near = arm.within(q, here.clearance + 0.05)
    assert near.clearance[0] == arm.clearance(q).clearance and (np.diff(near.clearance) >= 0).all()
    assert arm.within(q, -1).a == []
    assert np.isnan(arm.clearance(q, gradient=False).gradient).all()
    far = arm.clearance(q, far_enough=1e-9)
    assert far.a == "" and far.clearance == np.inf and np.isnan([far.point_a, far.point_b]).all()


def test_least_clearance(arm):
    q0, q1 = np.array([-1.0, 0.4]), np.array([1.0, 0.4])
    found = arm.least_clearance([q0, q1], abs_err=1e-4, rel_err=0)
    assert found.complete and found.upper - 1.1e-4 <= found.lower <= found.upper
    assert np.isclose(arm.clearance(found.at).clearance, found.upper)
    box = arm.least_clearance(box=([-1, 0.4], [1, 0.4]))
    assert box.lower <= found.upper and box.upper >= found.lower and box.complete
    each = arm.least_clearances([q0, q1])
    assert len(each) > 3 and each[0].lower == min(pair.lower for pair in each)
    with pytest.raises(ValueError, match="limits"):
        arm.least_clearance(box=([0, 0], [0, 3]))
    assert arm.least_clearance(box=([0, 0], [0, 3]), within_limits=False).queries > 0
    assert arm.least_clearance([q0, [0, 3]]).queries > 0
    for wrong in (dict(path=[q0, [0, 3]], within_limits=True), dict(path=[q0, q1], max_queries=-5),
                  dict(), dict(path=[q0], box=(q0, q1)), dict(path=[q0]), dict(box=[q0])):
        with pytest.raises(ValueError):
            arm.least_clearance(**wrong)


def test_the_world_changes(arm, torus):
    q = [0.0, 1.2]
    arm.remove("post")
    assert arm.contact(q) is None
    X = arm.pose("tool", q)
    for add in (lambda: arm.add("thing", torus, X @ shapes.translation(-1.4)),
                lambda: arm.add("thing", fcl.Sphere(0.1), X),
                lambda: arm.add("thing", shapes.bvh(*shapes.box(0.1)), X),
                lambda: arm.add_points("thing", X[:3, 3] + [[0, 0, 0], [9, 9, 9]], 0.01)):
        add()
        hit = arm.contact(q)
        assert {hit.a, hit.b} & {"thing"} and hit.point.shape == (3,)
        arm.move("thing", shapes.translation(50))
        assert arm.contact(q) is None
        arm.remove("thing")
    ball = fcl.Sphere(0.1)
    arm.attach("cup", "tool", ball, shapes.translation(0, 0, 0.1))
    ball.radius = 99.0  # no longer the robot's
    assert arm.contact(q) is None
    other = copy.copy(arm)
    other.detach("cup", q)
    assert other.clearance(q, among="obstacles").clearance == 0  # of the tool, which it touched
    assert arm.clearance(q, among="obstacles").b == ""
    other.attach_obstacle("cup", "tool", q, touch_links="lower")
    assert other.is_ignored("cup", "lower") and not other.is_ignored("cup", "upper")
    assert np.allclose(other.pose("cup", [1, 1]), other.pose("tool", [1, 1]) @ shapes.translation(0, 0, 0.1))
    arm.set_padding("cup", 0.2)
    assert arm.contact([0, 2.4]) and not other.contact([0, 2.4])
    arm.ignore_pair("cup", "base")
    assert arm.is_ignored("base", "cup")


def test_files(tmp_path):
    robot = make()
    (tmp_path / "scene.yaml").write_text(
        "world: {collision_objects: [{id: post, primitives: [{type: sphere, dimensions: [0.2]}], "
        "primitive_poses: [{position: [0.5, 0, 0.5]}]}]}")
    robot.add_scene(tmp_path / "scene.yaml")
    assert robot.clearance([0, 0], among="obstacles").b == "post"
    head = b"# Octomap OcTree binary file\n#\nid OcTree\nsize 73\nres 0.1\ndata\n"
    room = os.path.join(os.fsencode(tmp_path), b"r\xf6om.bt")  # not UTF-8
    with open(room, "wb") as file:
        file.write(head + bytes([0xFF, 0xFF] + [0xAA, 0xAA] * 8))
    (tmp_path / "cut.bt").write_bytes(head + bytes([0xFF, 0xFF, 0xAA]))
    with pytest.raises(ValueError, match="cut.bt: .*octree"):
        robot.add_octomap("room", tmp_path / "cut.bt")
    (tmp_path / "part.3ds").write_bytes(b"3ds")
    (tmp_path / "part.urdf").write_text(URDF.read_text().replace(
        '<sphere radius="0.06"/>', '<mesh filename="part.3ds"/>'))
    with pytest.raises(ValueError, match="part.3ds: .* convert it to"):
        fcl_kios.Robot(tmp_path / "part.urdf")
    with pytest.raises(ValueError, match="none.bt"):
        robot.add_octomap("room", tmp_path / "none.bt")
    robot.add_octomap("room", os.fsdecode(room), shapes.translation(9))
    assert robot.pose("room", [0, 0])[0, 3] == 9


def test_pairs():
    robot = make()
    pairs = robot.link_pairs()
    verdicts = {frozenset((p.a, p.b)): p.verdict for p in pairs}
    assert verdicts[frozenset(("lower", "tool"))] == "always"
    assert verdicts[frozenset(("base", "tool"))] == "never"
    assert all(robot.contact(p.q) for p in pairs if p.verdict == "sometimes")
    robot.ignore(pairs)
    assert all(robot.is_ignored(p.a, p.b) == (p.verdict in ("always", "never")) for p in pairs)


def test_threads_change_and_ask(arm, configurations):
    """A change waits for queries, and each answer is that of one of the worlds."""
    arm.add("moving", fcl.Sphere(0.3), shapes.translation(9))
    far = arm.contacts(configurations)
    arm.move("moving", shapes.translation(0, 0.6, 0.5))
    near = arm.contacts(configurations)
    assert (far != near).any()
    wrong, stop = [], threading.Event()

    def ask():
        while not stop.is_set():
            hits = arm.contacts(configurations, threads=1)
            if not (np.array_equal(hits, far) or np.array_equal(hits, near)):
                wrong.append(hits)

    askers = [threading.Thread(target=ask) for _ in range(2)]
    for thread in askers:
        thread.start()
    for i in range(100):
        arm.move("moving", shapes.translation(0, 0.6, 0.5) if i % 2 else shapes.translation(9))
    stop.set()
    for thread in askers:
        thread.join()
    assert not wrong
    with pytest.raises(RuntimeError, match="robot"):
        arm.contacts(configurations, progress=lambda n: arm.remove("moving"))


def test_refusals(arm, tmp_path):
    q = [0, 0]
    for refused, words in (
            (lambda: fcl_kios.Robot(tmp_path / "none.urdf"), "none.urdf"),
            (lambda: arm.contact([0, 0, 0]), r"q has shape \(3,\).* coordinates of arm"),
            (lambda: arm.contact([[0, 0]]), "one configuration"),
            (lambda: arm.contacts([[0, 0], [0, np.nan]]), r"elbow of q is NaN.*q\[1\]"),
            (lambda: arm.check_motion([[0, 0]] * 2, [[0, 0]] * 3), "2 q0, but 3 q1"),
            (lambda: arm.check_motion(q, [0, 2.6], within_limits=True), "q1 .*limits .*elbow"),
            (lambda: arm.check_motion(q, [0, np.nan]), r"q1[^[]*$"),
            (lambda: arm.check_motion(q, [q, [0, np.nan]]), r"q1 .*motion\[1\]"),
            (lambda: arm.link_pairs(threads=0), "threads"),
            (lambda: arm.link_pairs(max_boxes=-1), ": max_boxes"),
            (lambda: arm.ignore([fcl_kios.LinkPair("base", "tool", "never", False, None),
                                 fcl_kios.LinkPair("base", "x", "never", False, None)]), "'x'"),
            (lambda: arm.add_box("b", [1, 1]), r"size has shape \(2,\)"),
            (lambda: arm.clearance(q, among="all of them"), "among"),
            (lambda: arm.add_box("post", [1, 1, 1]), "in use"),
            (lambda: arm.add_points("p", np.zeros((2, 2))), "shape")):
        with pytest.raises(ValueError, match=words):
            refused()
    assert not arm.is_ignored("base", "tool")
    assert arm.check_motion(q, [0, 2.6]).verdict in ("clear", "contact")
    with pytest.raises(TypeError, match="Mesh"):
        arm.add("x", 3)
