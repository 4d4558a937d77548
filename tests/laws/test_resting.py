"""What rests stays: stacks, pyramids, heavy loads, slopes, and how deep they sink."""

from __future__ import annotations

import math
from itertools import product
from typing import Any

import numpy as np
import pytest

from carom.ecs import Material, Motion, RigidBody, Transform
from carom.ecs.relations.contact import Contact
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

G = 9.81
ROUGH = {"friction": 0.5}
CORNERS = list(product((-0.5, 0.5), repeat=3))
#: The same cube of 1 m.
BLOCKS: dict[str, Any] = {
    "box": {"box": {"size": (1.0, 1.0, 1.0)}},
    "convex": {"convex": {"points": CORNERS}},
    "mesh": {"shape": Mesh(hull_of(np.array(CORNERS)))},
}


def on_ground(gravity: tuple[float, float, float] = (0.0, -G, 0.0), **settings: Any) -> Simulation:
    """Return a world with a rough floor at y = 0."""
    simulation = Simulation(gravity=gravity, checked=False, **settings)
    simulation.add(collider={"plane": {}}, material=ROUGH)
    return simulation


def add_cube(simulation: Simulation, *position: float, mass: float = 1.0, yaw: float = 0.0, size: float = 1.0) -> int:
    """Add a cube of 1 m, or another."""
    return simulation.add(
        collider={"box": {"size": (size, size, size)}},
        body={"mass": mass},
        material=ROUGH,
        transform={"position": position, "rotation": (0.0, math.sin(0.5 * yaw), 0.0, math.cos(0.5 * yaw))},
    )


def positions(simulation: Simulation) -> np.ndarray:
    """Return where all bodies are (n, 3)."""
    return np.array(simulation.world[Transform].position[simulation.world.rows(RigidBody)])


def fastest(simulation: Simulation) -> float:
    """Return the greatest speed of any body."""
    return float(np.linalg.norm(simulation.world[Motion].linear[simulation.world.rows(RigidBody)], axis=1).max())


@pytest.mark.parametrize("substeps", [4, 8, 16])
def test_ten_cubes_stand_for_twenty_seconds(substeps: int) -> None:
    """They neither lean nor creep, and sink by what the springs between them give; the ground does not yield.

    Those swing 3/16 of a period in a substep, at 45 Hz in the four of a default step. Below i cubes each of four points
    bears i g / 4 on a spring of w^2 times the mass that a corner feels, 1/8 kg: that of two cubes of 1 kg in a row,
    each with the lever 1/2 m about two axes of inertia 1/6 kg m2.
    """
    simulation = on_ground(substeps=substeps)
    for i in range(10):
        add_cube(simulation, 0.0, 0.5 + i, 0.0)
    simulation.step(1200)
    placed = positions(simulation)
    assert np.abs(placed[:, [0, 2]]).max() <= 2e-4
    assert fastest(simulation) <= 1e-6
    spring = (2.0 * math.pi * 3.0 / 16.0 * 60.0 * substeps) ** 2
    sunk = sum(i * G / 4.0 * 8.0 / spring for i in range(1, 10))
    assert 9.5 - placed[-1, 1] == pytest.approx(sunk, rel=1e-3)


@pytest.mark.parametrize(
    ("size", "count", "substeps"), [(0.1, 9, 4), (0.1, 14, 8), (0.3, 20, 8), (0.03, 8, 8), (0.01, 8, 16)]
)
def test_towers_of_small_cubes_stand_in_fine_substeps(size: float, count: int, substeps: int) -> None:
    """A tower buckles where springs yield to its weight more than they right: all but the first on those of 45 Hz."""
    simulation = on_ground(substeps=substeps)
    for i in range(count):
        add_cube(simulation, 0.0, (0.5 + i) * size, 0.0, mass=1000.0 * size**3, size=size)
    simulation.step(600)
    assert np.abs(positions(simulation)[:, [0, 2]]).max() <= 4e-3 * size
    assert fastest(simulation) <= 1e-3


@pytest.mark.parametrize("turn", [0.5, math.radians(45.0)], ids=["half a radian", "45 degrees"])
@pytest.mark.parametrize("below", BLOCKS)
def test_a_cube_leans_on_any_corner_of_the_octagon_it_shares_with_another(below: str, turn: float) -> None:
    """Wherever its centre of mass is above the octagon it comes to rest, and stays where it is within 10 um.

    It shifts by as much before the impulses of eight points, two manifolds that take turns, have found their balance.
    """
    for angle in np.radians(np.arange(0.0, 360.0, 45.0)):
        simulation = Simulation()
        simulation.add(collider=BLOCKS[below], material=ROUGH)
        off = (0.45 * math.cos(angle), -0.3, 0.45 * math.sin(angle))
        place = {"position": (0.0, 1.0, 0.0), "rotation": (0.0, math.sin(0.5 * turn), 0.0, math.cos(0.5 * turn))}
        simulation.add(
            collider=BLOCKS["box"], body={"mass": 1.0, "center_of_mass": off}, material=ROUGH, transform=place
        )
        simulation.step(120)
        assert fastest(simulation) <= 1e-9
        assert np.abs(positions(simulation) - place["position"]).max() <= 1e-5


