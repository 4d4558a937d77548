"""The overlay of joints draws what their table holds."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import Transform
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.coloring import on_scale
from carom.tools.marks import Arrows, Inset, Lines, Points
from carom.tools.overlays import OVERLAYS
from carom.tools.overlays.joints import AXIS, LIMIT, MOTOR, NEEDLE
from carom.tools.overlays.overlay import Overlay, Seen
from carom.tools.view import View

VIEW = View(Camera((0.0, 0.0, 10.0), fov=math.radians(60.0)), 160, 120)
TALL = 2.0 * 10.0 * math.tan(math.radians(30.0))  # of the picture at the target, m
BALL = {"collider": {"sphere": {"radius": 0.1}}, "body": {"mass": 2.0}}


def drawn(simulation: Simulation, overlay: Overlay) -> list[Lines | Arrows | Points | Inset]:
    """Return the marks of the overlay as a picture would have them."""
    return list(overlay.marks(Seen(simulation, (), simulation.world[Transform], simulation.time, VIEW)))  # type: ignore[arg-type]


def of_color(marks: list[Lines | Arrows | Points | Inset], color: tuple[float, ...], kind: type = Lines) -> np.ndarray:
    """Return the starts and ends (n, 2, 3) of all marks of one colour."""
    found = [
        np.stack([mark.starts[rows], mark.ends[rows]], axis=1)
        for mark in marks
        if type(mark) is kind
        for rows in [(mark.colors[:, :3] == color).all(axis=1)]
    ]
    return np.concatenate(found)


def test_a_line_goes_from_body_to_body_in_the_colour_of_the_load() -> None:
    """A weight of 2 kg below a post: 19.62 N on a scale to 20, from the anchor to its centre."""
    simulation = Simulation(dt=1 / 60, sleeping=False)
    simulation.add(name="post", transform={"position": (1.0, 2.0, 0.0)})
    simulation.add(name="weight", transform={"position": (1.0, 1.0, 0.0)}, **BALL)
    simulation.add(joint={"ball": {"a": "post", "b": "weight", "at": (1.0, 2.0, 0.0)}})
    simulation.step(120)
    marks = drawn(simulation, OVERLAYS["joints"]())
    color = tuple(on_scale(np.array([19.62 / 20.0]))[0])
    links = next(mark for mark in marks if isinstance(mark, Lines))
    assert links.colors[:, :3] == pytest.approx(np.tile(color, (3, 1)), abs=1e-3)
    assert [links.starts[1], links.ends[1]] == [
        pytest.approx([1.0, 2.0, 0.0], abs=1e-3),
        pytest.approx([1.0, 1.0, 0.0], abs=1e-3),
    ]
    points = next(mark for mark in marks if isinstance(mark, Points))
    assert points.positions == pytest.approx(np.array([[1.0, 2.0, 0.0]] * 2), abs=1e-3)
    assert any(isinstance(mark, Inset) for mark in marks)


def test_limits_are_arcs_and_the_needle_points_to_the_body() -> None:
    """A door at 30 of -20 to 70 degrees: the ends of its arc are 50 degrees before and 40 behind where it is."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    simulation.add(name="door", transform={"position": (1.0, 0.0, 0.0)}, motion={"angular": (0.0, 1.0, 0.0)}, **BALL)
    limits = (math.radians(-20.0), math.radians(70.0))
    hinge = {"b": "door", "at": (0.0, 0.0, 0.0), "axis": (0.0, 1.0, 0.0), "limits": limits}
    simulation.add(name="hinge", joint={"hinge": hinge})
    simulation.step(20)
    marks, at = drawn(simulation, OVERLAYS["joints"]()), float(simulation["hinge"].joint.position[3])
    place = simulation["door"].transform.position
    (needle,) = of_color(marks, NEEDLE)
    assert needle[1] / np.linalg.norm(needle[1]) == pytest.approx(place / np.linalg.norm(place), abs=1e-6)
    first, last = of_color(marks, LIMIT)[-2:, 1]
    radius = 0.06 * TALL
    for tip, angle in ((first, limits[0]), (last, limits[1])):
        assert tip == pytest.approx([radius * math.cos(angle), 0.0, -radius * math.sin(angle)], abs=1e-3)
    assert at == pytest.approx(math.atan2(-place[2], place[0]), abs=1e-3)
    (axis,) = of_color(marks, AXIS)
    assert axis == pytest.approx(np.array([[0.0, -0.05 * TALL, 0.0], [0.0, 0.05 * TALL, 0.0]]), abs=1e-9)


