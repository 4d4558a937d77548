"""Pictures show what they are given and depend on nothing else."""

from __future__ import annotations

import gc

import numpy as np
import pytest
from drawn_bodies import CUBE, batch, poses
from trimesh.creation import box, icosphere

from carom.tools.batch import LARGEST_ID, Batch, shading
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer

WIDTH, HEIGHT = 320, 240
BALL = icosphere(subdivisions=4, radius=1.0)
SQUARE = np.array([[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0]])
SQUARE_FACES = np.array([[0, 1, 2], [0, 2, 3]])


def test_the_largest_id_comes_through(renderer: Renderer) -> None:
    """The id image holds the highest id allowed unchanged, and -1 for the background."""
    ids = renderer.ids([batch(CUBE, (0.0, 0.0, 0.0), first=LARGEST_ID)], Camera((0.0, 0.0, 3.0)))
    assert sorted(np.unique(ids).tolist()) == [-1, LARGEST_ID]


def test_a_closed_renderer_leaves_those_that_came_after_it_alone(renderer: Renderer) -> None:
    """Also when Python throws it away, at whatever time: framebuffers of different contexts have the same numbers."""
    camera, ball = Camera((1.0, 2.0, 5.0)), batch(BALL, (0.0, 0.0, 0.0), smooth=True)
    fresh = renderer.picture([ball], camera)
    first, second = Renderer(WIDTH, HEIGHT), Renderer(WIDTH, HEIGHT)
    for made in (first, second):
        made.picture([ball], camera)
    first.close()
    assert np.array_equal(second.picture([ball], camera), fresh)
    del first
    gc.collect()
    assert np.array_equal(second.picture([ball], camera), fresh)
    second.close()


def test_frames_are_bit_identical_in_another_renderer_with_another_past(renderer: Renderer) -> None:
    """A picture depends on its batches and camera alone, not on what was drawn before."""
    camera = Camera((1.0, 2.0, 5.0))
    ball, cube = batch(BALL, (0.0, 0.0, 0.0), (1.5, 0.0, 0.0), smooth=True), batch(CUBE, (-1.5, 0.0, 0.0), first=2)
    fresh = renderer.picture([ball, cube], camera)
    with Renderer(WIDTH, HEIGHT) as other:
        other.picture([batch(BALL, (0.0, 1.0, 0.0), smooth=True)], Camera((0.0, 0.0, 9.0)))
        moved = Batch(ball.vertices, ball.faces, ball.poses + 0.0, ball.colors, ball.ids, smooth=True)
        moved.poses[:, 1, 3] += 1.0
        assert not np.array_equal(other.picture([moved, cube], camera), fresh)
        fewer = Batch(ball.vertices, ball.faces, ball.poses[:1], ball.colors[:1], ball.ids[:1], smooth=True)
        other.picture([fewer], camera)
        assert np.array_equal(other.picture([ball, cube], camera), fresh)
        other.ids([ball, cube], camera)
        assert np.array_equal(other.picture([ball, cube], camera), fresh)


