"""Visuals from glTF look as the file says: each part of an image where its coordinates put it, in its own colour."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from trimesh.creation import box
from trimesh.visual.material import PBRMaterial

from carom.ecs import Visual
from carom.ecs.errors import DeclarationError
from carom.systems.shapes.finish import Finish, load_seen
from carom.systems.simulation import Simulation
from carom.tools.batch import Batch
from carom.tools.cameras import Camera
from carom.tools.coloring import Coloring
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene
from carom.worlds import load_world

WIDTH, HEIGHT = 120, 90
SQUARE = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])
CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
RED, GREEN, BLUE, GRAY = (220, 30, 20), (40, 200, 60), (30, 60, 210), (180, 180, 180)
IMAGE = np.array([[RED, GREEN], [BLUE, GRAY]], np.uint8)  # first row on top
CAMERA = Camera((0.0, 0.0, 4.0))


def quad(path: Path, *, image: np.ndarray | None = IMAGE, shift: float = 0.0, **material: object) -> Path:
    """Write a square of 2 m with an image on it as a glTF file, by trimesh; return the path."""
    path.write_bytes(square(image, shift, **material).export(file_type="glb"))
    return path


def square(image: np.ndarray | None, shift: float = 0.0, **material: object) -> trimesh.Trimesh:
    """Return such a square."""
    png = None
    if image is not None:
        kept = io.BytesIO()
        Image.fromarray(image).save(kept, "PNG")
        png = Image.open(kept)
    made = trimesh.Trimesh(SQUARE + np.array((shift, 0.0, 0.0)), FACES, process=False)
    look = PBRMaterial(baseColorTexture=png, **({"metallicFactor": 0.0, "roughnessFactor": 1.0} | material))
    made.visual = trimesh.visual.TextureVisuals(CORNERS, material=look)
    return made


def shown(path: Path, **visual: object) -> Simulation:
    """Return a simulation with the file as a visual."""
    simulation = Simulation()
    simulation.add(name="quad", visual={"mesh": {"file": path}, **visual})
    return simulation


def pixel(picture: np.ndarray, x: float, y: float) -> list[int]:
    """Return the pixel that shows (x, y, 0) by `CAMERA`."""
    scale = HEIGHT / 2.0 / np.tan(CAMERA.fov / 2.0) / 4.0
    return picture[int(HEIGHT / 2.0 - scale * y), int(WIDTH / 2.0 + scale * x)].tolist()


def plain(renderer: Renderer, color: tuple[float, ...]) -> list[int]:
    """Return how a square of one colour looks in its middle."""
    batch = Batch(SQUARE, FACES, np.eye(4)[None], np.array([(*color, 1.0)]), np.zeros(1, np.int64))
    return pixel(renderer.picture([batch], CAMERA), 0.5, 0.5)


def test_each_colour_of_an_image_is_in_its_place(renderer: Renderer, tmp_path: Path) -> None:
    """Red is on the left on top; the middle of each quarter is that of a square of its one colour.

    But for what is blended in from its neighbours, since a pixel is not quite in the middle of a texel.
    """
    picture = renderer.picture(Scene(shown(quad(tmp_path / "quad.glb")).world).batches(), CAMERA)
    for x, y, color in ((-0.5, 0.5, RED), (0.5, 0.5, GREEN), (-0.5, -0.5, BLUE), (0.5, -0.5, GRAY)):
        assert pixel(picture, x, y) == pytest.approx(plain(renderer, tuple(np.array(color) / 255.0)), abs=5)


def test_a_world_file_shows_it(renderer: Renderer, tmp_path: Path) -> None:
    """A file beside the world, open as a square is, brings its image, larger and with z up where that is stated."""
    quad(tmp_path / "quad.glb", image=IMAGE.repeat(4, axis=0).repeat(4, axis=1))
    words = "{mesh: {file: quad.glb, scale: 0.5, up: z}, rotation: {axis: [1, 0, 0], angle: 90 deg}}"
    (tmp_path / "world.yaml").write_text(f"carom: 1\nentities: [{{name: quad, visual: {words}}}]\n")
    picture = renderer.picture(Scene(load_world(tmp_path / "world.yaml").simulation.world).batches(), CAMERA)
    assert pixel(picture, -0.25, 0.25) == pytest.approx(plain(renderer, tuple(np.array(RED) / 255.0)), abs=2)
    assert pixel(picture, 0.75, 0.25) == pixel(renderer.picture([], CAMERA), 0.75, 0.25)


def test_factor_and_colour_multiply_light(renderer: Renderer, tmp_path: Path) -> None:
    """A base colour factor of a quarter of the light is half the value on the screen; a stated colour tints that."""
    path = quad(tmp_path / "quad.glb", image=None, baseColorFactor=[64, 255, 0, 255])
    for words, tint in (({}, (1.0, 1.0, 1.0)), ({"color": (1.0, 0.5, 1.0)}, (1.0, 0.5, 1.0))):
        picture = renderer.picture(Scene(shown(path, **words).world).batches(), CAMERA)
        wanted = plain(renderer, (0.501 * tint[0], 1.0 * tint[1], 0.0))
        assert pixel(picture, 0.5, 0.5) == pytest.approx(wanted, abs=2)


def test_without_a_material_the_colour_is_the_entitys(tmp_path: Path) -> None:
    """A mesh file with nothing but triangles has the colour of the entity's material; one with a look is white."""
    bare = tmp_path / "bare.stl"
    bare.write_bytes(trimesh.Trimesh(SQUARE, FACES).export(file_type="stl"))
    simulation = Simulation()
    for path in (bare, quad(tmp_path / "quad.glb")):
        simulation.add(visual={"mesh": {"file": path}}, material={"color": (0.2, 0.3, 0.4)})
    assert simulation.world[Visual].color[:2].tolist() == [[0.2, 0.3, 0.4, 1.0], [1.0, 1.0, 1.0, 1.0]]


