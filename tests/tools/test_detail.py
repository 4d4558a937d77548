"""Detail: what is small in a picture is drawn with as few triangles as no eye misses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.systems.shapes.ball_surface import ball_surfaces
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.detail import MOST_OFF, in_detail

HEIGHT = 480
RADIUS = 0.1
FINE, *COARSER = ball_surfaces(np.full(3, RADIUS))


def balls(places: list[tuple[float, float, float]]) -> Batch:
    """Return balls of 10 cm at some places."""
    poses = np.tile(np.eye(4), (len(places), 1, 1))
    poses[:, :3, 3] = places
    count = len(places)
    return Batch(FINE.vertices, FINE.faces, poses, np.ones((count, 4)), np.arange(count), True, coarser=tuple(COARSER))


@pytest.mark.parametrize("lens", [{"fov": math.radians(60.0)}, {"height": 4.0}])
def test_an_outline_is_never_off_by_more_than_a_quarter_of_a_pixel(lens: dict[str, float]) -> None:
    """By the coarsest mesh of which that is so, for a ball from 1 m to 200 m away; what stays is drawn fine."""
    camera = Camera((0.0, 0.0, 5.0), **lens)
    places = [(0.3 * away, 0.0, 5.0 - away) for away in np.geomspace(1.0, 200.0, 60)]
    parts = in_detail(balls(places), camera, HEIGHT)
    assert sorted(np.concatenate([part.ids for part in parts]).tolist()) == list(range(60))
    offs = {len(surface.faces): surface.off for surface in (FINE, *COARSER)}
    for part in parts:
        for i in part.ids:
            seen = 4.0 if "height" in lens else 2.0 * (5.0 - places[i][2]) * math.tan(math.radians(30.0))
            pixels = HEIGHT / seen
            count = len(part.faces)
            assert offs[count] * pixels <= MOST_OFF or count == 1280
            assert count == 80 or offs[count // 4] * pixels > MOST_OFF
    assert {len(part.faces) for part in parts if len(part.ids)} == ({320} if "height" in lens else {1280, 320, 80})


def test_how_far_triangles_are_off_a_ball_is_as_measured() -> None:
    """No place on an edge is nearer to the centre than radius less ``off``; the fewer triangles, the farther."""
    for surface in (FINE, *COARSER):
        corners = surface.vertices[surface.faces]
        edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
        share = np.linspace(0.0, 1.0, 21)[:, None, None]
        nearest = np.linalg.norm((1.0 - share) * edges[:, 0] + share * edges[:, 1], axis=-1).min()
        assert nearest == pytest.approx(RADIUS - surface.off, rel=1e-12)
    assert FINE.off < COARSER[0].off < COARSER[1].off


def test_what_has_one_mesh_is_left_as_it_is() -> None:
    """The very same batch, so that it stays on the graphics side."""
    batch = Batch(FINE.vertices, FINE.faces, np.eye(4)[None], np.ones((1, 4)), np.zeros(1, np.int64))
    assert in_detail(batch, Camera((0.0, 0.0, 5.0)), HEIGHT) == [batch]
    near = balls([(0.0, 0.0, 4.5)])
    assert in_detail(near, Camera((0.0, 0.0, 5.0)), HEIGHT) == [near]
