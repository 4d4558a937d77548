"""Marks are where a pinhole camera shows their places in the world, as wide as stated, and hidden by what is nearer."""

from __future__ import annotations

import math

import numpy as np
import pytest
from trimesh.creation import box

from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.drawing import draw
from carom.tools.marks import Arrows, Inset, Labels, Lines, Points, tinted
from carom.tools.renderer import Renderer
from carom.tools.strokes import draw_strokes
from carom.tools.view import View

WIDTH, HEIGHT = 160, 120
CAMERA = Camera((0.0, 0.0, 5.0), fov=math.radians(60.0))
PIXELS = HEIGHT / 2.0 / math.tan(math.radians(30.0))  # per unit of slope
RED = (1.0, 0.0, 0.0)
CUBE = box(extents=(1.0, 1.0, 1.0))


def cube(*positions: tuple[float, float, float]) -> Batch:
    """Return white cubes of 1 m."""
    poses = np.tile(np.eye(4), (len(positions), 1, 1))
    poses[:, :3, 3] = positions
    return Batch(CUBE.vertices, CUBE.faces, poses, np.ones((len(positions), 4)), np.arange(len(positions)))


def changed(picture: np.ndarray, plain: np.ndarray) -> np.ndarray:
    """Return rows and columns (n, 2) of the pixels that differ."""
    return np.argwhere((picture != plain).any(axis=2))


def test_an_arrow_ends_at_the_pixel_its_point_is_projected_to(renderer: Renderer) -> None:
    """An arrow of 1.5 m to the right and 0.8 m up, 5 m away, reaches from the middle to where the pinhole has it."""
    along = (1.5, 0.8, 0.0)
    arrow = Arrows(np.zeros((1, 3)), np.array([along]), tinted(RED, 1), 3.0)
    picture, plain = renderer.picture([], CAMERA, [arrow]), renderer.picture([], CAMERA)
    drawn = np.argwhere(picture[..., 0].astype(int) - picture[..., 1] > 100)[:, ::-1] + 0.5
    unit = np.array([along[0], -along[1]]) / np.hypot(*along[:2])
    ahead = (drawn - (WIDTH / 2.0, HEIGHT / 2.0)) @ unit
    length = math.hypot(*along[:2]) / 5.0 * PIXELS
    assert ahead.max() == pytest.approx(length, abs=1.5)  # a point covers its last pixel only in part
    assert ahead.min() == pytest.approx(0.0, abs=2.0)  # half its width, since the end is round
    across = (drawn - (WIDTH / 2.0, HEIGHT / 2.0)) @ (-unit[1], unit[0])
    shaft = (ahead > 2.0) & (ahead < length - 3.6 * 3.0 - 1.0)
    assert np.abs(across[shaft]).max() == pytest.approx(1.5, abs=0.7)
    assert np.abs(across[~shaft]).max() == pytest.approx(4.5, abs=0.7)
    assert len(changed(picture, plain)) > len(drawn)  # the halo


@pytest.mark.parametrize("width", [1.0, 1.5, 2.0, 5.25])
@pytest.mark.parametrize("offset", [0.0, 0.3, 0.5, 0.77])
def test_a_level_line_covers_its_width_wherever_it_lies(width: float, offset: float) -> None:
    """Its coverage, summed over a column, is its width, whatever part of a pixel it is off."""
    picture = np.zeros((20, 12, 3), np.uint8)
    stroke = np.array([[-5.0, 10.0 + offset, 0.5, 20.0, 10.0 + offset, 0.5, width / 2.0, width / 2.0]])
    draw_strokes(stroke, np.ones((1, 4)), np.ones(1), np.ones((20, 12), np.float32), picture)
    assert picture[..., 0].sum(axis=0) / 255.0 == pytest.approx(np.full(12, width), abs=2.0 / 255.0)


def test_a_dot_covers_the_area_of_its_disc() -> None:
    """The coverage of a dot of 9 px sums to pi d^2 / 4, but for a ring that counts by distance."""
    picture = np.zeros((21, 21, 3), np.uint8)
    stroke = np.array([[10.3, 9.8, 0.0, 10.3, 9.8, 0.0, 4.5, 4.5]])
    draw_strokes(stroke, np.ones((1, 4)), np.ones(1), np.ones((21, 21), np.float32), picture)
    assert picture[..., 0].sum() / 255.0 == pytest.approx(math.pi * 4.5**2, rel=0.01)


