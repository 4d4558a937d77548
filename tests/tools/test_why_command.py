"""``carom why`` answers of a recording or a world what moved a body, why it is awake, why two do not touch."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from carom.ecs import Motion
from carom.systems.observer import observed
from carom.tools.cli import main
from carom.tools.recorder import Recorder
from carom.worlds import load_text

ROW = """
carom: 1
name: row
gravity: [0, -10, 0]
step: {dt: 1/100}
run: {duration: 1.2 s}
prefabs:
  ball: {collider: {sphere: {radius: 0.5}}, body: {mass: 1}, material: {restitution: 1, friction: 0}}
entities:
  - {name: floor, collider: {plane: {}}, material: {friction: 0}}
  - {name: first, prefab: ball, transform: {position: [-2.01, 0.5, 0]}, motion: {linear: [2, 0, 0]}}
  - {name: second, prefab: ball, transform: {position: [0, 0.5, 0]}}
  - {name: third, prefab: ball, transform: {position: [1.525, 0.5, 0]}}
"""


@pytest.fixture
def row(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return a world of three balls in a row: the first strikes the second at 0.505 s, that the third at 0.7675 s."""
    monkeypatch.chdir(tmp_path)
    Path("row.yaml").write_text(ROW)
    return "row.yaml"


def test_a_ball_was_moved_by_whom_that_was_moved(row: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a world, and with the same words of its recording; balls of one mass hand on 2 m/s, 2 N s."""
    told = """\
'third' in frame 77: from [+0, +0, +0] to [+2, +0, +0] m/s
  source   from    change in m/s   N s
  impact   second  [+2, +0, +0]    2
  gravity          [+0, -0.1, +0]  0.1
  contact  floor   [+0, +0.1, +0]  0.1
  in all           [+2, +0, +0]
back to where it began:
  frame 77: 'third' was at rest until 'second' struck it at 0.7675 s, by 2 N s
  frame 51: 'second' was at rest until 'first' struck it at 0.505 s, by 2 N s
  frame 0: 'first' moves since then, at 2 m/s
"""
    assert main(["why", row, "--moved", "third", "--frame", "77"]) == 0
    assert capsys.readouterr().out == told
    assert main(["run", row, "--record", "row.rrd"]) == 0
    capsys.readouterr()
    assert main(["why", "row.rrd", "--moved", "third", "--frame", "77"]) == 0
    assert capsys.readouterr().out == told
    assert main(["why", "row.rrd", "--moved", "third", "--frame", "77", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["entity"], found["frame"], found["causes"][0]["from"]) == ("third", 77, "second")
    assert found["causes"][0]["change"] == pytest.approx([2.0, 0.0, 0.0])
    assert [(link["frame"], link["by"]) for link in found["chain"]] == [(77, "second"), (51, "first"), (0, "")]


def test_what_code_outside_set_going_is_told(row: str, capsys: pytest.CaptureFixture[str]) -> None:
    """It is done again; the chain ends where it was done."""
    loaded = load_text(ROW.replace("[2, 0, 0]", "[0, 0, 0]"))
    simulation, recorder = loaded.simulation, Recorder("pushed.rrd", source=loaded.source_text)
    with observed(simulation, recorder):
        simulation.step(20)
        with simulation.world.edit(Motion) as motion:
            motion.linear[simulation.world.row(simulation.world.find("second")), 0] = 2.0
        simulation.step(40)
    assert main(["why", "pushed.rrd", "--moved", "third"]) == 0
    assert capsys.readouterr().out.splitlines()[-2:] == [
        "  frame 47: 'third' was at rest until 'second' struck it at 0.4625 s, by 2 N s",
        "  frame 21: 'second' was at rest until code outside the step set it going",
    ]


def test_a_fall_began_with_gravity(row: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Also of a body that fell from rest."""
    Path(row).write_text(ROW.replace("[1.525, 0.5, 0]", "[1.525, 9, 0]"))
    assert main(["why", row, "--moved", "third", "--frame", "30"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "  frame 1: 'third' was at rest until gravity set it going"


def test_what_moves_by_itself_was_moved_by_nobody(row: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A ball that strikes a paddle at the very beginning of its way does not set it going."""
    assert main(["why", "pong", "--moved", "right", "--frame", "60"]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert last == "  frame 23: 'right' was at rest until follow_keyframes set it going"


def test_who_is_awake_and_who_does_not_touch(row: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The words are those of `why_awake` and `why_no_contact`, in the frame asked for."""
    assert main(["why", row, "--awake", "first", "--frame", "10"]) == 0
    told = "frame 10: 'first' is awake since it moves at 2 m/s; at 0.03 m/s or less it may fall asleep\n"
    assert capsys.readouterr().out == told
    assert main(["why", row, "--no-contact", "first", "third", "--frame", "10", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["frame"] == 10
    assert "apart" in found["answer"]


WRONG = {
    "--moved third --frame 0": "--frame: nothing led to frame 0; accepted: 1 to 120",
    "--moved third --frame 200": "row.yaml does not have frame 199, but frames 0 to 120",
    "--moved floor --frame 10": "'floor' has no body; it stands\n",
    "--awake thrid": "no entity is named 'thrid'; did you mean 'third'?",
}


@pytest.mark.parametrize("words", WRONG)
def test_wrong_questions_are_told(words: str, row: str, capsys: pytest.CaptureFixture[str]) -> None:
    """With what is accepted, and exit status 2."""
    assert main(["why", row, *words.split()]) == 2
    assert capsys.readouterr().err.startswith(WRONG[words])
