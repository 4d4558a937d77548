"""Pictures, depths and ids hold to the geometry of a pinhole camera."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from collections.abc import Iterator

import numpy as np
import pytest
from trimesh.creation import box, icosphere

from carom.ecs.errors import CaromError
from carom.tools import offscreen
from carom.tools.batch import LARGEST_ID, Batch, shading
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer

WIDTH, HEIGHT = 320, 240
BALL = icosphere(subdivisions=4, radius=1.0)
CUBE = box(extents=(1.0, 1.0, 1.0))
SQUARE = np.array([[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0]])
SQUARE_FACES = np.array([[0, 1, 2], [0, 2, 3]])
WHITE = (1.0, 1.0, 1.0, 1.0)


@pytest.fixture(scope="module")
def renderer() -> Iterator[Renderer]:
    """Yield one renderer that the tests of this module share."""
    with Renderer(WIDTH, HEIGHT) as made:
        yield made


def poses(*positions: tuple[float, float, float]) -> np.ndarray:
    """Return unturned poses (n, 4, 4)."""
    made = np.tile(np.eye(4), (len(positions), 1, 1))
    made[:, :3, 3] = np.reshape(positions, (-1, 3))
    return made


def batch(
    mesh: object,
    *positions: tuple[float, float, float],
    color: tuple[float, ...] = WHITE,
    first: int = 0,
    smooth: bool = False,
) -> Batch:
    """Return copies of a trimesh in one colour, numbered from ``first``."""
    ids = np.arange(first, first + len(positions))
    return Batch(mesh.vertices, mesh.faces, poses(*positions), np.tile(color, (len(positions), 1)), ids, smooth)  # type: ignore[attr-defined]


def rays(camera: Camera) -> np.ndarray:
    """Return for each pixel centre the point (h, w, 3) of its line of sight 1 m before the camera, camera frame."""
    half = math.tan(camera.fov / 2.0)
    y = half * (1.0 - 2.0 * (np.arange(HEIGHT) + 0.5) / HEIGHT)
    x = half * WIDTH / HEIGHT * (2.0 * (np.arange(WIDTH) + 0.5) / WIDTH - 1.0)
    return np.stack([*np.meshgrid(x, y), np.full((HEIGHT, WIDTH), -1.0)], axis=-1)


def resolution(depth: np.ndarray, camera: Camera) -> np.ndarray:
    """Return twice the step of a depth buffer of 24 bits at ``depth`` (m): one for rounding, one for interpolation."""
    near, far = camera.planes
    return 2.0 * depth**2 * (far - near) / (near * far * 2**24) + 1e-6 * depth


def test_a_ball_covers_the_area_of_its_silhouette(renderer: Renderer) -> None:
    """The pixels of a ball's id are as many as the pinhole projection of its outline encloses."""
    camera = Camera((0.0, 0.0, 4.0), fov=math.radians(50.0))
    covered = (renderer.ids([batch(BALL, (0.0, 0.0, 0.0), first=7)], camera) == 7).sum()
    inner = np.einsum("ij,ij->i", BALL.face_normals, BALL.triangles[:, 0]).min()  # facets lie inside of the sphere
    pixels = HEIGHT / 2.0 / math.tan(camera.fov / 2.0)
    least, most = (math.pi * (pixels * r) ** 2 / (4.0**2 - r**2) for r in (inner, 1.0))
    # A pixel counts by its centre: for a disc that errs by less than the square root of its perimeter.
    rounding = math.sqrt(2.0 * math.sqrt(math.pi * most))
    assert least - rounding < covered < most + rounding
    assert most - least < 0.005 * most


def test_a_box_has_the_depth_and_the_width_of_its_near_face(renderer: Renderer) -> None:
    """Depth is measured along the line of view to the face, and is infinite where nothing is drawn."""
    camera = Camera((0.0, 0.0, 3.0))
    drawn = [batch(CUBE, (0.0, 0.0, 0.0))]
    depth, seen = renderer.depth(drawn, camera), renderer.ids(drawn, camera) == 0
    inside = (np.abs(rays(camera)[..., :2]) * 2.5 < 0.5).all(axis=-1)
    assert np.array_equal(seen, inside)  # only the near face is seen from the front
    assert np.abs(depth[seen] - 2.5).max() < resolution(np.array(2.5), camera)
    assert np.isinf(depth[~seen]).all()


