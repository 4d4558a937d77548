"""``carom import`` writes a world that loads, with a report for people and for programs, and exit codes for scripts."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from carom.tools.cli import main
from carom.worlds import load_world

ARM = """<robot name="arm">
  <link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="arm">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><sphere radius="0.1"/></geometry></visual>
  </link>
  <joint name="j" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="{effort}" velocity="0"/>
  </joint>
</robot>"""


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the file of an arm of which nothing is lost, in an otherwise empty folder."""
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(ARM.format(effort=0))
    return Path("arm.urdf")


def test_a_world_is_written_and_told_of(arm: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It loads as it lies, and --strict is content where everything was kept."""
    assert main(["import", "arm.urdf", "-o", "out/arm.yaml", "--strict"]) == 0
    assert capsys.readouterr().out == (
        "kept          1 joint, 2 links, 1 collider, 1 body, 1 visual\nwritten to    out/arm.yaml\n"
    )
    assert load_world("out/arm.yaml").simulation["j"].joint.upper[3] == 1.0


def test_strict_tells_of_what_was_not_kept(arm: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """1 where anything was dropped, the world being written all the same, named after the model."""
    arm.write_text(ARM.format(effort=5))
    assert main(["import", "arm.urdf", "--strict", "--json"]) == 1
    assert json.loads(capsys.readouterr().out) == {
        "world": "arm.yaml",
        "files": [],
        "kept": {"joint": 1, "link": 2, "collider": 1, "body": 1, "visual": 1},
        "approximated": [],
        "dropped": [
            {"what": "limits of effort, for who drives the joint", "whose": "j", "file": "arm.urdf", "line": 9}
        ],
    }
    assert load_world("arm.yaml").simulation["arm"].rigid_body.mass == 1.0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["none.urdf"], "none.urdf: does not exist"),
        (["arm.urdf", "--root", "no"], "--root: is no folder; received 'no'"),
        (["arm.urdf", "--units", "0"], "--units: must be above 0 m; received '0'"),
    ],
)
def test_bad_input_is_told_and_writes_nothing(
    arm: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit status 2."""
    assert main(["import", *words]) == 2
    assert capsys.readouterr().err == f"{message}\n"
    assert [path.name for path in Path().iterdir()] == ["arm.urdf"]
