"""The command line: exit statuses, whole messages, and outputs that are there or not written at all."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from carom.tools.cli import COMMANDS, main
from carom.tools.recording import Recording

CAROM = [sys.executable, "-m", "carom.tools.cli"]

FALLING = """carom: 1
name: Falling
step: {dt: 1/60}
run: {duration: 0.5 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: ball, transform: {position: [0, 1, 0]}, collider: {sphere: {radius: 0.1}}, body: {}}
cameras: {main: {position: [0, 1, 3]}, top: {position: [0, 3, 0.1]}}
render: {width: 64, height: 48}
expect:
  - at: 0.2 s
    ball.position.y: {is: 0.8038, within: 1 mm}
"""


@pytest.fixture
def world(tmp_path: Path) -> Path:
    """Return the file of a small world."""
    path = tmp_path / "falling.yaml"
    path.write_text(FALLING)
    return path


def changed(world: Path, before: str, after: str) -> str:
    """Return the path of the world with one thing changed."""
    text = world.read_text()
    assert before in text
    world.write_text(text.replace(before, after))
    return str(world)


def files(folder: Path) -> list[str]:
    """Return everything in a folder."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_run_writes_recording_film_and_picture_and_tells_how_to_open_them(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Folders are made with their parents; the summary is the same ten lines every time."""
    out = tmp_path / "deep" / "out"
    outputs = ["--record", f"{out}/a.rrd", "--film", f"{out}/a.mp4", "--picture", f"{out}/a.png"]
    assert main(["run", str(world), *outputs]) == 0
    printed = capsys.readouterr()
    lines = printed.out.splitlines()
    assert printed.err == ""  # no progress bar where there is no terminal
    assert lines[0] == "Falling: 30 frames, 1 bodies"
    assert lines[1].startswith("  time          0.50 s simulated in ")
    assert lines[2].startswith("  energy        ")
    assert lines[3].startswith("  overlap       ")
    assert lines[4].startswith("  pairs         ")
    assert lines[5] == "  expectations  1 of 1 held"
    assert lines[-4:] == [
        f"  recording     {out}/a.rrd",
        f"  film          {out}/a.mp4",
        f"  picture       {out}/a.png",
        f"open it with: carom view {out}/a.rrd",
    ]
    assert files(out) == ["a.mp4", "a.png", "a.rrd"]
    assert len(Recording(out / "a.rrd").frames) == 31