def test_the_depth_of_a_plane_follows_from_the_line_of_sight(renderer: Renderer) -> None:
    """Over slanted ground, each pixel's depth agrees with the ray through its centre."""
    camera = Camera((0.0, 2.0, 3.0), (0.0, 0.0, 0.0))
    ground = Batch(SQUARE * 100.0, SQUARE_FACES, poses((0.0, 0.0, 0.0)), np.ones((1, 4)), np.zeros(1, np.int64))
    ground.poses[0, :3, :3] = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
    depth = renderer.depth([ground], camera)
    down = (rays(camera) @ camera.pose()[:3, :3].T)[..., 1]
    truth = 2.0 / np.maximum(-down, 1e-9)
    near = truth < 30.0
    assert near.mean() > 0.7
    slope = np.abs(np.gradient(truth, axis=0))  # m per pixel; OpenGL places corners on a grid of 1/256 pixel
    assert (np.abs(depth - truth) < resolution(truth, camera) + slope / 128.0)[near].all()


def test_the_ids_of_2500_instances_are_exact(renderer: Renderer) -> None:
    """Each pixel holds the id of the instance its ray meets, and every instance is seen."""
    side, camera = 50, Camera((0.0, 0.0, 60.0), fov=math.radians(45.0))
    column, row = np.meshgrid(np.arange(side), np.arange(side))
    places = [(x - side / 2 + 0.5, y - side / 2 + 0.5, 0.0) for x, y in zip(column.ravel(), row.ravel(), strict=True)]
    numbers = np.random.default_rng(1).permutation(LARGEST_ID)[: side * side]
    tiles = Batch(SQUARE, SQUARE_FACES, poses(*places), np.tile(WHITE, (side * side, 1)), numbers)
    ids = renderer.ids([tiles], camera)
    at = rays(camera)[..., :2] * 60.0 + side / 2
    cell = np.floor(at).astype(int)
    inside = ((cell >= 0) & (cell < side)).all(axis=-1)
    truth = np.where(
        inside,
        numbers.reshape(side, side)[tuple(np.clip(cell, 0, side - 1)[..., ::-1].reshape(-1, 2).T)].reshape(
            HEIGHT, WIDTH
        ),
        -1,
    )
    sure = (np.abs(at - np.round(at)) > 1e-3).all(axis=-1)  # OpenGL places corners on a grid of 1/256 pixel
    assert np.array_equal(ids[sure], truth[sure])
    assert set(numbers.tolist()) == set(ids[ids >= 0].tolist())


def test_the_largest_id_comes_through(renderer: Renderer) -> None:
    """The id image holds the highest id allowed unchanged, and -1 for the background."""
    ids = renderer.ids([batch(CUBE, (0.0, 0.0, 0.0), first=LARGEST_ID)], Camera((0.0, 0.0, 3.0)))
    assert sorted(np.unique(ids).tolist()) == [-1, LARGEST_ID]


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


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            {"position": (1.0, 0.0, 0.0), "target": (1.0, 0.0, 0.0)},
            "camera: position and target must be finite and differ, received (1.0, 0.0, 0.0) and (1.0, 0.0, 0.0)",
        ),
        (
            {"position": (math.nan, 0.0, 0.0)},
            "camera: position and target must be finite and differ, received (nan, 0.0, 0.0) and (0.0, 0.0, 0.0)",
        ),
        (
            {"position": (1.0, 0.0, 0.0), "up": (0.0, 0.0, 0.0)},
            "camera: up must be finite and not zero, received (0.0, 0.0, 0.0)",
        ),
        (
            {"position": (1.0, 0.0, 0.0), "fov": math.pi},
            "camera: fov must lie between 0 and 180 deg, received 180 deg",
        ),
        (
            {"position": (1.0, 0.0, 0.0), "near": 2.0, "far": 1.0},
            "camera: near must be above 0 m and below far, received 2 m and 1 m",
        ),
    ],
)
def test_a_camera_that_sees_nothing_is_refused(arguments: dict[str, object], message: str) -> None:
    """A camera without a direction, an angle or a range raises an error that names the values received."""
    with pytest.raises(CaromError) as caught:
        Camera(**arguments)  # type: ignore[arg-type]
    assert str(caught.value) == message


def test_ids_that_do_not_fit_are_refused() -> None:
    """A batch with an id above the largest one raises an error that gives the range allowed."""
    with pytest.raises(CaromError) as caught:
        batch(CUBE, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), first=LARGEST_ID)
    assert str(caught.value) == "batch: ids must lie from 0 to 16777214, received 16777214 to 16777215"


