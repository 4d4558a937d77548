"""Files that cannot be read or used, by themselves or beside a world, are told in whole sentences."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import json
from pathlib import Path

import pytest
import trimesh
from refusals import LENGTH, messages

import carom
from carom.tools.cli import main
from carom.worlds import WorldError, load_text, load_world
from carom.worlds.library import names

LATER = f"install a later carom to read it, this is {carom.__version__}"


def test_meshes_that_cannot_be_used(tmp_path: Path) -> None:
    """A mesh must be there, closed and turned outward; a hull takes open ones."""
    box = trimesh.creation.box()
    box.export(tmp_path / "closed.obj")
    trimesh.Trimesh(box.vertices, box.faces[:-1], process=False).export(tmp_path / "open.obj")
    trimesh.Trimesh(box.vertices, box.faces[:, ::-1], process=False).export(tmp_path / "inverted.obj")
    names = ("missing", "open", "inverted", "closed")
    text = "entities:\n" + "".join(
        f"  - {{name: {name}, collider: {{mesh: {{file: {name}.obj}}}}}}\n" for name in names
    )
    assert messages(text, tmp_path) == [
        f"w.yaml:3:39: entities.0.collider.mesh.file: mesh file {tmp_path}/missing.obj does not exist",
        (
            f"w.yaml:4:36: entities.1.collider.mesh.file: mesh file {tmp_path}/open.obj is open: "
            "3 edges do not join two faces; close its holes, or use convex"
        ),
        (
            f"w.yaml:5:40: entities.2.collider.mesh.file: mesh file {tmp_path}/inverted.obj is inverted: "
            "its volume is -1 m3; turn its faces outward"
        ),
    ]
    load_text("carom: 1\nentities: [{body: {}, collider: {convex: {file: open.obj}}}]\n", "w.yaml", tmp_path)


#: A ship whose bow lies 2 million km off.
FAR_BOW = [[x, y, z] for x in (-4, 4) for y in (0, 1.6) for z in (-1.5, 1.5)] + [[7, 2**31, 0], [7, 1.6, 0]]


def test_shapes_from_files_and_images(tmp_path: Path) -> None:
    """Whatever is wrong with the words of a mesh, hull or height field, or with what they name, is told where it stands."""
    (tmp_path / "words.png").write_text("hello")
    lines = {
        "mesh: {file: a.step}": (
            f".mesh.file: mesh file {tmp_path}/a.step is of an unknown format '.step'; "
            "write OBJ, STL, PLY or glTF (.obj, .stl, .ply, .glb, .gltf)"
        ),
        "mesh: {file: a.obj, unit: feet, up: x}": [
            ".mesh.unit: unknown word; received 'feet'; accepted: m, cm, mm, km, in, ft",
            ".mesh.up: unknown word; received 'x'; accepted: y, z",
        ],
        "convex: {}": ".convex: must state one source; received none; accepted: points or file",
        "convex: {points: [[0, 0, 0], [1, 0, 0], [0, 1]]}": (
            ".convex.points.2: must be a list of 3 numbers; received [0, 1]; accepted: numbers in m"
        ),
        f"convex: {{points: {FAR_BOW}}}": (
            ".convex.points: rounding leaves the faces of the hull in doubt, of 10 corners over 2.15e+09 m, the nearest 1.6 m apart; leave out those that nearly coincide, or that lie far off"
        ),
        "height_field: {heights: [[0, 1], [0]], spacing: 1}": (
            ".height_field.heights: must be rows of as many numbers each, received rows of 1, 2"
        ),
        "height_field: {heights: [[0, 1], [0, .nan]], spacing: 0}": [
            f".height_field.heights.1.1: must be finite; received nan; accepted: {LENGTH}",
            ".height_field.spacing: must be above 0 m; received 0",
        ],
        "height_field: {image: words.png, heights: [[0]], spacing: 1}": (
            ".height_field: must state one source; received heights and image; accepted: heights, image or noise"
        ),
        "height_field: {noise: {count: [9, 9], wavelength: 2, octave: 2}, spacing: 1}": (
            ".height_field.noise.octave: unknown key; received 'octave'; accepted: count, wavelength, octaves, roughness, seed; did you mean 'octaves'?"
        ),
        "height_field: {noise: {count: [9, 9], wavelength: 2 m, octaves: 2}, spacing: 1}": (
            ".height_field.noise: octave 2 has a wavelength of 1 m, which places 1 m apart cannot show; take fewer octaves, a longer wavelength, or a spacing of at most 0.5 m"
        ),
        "height_field: {image: words.png, spacing: [1, 2]}": (
            f".height_field.image: image file {tmp_path}/words.png cannot be read: "
            f"cannot identify image file '{tmp_path}/words.png'"
        ),
        "cone: {radius: 1}": ".cone.length: is missing; accepted: height from base to apex (m)",
        "ellipsoid: {radii: [1, 2]}": ".ellipsoid.radii: must be a list of 3 numbers; received [1, 2]; accepted: numbers in m",
        "ellipsoid: {radii: [1, 2, -3 cm]}": ".ellipsoid.radii.2: must be above 0 m; received '-3 cm'",
    }
    text = "entities:\n" + "".join(f"  - {{collider: {{{words}}}}}\n" for words in lines)
    found = [line.partition(": entities.")[2] for line in messages(text, tmp_path)]
    wanted = [
        f"{index}.collider{line}"
        for index, told in enumerate(lines.values())
        for line in ([told] if isinstance(told, str) else told)
    ]
    assert found == wanted


def test_what_a_file_can_do_without_is_told_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Triangles without area are left out, and both commands say so where the file is named."""
    box = trimesh.creation.box()
    trimesh.Trimesh(box.vertices, [*box.faces.tolist(), [0, 1, 1]], process=False).export(tmp_path / "box.ply")
    world = tmp_path / "w.yaml"
    world.write_text("carom: 1\nentities:\n  - {name: a, collider: {mesh: {file: box.ply, unit: cm, up: z}}}\n")
    note = f"mesh file {tmp_path}/box.ply: 1 of 13 triangles has no area and is left out"
    line = f"{world}:3:33: entities.0.collider.mesh.file: {note}"
    assert load_world(world).warnings == [line]
    for command in (["check", str(world)], ["run", str(world), "--frames", "1"]):
        assert main(command) == 0
        assert capsys.readouterr().err == f"warning: {line}\n"
    assert main(["check", str(world), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)[0]["warnings"] == [line]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "w.yaml:1:1: is no world; received nothing; accepted: 'carom: 1' as its first line"),
        ("- 1\n", "w.yaml:1:1: is no world; received [1]; accepted: 'carom: 1' as its first line"),
        ("name: x\n", "w.yaml:1:1: carom: is missing; accepted: 'carom: 1' as its first line"),
        ("carom: 2\n", "w.yaml:1:1: carom: unknown version; received 2; accepted: 1; " + LATER),
        ("carom: true\n", "w.yaml:1:1: carom: unknown version; received true; accepted: 1"),
    ],
)
def test_other_files_are_refused_at_once(text: str, message: str) -> None:
    """Without the header of this version nothing else counts."""
    with pytest.raises(WorldError) as caught:
        load_text(text, "w.yaml")
    assert str(caught.value) == message


def test_files_that_are_not_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A path that leads nowhere and a name that nothing bears are told apart."""

    def refusal(world: str | Path) -> str:
        with pytest.raises(WorldError) as caught:
            load_world(world)
        return str(caught.value)

    accepted = "a world file, or the name of a library world"
    assert refusal("nowhere.yaml") == f"nowhere.yaml: does not exist; accepted: {accepted}"
    assert refusal(tmp_path) == f"{tmp_path}: is a folder; accepted: {accepted}"
    assert refusal("mirror_rom") == (
        f"mirror_rom: no world of this name; accepted: {', '.join(names())}; did you mean 'mirror_room'?"
    )
    (tmp_path / "latin.yaml").write_bytes(b"carom: 1\nname: caf\xe9\n")
    monkeypatch.chdir(tmp_path)
    assert refusal("lattin.yaml") == (f"lattin.yaml: does not exist; accepted: {accepted}; did you mean 'latin.yaml'?")
    assert refusal("latin") == (
        f"latin: no world of this name; accepted: {', '.join(names())}; did you mean 'latin.yaml'?"
    )
    assert refusal(tmp_path / "latin.yaml") == f"{tmp_path}/latin.yaml: is not text in UTF-8: byte 18 is 0xe9"
