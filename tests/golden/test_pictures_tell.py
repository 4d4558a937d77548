"""What the picture layer of a golden notices, and what not, in library worlds seen by their own cameras.

A body counts as visible when at least `VISIBLE` pixels show it. It is moved across the line of sight, in four
directions, by a tenth of the radius of the ball around it; along the line of sight that changes hardly a pixel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from carom.ecs import RigidBody
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.filming import shot_of
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene
from carom.tools.snapshot_kit.picture import LIMIT, Picture, patch_difference, picture_fault
from carom.worlds import load_world

WORLDS = {"billiards": 240, "bounce": 60, "head_on": 30, "jump": 30, "trap": 120}  # frames
VISIBLE = 12  # px


@pytest.fixture(scope="module")
def renderer() -> Iterator[Renderer]:
    """Return a renderer of goldens."""
    with Renderer(320, 240) as made:
        yield made


@pytest.fixture(scope="module", params=WORLDS)
def seen(request: pytest.FixtureRequest, renderer: Renderer) -> Seen:
    """Return a world as it is seen after some frames."""
    loaded = load_world(request.param)
    loaded.simulation.step(WORLDS[request.param])
    world = loaded.simulation.world
    camera = shot_of(loaded).camera(world)
    return Seen(renderer, Scene(world).batches(), camera, world.row_numbers(RigidBody))


class Seen:
    """Batches seen by a camera, of which some are bodies."""

    def __init__(self, renderer: Renderer, batches: list[Batch], camera: Camera, bodies: np.ndarray) -> None:
        self.renderer, self.batches, self.camera = renderer, batches, camera
        self.picture = self.with_batches(batches)
        rows, pixels = np.unique(renderer.ids(batches, camera), return_counts=True)
        self.visible = [int(row) for row, count in zip(rows, pixels, strict=True) if row in bodies and count >= VISIBLE]

    def with_batches(self, batches: list[Batch]) -> Picture:
        """Return the picture of other batches."""
        return self.renderer.picture(batches, self.camera)

    def place(self, row: int) -> tuple[int, int]:
        """Return where a body is: its batch and its number there."""
        return next((k, int(np.nonzero(b.ids == row)[0][0])) for k, b in enumerate(self.batches) if row in b.ids)

    def moved(self, row: int, way: np.ndarray) -> Picture:
        """Return the picture with a body moved by a tenth of its radius."""
        batch, number = self.place(row)
        vertices, poses = self.batches[batch].vertices, self.batches[batch].poses.copy()
        middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
        poses[number, :3, 3] += 0.1 * np.linalg.norm(vertices - middle, axis=1).max() * way
        return self.with_batches(self.changed(batch, poses=poses))

    def changed(self, batch: int, **columns: np.ndarray) -> list[Batch]:
        """Return the batches with columns of one replaced."""
        return [replace(one, **columns) if k == batch else one for k, one in enumerate(self.batches)]

    def fails(self, picture: Picture) -> bool:
        """Tell whether a picture does not pass."""
        return picture_fault(picture, self.picture, same_driver=True) is not None


def test_a_body_moved_by_a_tenth_of_its_radius_fails(seen: Seen) -> None:
    """Every visible body in every direction across the line of sight."""
    right, up = seen.camera.pose()[:3, :2].T
    assert seen.visible
    for row in seen.visible:
        for way in (right, -right, up, -up):
            assert seen.fails(seen.moved(row, way)), f"entity {row} moved by {way}"


def test_two_swapped_colours_fail(seen: Seen) -> None:
    """Of every body and the next one of another colour."""
    swapped = 0
    for one, other in zip(seen.visible, [*seen.visible[1:], seen.visible[0]], strict=True):
        (batch, i), (other_batch, j) = seen.place(one), seen.place(other)
        colors = [batch.colors.copy() for batch in seen.batches]
        if np.abs(colors[batch][i] - colors[other_batch][j]).max() < 0.1:
            continue
        colors[batch][i], colors[other_batch][j] = colors[other_batch][j].copy(), colors[batch][i].copy()
        swapped += 1
        assert seen.fails(
            seen.with_batches([replace(b, colors=c) for b, c in zip(seen.batches, colors, strict=True)])
        ), f"entities {one} and {other}"
    assert swapped


def test_dropped_shadows_fail(seen: Seen, monkeypatch: pytest.MonkeyPatch) -> None:
    """The sun looks past everything, and finds nothing in its way."""
    away = np.eye(4)
    away[0, 3] = 1e9
    monkeypatch.setattr(seen.renderer._passes, "_get_light_cam_matrices", lambda *_: (away, np.eye(4)))
    assert seen.fails(seen.with_batches(seen.batches))


def test_noise_of_one_step_passes(seen: Seen) -> None:
    """With every pixel of every channel up or down by 1 of 255, no patch comes near the limit."""
    noise = np.random.default_rng(1).integers(-1, 2, seen.picture.shape)
    noisy = np.clip(seen.picture + noise, 0, 255).astype(np.uint8)
    assert patch_difference(noisy, seen.picture).max() < LIMIT / 3.0
    assert not seen.fails(noisy)