@pytest.mark.parametrize("pitch", [1.05, 1.06])
@pytest.mark.parametrize(
    ("substeps", "aside", "speed"), [(1, 0.02, 1e-3), (2, 2e-3, 1e-3), (4, 1e-3, 1e-4), (8, 2e-4, 1e-6)]
)
def test_a_pyramid_of_55_cubes_stands(substeps: int, aside: float, speed: float, pitch: float) -> None:
    """Ten at the base, 5 or 6 cm apart: none moves sideways by more than 1 mm in 10 s; by more in coarse substeps.

    Springs are softer then, and it rests: stiffer than substeps can follow, they made it flutter at 10 cm/s, and with
    two sweeps after the drift of a whole step one 6 cm apart swayed at 3 mm/s.
    """
    simulation = on_ground(substeps=substeps)
    placed = [(pitch * (j - 0.5 * i - 4.5), 0.5 + i, 0.0) for i in range(10) for j in range(i, 10)]
    for place in placed:
        add_cube(simulation, *place)
    simulation.step(600)
    assert np.abs(positions(simulation) - placed)[:, [0, 2]].max() <= aside
    assert fastest(simulation) <= speed


def test_four_cubes_in_a_column_carry_a_hundred_times_their_mass() -> None:
    """They yield, but stand for 20 s without leaning."""
    simulation = on_ground()
    for i in range(4):
        add_cube(simulation, 0.0, 0.5 + i, 0.0)
    add_cube(simulation, 0.0, 4.5, 0.0, mass=100.0)
    simulation.step(1200)
    placed = positions(simulation)
    assert np.abs(placed[:, [0, 2]]).max() <= 5e-3
    assert placed[-1, 1] > 4.4
    assert fastest(simulation) <= 1e-3


def test_four_cubes_carry_a_slab_of_a_hundred_times_their_mass() -> None:
    """One under each corner, for 20 s."""
    simulation = on_ground()
    corners = [(x, 0.5, z) for x in (-1.0, 1.0) for z in (-1.0, 1.0)]
    for corner in corners:
        add_cube(simulation, *corner)
    simulation.add(
        collider={"box": {"size": (3.0, 1.0, 3.0)}},
        body={"mass": 100.0},
        material=ROUGH,
        transform={"position": (0.0, 1.5, 0.0)},
    )
    simulation.step(1200)
    assert np.abs(positions(simulation) - [*corners, (0.0, 1.5, 0.0)]).max() <= 4e-3
    assert fastest(simulation) <= 1e-5


@pytest.mark.parametrize("yaw", [0.0, math.radians(45.0)], ids=["along an edge", "corner first"])
def test_a_cube_stays_on_a_slope_below_the_angle_of_friction(yaw: float) -> None:
    """At tan 0.45 against mu 0.5: it creeps less than 0.1 mm in 5 s."""
    slope = math.atan(0.45)
    simulation = on_ground((G * math.sin(slope), -G * math.cos(slope), 0.0))
    add_cube(simulation, 0.0, 0.5, 0.0, yaw=yaw)
    simulation.step(300)
    assert np.abs(positions(simulation) - (0.0, 0.5, 0.0)).max() <= 1e-4
    assert fastest(simulation) <= 1e-12


@pytest.mark.parametrize("yaw", [0.0, math.radians(45.0)], ids=["along an edge", "corner first"])
def test_a_cube_slides_down_a_steeper_slope_at_theorys_acceleration(yaw: float) -> None:
    """At tan 0.55: g (sin - mu cos), but for the first step, in which points and friction have to find together."""
    slope = math.atan(0.55)
    simulation = on_ground((G * math.sin(slope), -G * math.cos(slope), 0.0))
    cube = add_cube(simulation, 0.0, 0.5, 0.0, yaw=yaw)
    simulation.step(300)
    expected = G * (math.sin(slope) - 0.5 * math.cos(slope))
    assert simulation[cube].motion.linear[0] / 5.0 == pytest.approx(expected, rel=1e-6)
    assert np.abs(simulation[cube].motion.angular).max() <= 1e-9


@pytest.mark.parametrize("shape", ["box", "sphere"])
def test_what_comes_to_slide_on_ice_keeps_its_speed(shape: str) -> None:
    """Friction that is gone is gone at once: what it pushed with before does not go on pushing."""
    simulation = on_ground()
    size = {"size": (1.0, 1.0, 1.0)} if shape == "box" else {"radius": 0.5}
    slider = simulation.add(
        collider={shape: size}, body={"mass": 1.0}, material=ROUGH, transform={"position": (0.0, 0.5, 0.0)},
        motion={"linear": (2.0, 0.0, 0.0)},
    )  # fmt: skip
    simulation.step(10)
    with simulation.world.edit(Material) as material:
        material.friction[simulation.world.row(slider)] = 0.0
    before = simulation[slider].motion.linear[0]
    simulation.step(60)
    assert 0.5 < before < 2.0
    assert simulation[slider].motion.linear[0] == pytest.approx(before, rel=1e-12)


