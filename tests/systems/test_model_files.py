"""Model files and images: what is read from them, how it is turned and scaled, and what is refused."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from faults import error
from PIL import Image

from carom.ecs import DeclarationError
from carom.systems.shapes import model_files
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.model_files import load_mesh
from carom.systems.simulation import Simulation

BOX = trimesh.creation.box(extents=(1.0, 2.0, 3.0))
FORMATS = "OBJ, STL, PLY or glTF (.obj, .stl, .ply, .glb, .gltf)"


def write(path: Path, vertices: Any, faces: Any) -> Path:
    """Write triangles as they are, without trimesh's mending."""
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)  # trimesh leaves its .gltf open
        mesh.export(path)
    return path


def refused(make: Any, message: str) -> None:
    """Expect the whole of a message."""
    with error(DeclarationError, message):
        make()


@pytest.mark.parametrize("ending", ["obj", "stl", "ply", "glb", "gltf"])
def test_every_format_holds_the_same_solid(ending: str, tmp_path: Path) -> None:
    """STL repeats its vertices and all may be lists of separate triangles: eight corners are left of each."""
    path = write(tmp_path / f"box.{ending}", BOX.vertices, BOX.faces)
    mesh = Mesh.stated(file=path, scale=0.1)
    solid = mesh.mass_properties()
    assert (len(mesh.geometry.vertices), len(mesh.geometry.faces), mesh.geometry.notes) == (8, 12, ())
    assert solid.volume == pytest.approx(6e-3, rel=1e-6)
    assert sorted(solid.inertia) == pytest.approx([0.05 / 12, 0.10 / 12, 0.13 / 12], rel=1e-6)
    assert Convex.stated(file=path, scale=0.1).bounds().half == pytest.approx(mesh.bounds().half)


@pytest.mark.parametrize(
    ("words", "half"),
    [
        ({}, (0.5, 1.0, 1.5)),
        ({"unit": "mm"}, (0.5e-3, 1e-3, 1.5e-3)),
        ({"unit": "in", "scale": 2.0}, (0.0254, 0.0508, 0.0762)),
        ({"up": "z"}, (0.5, 1.5, 1.0)),
    ],
)
def test_units_scale_and_the_axis_that_points_up(
    words: dict[str, Any], half: tuple[float, ...], tmp_path: Path
) -> None:
    """The shape is that of the file, in metres and with y up."""
    path = write(tmp_path / "box.ply", BOX.vertices, BOX.faces)
    assert Mesh.stated(file=path, **words).bounds().half == pytest.approx(half, rel=1e-12)


def test_z_up_turns_the_model_and_does_not_mirror_it(tmp_path: Path) -> None:
    """What was on top of the file is on top, what was at its front (-y) at the front (+z)."""
    path = write(tmp_path / "box.ply", np.add(BOX.vertices, (0.0, 5.0, 7.0)), BOX.faces)
    mesh = Mesh.stated(file=path, up="z")
    assert mesh.bounds().center == pytest.approx((0.0, 7.0, -5.0))
    assert mesh.mass_properties().volume == pytest.approx(6.0)


def test_the_meshes_of_a_scene_are_joined_where_it_places_them(tmp_path: Path) -> None:
    """Two boxes of one scene, one of them moved and turned by its node."""
    scene = trimesh.Scene([BOX])
    scene.add_geometry(BOX, transform=trimesh.transformations.translation_matrix([10.0, 0.0, 0.0]))
    scene.export(tmp_path / "two.glb")
    mesh = Mesh.stated(file=tmp_path / "two.glb")
    assert mesh.mass_properties().volume == pytest.approx(12.0, rel=1e-6)
    assert mesh.bounds().half == pytest.approx((5.5, 1.0, 1.5))


def test_triangles_without_area_are_dropped_and_reported(tmp_path: Path) -> None:
    """One collapsed to an edge, one to a point; the geometry says so and Python warns."""
    path = write(tmp_path / "box.ply", BOX.vertices, [*BOX.faces.tolist(), [0, 1, 1], [2, 2, 2]])
    note = f"mesh file {path}: 2 of 14 triangles have no area and are left out"
    mesh = Mesh.stated(file=path)
    assert mesh.geometry.notes == (note,)
    assert len(mesh.geometry.faces) == 12
    with pytest.warns(UserWarning, match=f"^{re.escape(note)}$"):
        Simulation().add(collider={"mesh": {"file": path}})


