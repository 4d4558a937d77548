"""Scenes of contact that every engine is given alike, as arrays: z is up, density 1000 kg/m3, friction 0.5."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion

SEED = 12345
THICK = 1.0  # m, floors and walls
BALL = 0.5  # m, radius

Wall = tuple[Floats, Floats]


class Joints(NamedTuple):
    """Ball joints: body ``b`` (m,) held by body ``a`` (m,), -1 for the world, at points (m, 3) where all begins."""

    a: Integers
    b: Integers
    at: Floats


@dataclass
class Scene:
    """Bodies as arrays, each a ball or a box, and what stands still around them.

    ``half`` (n, 3) has the half edges of boxes, m, and a ball's radius three times; a ball that is longer along y is a
    capsule. ``walls`` are boxes along the axes by centre and half edges, ``land`` the vertices and faces of ground that
    rises to ``height(x, y)``. Bodies with ``joints`` pass through everybody.
    """

    steps: int
    ball: np.ndarray
    half: Floats
    position: Floats
    rotation: Floats
    linear: Floats
    angular: Floats
    walls: tuple[Wall, ...] = ()
    land: tuple[Floats, Integers] | None = None
    joints: Joints | None = None

    @property
    def count(self) -> int:
        """How many bodies there are."""
        return len(self.position)


def at_rest(steps: int, position: Floats, half: object, *, ball: bool = False) -> Scene:
    """Return upright bodies of one kind that do not move."""
    n = len(position)
    halves: Floats = np.array(np.broadcast_to(np.asarray(half, np.float64), (n, 3)))
    upright: Floats = np.tile(quaternion.IDENTITY, (n, 1))
    return Scene(steps, np.full(n, ball), halves, position, upright, np.zeros((n, 3)), np.zeros((n, 3)))


def sphere_pile(count: int) -> Scene:
    """Return balls of 1 m above a bin, on a grid hardly larger than they are."""
    random, side = np.random.default_rng(SEED), {1000: 10.0, 10000: 22.0}[count]
    places = lattice(count, side, 1.1, 0.6)
    scene = at_rest(300, places + random.uniform(-0.04, 0.04, places.shape), BALL, ball=True)
    scene.walls = bin_walls(side, 2.0 * float(scene.position[:, 2].max()))
    return scene


def box_pile(count: int, seed: int = SEED) -> Scene:
    """Return boxes of all sizes and turns above a bin."""
    random, side = np.random.default_rng(seed), {1000: 14.0, 4000: 22.0}[count]
    places = lattice(count, side, 1.4, 0.8)
    random.uniform(size=places.shape)  # drawn for a jitter of nothing, and kept: the poses are those others measured
    scene = at_rest(300, places, random.uniform(0.2, 0.4, (count, 3)))
    scene.rotation = any_turn(count, random)
    scene.walls = bin_walls(side, 2.0 * float(scene.position[:, 2].max()))
    return scene


def pyramid(base: int) -> Scene:
    """Return cubes of 1 m in rows, each row a cube shorter than that below it."""
    places = [(j - 0.5 * i - (base - 1) / 2.0, 0.0, i + 0.5) for i in range(base) for j in range(i, base)]
    scene = at_rest(300, np.array(places), 0.5)
    scene.walls = (wall((0.0, 0.0, -1.0), (200.0, 200.0, 1.0)),)
    return scene


def terrain(count: int) -> Scene:
    """Return balls and boxes above hills of 20,000 triangles."""
    random, cells, reach = np.random.default_rng(SEED), 100, 50.0
    per = int(np.ceil(np.sqrt(count)))
    place = np.stack(np.divmod(np.arange(count), per)[::-1], axis=1) - (per - 1) / 2.0
    over = 3.0 * place + random.uniform(-0.5, 0.5, (count, 2))
    scene = at_rest(300, np.column_stack([over, np.full(count, 5.0)]), (0.5, 0.4, 0.3))
    scene.ball[::2] = True
    scene.half[::2] = BALL
    scene.rotation = any_turn(count, random)
    x, y = np.meshgrid(*[np.linspace(-reach, reach, cells + 1)] * 2, indexing="ij")
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    right, back = corner + cells + 1, corner + 1
    faces = np.concatenate([np.stack([corner, right, back], 1), np.stack([right, right + 1, back], 1)])
    scene.land = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3), faces
    return scene


def height(x: Floats, y: Floats) -> Floats:
    """Return how high the land is, m."""
    hills: Floats = 2.0 * np.sin(0.25 * x) * np.cos(0.25 * y) + 0.05 * np.sin(0.9 * x + 0.7 * y)
    return hills


def free_flight(count: int) -> Scene:
    """Return boxes that drift, tumble and fall, too far apart to meet."""
    random, per = np.random.default_rng(SEED), int(np.ceil(count ** (1 / 3)))
    places = lattice(count, 3.0 * per + 0.2, 3.0, 0.0)
    random.uniform(size=places.shape)  # as for the boxes of a pile
    scene = at_rest(200, places, (0.3, 0.2, 0.1))
    scene.linear, scene.angular = random.uniform(-0.2, 0.2, (count, 3)), random.uniform(-2.0, 2.0, (count, 3))
    return scene


def lattice(count: int, side: float, spacing: float, low: float) -> Floats:
    """Return places on a grid, layer upon layer from ``low``, as many beside each other as ``side`` has room for."""
    per = int((side - 0.1) // spacing)
    k = np.arange(count)
    cells = np.stack([k % per, k // per % per, k // per**2], axis=1)
    return spacing * (cells - [(per - 1) / 2.0, (per - 1) / 2.0, 0.0]) + [0.0, 0.0, low]


def bin_walls(side: float, high: float) -> tuple[Wall, ...]:
    """Return a floor and four walls around ``side`` x ``side``."""
    half, thick = side / 2.0, THICK / 2.0
    walls = [wall((0.0, 0.0, -thick), (half + THICK, half + THICK, thick))]
    for sign in (-1.0, 1.0):
        away, level = sign * (half + thick), high / 2.0
        walls.append(wall((away, 0.0, level), (thick, half + THICK, level)))
        walls.append(wall((0.0, away, level), (half + THICK, thick, level)))
    return tuple(walls)


def wall(center: tuple[float, float, float], half: tuple[float, float, float]) -> Wall:
    """Return a box along the axes."""
    return np.array(center), np.array(half)


def any_turn(count: int, random: np.random.Generator) -> Floats:
    """Return rotations, all as likely."""
    return quaternion.normalise(random.normal(size=(count, 4)))
