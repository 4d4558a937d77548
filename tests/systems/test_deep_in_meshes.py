"""Deep in meshes: what sank in, whatever its pose, is pushed out along the surface's outward side, and never back.

CAROM_POSES says in how many poses of each pair; 10,000 are what the slow run takes. A body that no triangle comes
within half its width of, wholly inside a thick solid or far under open land, meets nothing; one between two surfaces
that face each other more closely than it is thick is pushed by both and stays.
"""

from __future__ import annotations

import os

import numpy as np
import pytest
from hulls import HULLS
from meshes import Laid, laid, sheet

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.detection.narrow import Found
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.sphere import Sphere

POSES = int(os.environ.get("CAROM_POSES", "200"))
AT_ONCE = 200
REACH = 0.01  # m
LEVEL = np.array(quaternion.IDENTITY)
BODIES: dict[str, Shape] = {
    "box": Box((0.6, 0.4, 1.0)),
    "capsule": Capsule(0.25, 0.9),
    "sphere": Sphere(0.4),
    "hull": Convex(HULLS["rounded"]),
}
LARGEST = 1.42  # m, as wide as the widest body and its reach


def valley(slope: float) -> Geometry:
    """Return two slopes of 6 m that meet in a line."""
    vertices = np.array([[x, abs(x) * slope, z] for x in (-6.0, 0.0, 6.0) for z in (-6.0, 6.0)])
    return Geometry(vertices, np.array([[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]]), "valley")


def two_sheets(gap: float) -> Geometry:
    """Return land over land, both facing up."""
    land = sheet(9, 6.0, 0.05, 0.2)
    above = land.vertices + np.array([0.0, gap, 0.0])
    faces = np.concatenate([land.faces, land.faces + len(above)])
    return Geometry(np.concatenate([land.vertices, above]), faces, "two sheets")


def ring() -> Geometry:
    """Return a torus of radii 1.5 and 0.5 m about the y axis."""
    import trimesh

    mesh = trimesh.creation.torus(1.5, 0.5, major_sections=24, minor_sections=12)
    return Geometry(np.array(mesh.vertices)[:, [0, 2, 1]] * [1.0, 1.0, -1.0], np.array(mesh.faces, np.int64), "ring")


LANDS = {
    "land": sheet(13, 8.0, 1.0, 0.3),
    "valley": valley(0.5),
    "gorge": valley(1.5),
    "sheets": two_sheets(0.3),
    "ring": ring(),
}


def poses(seed: int) -> list[tuple[Floats, Floats]]:
    """Return places about the middle of a mesh, and turns, AT_ONCE at a time."""
    generator = np.random.default_rng(seed)
    return [
        (
            generator.uniform([-2.2, -0.6, -2.2], [2.2, 1.4, 2.2], (AT_ONCE, 3)),
            quaternion.normalise(generator.normal(size=(AT_ONCE, 4))),
        )
        for _ in range(-(-POSES // AT_ONCE))
    ]


def way_out(found: Found) -> Floats:
    """Return the way (m) by which its deepest point pushes a body out; nothing where none is deeper than 0.1 mm."""
    if not len(found.depth) or found.depth.max() <= 1e-4:
        return np.zeros(3)
    deepest = int(found.depth.argmax())
    way: Floats = found.normal[deepest] * found.depth[deepest]
    return way


def pushed_out(mesh: Laid, places: Floats, turns: Floats) -> None:
    """Move bodies out along their deepest points, again and again; they must come out."""
    for _ in range(40):
        ways = np.array([way_out(found) for found in mesh.measure(places, turns, REACH)])
        if not ways.any():
            return
        places += ways
    raise AssertionError(f"{int(ways.any(axis=1).sum())} bodies do not come out, as {places[ways.any(axis=1)][0]}")


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("key", LANDS)
def test_what_sank_in_comes_out(key: str, body: str) -> None:
    """Every contact is finite and no deeper than bodies are wide; pushed along the deepest one it comes out in front.

    Of land no normal leads down, whichever of its hollows a body is in.
    """
    mesh, seen = laid(LANDS[key], BODIES[body], AT_ONCE, turn=LEVEL), 0
    for places, turns in poses(11):
        met = np.zeros(AT_ONCE, np.bool_)
        for k, found in enumerate(mesh.measure(places, turns, REACH)):
            met[k] = len(found.depth) > 0
            assert np.isfinite(found.point).all()
            assert np.sqrt((found.normal**2).sum(axis=1)) == pytest.approx(1.0)
            assert (found.depth <= LARGEST).all()
            assert key not in ("land", "valley", "gorge") or (found.normal[:, 1] > 0.0).all()
        seen += int(met.sum())
        pushed_out(mesh, places, turns)
        if key == "ring":
            across = np.sqrt(places[:, 0] ** 2 + places[:, 2] ** 2) - 1.5
            assert (np.sqrt(across**2 + places[:, 1] ** 2) > 0.45)[met].all()
    assert seen > POSES // 4


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("key", ["valley", "rolling"])
def test_the_way_out_does_not_turn_round(key: str, body: str) -> None:
    """Lowered by centimetres through a surface until its middle is 10 cm behind, a body is never pushed the other way.

    On slopes of up to 27 degrees successive ways out are less than 90 degrees apart, and lead up.
    """
    land = valley(0.5) if key == "valley" else sheet(13, 8.0, 0.2, 0.3)
    mesh = laid(land, BODIES[body], AT_ONCE, turn=LEVEL)
    for places, turns in poses(12):
        height = 0.5 * np.abs(places[:, 0]) if key == "valley" else 0.1
        places[:, 1] = height + 0.8
        before = np.zeros((AT_ONCE, 3))
        for _ in range(90):
            places[:, 1] -= 0.01
            ways = np.array([way_out(found) for found in mesh.measure(places, turns, REACH)])
            assert (ways[:, 1] >= 0.0).all()
            assert ((ways * before).sum(axis=1) >= 0.0).all()
            before = ways
        assert (before[:, 1] > 0.0).all()