def test_a_sliver_that_fills_a_gap_is_dropped_without_opening_it(tmp_path: Path) -> None:
    """A vertex in the middle of an edge, joined by a triangle whose corners lie on a line: the solid stays closed."""
    tetrahedron = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5, 0.0, 0.0]]
    faces = [[0, 2, 4], [4, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [0, 4, 1]]
    mesh = load_mesh(write(tmp_path / "sliver.ply", tetrahedron, faces))
    assert mesh.notes == (f"mesh file {tmp_path}/sliver.ply: 1 of 6 triangles has no area and is left out",)
    assert Mesh(mesh).mass_properties().volume == pytest.approx(1.0 / 6.0, rel=1e-12)


def test_surfaces_that_enclose_nothing(tmp_path: Path) -> None:
    """Open, turned both ways, inside out, flat, and without triangles: each says what to mend."""
    source = f"mesh file {tmp_path}"
    flipped = np.array(BOX.faces)
    flipped[0] = flipped[0, ::-1]
    for name, faces, message in (
        ("open", BOX.faces[:-1], "is open: 3 edges do not join two faces; close its holes, or use convex"),
        (
            "twisted",
            flipped,
            "is turned both ways: 3 edges join faces that look to opposite sides; turn its faces outward",
        ),
        ("inverted", BOX.faces[:, ::-1], "is inverted: its volume is -0.048 m3; turn its faces outward"),
        ("flat", [[0, 1, 1], [2, 2, 3]], "holds 2 triangles, none of which has an area"),
    ):
        path = write(tmp_path / f"{name}.ply", BOX.vertices, faces)
        refused(lambda path=path: load_mesh(path, scale=0.2), f"{source}/{name}.ply {message}")
    trimesh.PointCloud(BOX.vertices).export(tmp_path / "points.ply")
    refused(lambda: load_mesh(tmp_path / "points.ply"), f"{source}/points.ply holds no triangles")
    assert Convex.stated(file=tmp_path / "points.ply").mass_properties().volume == pytest.approx(6.0)


def test_a_file_of_nan(tmp_path: Path) -> None:
    """The vertex is named; a file in metres that overflows in kilometres is no better."""
    vertices = np.array(BOX.vertices)
    vertices[5] = [1.0, np.nan, 0.0]
    path = write(tmp_path / "nan.ply", vertices, BOX.faces)
    for read in (load_mesh, lambda file: Convex.stated(file=file)):
        refused(
            lambda read=read: read(path),
            f"mesh file {path}: vertices must be finite, received [1.0, nan, 0.0] as vertex 5",
        )


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("words.obj", "hello world\n", "holds no triangles"),
        ("words.stl", "hello", "holds no triangles"),
        ("empty.stl", "", "holds no triangles"),
        ("words.ply", "hello", "cannot be read: Not a ply file!"),
        ("words.glb", "hello", "cannot be read: buffer size must be a multiple of element size"),
        ("words.yaml", "hello: 1", f"is of an unknown format '.yaml'; write {FORMATS}"),
        ("none", "", f"is of an unknown format ''; write {FORMATS}"),
    ],
)
def test_a_file_that_is_no_mesh(name: str, text: str, said: str, tmp_path: Path) -> None:
    """A file without triangles says so, whatever its name promises."""
    path = tmp_path / name
    path.write_text(text)
    refused(lambda: load_mesh(path), f"mesh file {path} {said}")