def test_a_ball_rolls_down_a_slope_at_five_sevenths() -> None:
    """5/7 g sin of 20 degrees, to rounding."""
    slope = math.radians(20.0)
    simulation = on_ground((G * math.sin(slope), -G * math.cos(slope), 0.0))
    ball = simulation.add(
        collider={"sphere": {"radius": 0.5}},
        body={"mass": 1.0},
        material=ROUGH,
        transform={"position": (0.0, 0.5, 0.0)},
    )
    simulation.step(300)
    assert simulation[ball].motion.linear[0] == pytest.approx(5.0 * 5.0 / 7.0 * G * math.sin(slope), rel=1e-9)


CRADLE: dict[str, tuple[dict[str, Any], float]] = {  # and how fast (m/s) what they overlap by leaves, by rounding
    "balls": ({"sphere": {"radius": 0.5}}, 1e-9),
    "boxes": ({"box": {"size": (1.0, 1.0, 1.0)}}, 1e-9),
    "capsules": ({"capsule": {"radius": 0.5, "length": 0.3}}, 1e-9),
    "cylinders": ({"cylinder": {"radius": 0.5, "length": 1.0}}, 5e-6),
}


@pytest.mark.parametrize(("speed", "gravity"), [(1.0, 0.0), (0.1, 0.0), (0.01, 0.0), (1.0, G), (0.1, G)])
@pytest.mark.parametrize("gap", [1e-3, 1e-5, 0.0], ids=["1 mm apart", "10 um apart", "touching"])
@pytest.mark.parametrize("shape", CRADLE)
def test_newtons_cradle_passes_the_blow_on(shape: str, gap: float, speed: float, gravity: float) -> None:
    """Five equal bodies, e = 1: the last leaves with all of the first's speed, however slow; on a floor from 8 cm/s."""
    simulation = Simulation(gravity=(0.0, -gravity, 0.0), checked=False)
    collider, off = CRADLE[shape]
    simulation.add(collider={"plane": {"offset": -0.5}}, material={"friction": 0.0})
    bodies = [
        simulation.add(
            collider=collider,
            body={"mass": 1.0},
            material={"friction": 0.0, "restitution": 1.0},
            transform={
                "position": ((1.0 + gap) * i - (0.5 * speed if i == 0 else 0.0), 0.0, 0.0),
                "rotation": (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)),  # they lie across
            },
            motion={"linear": (speed if i == 0 else 0.0, 0.0, 0.0)},
        )
        for i in range(5)
    ]
    simulation.step(120)
    speeds = [float(simulation[body].motion.linear[0]) for body in bodies]
    assert speeds == pytest.approx([0.0, 0.0, 0.0, 0.0, speed], abs=off)


def test_the_floor_carries_the_weight_of_a_stack() -> None:
    """The impulses of the contacts with it are m g dt, and those of each cube carry what lies above."""
    simulation = on_ground()
    for i in range(4):
        add_cube(simulation, 0.0, 0.5 + i, 0.0)
    simulation.step(600)
    contact = simulation.world[Contact]
    rows = slice(0, contact.count)
    lower = np.array(contact.row_a[rows])
    carried = [contact.impulse[rows][lower == row].sum() for row in range(4)]
    assert carried == pytest.approx([(4 - row) * G / 60.0 for row in range(4)], rel=1e-6)


def test_a_pile_of_boxes_comes_to_rest_without_overlap() -> None:
    """Sixty boxes of all sizes dropped into a bin: after 10 s none moves by more than 0.1 mm/s.

    None is deeper than the spring of a corner gives under the weight of six others.
    """
    simulation = on_ground()
    for x, z in ((3.0, 0.0), (-3.0, 0.0), (0.0, 3.0), (0.0, -3.0)):
        size = (1.0, 20.0, 7.0) if x else (7.0, 20.0, 1.0)
        simulation.add(collider={"box": {"size": size}}, transform={"position": (x, 10.0, z)}, material=ROUGH)
    generator = np.random.default_rng(1)
    for i in range(60):
        turn = generator.normal(size=4)
        simulation.add(
            collider={"box": {"size": tuple(generator.uniform(0.4, 0.8, 3))}},
            body={},
            material=ROUGH,
            transform={
                "position": (1.4 * (i % 3 - 1), 1.0 + 1.4 * (i // 9), 1.4 * (i // 3 % 3 - 1)),
                "rotation": tuple(turn / np.linalg.norm(turn)),
            },
        )
    simulation.step(600)
    placed = positions(simulation)
    assert (np.abs(placed[:, [0, 2]]) < 2.5).all()
    assert (placed[:, 1] > 0.1).all()
    contact = simulation.world[Contact]
    assert contact.depth[: contact.count].max() <= 6.0 * G * 8.0 / (2.0 * math.pi * 45.0) ** 2
    assert fastest(simulation) <= 1e-4