def test_run_as_json(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """For programs; and --collision fcl leaves no pair to kernels."""
    assert main(["run", str(world), "--json", "--collision", "fcl"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert summary["frames"] == 30
    assert summary["expectations"] == 1
    assert summary["pairs_by_kernels"] == 0


def test_an_expectation_that_fails_makes_exit_1(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By run as by test, with when and by how much it failed."""
    assert main(["run", changed(world, "0.8038", "0.9")]) == 1
    assert "  expectations  0 of 1 held" in capsys.readouterr().out.splitlines()
    assert main(["test", str(world)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"FAILED {world}: 0 of 1 expectations held"
    assert lines[1].startswith("       failed in frame 12 at 0.2 s: ")


def test_a_run_cut_short_is_not_judged(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a world expects holds for whole runs."""
    assert main(["run", str(world), "--frames", "5"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "Falling: 5 frames, 1 bodies"
    assert lines[5] == "  expectations  not asked of a run that is cut short"


def test_test_holds_worlds(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Files and library worlds alike; no world at all is wrong usage."""
    assert main(["test", str(world), "falling_ball"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"ok     {world}: 1 of 1 expectations held"
    assert main(["test"]) == 2
    message = "no world to test; accepted: world files, names of library worlds, or --all\n"
    assert capsys.readouterr().err == message


def test_check_tells_every_fault_of_every_world(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A bad world does not hide the next one."""
    assert main(["check", str(world)]) == 0
    assert capsys.readouterr().out == f"ok     {world}: 2 entities, 1 expectations\n"
    changed(world, "radius: 0.1", "radius: 0")
    assert main(["check", changed(world, "body: {}", "bodi: {}"), "falling_ball"]) == 2
    printed = capsys.readouterr()
    assert len(printed.err.splitlines()) == 2
    assert all(line.startswith(f"{world}:7:") for line in printed.err.splitlines())
    assert printed.out.startswith("ok     falling_ball: ")


@pytest.mark.parametrize("words", [["run"], ["test"], ["render", "--out", "{out}/a.png"]])
def test_a_bad_world_ends_with_2_and_writes_nothing(
    words: list[str], world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Not even the folder of the output."""
    out = tmp_path / "out"
    stated = [word.format(out=out) for word in words]
    records = ["--record", f"{out}/a.rrd"] if words[0] == "run" else []
    assert main([*stated, changed(world, "body: {}", "body: {mass: -1 kg}"), *records]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"{world}:7:")
    assert files(tmp_path) == ["falling.yaml"]


def test_an_output_that_cannot_be_written_ends_with_2_before_anything_runs(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every bad output is named, and not even the good one's folder is made."""
    (tmp_path / "file").write_text("")
    record, film = tmp_path / "file" / "out" / "a.rrd", tmp_path / "good" / "a.mp4"
    assert main(["run", str(world), "--record", str(record), "--film", str(film), "--picture", str(tmp_path)]) == 2
    assert capsys.readouterr().err == (
        f"cannot write {record}: {tmp_path / 'file'}: Not a directory; choose a folder that can be written\n"
        f"cannot write {tmp_path}: it is a folder; name a file in it\n"
    )
    assert files(tmp_path) == ["falling.yaml", "file"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["run", "--dt", "0"], "--dt: must be above 0 s; received '0'"),
        (["run", "--camera", "tpo"], "{world}: no camera is named 'tpo'; accepted: main, top; did you mean 'top'?"),
        (["render", "--out", "a.png", "--at", "-1 s"], "--at: must be at least 0 s; received '-1 s'"),
    ],
)
def test_wrong_options_end_with_2_and_say_what_is_accepted(
    words: list[str], message: str, world: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Options are read like the values of a file."""
    assert main([words[0], str(world), *words[1:]]) == 2
    assert capsys.readouterr().err == message.format(world=world) + "\n"


def test_wrong_usage_ends_with_2(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By argparse, which leaves through SystemExit."""
    with pytest.raises(SystemExit, match="2"):
        main(["run", str(world), "--frames", "-3"])
    assert capsys.readouterr().err.splitlines()[-1] == (
        "carom run: error: argument --frames: must be a whole number from 0 on, received '-3'"
    )
    with pytest.raises(SystemExit, match="2"):
        main(["rnu"])


def test_view_tells_how_to_get_a_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The message holds a command to paste."""
    path = tmp_path / "none.rrd"
    assert main(["view", str(path)]) == 2
    message = f"no recording at {path}; make one with: carom run billiards --record {path}\n"
    assert capsys.readouterr().err == message


def test_view_needs_a_display_or_a_browser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """On a server the browser is the way."""
    path = tmp_path / "a.rrd"
    path.write_bytes(b"")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    assert main(["view", str(path)]) == 2
    assert capsys.readouterr().err == f"no display to open a window on; serve it instead: carom view --web {path}\n"
    assert main(["view", "--web", "--json", str(path)]) == 0
    assert json.loads(capsys.readouterr().out)["command"][1:] == [str(path), "--serve-web", "--bind", "127.0.0.1"]


def test_render_photographs_a_moment(world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With any camera of the world."""
    picture = tmp_path / "out" / "a.png"
    assert main(["render", str(world), "--at", "0.1 s", "--camera", "top", "--out", str(picture)]) == 0
    assert capsys.readouterr().out == f"{picture}: frame 6, 0.1 s\n"
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_explain_schema_and_worlds_print(capsys: pytest.CaptureFixture[str]) -> None:
    """The commands that only tell."""
    assert main(["explain"]) == 0
    assert capsys.readouterr().out.startswith("phase")
    assert main(["explain", "--json"]) == 0
    assert {"phase", "system", "reads", "writes", "adds"} < json.loads(capsys.readouterr().out)[0].keys()
    assert main(["schema"]) == 0
    assert "properties" in json.loads(capsys.readouterr().out)
    assert main(["worlds"]) == 0
    assert any(line.startswith("billiards ") for line in capsys.readouterr().out.splitlines())


def test_help_names_every_command_and_imports_nothing_of_weight() -> None:
    """So that it comes at once."""
    code = (
        "import sys\nfrom carom.tools.cli import main\n"
        "try:\n    main(['--help'])\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'numba', 'rerun', 'pyrender', 'fcl', 'pydantic', 'yaml', 'trimesh', 'scipy'}\n"
        "assert not heavy & set(sys.modules), heavy & set(sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    for name in COMMANDS:
        assert f"    {name}" in [line[: 4 + len(name)] for line in done.stdout.splitlines()]


def test_ctrl_c_ends_cleanly_with_the_recording_flushed(world: Path, tmp_path: Path) -> None:
    """Between two steps: the last recorded frame is the last frame."""
    record = tmp_path / "a.rrd"
    long = changed(world, "duration: 0.5 s", "duration: 1000 s")
    words = [*CAROM, "run", long, "--record", str(record)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        while not record.exists() or record.stat().st_size < 20_000:
            time.sleep(0.05)
            assert process.poll() is None
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    frames = Recording(record).frames
    assert process.returncode == 130
    assert out == ""
    assert err == f"interrupted in frame {frames[-1]}; the recording up to there: carom view {record}\n"


def test_a_number_that_runs_away_stops_the_run_with_1_and_keeps_the_recording(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The message names frame, column, entity and system."""
    record = tmp_path / "a.rrd"
    changed(world, "duration: 0.5 s", "duration: 3 s")
    far = changed(world, "body: {}", "body: {}, motion: {linear: [1e308, 0, 0]}")
    assert main(["run", far, "--record", str(record)]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("frame ")
    assert "of entity 'ball' is " in printed.err
    assert ", written by system '" in printed.err
    assert printed.err.endswith(f"; the recording up to there: carom view {record}\n")
    assert Recording(record).frames[0] == 0


def test_the_module_runs_as_the_console_script_does() -> None:
    """Benches start it this way."""
    done = subprocess.run([*CAROM, "--version"], capture_output=True, text=True, check=True, env=os.environ.copy())
    assert done.stdout.startswith("carom 0.")