def test_a_missing_file_and_wrong_options(tmp_path: Path) -> None:
    """The path, or the option and what it accepts, is in the message."""
    source = f"mesh file {tmp_path}/none.obj"
    path: Any = tmp_path / "none.obj"
    refused(lambda: load_mesh(path), f"{source} does not exist")
    refused(lambda: load_mesh(path, scale=0.0), f"{source}: scale must be finite and above 0, received 0.0")
    refused(
        lambda: load_mesh(path, unit="feet"), f"{source}: unit must be one of m, cm, mm, km, in, ft, received 'feet'"
    )
    refused(lambda: load_mesh(path, up="x"), f"{source}: up must be one of y, z, received 'x'")
    refused(Convex.stated, "convex: must state one source, points or file")


def test_a_mesh_beyond_the_limit_is_refused_with_the_reason(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is not known after how many minutes it would be there; a hull takes any number."""
    monkeypatch.setattr(model_files, "MOST_TRIANGLES", 11)
    path = write(tmp_path / "box.stl", BOX.vertices, BOX.faces)
    refused(
        lambda: load_mesh(path),
        f"mesh file {path} holds 12 triangles, more than the 11 a mesh may have, since each million takes "
        "some 20 s to load; simplify it, or use convex",
    )
    assert Convex.stated(file=path).mass_properties().volume == pytest.approx(6.0)


def test_land_from_an_image(tmp_path: Path) -> None:
    """Black is low, white is high, rows from the back to the front; 8 and 16 bits say the same."""
    grey = np.array([[0, 51], [255, 102], [0, 0]])
    Image.fromarray(grey.astype(np.uint8)).save(tmp_path / "8.png")
    Image.fromarray((grey * 257).astype(np.uint16)).save(tmp_path / "16.png")
    for name in ("8.png", "16.png"):
        land = HeightField.stated(image=tmp_path / name, spacing=0.5, low=-1.0, high=4.0)
        assert land.geometry.vertices[:4] == pytest.approx(
            np.array([[-0.25, -1.0, -0.5], [0.25, 0.0, -0.5], [-0.25, 4.0, 0.0], [0.25, 1.0, 0.0]]), abs=1e-12
        )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({}, "height_field: must state one source, heights, image or noise"),
        ({"heights": []}, "heights: must be rows of as many numbers each, received none"),
        ({"heights": [1.0, 2.0]}, "heights: must be rows of as many numbers each, received none"),
        ({"heights": [[1.0, 2.0], [3.0]]}, "heights: must be rows of as many numbers each, received rows of 1, 2"),
        ({"heights": [[1.0, 2.0]]}, "heights: land needs at least 2 x 2 heights, received 1 x 2"),
        ({"heights": [[1.0, 2.0], [3.0, np.inf]]}, "heights: heights must be finite, received inf in row 1, column 1"),
        (
            {"heights": [[0.0] * 2] * 2, "spacing": 0.0},
            "height_field.spacing: must be finite and above 0 m, received 0.0",
        ),
        ({"image": "none.png"}, "image file none.png does not exist"),
        (
            {"heights": np.zeros((1001, 502))},
            "heights: 1001 x 502 heights make 1,002,000 triangles, more than the 1,000,000 a mesh may have; take fewer, or split the land",
        ),
    ],
)
def test_land_that_is_none(words: dict[str, Any], message: str) -> None:
    """Too few heights, rows of different lengths, too many for FCL."""
    refused(lambda: HeightField.stated(**{"spacing": 1.0} | words), message)


def test_an_image_that_is_none(tmp_path: Path) -> None:
    """Pillow says what it is not."""
    path = tmp_path / "words.png"
    path.write_text("hello")
    refused(
        lambda: HeightField.stated(image=path, spacing=1.0),
        f"image file {path} cannot be read: cannot identify image file '{path}'",
    )


def test_python_takes_the_words_of_a_file() -> None:
    """A collider's shape is stated alike in both."""
    simulation = Simulation()
    simulation.add(name="land", collider={"height_field": {"heights": np.zeros((3, 3)), "spacing": 1.0}})
    simulation.add(
        name="rock", body={}, collider={"convex": {"points": BOX.vertices}}, transform={"position": (0, 1.5, 0)}
    )
    simulation.step(30)
    assert simulation["rock"].transform.position[1] == pytest.approx(1.0, abs=0.02)
    assert simulation["rock"].rigid_body.mass == pytest.approx(6000.0)
