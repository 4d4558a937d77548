"""Meshes of models: found below the root, named where they lie or written anew, touching as hulls or parts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from carom.ecs.spatial import quaternion
from carom.systems.shapes.model_files import read_scene
from carom.worlds import load_text
from carom.worlds.importing import Imported, Options, import_model

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]])  # no mirror image of itself
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
INERTIA = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def robot(folder: Path, mesh: str, inertia: str = INERTIA, **options: object) -> Imported:
    """Return what becomes of a link whose only shape is a mesh; what is to be beside it is written."""
    path = folder / "arm_description" / "urdf" / "arm.urdf"
    path.parent.mkdir(parents=True, exist_ok=True)
    (path.parent.parent / "meshes").mkdir(exist_ok=True)
    trimesh.Trimesh(CORNERS, FACES, process=False).export(path.parent.parent / "meshes" / "corner.ply")
    shape = f"<geometry><mesh {mesh}/></geometry>"
    parts = f"<visual>{shape}</visual><collision>{shape}</collision>"
    path.write_text(f'<robot name="r"><link name="a">{inertia}{parts}</link></robot>')
    root = path.parent.parent
    made = import_model(path, Options(root=root, **options), folder=folder, stem="world")  # type: ignore[arg-type]
    made.write_files(folder)
    return made


@pytest.mark.parametrize(
    "word", ["package://arm_description/meshes/corner.ply", "../meshes/corner.ply", "package://other/meshes/corner.ply"]
)
def test_files_are_found_by_package_and_path(word: str, tmp_path: Path) -> None:
    """Of a package its own folder or, of another name, what lies below the root."""
    made = robot(tmp_path, f'filename="{word}" scale="0.5 0.5 0.5"')
    words = "{file: arm_description/meshes/corner.ply, scale: 0.5, up: z}"
    assert f"collider: {{convex: {words}, layer: robot}}" in made.text
    assert f"visual: {{mesh: {words}}}" in made.text
    assert made.files == {}
    assert [note.what for note in made.report.notes] == ["a mesh to touch as its hull"]


def test_a_mesh_that_stands_still_touches_as_itself(tmp_path: Path) -> None:
    """Where it is closed."""
    made = robot(tmp_path, 'filename="../meshes/corner.ply"', inertia="")
    assert "collider: {mesh: {file: arm_description/meshes/corner.ply, up: z}" in made.text
    assert made.report.exact


@pytest.mark.parametrize(
    ("scale", "options", "turn"),
    [
        ("1 2 -3", {}, [[1, 0, 0], [0, 0, -3], [0, -2, 0]]),
        ("1 1 1", {"up": "x"}, [[0, -1, 0], [1, 0, 0], [0, 0, 1]]),
        ("1 1 1", {"hand": "left", "unit": 0.5}, [[0.5, 0, 0], [0, 0, 0.5], [0, 0.5, 0]]),
    ],
)
def test_what_no_words_turn_is_written_anew(
    scale: str, options: dict[str, object], turn: list[list[float]], tmp_path: Path
) -> None:
    """Stretched, mirrored and turned as the file has it, its faces looking outward."""
    made = robot(tmp_path, f'filename="../meshes/corner.ply" scale="{scale}"', **options)
    pose = load_text(made.text, "world.yaml", tmp_path).simulation["a"].transform
    written = read_scene(tmp_path / "world-parts" / "corner.glb")
    found = pose.position + quaternion.rotate(pose.rotation, np.array(written.vertices))
    wanted = CORNERS @ np.array(turn).T
    assert sorted((np.round(found, 6) + 0.0).tolist()) == sorted((np.round(wanted, 6) + 0.0).tolist())
    assert written.volume == pytest.approx(abs(np.linalg.det(turn)), rel=1e-6)


def test_what_is_missing_or_of_no_known_format_is_dropped(tmp_path: Path) -> None:
    """And told."""
    (tmp_path / "arm_description" / "meshes").mkdir(parents=True)
    (tmp_path / "arm_description" / "meshes" / "arm.dae").write_text("")
    for word, what in (("none.stl", "the file 'none.stl', which is not there"), ("../meshes/arm.dae", ".dae files")):
        made = robot(tmp_path, f'filename="{word}"')
        assert {note.what for note in made.report.notes} == {what}
        assert "collider" not in made.text
