"""How fast turning moves a shape as a whole: never faster than by its lever, and not at all about its own axis."""

from __future__ import annotations

import numpy as np
import pytest
import spending

from carom.ecs import Motion
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.spatial import quaternion
from carom.systems.continuous import fast_of, look_at
from carom.systems.detection.bounds import reach_within
from carom.systems.kernels.swinging import LEVER, REACH
from carom.systems.looked import Looked
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
FAST, TURN = 200.0, 1e-6


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", SHAPES)
def test_turning_moves_no_shape_farther_than_its_lever(name: str, seed: int) -> None:
    """How far it extends along any direction changes by less, wherever it is on its body and however that turns."""
    random = np.random.default_rng(seed)
    rotation, axis, directions = any_turn(random), any_direction(random), random.normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    place = random.uniform(-1.0, 1.0, 3)
    found = numbers(SHAPES[name], place, rotation, FAST * axis)
    assert moved(SHAPES[name], place, rotation, axis, directions) <= 1.0001 * found[LEVER] * TURN
    assert found[LEVER] <= found[REACH]


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", SHAPES)
def test_the_axis_of_a_lever_turns_with_its_body(name: str, seed: int) -> None:
    """Whoever has tumbled since moves no faster than is said, about any axis, and about that one as fast as before."""
    random = np.random.default_rng(seed)
    rotation, axis, directions = any_turn(random), any_direction(random), random.normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    place, tumbled = random.uniform(-1.0, 1.0, 3), any_turn(random)
    found = numbers(SHAPES[name], place, rotation, FAST * axis)
    now = quaternion.rotate(tumbled, place), quaternion.multiply(tumbled, rotation)
    for aside in (0.0, 0.1, 1.0):
        angular = 2.0 * FAST * quaternion.rotate(tumbled, axis + aside * any_direction(random))
        spin = float(np.linalg.norm(angular))
        swing = swing_of(found, tumbled, angular)
        assert moved(SHAPES[name], *now, angular / spin, directions) <= 1.0001 * swing / spin * TURN
        if not aside:
            assert swing == pytest.approx(spin * found[LEVER], rel=1e-12)


@pytest.mark.parametrize("aside", [0.0, 0.4])
@pytest.mark.parametrize("name", ["capsule", "cylinder", "cone", "egg"])
def test_about_its_own_axis_it_moves_as_its_middle_does(name: str, aside: float) -> None:
    """Which stays, or goes round an axis so far aside."""
    rotation = any_turn(np.random.default_rng(7))
    along, across = quaternion.rotate(rotation, np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]))
    found = numbers(SHAPES[name], 0.3 * along + aside * across, rotation, FAST * along)
    assert found[LEVER] == pytest.approx(aside, abs=1e-9)


def moved(shape: Shape, place: Floats, rotation: Floats, axis: Floats, directions: Floats) -> float:
    """Return how much farther a shape comes along any of the directions (n, 3) by a small turn about the origin, m."""
    turn = np.array([*(np.sin(0.5 * TURN) * axis), np.cos(0.5 * TURN)])
    after = extents(shape, quaternion.rotate(turn, place), quaternion.multiply(turn, rotation), directions)
    return float(np.abs(after - extents(shape, place, rotation, directions)).max())


def extents(shape: Shape, place: Floats, rotation: Floats, directions: Floats) -> Floats:
    """Return how far a shape there reaches along directions (n, 3), m."""
    points = shape.support(quaternion.rotate(quaternion.conjugate(rotation), directions))
    found: Floats = np.einsum("ij,ij->i", quaternion.rotate(rotation, points) + place, directions)
    return found


def swing_of(found: Floats, turned: Floats, angular: Floats) -> float:
    """Return how fast (m/s) what has these numbers moves by turning, by what trust in its contacts it spends."""
    left, still = np.array([1e6]), np.zeros((1, 3))
    spending.spend(1.0, found[None], left, still, angular[None], still, turns=turned[None])
    return float(1e6 - left[0])


def numbers(shape: Shape, place: Floats, rotation: Floats, angular: Floats) -> Floats:
    """Return the numbers of a shape, first, that is there on a body which turns so, with the ground."""
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
        center = world[Flight].detected_center
        fast, found = fast_of(world, pair, 1.0, center)
        look_at(world, fast, center, Looked.room(found))
    return found[0]


def any_turn(random: np.random.Generator) -> Floats:
    """Return a rotation."""
    q = random.normal(size=4)
    return np.asarray(q / np.linalg.norm(q))


def any_direction(random: np.random.Generator) -> Floats:
    """Return a unit vector."""
    v = random.normal(size=3)
    return np.asarray(v / np.linalg.norm(v))
