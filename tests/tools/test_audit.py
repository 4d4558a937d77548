"""Auditing: FCL measures what kernels answered, and a stand-in that is wrong is found out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carom.systems.detection import narrow
from carom.tools.cli import main

WORLD = """carom: 1
name: Three
gravity: [0, 0, 0]
step: {dt: 1/60}
run: {duration: 1 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: left, transform: {position: [0, 0.499, 0]}, collider: {sphere: {radius: 0.5}}, body: {}}
  - {name: right, transform: {position: [0.999, 0.499, 0]}, collider: {sphere: {radius: 0.5}}, body: {}}
"""
AUDIT = (
    "  audit         kernels against FCL at the deepest point of each contact, "
    "limits 0.5 degrees and 3e-06 of the smaller size"
)


def wrong(monkeypatch: pytest.MonkeyPatch, deeper: float, tilt: float) -> None:
    """Let the kernel of balls answer too deep and with a tilted normal."""
    right = narrow.FUNCTIONS[0]

    def measure(*arguments: Any) -> None:
        right(*arguments)
        start, count, _, normal, depth, _ = arguments[-6:]
        for first in start[count > 0]:  # a pair of which one is a ball has one point
            depth[first] += deeper
            normal[first] = np.cos(tilt) * normal[first] + np.sin(tilt) * np.array([0.0, 0.0, 1.0])

    monkeypatch.setattr(narrow, "FUNCTIONS", [measure, *narrow.FUNCTIONS[1:]])


def audited(world: Path, capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, list[str]]:
    """Return exit status and the lines of the audit after one step."""
    status = main(["run", str(world), "--frames", "1", "--audit", *words])
    lines = capsys.readouterr().out.splitlines()
    return status, lines[lines.index(AUDIT) :]


def test_kernels_that_agree_make_exit_0(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whole output; what the audit asks FCL does not count as answered by FCL."""
    assert main(["run", str(world), "--frames", "1", "--audit"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "  pairs         0 answered by FCL, 3 by kernels" in lines
    lines = lines[lines.index(AUDIT) + 1 :]
    assert [line.split(":")[0] for line in lines] == ["    plane, sphere     agree", "    sphere, sphere    agree"]
    assert [line.split(": ")[1].split(",")[0] for line in lines] == ["2 compared", "1 compared"]


@pytest.mark.parametrize("collision", ["auto", "fcl"])
def test_a_wrong_depth_is_reported_with_exit_1(
    collision: str, world: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """By pair of shapes, with frame, names and both answers, the worst first; also where FCL answered in the run."""
    wrong(monkeypatch, -1e-4, 0.0)
    status, lines = audited(world, capsys, "--collision", collision)
    assert status == 1
    assert lines == [
        AUDIT,
        "    plane, sphere     2 DISAGREE: 2 compared, at worst 0 degrees and 0.0001 m",
        "      frame 1, 'floor' and 'left': depth 0.0009 m by the kernel, 0.001 m by FCL; normals 0 degrees apart",
        "      frame 1, 'floor' and 'right': depth 0.0009 m by the kernel, 0.001 m by FCL; normals 0 degrees apart",
        "    sphere, sphere    1 DISAGREE: 1 compared, at worst 0 degrees and 0.0001 m",
        "      frame 1, 'left' and 'right': depth 0.0009 m by the kernel, 0.001 m by FCL; normals 0 degrees apart",
    ]


def test_a_wrong_normal_is_reported_as_json(
    world: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A degree off, with the right depth: no tie, for along that direction the balls overlap by less."""
    wrong(monkeypatch, 0.0, float(np.deg2rad(1.0)))
    assert main(["run", str(world), "--frames", "1", "--audit", "--json"]) == 1
    rows = json.loads(capsys.readouterr().out)["audit"]
    assert [row["shapes"] for row in rows] == [["plane", "sphere"], ["sphere", "sphere"]]
    balls = rows[1]
    assert {key: balls[key] for key in ("pairs", "ties", "beyond")} == {
        "pairs": 1, "ties": 0, "beyond": 1,
    }  # fmt: skip
    assert balls["worst_degrees"] == pytest.approx(1.0, abs=1e-6)
    (listed,) = balls["listed"]
    assert (listed["frame"], listed["a"], listed["b"]) == (1, "left", "right")
    assert listed["degrees"] == pytest.approx(1.0, abs=1e-6)
    assert listed["excess"] == pytest.approx(2.0, abs=1e-6)


def test_a_contact_only_one_way_sees_is_a_disagreement(
    world: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Here the kernel sees none in the audit of a run by FCL."""
    monkeypatch.setattr(narrow, "FUNCTIONS", [lambda *arguments: None, *narrow.FUNCTIONS[1:]])
    status, lines = audited(world, capsys, "--collision", "fcl")
    assert status == 1
    assert (
        "      frame 1, 'left' and 'right': depth none by the kernel, 0.001 m by FCL; normals 0 degrees apart" in lines
    )


def test_two_directions_that_part_equally_well_are_both_right(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two boxes corner over corner overlap by 1 cm along two axes; nothing to audit is said as well."""
    box = "collider: {box: {size: [1, 1, 1]}}, body: {}"
    path = tmp_path / "ties.yaml"
    path.write_text(
        "carom: 1\nname: Ties\ngravity: [0, 0, 0]\nrun: {duration: 1 s}\nentities:\n"
        f"  - {{name: a, {box}}}\n  - {{name: b, transform: {{position: [0.99, 0.99, 0.2]}}, {box}}}\n"
    )
    status, lines = audited(path, capsys)
    assert status == 0
    assert lines[1].startswith("    box, box          agree: 1 compared, ")
    path.write_text(path.read_text().replace("0.99, 0.99", "9, 9"))
    assert main(["run", str(path), "--frames", "1", "--audit"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "  audit         no contact that a kernel answers"
