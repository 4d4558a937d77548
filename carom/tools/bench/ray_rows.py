"""Rays: 10,000 of them against 1,000 bodies, and against 20,000 triangles beside trimesh with embreex."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from math import inf

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.vector import normalise
from carom.systems.queries.rays import cast_rays
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, compared, figure, timed

RAYS, BODIES = 10_000, 1_000
WIDTH = 40.0  # m, of the cube in which bodies float
RINGS, SEGMENTS = 200, 50  # of a tube, each with two triangles
HULL = [(0.5, 0.0, 0.0), (-0.5, 0.1, 0.0), (0.0, 0.5, 0.1), (0.1, -0.5, 0.0), (0.0, 0.1, 0.5), (0.1, 0.0, -0.5)]
SHAPES = (
    {"sphere": {"radius": 0.5}},
    {"box": {"size": (1.0, 0.8, 0.6)}},
    {"capsule": {"radius": 0.3, "length": 0.8}},
    {"cylinder": {"radius": 0.4, "length": 1.0}},
    {"cone": {"radius": 0.5, "length": 1.0}},
    {"ellipsoid": {"radii": (0.5, 0.4, 0.3)}},
    {"convex": {"points": HULL}},
)
OF_EMBREE = 0.4  # Embree computes in single precision, twice as many numbers in a register
REPEATS = 15


def figures() -> Iterator[Figure]:
    """Yield the time of a batch against bodies and against a mesh, and how many times longer trimesh takes."""
    generator = np.random.default_rng(0)
    world = floating(generator)
    origins, directions = rays_within(generator, WIDTH)
    timing = timed(lambda: cast_rays(world, origins, directions), REPEATS)
    yield figure(f"{RAYS:,} rays, {BODIES:,} mixed bodies", "ms", timing, 10.0, 1e3)

    ring = knotted_ring()
    simulation = Simulation(checked=False)
    simulation.add(collider={"shape": Mesh(ring)})
    origins, directions = rays_within(generator, 4.0)
    world = simulation.world
    name = f"{RAYS:,} rays, {len(ring.faces):,} triangles"
    yield figure(name, "ms", timed(lambda: cast_rays(world, origins, directions), REPEATS), 20.0, 1e3)
    if find_spec("embreex") is not None:
        yield from beside_embree(name, world, ring, origins, directions)


def beside_embree(name: str, world: World, ring: Geometry, origins: Floats, directions: Floats) -> Iterator[Figure]:
    """Compare with trimesh, asked for as much: the triangle and the place of every ray's first hit."""
    from trimesh import Trimesh

    mesh = Trimesh(ring.vertices, ring.faces, process=False)

    def by_trimesh() -> object:
        return mesh.ray.intersects_id(origins, directions, return_locations=True, multiple_hits=False)

    ratio = compared(by_trimesh, lambda: cast_rays(world, origins, directions), REPEATS)
    yield figure(f"{name}, embree", "x as fast as trimesh", ratio, OF_EMBREE, at_least=True)
    yield figure(f"{name}, embree", "ms, trimesh", timed(by_trimesh, REPEATS), inf, 1e3)


def floating(generator: np.random.Generator) -> World:
    """Return bodies of all convex shapes, turned every way, in a cube."""
    simulation = Simulation(checked=False)
    places = generator.uniform(-0.5 * WIDTH, 0.5 * WIDTH, (BODIES, 3))
    turns = quaternion.normalise(generator.normal(size=(BODIES, 4)))
    for k in range(BODIES):
        pose = {"position": places[k], "rotation": turns[k]}
        simulation.add(collider=SHAPES[k % len(SHAPES)], body={}, transform=pose, visual=False)
    return simulation.world


def rays_within(generator: np.random.Generator, width: float) -> tuple[Floats, Floats]:
    """Return origins on the faces of a cube, with directions towards places within it."""
    origins = generator.uniform(-0.5 * width, 0.5 * width, (RAYS, 3))
    origins[np.arange(RAYS), generator.integers(3, size=RAYS)] = generator.choice([-0.5, 0.5], RAYS) * width
    return origins, normalise(generator.uniform(-0.3 * width, 0.3 * width, (RAYS, 3)) - origins)


def knotted_ring() -> Geometry:
    """Return a tube along a trefoil knot of 20,000 triangles, some 4 m wide."""
    along = np.linspace(0.0, 2.0 * np.pi, RINGS, endpoint=False)
    around = np.linspace(0.0, 2.0 * np.pi, SEGMENTS, endpoint=False)
    spine = np.stack(
        [
            np.sin(along) + 2.0 * np.sin(2.0 * along),
            np.cos(along) - 2.0 * np.cos(2.0 * along),
            -np.sin(3.0 * along),
        ],
        axis=1,
    )
    forward = normalise(np.roll(spine, -1, axis=0) - np.roll(spine, 1, axis=0))
    side = normalise(np.cross(forward, [0.0, 0.0, 1.0]))
    up = np.cross(side, forward)
    circle = np.cos(around)[None, :, None] * side[:, None] + np.sin(around)[None, :, None] * up[:, None]
    vertices = 0.6 * (spine[:, None] + 0.4 * circle)
    ring, turn = np.meshgrid(np.arange(len(along)), np.arange(len(around)), indexing="ij")
    after, beside = (ring + 1) % len(along), (turn + 1) % len(around)
    a, b, c, d = (
        (r * len(around) + t).ravel() for r, t in ((ring, turn), (after, turn), (after, beside), (ring, beside))
    )
    return Geometry(vertices.reshape(-1, 3), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))
