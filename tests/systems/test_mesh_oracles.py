"""Solids on meshes against coal: distances over land, and depths about a block made of triangles.

CAROM_POSES says in how many poses of each pair; 10,000 are what the slow run takes.
"""

from __future__ import annotations

import os

import numpy as np
import pytest
from batches import Batch, random_batch
from hulls import HULLS
from meshes import Coal, block, laid, sheet
from pairs import coal_geometry

from carom.ecs.spatial import quaternion
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.sphere import Sphere

POSES = int(os.environ.get("CAROM_POSES", "300"))
HALF_A_DEGREE = float(np.cos(np.radians(0.5)))
SOLIDS: dict[str, Shape] = {
    "box": Box((0.6, 0.4, 1.0)),
    "capsule": Capsule(0.25, 0.9),
    **{key: Convex(geometry) for key, geometry in HULLS.items()},
    "cylinder": Cylinder(0.4, 1.1),
    "cone": Cone(0.4, 1.0),
    "ellipsoid": Ellipsoid((0.3, 0.5, 0.4)),
}
ROUND = ("cylinder", "cone", "ellipsoid")


@pytest.mark.parametrize("key", SOLIDS)
def test_distances_over_land(key: str) -> None:
    """Of bodies apart from the land the gap is the distance; none within reach is missed, no other found.

    To 1e-8 m, and to 2e-6 of round bodies, where coal stops at 1e-6.
    """
    land, shape, reach = sheet(13, 8.0, 1.0, 0.3), SOLIDS[key], 0.3
    oracle = Coal(land, coal_geometry(shape), shape.along_z)
    generator = np.random.default_rng(5)
    places = generator.uniform([-3.0, 0.5, -3.0], [3.0, 2.0, 3.0], (POSES, 3))
    turns = quaternion.normalise(generator.normal(size=(POSES, 4)))
    seen = beyond = 0
    for place, turn, found in zip(places, turns, laid(land, shape, POSES).measure(places, turns, reach), strict=True):
        gap = oracle.distance(place, turn)
        if 1e-6 < gap < reach:
            seen += 1
            assert -found.depth.max() == pytest.approx(gap, abs=2e-6 if key in ROUND else 1e-8)
        elif gap > reach:
            beyond += 1
            assert len(found.depth) == 0
    assert seen > POSES // 10
    assert beyond > POSES // 10


@pytest.mark.parametrize("key", ["sphere", *SOLIDS])
def test_depths_about_a_block(key: str) -> None:
    """Triangle by triangle, a block has coal's contact among its own, to 0.5 degrees and 1e-5 m and another's rounding.

    Of balls and capsules it is the deepest of all. Others, at the very corners of the block, may have one more that is
    deeper, or only that: at most one in fifty.
    """
    small = Geometry(0.3 * block().vertices + np.array([0.0, 0.3, 0.0]), block().faces, "block")
    shape = Sphere(0.4) if key == "sphere" else SOLIDS[key]
    batch, distance, normal = random_batch(Mesh(small), shape, POSES, seed=1)
    sound = np.abs(batch.position_b).max(axis=1) < 10.0  # coal puts one cone of 3,000 beyond all bounds
    assert sound.mean() > 0.999
    distance, normal = distance[sound], normal[sound]
    batch = Batch(*(part[sound] for part in batch))
    back = quaternion.conjugate(batch.rotation_a)
    places, turns = quaternion.rotate(back, batch.position_b), quaternion.multiply(back, batch.rotation_b)
    reach, within, far = 0.05, 0, 0
    for found, gap, way in zip(
        laid(small, shape, len(places), turn=np.array(quaternion.IDENTITY)).measure(places, turns, reach),
        distance,
        quaternion.rotate(back, normal),
        strict=True,
    ):
        if gap > reach - 1e-6:
            continue
        within += 1
        alike = (np.abs(found.depth + gap) < 2e-5) & ((found.normal @ way > HALF_A_DEGREE) | (gap > -1e-6))
        deepest = len(found.depth) > 0 and found.depth.max() < 2e-5 - gap
        if key in ("sphere", "capsule"):
            assert alike.any()
            assert deepest
        far += not alike.any() or found.depth.max() > 0.01 - gap
    assert within > POSES // 2
    assert far <= within / 50
