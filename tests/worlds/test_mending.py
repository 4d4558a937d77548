"""`carom check --fix` mends what is no guess, `carom upgrade` goes from version to version; comments stay."""

from __future__ import annotations

from pathlib import Path

import pytest

from carom.tools.cli import main
from carom.worlds.errors import WorldError
from carom.worlds.layout import Collection, Scalar
from carom.worlds.upgrading import upgraded

BROKEN = """carom: 1
# of what
materials:
  stone: {color: gray}  # hard
  # soft
  silk: {color: red}
prefabs: {bale: {body: {}}}
entities:
  - {nmae: ground, collider: {plane: {}}, material: stoen}  # level
  - name: ball
    colider: {sphere: {radius: 0.1 m}}
    transform: {position: [0, 1.50, 0], rotation: {axis: [0, 1, 0], angle: 5 kg}}
"""
MENDED = """carom: 1
# of what
materials:
  stone: {color: gray}  # hard
  # soft
entities:
  - {name: ground, collider: {plane: {}}, material: stone}  # level
  - name: ball
    collider: {sphere: {radius: 0.1 m}}
    transform: {position: [0, 1.50, 0], rotation: {axis: [0, 1, 0], angle: 5 deg}}
"""


def test_what_is_no_guess_is_mended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Words with one near; then, once the file is good, what nobody uses; a wrong unit is left, and told."""
    monkeypatch.chdir(tmp_path)
    path = Path("w.yaml")
    path.write_text(BROKEN)
    assert main(["check", "--fix", "w.yaml"]) == 2
    told = capsys.readouterr()
    assert told.out == (
        "fixed  w.yaml: entities.0.nmae: 'nmae' is now 'name'\n"
        "fixed  w.yaml: entities.1.colider: 'colider' is now 'collider'\n"
        "fixed  w.yaml: entities.0.material: 'stoen' is now 'stone'\n"
    )
    assert told.err.startswith("w.yaml:12:69: entities.1.transform.rotation.angle: must be an angle; received '5 kg'")
    path.write_text(path.read_text().replace("5 kg", "5 deg"))
    assert main(["check", "--fix", "w.yaml"]) == 0
    assert capsys.readouterr().out == (
        "fixed  w.yaml: prefabs.bale: taken out, it was used nowhere\n"
        "fixed  w.yaml: materials.silk: taken out, it was used nowhere\n"
        "ok     w.yaml: 2 entities, 0 expectations\n"
    )
    assert path.read_text() == MENDED
    assert main(["check", "--fix", "billiards"]) == 2
    assert capsys.readouterr().err == "billiards: is no file; --fix writes files, so state one\n"


def test_materials_for_other_files_stay(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file without entities is there to be included."""
    path = tmp_path / "materials.yaml"
    path.write_text("carom: 1\nmaterials: {stone: {color: gray}}\n")
    assert main(["check", "--fix", str(path)]) == 0
    assert path.read_text() == "carom: 1\nmaterials: {stone: {color: gray}}\n"


def _rename(root: Collection) -> None:
    root.entry(("title",)).key = Scalar("name", "name")


def _shout(root: Collection) -> None:
    root.entry(("name",)).node = Scalar("A", "A")


def test_files_go_from_version_to_version() -> None:
    """By each step in turn, from where they are; comments stay, and a file of today stays as it is."""
    steps = {1: _rename, 2: _shout}
    old = "# mine\ncarom: 1  # first\n# called\ntitle: a\n"
    assert upgraded(old, "w.yaml", steps=steps, version=3) == (
        "# mine\ncarom: 3  # first\n# called\nname: A\n",
        1,
    )
    assert upgraded("carom: 2\nname: a\n", "w.yaml", steps=steps, version=3) == ("carom: 3\nname: A\n", 2)
    assert upgraded("carom:   1\n", "w.yaml") == ("carom:   1\n", 1)
    with pytest.raises(WorldError, match="unknown version; received 0; accepted: 1"):
        upgraded("carom: 0\n", "w.yaml")


def test_the_command_tells_the_version(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of the file; one of a later version is left for a later carom."""
    monkeypatch.chdir(tmp_path)
    Path("w.yaml").write_text("carom: 1\n")
    assert main(["upgrade", "w.yaml"]) == 0
    assert capsys.readouterr().out == "w.yaml is of version 1, the current one\n"
    Path("w.yaml").write_text("carom: 2\n")
    assert main(["upgrade", "w.yaml"]) == 2
    assert "install a later carom to read it, this is " in capsys.readouterr().err
