"""Decomposition: parts are written, known the second time, and make a body that loads."""

from __future__ import annotations

import builtins
import json
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import trimesh

from carom.tools import decomposition
from carom.tools.cli import main
from carom.worlds import load_text


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the file of an L of two boxes in mm, z up, in an otherwise empty folder, with a cache of its own."""
    profile = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]])
    mesh = prism(profile[:, [0, 1]] * 1000.0, 1000.0)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    mesh.export("bench 2.ply")
    return Path("bench 2.ply")


def prism(profile: Any, height: float) -> trimesh.Trimesh:
    """Return a profile (n, 2), star-shaped about its second to last inner corner, raised along z."""
    count = len(profile)
    low, high = np.column_stack([profile, np.zeros(count)]), np.column_stack([profile, np.full(count, height)])
    here, then = np.arange(count), (np.arange(count) + 1) % count
    sides = [*zip(here, then, then + count, strict=True), *zip(here, then + count, here + count, strict=True)]
    caps = [(3, k, (k + 1) % count) for k in range(count) if 3 not in (k, (k + 1) % count)]
    faces = [*sides, *((a, c, b) for a, b, c in caps), *((a + count, b + count, c + count) for a, b, c in caps)]
    return trimesh.Trimesh(np.concatenate([low, high]), faces, process=False)


class Knife:
    """Stands for coacd: cuts the L into its two boxes, and counts how often it is asked."""

    def __init__(self) -> None:
        self.asked: list[dict[str, Any]] = []
        self.Mesh = lambda vertices, faces: SimpleNamespace(vertices=vertices, faces=faces)

    def set_log_level(self, level: str) -> None:
        """Be quiet."""

    def run_coacd(self, mesh: Any, **options: Any) -> list[Any]:
        """Return a box of 3 x 1 x 1 and one of 1 x 1 x 1 m, in the axes of carom."""
        self.asked.append(options)
        assert np.ptp(mesh.vertices, axis=0) == pytest.approx([3.0, 1.0, 2.0])
        boxes = []
        for size, center in (((3, 1, 1), (1.5, 0.5, -0.5)), ((1, 1, 1), (0.5, 0.5, -1.5))):
            box = trimesh.creation.box(extents=size)
            boxes.append([box.vertices + np.array(center), box.faces])
        return boxes


@pytest.fixture
def knife(monkeypatch: pytest.MonkeyPatch) -> Knife:
    """Put a stand-in in the place of coacd."""
    made = Knife()
    monkeypatch.setitem(sys.modules, "coacd", made)
    monkeypatch.setattr(decomposition, "version", lambda name: "1.0")
    return made


def test_parts_are_written_once_and_make_a_body(bench: Path, knife: Knife, capsys: pytest.CaptureFixture[str]) -> None:
    """What is printed goes into a world file as it is; the second time nothing is cut."""
    command = ["decompose", str(bench), "-o", "out/parts", "--unit", "mm", "--up", "z", "--parts", "4"]
    assert main(command) == 0
    head, _, world = capsys.readouterr().out.partition("\n")
    assert head.startswith("# 2 convex parts of bench 2.ply, ")
    assert (
        world
        == """entities:
  - {name: bench-2, body: {}, visual: {mesh: {file: bench 2.ply, unit: mm, up: z}}}
  - {name: bench-2-0, parent: {entity: bench-2}, collider: {convex: {file: out/parts/bench-2-0.ply}}, visual: false}
  - {name: bench-2-1, parent: {entity: bench-2}, collider: {convex: {file: out/parts/bench-2-1.ply}}, visual: false}
"""
    )
    body = load_text("carom: 1\n" + world).simulation["bench-2"].rigid_body
    assert body.mass == pytest.approx(4000.0)
    assert body.center_of_mass == pytest.approx([1.25, 0.5, -0.75])
    assert main([*command, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["known"], told["parts"]) == (True, ["out/parts/bench-2-0.ply", "out/parts/bench-2-1.ply"])
    assert knife.asked == [{"threshold": 0.05, "max_convex_hull": 4, "seed": 0}]
    assert main([*command, "--concavity", "0.2"]) == 0
    assert knife.asked[1] == {"threshold": 0.2, "max_convex_hull": 4, "seed": 0}


def test_without_coacd_the_message_says_what_to_install(
    bench: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is an extra, since only authors need it."""
    found = builtins.__import__

    def absent(name: str, *rest: Any) -> Any:
        if name == "coacd":
            raise ImportError(name)
        return found(name, *rest)

    monkeypatch.setattr(builtins, "__import__", absent)
    assert main(["decompose", str(bench), "-o", "out"]) == 2
    assert capsys.readouterr().err == "decompose needs coacd, which is not installed: pip install 'carom[authoring]'\n"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--parts", "0"], "argument --parts: must be a whole number from 1 on, received '0'"),
        (["--concavity", "nan"], "argument --concavity: must be a number from 0.01 to 1, received 'nan'"),
        (["--up", "x"], "argument --up: invalid choice: 'x' (choose from 'y', 'z')"),
    ],
)
def test_wrong_options(bench: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit status 2, what was received and what is accepted."""
    with pytest.raises(SystemExit) as ended:
        main(["decompose", str(bench), "-o", "out", *words])
    assert ended.value.code == 2
    assert capsys.readouterr().err.splitlines()[-1] == f"carom decompose: error: {message}"


def test_a_wrong_unit_and_a_file_that_is_not_there(bench: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As any other reader of models says it."""
    assert main(["decompose", str(bench), "-o", "out", "--unit", "feet"]) == 2
    accepted = "m, cm, mm, km, in, ft"
    assert capsys.readouterr().err == f"mesh file bench 2.ply: unit must be one of {accepted}, received 'feet'\n"
    assert main(["decompose", "none.obj", "-o", "out"]) == 2
    assert capsys.readouterr().err == "mesh file none.obj does not exist\n"


def test_coacd_itself(bench: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An L is two boxes, and its parts fill what it fills."""
    pytest.importorskip("coacd")
    assert main(["decompose", str(bench), "-o", "out", "--unit", "mm", "--up", "z"]) == 0
    world = capsys.readouterr().out
    body = load_text("carom: 1\n" + world).simulation["bench-2"].rigid_body
    assert body.mass == pytest.approx(4000.0, rel=0.02)
