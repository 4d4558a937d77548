"""Rays: each hit is where geometry has it, and nothing is a NaN."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from meshes import block, sheet
from ray_worlds import EXACT, PLACE, TURN, alone, finite, rays_at, searched
from solids import SOLIDS

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.vector import normalise
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.land import land
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation


@pytest.mark.parametrize("far", [3.0, pytest.param(1e5, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", SOLIDS)
def test_distances_points_and_normals_are_exact(name: str, far: float) -> None:
    """Of every convex shape, turned and moved, from near and from 100 km: against a search along the ray."""
    collider, outside = SOLIDS[name]
    origin, direction = rays_at(1, 400, far)
    skipped = max(far - 4.0, 0.0)
    hits = alone(collider, position=PLACE, rotation=TURN).space.cast_rays(origin, direction, skipped + 8.0)
    expected, clear = searched(outside, origin, direction, skipped)
    assert clear.sum() > 150
    assert (hits.hit == np.isfinite(expected))[clear].all()
    met = clear & hits.hit
    assert met.sum() > 60
    assert np.abs(hits.distance[met] - expected[met]).max() < EXACT
    assert np.abs(hits.point[met] - origin[met] - hits.distance[met, None] * direction[met]).max() < EXACT
    assert finite(hits)

    back = quaternion.conjugate(TURN)
    local, facing = quaternion.rotate(back, hits.point[met] - PLACE), quaternion.rotate(back, hits.normal[met])
    steps = 1e-6 * np.eye(3)
    ahead, behind = (np.stack([outside(local + sign * step) for step in steps], axis=1) for sign in (1.0, -1.0))
    smooth = np.abs(ahead + behind).max(axis=1) < 1e-9  # not at an edge
    assert smooth.mean() > 0.9
    assert np.abs(normalise(ahead - behind) - facing)[smooth].max() < 1e-4
    assert np.abs(np.linalg.norm(facing, axis=1) - 1.0).max() < 1e-14


def test_faces_of_boxes_and_round_solids_are_named() -> None:
    """Boxes: -x +x -y +y -z +z; cylinders and cones: side, bottom, top; spheres have one."""
    box, axes = alone({"box": {"size": (2.0, 2.0, 2.0)}}), np.concatenate([np.eye(3), -np.eye(3)])
    assert box.space.cast_rays(5.0 * axes, -axes).face.tolist() == [1, 3, 5, 0, 2, 4]
    for key, faces in (("cylinder", [0, 2, 0, 0, 1, 0]), ("cone", [0, 0, 0, 0, 1, 0])):
        simulation = alone({key: {"radius": 1.0, "length": 2.0}})
        assert simulation.space.cast_rays(5.0 * axes + [0.0, 0.0, 1e-3], -axes).face.tolist() == faces
    assert set(alone({"sphere": {"radius": 1.0}}).space.cast_rays(5.0 * axes, -axes).face.tolist()) == {0}


def brute_force(geometry: Geometry, origin: Floats, direction: Floats) -> tuple[Floats, Floats]:
    """Return (distance, face) of the first front each ray meets (Moeller and Trumbore, JGT 2 (1), 1997)."""
    a, b, c = (geometry.vertices[geometry.faces[:, k]] for k in range(3))
    u, v = b - a, c - a
    p = np.cross(direction[:, None], v)
    whole = (p * u).sum(axis=2)
    t = origin[:, None] - a
    with np.errstate(divide="ignore", invalid="ignore"):
        of_b = (p * t).sum(axis=2) / whole
        q = np.cross(t, u)
        of_c = (q * direction[:, None]).sum(axis=2) / whole
        s = (q * v).sum(axis=2) / whole
        inside = (whole > 0.0) & (of_b >= 0.0) & (of_c >= 0.0) & (of_b + of_c <= 1.0) & (s >= 0.0)
    s = np.where(inside, s, np.inf)
    return s.min(axis=1), s.argmin(axis=1)


@pytest.mark.parametrize("kind", ["ring", "land"])
def test_meshes_are_met_where_every_triangle_tested_says(kind: str) -> None:
    """The nearest triangle of a torus and of rough land, with its own number and normal."""
    from trimesh.creation import torus

    if kind == "ring":
        ring = torus(1.0, 0.4, major_sections=24, minor_sections=12)
        geometry = Geometry(np.array(ring.vertices), np.array(ring.faces, np.int64))
        collider: dict[str, Any] = {"shape": Mesh(geometry)}
    else:
        geometry = land(np.random.default_rng(3).uniform(-0.3, 0.3, (9, 9)), 0.4, 0.4, "test")
        collider = {"shape": HeightField(geometry)}
    origin, direction = rays_at(5, 1500, 4.0)
    if kind == "land":
        origin[:, 1] = np.abs(origin[:, 1]) + 0.5
        direction = normalise(np.random.default_rng(6).uniform(-1.5, 1.5, origin.shape) * [1, 0, 1] - origin)
    hits = alone(collider).space.cast_rays(origin, direction)
    distance, face = brute_force(geometry, origin, direction)
    assert hits.hit.mean() > 0.3
    assert (hits.hit == np.isfinite(distance)).all()
    met = hits.hit
    assert np.abs(hits.distance[met] - distance[met]).max() < EXACT
    assert (hits.face[met] == face[met]).mean() > 0.99  # along an edge of two either is right
    a, b, c = (geometry.vertices[geometry.faces[hits.face[met], k]] for k in range(3))
    assert np.abs(normalise(np.cross(b - a, c - a)) - hits.normal[met]).max() < 1e-12


def test_no_ray_slips_between_triangles() -> None:
    """Aimed at vertices and at edges of a closed mesh from outside, every ray meets it."""
    geometry = block()
    generator = np.random.default_rng(2)
    target = geometry.vertices[geometry.faces]
    share = generator.uniform(0.0, 1.0, (50, len(geometry.faces), 1))
    aims = np.concatenate([target[:, 0], *(s * target[:, 0] + (1.0 - s) * target[:, 1] for s in share)])
    center = geometry.vertices.mean(axis=0)
    origin = center + 5.0 * normalise(aims - center)
    hits = alone({"shape": Mesh(geometry)}).space.cast_rays(origin, aims - origin)
    assert hits.hit.all()
    assert np.abs(hits.distance - np.linalg.norm(aims - origin, axis=1)).max() < EXACT


def test_turning_and_moving_everything_changes_no_distance() -> None:
    """Rays, and bodies of every shape, in one frame and in another."""
    generator = np.random.default_rng(8)
    origin, direction = rays_at(9, 500, 6.0)
    turn, shift = quaternion.normalise(generator.normal(size=4)), np.array([3.0, -40.0, 7.0])
    found = []
    for moved in (False, True):
        generator = np.random.default_rng(10)
        simulation = Simulation()
        for collider in [words for name, (words, _) in SOLIDS.items() if name != "plane"] + [{"shape": Mesh(block())}]:
            place, rotation = generator.uniform(-2.0, 2.0, 3), quaternion.normalise(generator.normal(size=4))
            if moved:
                place, rotation = quaternion.rotate(turn, place) + shift, quaternion.multiply(turn, rotation)
            simulation.add(collider=collider, transform={"position": place, "rotation": rotation})
        found.append(
            simulation.space.cast_rays(quaternion.rotate(turn, origin) + shift, quaternion.rotate(turn, direction))
            if moved
            else simulation.space.cast_rays(origin, direction)
        )
    one, other = found
    same = (one.entity == other.entity) & (one.face == other.face)
    assert same.mean() > 0.99  # others graze an edge
    met = same & one.hit
    steep = met & ((one.normal * direction).sum(axis=1) < -0.05)
    assert steep.sum() > 100
    assert np.abs(one.distance[steep] - other.distance[steep]).max() < EXACT
    assert np.abs(quaternion.rotate(turn, one.normal) - other.normal)[steep].max() < 1e-12


def test_all_any_and_first_agree() -> None:
    """All of a ray begins with its first, has every collider once, and any is whether there is one."""
    generator = np.random.default_rng(11)
    simulation = Simulation()
    simulation.add(collider={"plane": {"offset": -5.0}})
    for k in range(60):
        collider = list(SOLIDS.values())[k % 7][0]
        simulation.add(collider=collider, transform={"position": generator.uniform(-3.0, 3.0, 3)})
    origin, direction = rays_at(12, 300, 6.0)
    reach = generator.uniform(2.0, 12.0, 300)
    first = simulation.space.cast_rays(origin, direction, reach)
    every = simulation.space.cast_rays_all(origin, direction, reach)
    assert (simulation.space.cast_rays_any(origin, direction, reach) == first.hit).all()
    rays, at = np.unique(every.ray, return_index=True)
    assert rays.tolist() == np.nonzero(first.hit)[0].tolist()
    for column, others in zip(first, every[1:], strict=True):
        assert (column[rays] == others[at]).all()
    assert len(set(zip(every.ray.tolist(), every.collider.tolist(), strict=True))) == len(every.ray) > 200
    assert (every.distance <= reach[every.ray]).all()
    for k in range(0, 300, 37):  # each by itself
        one = [simulation.space.cast_ray_any(origin[k], direction[k], reach[k], only=int(e)) for e in every.collider]
        assert {int(e) for e, met in zip(every.collider, one, strict=True) if met} == set(
            every.collider[every.ray == k].tolist()
        )


def test_land_without_end_is_sheet_by_sheet() -> None:
    """A ray that passes the rim of land meets nothing, and one onto an open sheet from behind passes it."""
    simulation = alone({"shape": Mesh(sheet(3, 2.0, 0.0))})
    assert simulation.space.cast_ray((0.1, 1.0, 0.2), (0.0, -1.0, 0.0)) is not None
    assert simulation.space.cast_ray((0.1, -1.0, 0.2), (0.0, 1.0, 0.0)) is None
    assert simulation.space.cast_ray((5.0, 1.0, 0.2), (0.0, -1.0, 0.0)) is None
