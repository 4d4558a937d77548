"""What fails tells its file, frame and entity, and the one command that opens it there, which is run here as told."""

from __future__ import annotations

import io
import json
import shlex
from pathlib import Path

import pytest

from carom.tools import viewer
from carom.tools.cli import main

WORLD = """carom: 1
name: drop
step: {dt: 1/100}
run: {duration: 0.8 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - name: ball
    collider: {sphere: {radius: 0.1}}
    body: {}
    transform: {position: [0, 5, 0]}
    grid: {count: [2, 1, 1], spacing: 3}
expect:
  - never: ball[*].position.y < 2
  - at: 0
    ball[1,0,0].position.x: {is: 0, within: 1 m}
  - momentum: constant within 1e-6
"""
# Both fall by g t^2 / 2 = 3 m within 0.782 s; the summary begins with where each expectation is written.
FALLS = (
    "failed in frame 79 at 0.79 s: never: ball[*].position.y < 2; expected never ball[*].position.y < 2; received "
    "ball[0,0,0].position.y = 1.9387895 m; worst ball[0,0,0].position.y = 1.8608 m"
)
PROMPT = "print(simulation.frame + 1, stopped.names)\n"


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return the name of a world file in a folder of its own, where the tests are."""
    monkeypatch.chdir(tmp_path)
    Path("drop.yaml").write_text(WORLD)
    return "drop.yaml"


def commands(lines: list[str]) -> list[list[str]]:
    """Return the words of the commands that are told, without that of carom itself."""
    found = [line.partition("open it with: ")[2] for line in lines if line.startswith("    ") and "open it" in line]
    assert all(text.startswith("carom ") for text in found)
    return [shlex.split(text)[1:] for text in found]


def frame_of_prompt(words: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Run a command that opens a prompt; return the frame of the step that it stands before, and of whom that is."""
    monkeypatch.setattr("sys.stdin", io.StringIO(PROMPT))
    assert main(words) == 1
    return capsys.readouterr().out.replace(">>> ", "").split()


@pytest.mark.parametrize("command", ["run", "test"])
def test_an_expectation_that_fails_is_opened_in_its_frame(
    command: str, world: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """At a prompt, with the options of the run; one that fails at the start before the first step."""
    assert main([command, world, "--seed", "3"]) == 1
    told = capsys.readouterr().out.splitlines()
    lines = [line.strip() for line in told]
    assert lines[lines.index(f"drop.yaml:13:5: {FALLS}") + 1 :][:2] == [
        "drop.yaml:7:5: 'ball[0,0,0]'",
        "open it with: carom run drop.yaml --break 'frame 79' --seed 3 --pdb",
    ]
    found = [frame_of_prompt(words, capsys, monkeypatch) for words in commands(told)]
    assert found == [["79", "[]"], ["1", "[]"], ["1", "[]"]]


def test_who_comes_by_an_event_is_written_there(world: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The file and line that bring whom it failed of."""
    spawn = "spawn: {name: late, body: {mass: 1, inertia: [1, 1, 1]}, transform: {position: [9, 1, 0]}}"
    Path("late.yaml").write_text(WORLD.replace("never: ball[*]", "never: late") + f"events: [{{at: 0.1 s, {spawn}}}]\n")
    assert main(["test", "late.yaml"]) == 1
    lines = [line.strip() for line in capsys.readouterr().out.splitlines()]
    assert "late.yaml:17:22: 'late'" in lines


def test_what_is_recorded_is_opened_in_the_recording(
    world: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the entity selected; what is before the frames that it holds is opened at a prompt."""
    monkeypatch.setattr(viewer, "has_display", lambda: True)
    assert main(["run", world, "--record", "rec.rrd", "--record-from", "0.5 s", "--json"]) == 1
    failures = json.loads(capsys.readouterr().out)["failures"]
    assert [(one["file"], one["frame"], one["entities"], one["files"]) for one in failures] == [
        ("drop.yaml:13:5", 79, ["ball[0,0,0]"], ["drop.yaml:7:5"]),
        ("drop.yaml:14:5", 0, ["ball[1,0,0]"], ["drop.yaml:7:5"]),
        ("drop.yaml:16:5", 1, [], []),
    ]
    assert [one["command"] for one in failures] == [
        "carom view rec.rrd --frame 79 --select 'ball[0,0,0]'",
        "carom run drop.yaml --break 'frame 1' --pdb",
        "carom run drop.yaml --break 'frame 1' --pdb",
    ]
    assert main([*shlex.split(failures[0]["command"])[1:], "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {
        "file": "rec.rrd",
        "frame": 79,
        "selected": "/world/sphere/ball[#0]",
    }


def test_whoever_is_not_recorded_is_not_selected(world: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The command would be refused; a break in what is recorded of the other ball alone."""
    words = ["--break", "ball[0,0,0].position.y < 2", "--record", "rec.rrd", "--only", "ball[1,0,0]"]
    assert main(["run", world, *words]) == 1
    assert capsys.readouterr().out.endswith("\nopen it with: carom view rec.rrd --frame 79\n")


def test_a_number_that_is_none_is_opened_before_its_step(
    world: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """By what was told of it, whether anything was stated to break at or not."""
    Path(world).write_text(
        WORLD.replace("body: {}", "body: {mass: 1e-3}") + "forces: [{constant_push: {force: [1e308, 0, 0]}}]\n"
    )
    for command, stream in (("run", "err"), ("test", "out")):
        assert main([command, world]) == 1
        lines = getattr(capsys.readouterr(), stream).splitlines()
        assert lines[-1].strip() == "open it with: carom run drop.yaml --break 'not finite' --pdb"
    monkeypatch.setattr("sys.stdin", io.StringIO("print(stopped.frame - simulation.frame)\n"))
    assert main(shlex.split(lines[-1].partition(": carom ")[2])) == 1
    assert capsys.readouterr().out.replace(">>> ", "") == "1\n"


def test_a_break_at_a_frame_is_one_from_the_first_on(world: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The step to it is looked at before it is taken."""
    assert main(["run", world, "--break", "frame 7"]) == 1
    told = "frame 7 at 0.07 s: frame 7: is reached; the world stands at frame 6, before that step\n"
    assert capsys.readouterr().out == told + "open it with: carom run drop.yaml --break 'frame 7' --pdb\n"
    assert main(["run", world, "--break", "frame 0"]) == 2
    told = "--break: is before the first step; received 'frame 0'; accepted: a frame from 1 on\n"
    assert capsys.readouterr().err == told