def test_what_lies_behind_a_body_is_paler(renderer: Renderer) -> None:
    """Lines behind a cube keep the stated share of their alpha; before it, and where there is nothing, all of it."""
    drawn, middle = [cube((0.0, 0.0, 0.0))], (HEIGHT // 2, WIDTH // 2)
    plain = renderer.picture(drawn, CAMERA)
    for z, behind, share in ((-2.0, 0.0, 0.0), (-2.0, 0.4, 0.4), (-2.0, 1.0, 1.0), (2.0, 0.0, 1.0)):
        line = Lines(np.array([[-9.0, 0.0, z]]), np.array([[9.0, 0.0, z]]), tinted(RED, 1), 3.0, behind)
        seen = renderer.picture(drawn, CAMERA, [line])
        wanted = plain[middle] + share * (np.array([255.0, 0.0, 0.0]) - plain[middle])
        assert seen[middle] == pytest.approx(wanted, abs=1.0)
        assert seen[HEIGHT // 2, 2].tolist() == [255, 0, 0]  # beside the cube


def test_a_line_on_a_surface_is_seen(renderer: Renderer) -> None:
    """A line that lies in the near face of a cube is not hidden by it."""
    line = Lines(np.array([[-0.3, 0.0, 0.5]]), np.array([[0.3, 0.0, 0.5]]), tinted(RED, 1), 3.0, 0.0)
    assert renderer.picture([cube((0.0, 0.0, 0.0))], CAMERA, [line])[HEIGHT // 2, WIDTH // 2].tolist() == [255, 0, 0]


def test_a_line_through_the_camera_is_cut_at_the_near_plane() -> None:
    """Of a line from 5 m ahead to 5 m behind, what is ahead keeps its place and its end is on the near plane."""
    view, near = View(CAMERA, WIDTH, HEIGHT), CAMERA.planes[0]
    start, end = np.array([[1.0, 0.0, 0.0]]), np.array([[1.0, 0.0, 10.0]])
    one, other = view.segments(start, end)
    assert one[0, :2] == pytest.approx((WIDTH / 2.0 + PIXELS / 5.0, HEIGHT / 2.0))
    assert other[0, :2] == pytest.approx((WIDTH / 2.0 + PIXELS / near, HEIGHT / 2.0))
    back, front = view.segments(end, start)
    assert np.array_equal(back, other) and np.array_equal(front, one)
    assert np.isnan(view.segments(end, end + 1.0)[0]).all()
    assert np.isnan(view.pixels(end)).all()


def test_in_parallel_light_a_metre_is_as_long_everywhere() -> None:
    """By an orthographic camera that sees 4 m from bottom to top, a metre is a quarter of the height, near and far."""
    view = View(Camera((0.0, 0.0, 5.0), height=4.0), WIDTH, HEIGHT)
    one, other = view.segments(
        np.array([[0.0, 0.0, -20.0], [0.0, 0.0, 4.0]]), np.array([[0.0, 1.0, -20.0], [1.0, 0.0, 4.0]])
    )
    assert (other - one)[:, :2] == pytest.approx(np.array([[0.0, -HEIGHT / 4.0], [HEIGHT / 4.0, 0.0]]))
    assert view.metres_per_pixel == 4.0 / HEIGHT


def test_depth_of_marks_is_that_of_bodies(renderer: Renderer) -> None:
    """A point of a cube's near face has the depth that the depth buffer holds there, but for the 0.5 % it is nearer."""
    place = View(CAMERA, WIDTH, HEIGHT).pixels(np.array([[0.0, 0.0, 0.5]]))[0]
    near, far = CAMERA.planes
    metres = near * far / (far - place[2] * (far - near))
    assert metres == pytest.approx(0.995 * 4.5)
    assert renderer.depth([cube((0.0, 0.0, 0.0))], CAMERA)[HEIGHT // 2, WIDTH // 2] == pytest.approx(4.5, rel=1e-5)


def test_labels_name_only_what_is_seen(renderer: Renderer) -> None:
    """A cube behind another has no label, though its place is in the picture; both have one if none is hidden."""
    drawn = [cube((0.0, 0.0, 0.0), (0.0, 0.0, -3.0), (1.5, 1.0, 0.0))]
    places, plain = drawn[0].poses[:, :3, 3], renderer.picture(drawn, CAMERA)
    for which, seen in (([0], True), ([1], False), ([2], True)):
        label = Labels(places[which], ["name"], tinted(RED, 1), np.array(which))
        where = changed(renderer.picture(drawn, CAMERA, [label]), plain)
        assert bool(len(where)) is seen
        if seen:
            x, y, _ = View(CAMERA, WIDTH, HEIGHT).pixels(places[which])[0]
            assert x < where[:, 1].min() + 0.5 < x + 8.0  # beside its point, to the right
            assert abs(where[:, 0].mean() + 0.5 - y) < 2.0


def test_of_labels_that_overlap_the_first_is_written(renderer: Renderer) -> None:
    """Two names in one place are as the first alone; apart they are both there."""
    plain = renderer.picture([], CAMERA)
    one, other = np.zeros((1, 3)), np.array([[0.1, 0.02, 0.0]])
    first = renderer.picture([], CAMERA, [Labels(one, ["one"], tinted(RED, 1))])
    both = renderer.picture([], CAMERA, [Labels(np.concatenate([one, other]), ["one", "two"], tinted(RED, 2))])
    assert np.array_equal(both, first)
    assert len(changed(first, plain))


def test_insets_stack_in_their_corners(renderer: Renderer) -> None:
    """Two in one corner do not cover each other, and pixels are blended by alpha."""
    panel = np.full((10, 20, 4), (200, 100, 0, 128), np.uint8)
    plain = renderer.picture([], CAMERA)
    picture = renderer.picture([], CAMERA, [Inset(panel, "top left"), Inset(panel, "top left")])
    assert len(changed(picture, plain)) == 2 * 10 * 20
    at = plain[8, 8] + 128.0 / 255.0 * (np.array([200.0, 100.0, 0.0]) - plain[8, 8])
    assert picture[8, 8] == pytest.approx(at, abs=0.5)


def test_marks_without_number_or_behind_the_camera_draw_nothing(renderer: Renderer) -> None:
    """Nor do empty ones; a picture without marks is the same to the bit."""
    plain, far = renderer.picture([], CAMERA), np.array([[0.0, 0.0, 9.0]])
    nothing = np.zeros((0, 3))
    marks = [
        Points(np.array([[np.nan, 0.0, 0.0]]), tinted(RED, 1)),
        Arrows(far, far + 1.0, tinted(RED, 1)),
        Arrows(np.zeros((1, 3)), np.zeros((1, 3)), tinted(RED, 1)),
        Lines(nothing, nothing, tinted(RED, 0)),
        Labels(far, ["behind"], tinted(RED, 1)),
    ]
    assert np.array_equal(renderer.picture([], CAMERA, marks), plain)


def test_insets_without_room_go_beside_and_then_nowhere(renderer: Renderer) -> None:
    """A third one of half the height stands beside the first two, clear of those of the corner below."""
    panel, plain = np.full((48, 60, 4), 255, np.uint8), renderer.picture([], CAMERA)
    insets = [Inset(panel, "bottom right"), *[Inset(panel, "top right")] * 5]
    picture = renderer.picture([], CAMERA, insets)
    assert len(changed(picture, plain)) == 4 * 48 * 60
    for top in (8, 64):
        for left in (24, 92):
            assert (picture[top : top + 48, left : left + 60] == 255).all()


def test_lines_grow_with_the_picture() -> None:
    """A line that is 3 px wide in a picture 480 px high is 6 px wide in one of 960 px, and 3 px in all lower ones."""
    line = Lines(np.array([[-9.0, 0.0, 0.0]]), np.array([[9.0, 0.0, 0.0]]), tinted((1.0, 1.0, 1.0), 1), 3.0)
    for height, width in ((240, 3.0), (480, 3.0), (960, 6.0)):
        picture = np.zeros((height, 8, 3), np.uint8)
        draw(picture, View(CAMERA, 8, height), [line], lambda: pytest.fail("nothing hides it"))
        assert picture[:, 4, 0].sum() / 255.0 == pytest.approx(width, abs=0.02)