def test_a_white_image_changes_nothing_else(renderer: Renderer) -> None:
    """Shadows fall on textured bodies as on others, whichever is drawn first: each picture is that without images."""
    cube, floor, camera = box(), box(extents=(9.0, 0.1, 9.0)), Camera((2.0, 3.0, 4.0))
    white = np.full((1, 1, 4), 255, np.uint8)
    pictures = []
    for textured in (True, False):
        batches = []
        for number, (mesh, y) in enumerate(((cube, 0.5), (floor, -0.05), (cube, 1.8))):
            pose = np.eye(4)[None].copy()
            pose[0, 1, 3] = y
            vertices = np.array(mesh.vertices)
            finish = Finish(white, np.zeros((len(vertices), 2))) if textured else None
            look = np.full((1, 4), 0.7 + 0.3 * (np.arange(4) == 3)), np.array([number])
            batches.append(Batch(vertices, mesh.faces, pose, *look, finish=finish))
        pictures.append(renderer.picture(batches, camera).astype(int))
    assert np.abs(pictures[0] - pictures[1]).max() <= 1
    assert pictures[1].std() > 10.0


def test_two_sides_are_seen_from_behind(renderer: Renderer, tmp_path: Path) -> None:
    """A square that says so is seen from behind, mirrored; others are not there."""
    behind = Camera((0.0, 0.0, -4.0))
    for two_sided in (True, False):
        world = shown(quad(tmp_path / f"{two_sided}.glb", doubleSided=two_sided)).world
        picture = renderer.picture(Scene(world).batches(), behind)
        red = pixel(picture, 0.5, 0.5)
        assert (red[0] > 2 * red[1]) is two_sided


def test_an_image_may_let_through(renderer: Renderer, tmp_path: Path) -> None:
    """Where its alpha is half, and the material blends, half of what is behind is seen; else it is opaque."""
    image = np.dstack([IMAGE, np.array([[128, 255], [255, 255]], np.uint8)])
    sky = renderer.picture([], CAMERA)
    for mode, share in (("BLEND", 128.0 / 255.0), ("OPAQUE", 1.0)):
        world = shown(quad(tmp_path / f"{mode}.glb", image=image, alphaMode=mode)).world
        picture = renderer.picture(Scene(world).batches(), CAMERA)
        red, behind = plain(renderer, tuple(np.array(RED) / 255.0)), pixel(sky, -0.5, 0.5)
        wanted = share * np.array(red) + (1.0 - share) * np.array(behind)
        assert pixel(picture, -0.5, 0.5) == pytest.approx(wanted.tolist(), abs=3)


def test_several_meshes_keep_their_images(renderer: Renderer, tmp_path: Path) -> None:
    """Of a file with a red and a blue square, each is on its side."""
    parts = [square(np.full((4, 4, 3), color, np.uint8), x) for x, color in ((-1.0, RED), (1.0, BLUE))]
    path = tmp_path / "two.glb"
    path.write_bytes(trimesh.Scene(parts).export(file_type="glb"))
    picture = renderer.picture(Scene(shown(path).world).batches(), CAMERA)
    for x, color in ((-0.8, RED), (0.8, BLUE)):
        assert pixel(picture, x, 0.3) == pytest.approx(plain(renderer, tuple(np.array(color) / 255.0)), abs=4)


def test_metal_mirrors_in_its_own_colour(renderer: Renderer, tmp_path: Path) -> None:
    """Polished red metal shows the sky in red; rough or no metal hardly differ."""
    seen = {}
    for metallic, roughness in ((1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
        path = quad(
            tmp_path / "metal.glb",
            image=None,
            baseColorFactor=[255, 0, 0, 255],
            metallicFactor=metallic,
            roughnessFactor=roughness,
        )
        seen[metallic, roughness] = pixel(renderer.picture(Scene(shown(path).world).batches(), CAMERA), 0.5, 0.5)
    assert seen[1.0, 1.0] == seen[0.0, 1.0]
    assert seen[1.0, 0.0][0] != seen[0.0, 1.0][0]
    assert max(seen[1.0, 0.0][1:]) < 60


def test_a_mode_of_colour_takes_images_off(tmp_path: Path) -> None:
    """What colours tell is not mixed with what is painted on."""
    scene = Scene(shown(quad(tmp_path / "quad.glb")).world)
    assert scene.batches()[0].finish is not None
    assert scene.batches(coloring=Coloring("material"))[0].finish is not None
    assert scene.batches(coloring=Coloring("speed"))[0].finish is None


def test_equal_triangles_with_other_looks_are_two_geometries(tmp_path: Path) -> None:
    """And a file that is used twice is one."""
    simulation = Simulation()
    paths = [quad(tmp_path / "a.glb"), quad(tmp_path / "b.glb", image=IMAGE[::-1].copy()), tmp_path / "a.glb"]
    for path in paths:
        simulation.add(visual={"mesh": {"file": path}})
    assert simulation.world[Visual].geometry[:3].tolist() == [0, 1, 0]


def test_what_cannot_be_seen_is_refused(tmp_path: Path) -> None:
    """A file without triangles, or that is not there."""
    empty = tmp_path / "empty.ply"
    empty.write_bytes(trimesh.PointCloud(SQUARE).export(file_type="ply"))
    for path, message in (
        (empty, f"mesh file {empty} holds 0 triangles; accepted: 1 to 1,000,000"),
        (tmp_path / "none.glb", f"mesh file {tmp_path / 'none.glb'} does not exist"),
    ):
        with pytest.raises(DeclarationError) as caught:
            load_seen(path)
        assert str(caught.value) == message
