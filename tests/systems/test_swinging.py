"""How fast turning moves a shape as a whole: never faster than by its lever, and not at all about its own axis."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.spatial import quaternion
from carom.systems.continuous import fast_of
from carom.systems.detection.bounds import reach_within
from carom.systems.kernels.swinging import LEVER, REACH
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.shape import Shape
from carom.systems.simulation import Simulation

WEDGE = hull_of(np.array([(0.0, 0.0, 0.0), (0.3, 0.0, 0.0), (0.0, 0.2, 0.0), (0.1, 0.1, 0.4)]))
SHAPES: dict[str, Shape] = {
    "box": Box(size=(0.2, 0.5, 0.3)),
    "capsule": Capsule(radius=0.1, length=0.6),
    "cylinder": Cylinder(radius=0.1, length=0.6),
    "cone": Cone(radius=0.2, length=0.4),
    "ellipsoid": Ellipsoid(radii=(0.1, 0.3, 0.2)),
    "egg": Ellipsoid(radii=(0.1, 0.3, 0.1)),
    "hull": Convex(WEDGE),
}
SPIN, TURN = 200.0, 1e-6


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", SHAPES)
def test_turning_moves_no_shape_farther_than_its_lever(name: str, seed: int) -> None:
    """How far it extends along any direction changes by less, wherever it is on its body and however that turns."""
    random = np.random.default_rng(seed)
    rotation, axis, directions = any_turn(random), any_direction(random), random.normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    place = random.uniform(-1.0, 1.0, 3)
    before = extents(SHAPES[name], place, rotation, directions)
    turn = np.array([*(np.sin(0.5 * TURN) * axis), np.cos(0.5 * TURN)])
    turned = quaternion.multiply(turn, rotation)
    after = extents(SHAPES[name], quaternion.rotate(turn, place), turned, directions)
    reach, lever = numbers(SHAPES[name], place, rotation, SPIN * axis)
    assert np.abs(after - before).max() <= 1.0001 * lever * TURN
    assert lever <= reach


@pytest.mark.parametrize("aside", [0.0, 0.4])
@pytest.mark.parametrize("name", ["capsule", "cylinder", "cone", "egg"])
def test_about_its_own_axis_it_moves_as_its_middle_does(name: str, aside: float) -> None:
    """Which stays, or goes round an axis so far aside."""
    rotation = any_turn(np.random.default_rng(7))
    along, across = quaternion.rotate(rotation, np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]))
    _, lever = numbers(SHAPES[name], 0.3 * along + aside * across, rotation, SPIN * along)
    assert lever == pytest.approx(aside, abs=1e-9)


def extents(shape: Shape, place: Floats, rotation: Floats, directions: Floats) -> Floats:
    """Return how far a shape there reaches along directions (n, 3), m."""
    points = shape.support(quaternion.rotate(quaternion.conjugate(rotation), directions))
    found: Floats = np.einsum("ij,ij->i", quaternion.rotate(rotation, points) + place, directions)
    return found


def numbers(shape: Shape, place: Floats, rotation: Floats, angular: Floats) -> tuple[float, float]:
    """Return how far a shape reaches from the centre of its body, and from the axis about which that turns, m."""
    simulation = Simulation()
    ground = simulation.add(collider={"plane": {}}, transform={"position": (0.0, -5.0, 0.0)})
    body = simulation.add(body={"mass": 1.0, "center_of_mass": (0.0, 0.0, 0.0)})
    part = simulation.add(
        collider={"shape": shape}, parent={"entity": body, "position": tuple(place), "rotation": tuple(rotation)}
    )
    world = simulation.world
    with world.edit(Motion) as motion:
        motion.linear[world.row(body)], motion.angular[world.row(body)] = 100.0, angular  # so that it is fast
    with world.faces(None):
        reach_within(world, 1.0 / 60.0)
        pair = np.array([[world.row(ground), world.row(part)]])
        _, found = fast_of(world, pair, 1.0, world[Flight].detected_center)
    return float(found[0, REACH + 1]), float(found[0, LEVER + 1])


def any_turn(random: np.random.Generator) -> Floats:
    """Return a rotation."""
    q = random.normal(size=4)
    return np.asarray(q / np.linalg.norm(q))


def any_direction(random: np.random.Generator) -> Floats:
    """Return a unit vector."""
    v = random.normal(size=3)
    return np.asarray(v / np.linalg.norm(v))