def test_motors_are_arrows_along_what_they_turn_about() -> None:
    """As long as the torque, 3 N m on a scale to 5; what keeps its speed without effort has none."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    simulation.add(name="wheel", **BALL)
    motor = {"speed": 1e9, "most": 3.0}
    simulation.add(joint={"hinge": {"b": "wheel", "at": (0.0, 0.0, 0.0), "axis": (0.0, 0.0, 1.0), "motor": motor}})
    overlay = OVERLAYS["joints"]()
    assert len(of_color(drawn(simulation, overlay), MOTOR, Arrows)) == 0
    simulation.step()
    (arrow,) = of_color(drawn(simulation, overlay), MOTOR, Arrows)
    assert arrow[1] - arrow[0] == pytest.approx([0.0, 0.0, 0.15 * TALL * 3.0 / 5.0], abs=1e-9)


@pytest.mark.parametrize("soft", [False, True])
def test_springs_are_zigzags_between_their_anchors(soft: bool) -> None:
    """Both as forces and as joints; they begin and end at the anchors."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    simulation.add(name="bob", transform={"position": (0.0, -3.0, 0.0)}, **BALL)
    if soft:
        simulation.add(joint={"spring": {"b": "bob", "anchor_a": (0.0, 0.0, 0.0), "stiffness": 10.0}})
    else:
        simulation.add(spring={"b": simulation.world.find("bob"), "stiffness": 10.0, "rest_length": 3.0})
    simulation.step()
    lines = [
        mark for mark in drawn(simulation, OVERLAYS["joints"]()) if isinstance(mark, Lines) and len(mark.starts) > 10
    ]
    assert len(lines) == 1
    starts, ends = lines[0].starts[2:], lines[0].ends[2:]
    assert starts[0] == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)
    assert ends[-1] == pytest.approx([0.0, -3.0, 0.0], abs=1e-6)
    assert starts[1:] == pytest.approx(ends[:-1])
    assert np.abs(ends[:, 0]).max() == pytest.approx(0.012 * TALL, rel=1e-9)


def test_joints_are_drawn_before_any_step() -> None:
    """Ropes from a to b, whoever they are; a hinge from the world to its b."""
    simulation = Simulation()
    simulation.add(name="post", transform={"position": (0.0, 3.0, 0.0)})
    simulation.add(name="ball", body={"mass": 1.0}, transform={"position": (1.0, 2.0, 0.0)})
    simulation.add(joint={"rope": {"a": "post", "b": "ball", "anchor_a": (0, -1, 0), "anchor_b": (0, 0, 1)}})
    links = next(mark for mark in drawn(simulation, OVERLAYS["joints"]()) if isinstance(mark, Lines))
    assert links.starts.tolist() == [[0.0, 2.0, 0.0], [1.0, 2.0, 1.0], [0.0, 2.0, 0.0]]
    assert links.ends.tolist() == [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0], [1.0, 2.0, 1.0]]


def test_a_world_without_joints_has_nothing_to_draw() -> None:
    """Nor a legend."""
    simulation = Simulation()
    simulation.add(name="ball", **BALL)
    simulation.step()
    assert all(len(mark[0]) == 0 for mark in drawn(simulation, OVERLAYS["joints"]()))
