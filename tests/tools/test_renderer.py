"""Pictures show what they are given, depend on nothing else, and faults are told in whole sentences."""

from __future__ import annotations

import gc
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
    Renderer(64, 48).close()
    drawn = [Batch(cube.vertices, cube.faces, np.eye(4)[None], np.ones((1, 4)), np.zeros(1, np.int64))]
    camera = Camera((0.0, 0.0, 3.0))
    print(renderer.driver.partition(":")[0], (renderer.ids(drawn, camera) == 0).sum())
    print(round(renderer.picture(drawn, camera).mean()))
"""


@pytest.mark.skipif(not offscreen.loads(("libEGL.so.1", "libEGL_mesa.so.0")), reason="no libEGL on this machine")
def test_egl_draws_the_same_scene() -> None:
    """Each backend covers the pixels that geometry demands, and all give the same mean brightness.

    That another renderer was made and closed meanwhile is nothing to the first.
    """
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


WITHOUT_OSMESA = """
from carom.tools import offscreen
offscreen.LIBRARIES["osmesa"] = (("libOSMesa-that-is-not-there.so",),)
"""


@pytest.mark.skipif(not offscreen.loads(("libEGL.so.1", "libEGL_mesa.so.0")), reason="no libEGL on this machine")
def test_where_osmesa_is_missing_egl_draws_without_being_asked() -> None:
    """In a process whose loader finds no libOSMesa the driver is EGL's, and the cube is drawn."""
    environment = {name: value for name, value in os.environ.items() if name != offscreen.PLATFORM_VARIABLE}
    command = [sys.executable, "-c", WITHOUT_OSMESA + DRAW]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    said, covered, _ = done.stdout.split()
    assert (said, int(covered)) in (("egl", 23 * 23), ("egl", 24 * 24))


def test_no_library_of_windows_is_needed() -> None:
    """Where pyglet, which looks for those of X11 as it is imported, cannot be, the cube is drawn all the same."""
    command = [sys.executable, "-c", "import sys; sys.modules['pyglet'] = None" + DRAW]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert int(done.stdout.split()[1]) in (23 * 23, 24 * 24)


def test_frames_are_bit_identical_in_other_processes() -> None:
    """Pictures, depths and ids of shadowed, translucent and curved bodies have one hash, whatever the threads."""
    hashes = {
        subprocess.run(
            [sys.executable, "-c", HASH],
            env={**os.environ, "LP_NUM_THREADS": threads},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in ("0", "2", "5")
    }
    assert len(hashes) == 1 and len(hashes.pop().split()) == 3


HASH = """
import hashlib
import numpy as np
from trimesh.creation import box, icosphere
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer
rng = np.random.default_rng(5)
batches = []
for mesh, smooth, alpha in ((box(extents=(9, 0.1, 9)), False, 1), (box(), False, 1), (icosphere(), True, 0.5)):
    poses = np.tile(np.eye(4), (20, 1, 1))
    poses[:, :3, 3] = rng.uniform(-3, 3, (20, 3))
    colors = np.column_stack([rng.uniform(0, 1, (20, 3)), np.full(20, alpha)])
    batches.append(Batch(mesh.vertices, mesh.faces, poses, colors, np.arange(20), smooth))
with Renderer(160, 120) as renderer:
    for camera in (Camera((2.0, 5.0, 9.0)), Camera((2.0, 5.0, 9.0), height=8.0)):
        parts = renderer.picture(batches, camera), renderer.depth(batches, camera), renderer.ids(batches, camera)
        told = [hashlib.sha256(part.tobytes()).hexdigest() for part in parts]
print(*told)
"""
