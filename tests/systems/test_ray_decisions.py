"""What is decided of rays in odd places: from inside, on a surface, along a face, grazing, at one distance."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from meshes import block
from ray_worlds import EXACT, alone, finite, rays_at
from solids import SOLIDS

from carom.ecs.spatial.vector import normalise
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation


@pytest.mark.parametrize("name", [*SOLIDS, "mesh", "height_field"])
def test_a_ray_from_inside_meets_what_it_is_in_at_once(name: str) -> None:
    """At distance 0, facing the ray, without a face; whatever its length."""
    own: dict[str, dict[str, Any]] = {
        "mesh": {"shape": Mesh(block())},
        "height_field": {"height_field": {"heights": np.zeros((3, 3)), "spacing": 2.0}},
    }
    collider = own[name] if name in own else SOLIDS[name][0]
    simulation = alone(collider)
    inside = {"mesh": block().vertices.mean(axis=0), "height_field": (0.3, -5.0, 0.2), "plane": (0.0, -2.0, 0.0)}
    origin = np.array(inside.get(name, (0.0, 0.0, 0.0)))
    directions = normalise(np.random.default_rng(4).normal(size=(200, 3)))
    for reach in (np.inf, 1e-3, 0.0):
        hits = simulation.space.cast_rays(origin, directions, reach)
        assert hits.hit.all()
        assert not hits.distance.any()
        assert (hits.face == -1).all()
        assert np.abs(hits.normal + directions).max() < 1e-15
        assert (hits.point == origin).all()


def test_a_ray_of_no_length_sees_only_what_it_is_in() -> None:
    """Not what begins a millimetre ahead; a surface it begins on it meets where it leads in."""
    space = alone({"box": {"size": (2.0, 2.0, 2.0)}}).space
    assert space.cast_ray((0.0, 1.001, 0.0), (0.0, -1.0, 0.0), 0.0) is None
    hit = space.cast_ray((0.0, 1.0, 0.0), (0.0, -1.0, 0.0), 0.0)
    assert hit is not None
    assert (hit.distance, hit.normal.tolist(), hit.face) == (0.0, [0.0, 1.0, 0.0], 3)


@pytest.mark.parametrize("name", [*SOLIDS, "mesh"])
def test_a_ray_that_goes_on_from_a_hit_does_not_meet_it_again(name: str) -> None:
    """Leading out it leaves the surface alone, leading in it meets it at once; also far from the origin."""
    collider: dict[str, Any] = {"shape": Mesh(block())} if name == "mesh" else SOLIDS[name][0]
    place = np.array([1000.0, -2000.0, 500.0])
    space = alone(collider, position=place).space
    origin, direction = rays_at(7, 300)
    hits = space.cast_rays(origin + place, direction)
    steep = (hits.face >= 0) & ((hits.normal * direction).sum(axis=1) < -0.1)
    assert steep.sum() > 40
    point, normal, along = hits.point[steep], hits.normal[steep], direction[steep]
    mirrored = along - 2.0 * (normal * along).sum(axis=1)[:, None] * normal
    assert not space.cast_rays(point, mirrored).hit.any()
    again = space.cast_rays(point, along)
    assert again.hit.all()
    assert again.distance.max() < EXACT


def test_along_a_face_a_box_is_met_at_its_edge() -> None:
    """Solids hold their surface; a ray that begins on the face it runs along begins inside. A plane is met nowhere."""
    space = alone({"box": {"size": (2.0, 2.0, 2.0)}}).space
    hit = space.cast_ray((-3.0, 1.0, 0.2), (1.0, 0.0, 0.0))
    assert hit is not None
    assert (hit.distance, hit.normal.tolist(), hit.face) == (2.0, [-1.0, 0.0, 0.0], 0)
    assert space.cast_ray((-3.0, 1.0 + 1e-8, 0.2), (1.0, 0.0, 0.0)) is None
    on = space.cast_ray((0.0, 1.0, 0.2), (1.0, 0.0, 0.0))
    assert on is not None
    assert (on.distance, on.face) == (0.0, -1)
    assert alone({"plane": {}}).space.cast_ray((0.0, 1e-12, 0.0), (1.0, 0.0, 0.0)) is None


def test_grazing_a_ball() -> None:
    """The half chord of a line at distance d is the root of r^2 - d^2; a tangent meets it where it touches."""
    space = alone({"sphere": {"radius": 1.0}}).space
    apart = 1.0 - np.logspace(-12, -1, 45)
    hits = space.cast_rays(np.stack([-5.0 + 0 * apart, apart, 0 * apart], 1), (1.0, 0.0, 0.0))
    half = np.sqrt((1.0 - apart) * (1.0 + apart))
    assert hits.hit.all()
    assert (np.abs(hits.distance - (5.0 - half)) * half < 1e-14).all()
    tangent = space.cast_ray((-5.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    assert tangent is not None
    assert tangent.distance == 5.0
    assert tangent.normal.tolist() == [0.0, 1.0, 0.0]
    assert space.cast_ray((-5.0, np.nextafter(1.0, 2.0), 0.0), (1.0, 0.0, 0.0)) is None


def test_numbers_at_the_ends_of_their_range_are_no_nan() -> None:
    """Rays from 1e100 m, directions of 1e-300 and 1e300, and along axes through corners."""
    simulation = alone({"box": {"size": (1.0, 1.0, 1.0)}})
    for name, (collider, _) in SOLIDS.items():
        simulation.add(name=f"{name}'", collider=collider, transform={"position": (0.5, 0.5, 0.5)})
    simulation.add(name="mesh", collider={"shape": Mesh(block())}, transform={"position": (-0.5, 0.5, 0.5)})
    corners = np.array(
        [(x, y, z) for x in (-1, 0, 1e-300, 1) for y in (-1, 0, 5e-324, 1) for z in (-1, 0, 1)], np.float64
    )
    corners = corners[np.abs(corners).max(axis=1) > 0.0]
    for origin in (0.0, 0.5, 1.0, 1e5, 1e15, 1e100):
        for scale in (1.0, 1e-300, 1e300):
            directions = corners * scale
            directions = directions[np.abs(directions).max(axis=1) > 0.0]
            assert finite(simulation.space.cast_rays(-origin * corners[: len(directions)], directions))


def test_of_two_at_one_distance_the_lower_row_is_met() -> None:
    """Whatever the tree looks like."""
    simulation = Simulation()
    made = [simulation.add(collider={"sphere": {"radius": 1.0}}) for _ in range(20)]
    hit = simulation.space.cast_ray((0.0, 5.0, 0.0), (0.0, -1.0, 0.0))
    assert hit is not None
    assert hit.entity == made[0]
    assert simulation.space.cast_ray_all((0.0, 5.0, 0.0), (0.0, -1.0, 0.0)).collider.tolist() == made
