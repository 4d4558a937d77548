"""A scene shows the visible rows of a world where they are, one batch per mesh."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import Transform, Visual, World
from carom.systems.shapes.box import Box
from carom.systems.shapes.geometry import Geometries, Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.sphere import Sphere
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer
from carom.tools.scene import SPREAD, Scene

BALL, BOX = Sphere(0.5), Box((1.0, 2.0, 3.0))
QUARTER = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))  # 90 degrees about z


def look(shape: Sphere | Box | Plane, **values: object) -> Visual:
    """Return a visual of a shape."""
    return Visual(shape=shape.number, size=shape.packed(), **values)


def test_rows_of_one_shape_and_size_are_one_batch() -> None:
    """Batches keep each row's id, place and colour, and reuse their meshes from one call to the next."""
    world = World()
    for at, shape in enumerate((BALL, BOX, BALL, Sphere(0.25))):
        world.spawn(Transform(position=(at, 0.0, 0.0)), look(shape, color=(0.1 * at, 0.0, 0.0, 1.0)))
    scene = Scene(world)
    batches = scene.batches()
    assert [batch.ids.tolist() for batch in batches] == [[0, 2], [1], [3]]
    assert batches[0].poses[:, 0, 3].tolist() == [0.0, 2.0]
    assert batches[0].colors[:, 0].tolist() == [0.0, 0.2]
    assert [batch.smooth for batch in batches] == [True, False, True]
    again = scene.batches()
    assert all(new.vertices is old.vertices for new, old in zip(again, batches, strict=True))


def test_what_is_hidden_or_nowhere_is_not_drawn() -> None:
    """Only rows that have both a transform and a visible visual make a batch."""
    world = World()
    world.spawn(Transform(), look(BALL, visible=False))
    world.spawn(Transform())
    world.spawn(look(BALL))
    assert Scene(world).batches() == []


def test_a_visual_turns_with_its_entity() -> None:
    """The visual's own offset and rotation apply within the frame of its entity."""
    world = World()
    world.spawn(
        Transform(position=(1.0, 2.0, 3.0), rotation=QUARTER), look(BOX, position=(1.0, 0.0, 0.0), rotation=QUARTER)
    )
    (batch,) = Scene(world).batches()
    assert batch.poses[0] == pytest.approx(
        np.array([[-1.0, 0.0, 0.0, 1.0], [0.0, -1.0, 0.0, 3.0], [0.0, 0.0, 1.0, 3.0], [0.0, 0.0, 0.0, 1.0]])
    )


def test_a_plane_is_a_wide_floor_with_coordinates_in_metres() -> None:
    """Its corners lie on the plane, and its floor coordinates keep their distances in metres."""
    world, plane = World(), Plane((1.0, 2.0, -2.0), 5.0)
    world.spawn(Transform(), look(plane))
    (batch,) = Scene(world).batches()
    assert batch.vertices @ plane.normal == pytest.approx(np.full(4, 5.0))
    assert batch.floor is not None
    apart = np.linalg.norm(batch.vertices - batch.vertices[0], axis=1)
    assert np.linalg.norm(batch.floor - batch.floor[0], axis=1) == pytest.approx(apart)
    assert apart.max() == pytest.approx(SPREAD * 100.0 * math.sqrt(2.0))


def test_a_mesh_is_drawn_from_the_table_of_geometries() -> None:
    """A visual that names a geometry by number gets the vertices stored under it."""
    world, box = World(), BOX.surface()
    geometries = Geometries()
    world.add(geometries)
    number = geometries.number(Geometry(box.vertices, box.faces))
    world.spawn(Transform(), Visual(shape=Mesh.number, geometry=number))
    (batch,) = Scene(world).batches()
    assert np.array_equal(batch.vertices, box.vertices)


def test_entities_are_found_in_the_picture_by_their_row() -> None:
    """Ids in the picture are rows of the world, each where its entity stands, and -1 for the sky."""
    world = World()
    world.spawn(Transform(), look(Plane((0.0, 1.0, 0.0), 0.0)))
    left = world.spawn(Transform(position=(-1.0, 0.5, 0.0)), look(BALL))
    right = world.spawn(Transform(position=(1.0, 0.5, 0.0)), look(BALL))
    with Renderer(64, 48) as renderer:
        ids = renderer.ids(Scene(world).batches(), Camera((0.0, 1.0, 4.0), (0.0, 0.5, 0.0)))
    columns = {row: np.nonzero(ids == row)[1].mean() for row in (world.row(left), world.row(right))}
    assert columns[world.row(left)] == pytest.approx(63.0 - columns[world.row(right)], abs=0.5)
    assert columns[world.row(left)] < 31.5
    assert (ids[-1] == 0).all()  # ground at the bottom
    assert (ids[0] == -1).all()  # sky on top
