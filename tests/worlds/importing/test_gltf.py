"""Scenes in glTF stand as they stood: each node's mesh where the node is, stretched and mirrored as it is."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carom.ecs.spatial import quaternion
from carom.systems.shapes.model_files import read_scene
from carom.worlds import WorldError, load_text
from carom.worlds.importing import Imported, Options, import_model

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], np.float32)  # no mirror image of itself
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint16)
HALF = 0.5**0.5


def scene(nodes: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    """Return a scene whose only mesh is a tetrahedron with three different edges at a corner."""
    content = CORNERS.tobytes() + FACES.tobytes()
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}]
    points = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 3]}
    faces = {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}
    uri = "data:application/octet-stream;base64," + base64.b64encode(content).decode()
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "meshes": [{"name": "corner", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"uri": uri, "byteLength": len(content)}], "bufferViews": views, "accessors": [points, faces],
    } | more  # fmt: skip


def imported(folder: Path, data: Any, **options: Any) -> Imported:
    """Return what becomes of a scene; its meshes are written."""
    (folder / "model.gltf").write_text(data if isinstance(data, str) else json.dumps(data))
    made = import_model(folder / "model.gltf", Options(**options), folder=folder, stem="world")
    made.write_files(folder)
    return made


def in_order(points: np.ndarray) -> list[list[float]]:
    """Return points to the micrometre, in an order of their own: files may store them in any."""
    return sorted((np.round(points, 6) + 0.0).tolist())


def corners(folder: Path, data: Any, name: str, **options: Any) -> np.ndarray:
    """Return where in the world the tetrahedron's corners are, in the order of the file."""
    world = load_text(imported(folder, data, **options).text, "world.yaml", folder)
    pose = world.simulation[name].transform
    (file,) = {source["file"] for source in [world.document["entities"][0]["visual"]["mesh"]]}
    return pose.position + quaternion.rotate(pose.rotation, np.array(read_scene(folder / file).vertices))


NODES = [
    {"name": "outer", "translation": [1, 2, 3], "rotation": [0, HALF, 0, HALF], "scale": [2, 2, 2], "children": [1]},
    {"name": "inner", "mesh": 0, "translation": [0, 0, 1], "scale": [1, 1, -0.5]},
]
WANTED = np.array([[1, 2, 3]]) + 2.0 * (CORNERS * [1, 1, -0.5] + [0, 0, 1])[:, [2, 1, 0]] * [1, 1, -1]


def test_nodes_in_nodes_stand_where_they_stood(tmp_path: Path) -> None:
    """Translation, rotation and scale of both, a mirror among them: x' = t + R s x."""
    assert in_order(corners(tmp_path, scene(NODES), "inner")) == in_order(WANTED)


def test_a_left_handed_scene_in_cm_is_mirrored(tmp_path: Path) -> None:
    """(x, y, z) of a point becomes (x, y, -z) / 100, and faces still look outward."""
    found = corners(tmp_path, scene(NODES), "inner", hand="left", unit=0.01, up="y")
    wanted = WANTED * [0.01, 0.01, -0.01]
    assert in_order(found) == in_order(wanted)
    (file,) = (tmp_path / "world-parts").iterdir()
    assert read_scene(file).volume == pytest.approx(1.0 * 8 * 0.5 * 1e-6, rel=1e-5)


def test_meshes_touch_on_request(tmp_path: Path) -> None:
    """As themselves where they are closed, and as the parts that they are cut into."""
    node = [{"name": "a", "mesh": 0}]
    assert "collider" not in imported(tmp_path, scene(node)).text
    assert "collider: {mesh: {file: world-parts/corner.glb}}" in imported(tmp_path, scene(node), meshes="hull").text
    made = imported(tmp_path, scene(node), meshes="parts", cut=lambda path: [path, path])
    assert made.text.count("collider: {convex: ") == 2
    assert [note.what for note in made.report.notes] == ["a mesh to touch as convex parts"]


def test_cameras_and_what_is_left_out(tmp_path: Path) -> None:
    """A camera looks along -z of its node; animations, skins and extensions are told."""
    nodes = [{"name": "eye", "camera": 0, "translation": [0, 1, 0], "rotation": [0, HALF, 0, HALF]}]
    more = {"cameras": [{"type": "perspective", "perspective": {"yfov": 0.5}}], "animations": [{"name": "walk"}]}
    made = imported(tmp_path, scene(nodes, extensionsUsed=["KHR_lights_punctual"], **more))
    camera = load_text(made.text).cameras["eye"]
    assert (camera.position, camera.fov) == ((0.0, 1.0, 0.0), 0.5)
    assert camera.target == pytest.approx((-1.0, 1.0, 0.0))
    assert [(note.what, note.whose) for note in made.report.notes] == [
        ("animations", "walk"),
        ("extension KHR_lights_punctual", ""),
    ]


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ("{", "JSONDecodeError Expecting property name enclosed in double quotes: line 1 column 2 (char 1)"),
        ({"asset": {"version": "1.0"}}, "of version 1.0; accepted: 2.0"),
        (scene([{"children": [0]}]), "ValueError node 0 hangs in two places"),
        (scene([{"mesh": 7}]), "IndexError list index out of range"),
        (scene([{"mesh": 0, "rotation": [0, 0, 0, 0]}]), "ValueError a rotation is no quaternion"),
        (scene([{}], buffers=[{"byteLength": 9}]), "ValueError a buffer is not there, or shorter than it says"),
    ],
)
def test_what_is_no_gltf_is_refused(tmp_path: Path, data: Any, message: str) -> None:
    """With what is wrong."""
    with pytest.raises(WorldError) as fault:
        imported(tmp_path, data)
    assert str(fault.value) == f"{tmp_path}/model.gltf: is not glTF: {message}"


def test_buffers_outside_the_root_are_refused(tmp_path: Path) -> None:
    """Whatever the file says, nothing beyond its folder is read."""
    with pytest.raises(WorldError) as fault:
        imported(tmp_path, scene([{}], buffers=[{"uri": "../secret.bin", "byteLength": 9}]))
    accepted = f"files below {tmp_path.resolve()}; --root names another folder"
    assert str(fault.value) == (
        f"{tmp_path}/model.gltf: <glTF>: names a file outside the root; received '../secret.bin'; accepted: {accepted}"
    )