def test_columns_of_different_lengths_are_refused() -> None:
    """A batch has one pose, one colour and one id per instance, or raises an error with the three counts."""
    with pytest.raises(CaromError) as caught:
        Batch(CUBE.vertices, CUBE.faces, poses((0.0, 0.0, 0.0)), np.ones((2, 4)), np.zeros(1, np.int64))
    assert str(caught.value) == "batch: poses, colors and ids must be as many, received 1, 2 and 1"


def test_a_picture_without_area_is_refused() -> None:
    """A renderer needs at least one pixel each way, and the error states the size received."""
    with pytest.raises(CaromError) as caught:
        Renderer(0, 10)
    assert str(caught.value) == "renderer: width and height must be at least 1 px, received 0 x 10"


def test_a_closed_renderer_says_so() -> None:
    """Closing twice is harmless, and drawing afterwards raises an error that says what to do."""
    closed = Renderer(8, 8)
    closed.close()
    closed.close()
    with pytest.raises(CaromError) as caught:
        closed.picture([], Camera((0.0, 0.0, 3.0)))
    assert str(caught.value) == "renderer: it was closed; make a new one"


def test_without_any_opengl_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """The error names the libraries looked for, the command to run, and what works without them."""
    monkeypatch.delenv(offscreen.PLATFORM_VARIABLE, raising=False)
    monkeypatch.setattr(offscreen, "loads", lambda libraries: False)
    with pytest.raises(offscreen.GraphicsError) as caught:
        offscreen.backend()
    assert str(caught.value) == (
        "pictures need software OpenGL, and neither libOSMesa.so nor libEGL.so.1 was found; accepted: either of them; "
        "run: sudo apt-get install -y libosmesa6 (or, where that package does not exist, libegl1 libgl1-mesa-dri); "
        "simulating, checking and recording work without it"
    )


def test_opengl_imported_for_a_screen_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """If OpenGL was imported first, loading raises an error that gives two ways out."""
    monkeypatch.delenv(offscreen.PLATFORM_VARIABLE, raising=False)
    monkeypatch.setitem(sys.modules, "OpenGL", sys)
    monkeypatch.setattr(offscreen, "loads", lambda libraries: True)
    with pytest.raises(offscreen.GraphicsError) as caught:
        offscreen.load()
    assert str(caught.value) == (
        "OpenGL was imported before carom could choose how to draw without a screen; set the environment variable "
        "PYOPENGL_PLATFORM=osmesa before Python starts, or make carom's renderer first"
    )


def test_where_there_is_no_osmesa_egl_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """The backend falls back to EGL when only its libraries load."""
    monkeypatch.delenv(offscreen.PLATFORM_VARIABLE, raising=False)
    monkeypatch.setattr(offscreen, "loads", lambda libraries: "EGL" in libraries[0])
    assert offscreen.backend() == "egl"


DRAW = """
import numpy as np
from trimesh.creation import box
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer
cube = box(extents=(1.0, 1.0, 1.0))
with Renderer(64, 48) as renderer:
    drawn = [Batch(cube.vertices, cube.faces, np.eye(4)[None], np.ones((1, 4)), np.zeros(1, np.int64))]
    camera = Camera((0.0, 0.0, 3.0))
    print(renderer.driver.partition(":")[0], (renderer.ids(drawn, camera) == 0).sum())
    print(round(renderer.picture(drawn, camera).mean()))
"""


@pytest.mark.skipif(not offscreen.loads(("libEGL.so.1", "libEGL_mesa.so.0")), reason="no libEGL on this machine")
def test_egl_draws_the_same_scene() -> None:
    """Each backend covers the pixels that geometry demands, and all give the same mean brightness."""
    drawn = {}
    for name in ("egl", "osmesa"):
        if name == "osmesa" and not any(map(offscreen.loads, offscreen.LIBRARIES[name])):
            continue
        environment = {**os.environ, offscreen.PLATFORM_VARIABLE: name}
        done = subprocess.run([sys.executable, "-c", DRAW], env=environment, capture_output=True, text=True, check=True)
        said, covered, mean = done.stdout.split()
        assert said == name
        drawn[name] = (int(covered), int(mean))
    # The near face, 2.5 m away, is 23.2 pixels high: 23 or 24 rows of as many pixel centres.
    assert all(covered in (22 * 22, 23 * 23, 24 * 24) for covered, _ in drawn.values())
    assert len({mean for _, mean in drawn.values()}) == 1
