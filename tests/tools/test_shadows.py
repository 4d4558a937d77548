"""Shadows lie where geometry has them, leave lit faces even, and stay as they are while something else moves."""

from __future__ import annotations

import math

import numpy as np
import pytest
from trimesh.creation import box, icosphere

from carom.ecs.spatial import quaternion
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer
from carom.tools.sun import sun_axes, sun_for

WIDTH, HEIGHT = 320, 240
UP = (0.0, 1.0, 0.0)
SUN = sun_axes(UP)[:, 2]
PLATE = box(extents=(6.0, 6.0, 0.2))
GROUND = box(extents=(40.0, 0.2, 40.0))
CUBE = box(extents=(1.0, 1.0, 1.0))
BALL = icosphere(subdivisions=3, radius=0.5)


def at(mesh: object, position: tuple[float, float, float], number: int, rotation: object = None) -> Batch:
    """Return one white copy of a trimesh there."""
    pose = np.eye(4)
    pose[:3, 3] = position
    if rotation is not None:
        pose[:3, :3] = quaternion.matrix(rotation)
    return Batch(mesh.vertices, mesh.faces, pose[None], np.array([[0.8, 0.8, 0.8, 1.0]]), np.array([number]))  # type: ignore[attr-defined]


def still() -> list[Batch]:
    """Return a ground with a cube and a ball on it, which cast their shadows onto it."""
    return [at(GROUND, (0.0, -0.1, 0.0), 0), at(CUBE, (-1.0, 0.5, 0.0), 1), at(BALL, (1.5, 1.2, 0.5), 2)]


@pytest.mark.parametrize("degrees", [0, 10, 25, 40, 55, 70, 80, 85, 88])
def test_a_flat_face_is_lit_evenly_at_any_angle(renderer: Renderer, degrees: float) -> None:
    """A plate alone in the sun is of one brightness all over: none of it lies in its own shadow."""
    across = sun_axes(UP)[:, 0]
    normal = math.cos(math.radians(degrees)) * SUN + math.sin(math.radians(degrees)) * across
    plate = at(PLATE, (0.0, 0.0, 0.0), 0, quaternion.look_at(-normal, sun_axes(UP)[:, 1]))
    upward = sun_axes(UP)[:, 1]
    camera = Camera(tuple((7.0 * normal).tolist()), up=tuple(upward.tolist()), sky_up=UP)
    face = renderer.picture([plate], camera)[40:-40, 60:-60].astype(int)
    assert (renderer.ids([plate], camera)[40:-40, 60:-60] == 0).all()
    assert np.ptp(face, axis=(0, 1)).max() <= 1


def test_a_shadow_is_where_the_line_to_the_sun_meets_the_body(renderer: Renderer) -> None:
    """On the ground, pixels are dark where the ray to the sun goes through the cube or the ball, but near edges."""
    camera = Camera((1.0, 7.0, 5.0), (0.5, 0.0, -0.5))
    batches = still()
    ids, depth = renderer.ids(batches, camera), renderer.depth(batches, camera)
    lit = renderer.picture(batches[:1], camera).astype(int) - renderer.picture(batches, camera)
    half = math.tan(camera.fov / 2.0)
    x = half * WIDTH / HEIGHT * (2.0 * (np.arange(WIDTH) + 0.5) / WIDTH - 1.0)
    y = half * (1.0 - 2.0 * (np.arange(HEIGHT) + 0.5) / HEIGHT)
    sight = np.stack([*np.meshgrid(x, y), np.full((HEIGHT, WIDTH), -1.0)], axis=-1)
    points = np.array(camera.position) + (sight * depth[..., None].clip(0, 100)) @ camera.pose()[:3, :3].T
    margin = 6.0 * 2.0 * sun_for(camera, WIDTH / HEIGHT, 1024).reach / 1024  # texels that filter and lift reach
    gap = np.linalg.norm(np.cross(np.array((1.5, 1.2, 0.5)) - points, SUN), axis=-1) - 0.5

    def past(half: float) -> np.ndarray:
        """Return whether the ray to the sun passes a cube of half edges ``half`` in the cube's place."""
        slabs = np.stack([(np.array((-1.0, 0.5, 0.0)) + sign * half - points) / SUN for sign in (-1.0, 1.0)])
        return slabs.min(axis=0).max(axis=-1) > slabs.max(axis=0).min(axis=-1)

    inside = np.pad(ids == 0, 1)  # pixels beside a body are partly it
    inside = np.all([np.roll(inside, step, axis) for step in (-1, 0, 1) for axis in (0, 1)], axis=0)[1:-1, 1:-1]
    ground = inside & (np.abs(points) < 19.0).all(axis=-1)
    dark = ground & ((gap < -margin - 0.01) | ~past(0.5 - margin))
    bright = ground & (gap > margin) & past(0.5 + margin)
    assert dark.sum() > 500 and bright.sum() > 20000
    assert lit[dark].min() > 30
    assert np.abs(lit[bright]).max() <= 1


def test_shadows_of_what_stands_stay_to_the_bit_while_a_body_moves(renderer: Renderer) -> None:
    """Wherever the mover, pixels that neither it nor its shadow touches are the same."""
    camera = Camera((0.0, 4.0, 6.0))
    pictures = []
    for x in np.linspace(3.0, 200.0, 7):
        pictures.append(renderer.picture([*still(), at(BALL, (float(x), 0.5, -3.0), 3)], camera)[:, : WIDTH // 2])
    assert all(np.array_equal(picture, pictures[0]) for picture in pictures)


def test_shadows_stay_while_the_camera_glides_along(renderer: Renderer) -> None:
    """Texels of the shadow map are at home in the world: a camera that glides by whole pixels sees the same shadows.

    An orthographic camera above the ground is moved by 8 pixels, which are no whole number of texels.
    """

    def seen(step: int) -> np.ndarray:
        x = 8.0 * step * 6.0 / HEIGHT
        camera = Camera((x, 10.0, 0.0), (x, 0.0, 0.0), up=(0.0, 0.0, -1.0), height=6.0, sky_up=UP)
        return renderer.picture(still(), camera).astype(int)

    first = seen(0)
    shadow = (first.max(axis=-1) < 150).sum()
    assert shadow > 500
    for step in range(1, 8):
        moved = seen(step)
        away = np.abs(moved[:, : WIDTH - 8 * step] - first[:, 8 * step :]).max(axis=-1)
        assert (away > 2).mean() < 1e-3  # rounding may put single pixels of an edge on the other side