def test_colours_are_those_given_and_not_dark(renderer: Renderer) -> None:
    """Light and shade keep a body's hue, and the whole picture stays of medium brightness."""
    camera = Camera((0.0, 3.0, 3.0))
    red = renderer.picture([batch(CUBE, (0.0, 0.0, 0.0), color=(0.8, 0.1, 0.1, 1.0))], camera)
    top = red[HEIGHT // 2 - 20 : HEIGHT // 2, WIDTH // 2 - 20 : WIDTH // 2 + 20].reshape(-1, 3).mean(axis=0)
    assert abs(top[0] - 0.8 * 255) < 40 and top[1] < 60 and top[2] < 60  # within the range of lit and shaded
    assert 110.0 < (red @ [0.2126, 0.7152, 0.0722]).mean() < 240.0


def test_a_translucent_body_lets_through_what_is_behind(renderer: Renderer) -> None:
    """Blue glass before a red cube shows both colours, though it is given first."""
    camera, middle = Camera((0.0, 0.0, 5.0)), (HEIGHT // 2, WIDTH // 2)
    behind = batch(CUBE, (0.0, 0.0, -1.0), color=(1.0, 0.0, 0.0, 1.0))
    glass = batch(CUBE, (0.0, 0.0, 1.0), color=(0.0, 0.0, 1.0, 0.5), first=1)
    seen = renderer.picture([glass, behind], camera)[middle]
    assert seen[0] > 60 and seen[2] > 60


@pytest.mark.parametrize("shares", [(0.5,), (0.25, 0.75), (0.9, 0.1, 0.4)])
@pytest.mark.parametrize("given", [1, -1], ids=["nearest first", "farthest first"])
def test_panes_blend_one_after_another(renderer: Renderer, shares: tuple[float, ...], given: int) -> None:
    """Through panes of alpha a before each other one sees a c + (1 - a) (what is behind), in whatever order given."""
    camera, middle = Camera((0.0, 0.0, 9.0)), (HEIGHT // 2, WIDTH // 2)
    colors = ((0.9, 0.1, 0.2), (0.1, 0.8, 0.3), (0.2, 0.2, 0.9))

    def pane(number: int, alpha: float) -> Batch:
        """Return the pane of that place: the first is the farthest."""
        own = np.array(SQUARE) * 3.0  # each a mesh of its own
        color = np.array([(*colors[number], alpha)])
        return Batch(own, SQUARE_FACES, poses((0.0, 0.0, 2.0 * number)), color, np.array([number]))

    wanted = renderer.picture([], camera)[middle].astype(float)
    for number, alpha in enumerate(shares):
        wanted += alpha * (renderer.picture([pane(number, 1.0)], camera)[middle] - wanted)
    panes = [pane(number, alpha) for number, alpha in enumerate(shares)]
    assert renderer.picture(panes[::given], camera)[middle] == pytest.approx(wanted, abs=1.0 + len(shares) / 2.0)


@pytest.mark.parametrize("given", [1, -1], ids=["nearest first", "farthest first"])
def test_copies_blend_one_after_another(renderer: Renderer, given: int) -> None:
    """So do copies of one mesh."""
    camera, middle = Camera((0.0, 0.0, 9.0)), (HEIGHT // 2, WIDTH // 2)
    places, colors = (
        poses(*((0.0, 0.0, z) for z in range(3))),
        np.array([(0.9, 0.1, 0.2), (0.1, 0.8, 0.3), (0.2, 0.2, 0.9)]),
    )
    wanted = renderer.picture([], camera)[middle].astype(float)
    for place, color in zip(places, colors, strict=True):
        alone = Batch(SQUARE, SQUARE_FACES, place[None], np.array([(*color, 1.0)]), np.zeros(1, np.int64))
        wanted += 0.4 * (renderer.picture([alone], camera)[middle] - wanted)
    tinted = np.column_stack([colors, np.full(3, 0.4)])
    panes = Batch(SQUARE, SQUARE_FACES, places[::given], tinted[::given], np.arange(3))
    assert renderer.picture([panes], camera)[middle] == pytest.approx(wanted, abs=2.5)


def test_a_body_casts_a_shadow(renderer: Renderer) -> None:
    """A floating body darkens a bounded patch of the ground that the camera sees."""
    camera = Camera((0.0, 6.0, 6.0))
    ground = batch(box(extents=(20.0, 0.1, 20.0)), (0.0, -1.0, 0.0), color=(0.8, 0.8, 0.8, 1.0))
    floating = batch(CUBE, (0.0, 1.0, 0.0), first=1)
    on_ground = renderer.ids([ground, floating], camera) == 0
    alone, shaded = renderer.picture([ground], camera), renderer.picture([ground, floating], camera)
    darker = ((alone.astype(int) - shaded).max(axis=-1) > 40) & on_ground
    assert 200 < darker.sum() < 5000


def test_a_world_with_z_up_looks_like_one_with_y_up(renderer: Renderer) -> None:
    """Turning the bodies, the camera and its up together leaves the picture the same."""
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # y becomes z
    upright = batch(CUBE, (0.0, 0.0, 0.0), (1.0, 0.5, -1.0))
    turned = Batch(upright.vertices, upright.faces, upright.poses.copy(), upright.colors, upright.ids)
    turned.poses[:, :3] = turn @ upright.poses[:, :3]
    one = renderer.picture([upright], Camera((2.0, 2.0, 4.0))).astype(int)
    other = renderer.picture([turned], Camera(tuple(turn @ (2.0, 2.0, 4.0)), up=(0.0, 0.0, 1.0)))
    assert (np.abs(one - other) > 2).mean() < 1e-3  # rounding may put single pixels of an edge on the other side


def test_an_empty_scene_is_sky_alone(renderer: Renderer) -> None:
    """Without bodies no pixel has an id, every depth is infinite, and the picture is bright and bluish."""
    camera = Camera((0.0, 0.0, 5.0))
    nothing = batch(CUBE)
    assert (renderer.ids([nothing], camera) == -1).all()
    assert np.isinf(renderer.depth([], camera)).all()
    sky = renderer.picture([], camera)
    assert sky[0, 0, 2] > sky[0, 0, 0] and sky.mean() > 120


def test_normals_blend_over_blunt_edges_and_split_along_sharp_ones() -> None:
    """A cube keeps one normal per face and corner, while a smooth ball's normals follow its radius."""
    cube = shading(CUBE.vertices, CUBE.faces)
    assert len(cube.positions) == 24
    assert np.allclose(np.sort(np.abs(cube.normals), axis=1), [0.0, 0.0, 1.0])
    ball = shading(BALL.vertices, BALL.faces, smooth=True)
    assert len(ball.positions) == len(BALL.vertices)
    assert np.abs(ball.normals - ball.positions).max() < 0.01  # between facets of 4 degrees
    assert np.array_equal(ball.positions, BALL.vertices[ball.source])


@pytest.mark.parametrize("up", [(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.3, -0.5, 0.9)])
def test_a_camera_looks_along_its_own_minus_z_with_up_upward(up: tuple[float, float, float]) -> None:
    """The pose is a proper rotation for any up, with the target straight ahead at its distance."""
    camera = Camera((1.0, 2.0, 3.0), (-1.0, 0.5, 2.0), up)
    pose = camera.pose()
    assert np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-15)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)
    assert np.allclose(np.linalg.inv(pose) @ (-1.0, 0.5, 2.0, 1.0), [0.0, 0.0, -camera.distance, 1.0])
    assert pose[:3, 1] @ up > 0.0


def test_a_camera_that_looks_along_up_still_sees(renderer: Renderer) -> None:
    """A view straight down, where up gives no direction, still shows the target in the middle."""
    ids = renderer.ids([batch(CUBE, (0.0, 0.0, 0.0))], Camera((0.0, 5.0, 0.0)))
    assert ids[HEIGHT // 2, WIDTH // 2] == 0
