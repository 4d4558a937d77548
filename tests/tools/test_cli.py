"""The command line: a run and its outputs, which are there or not written at all, exit statuses and whole messages."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from command_lines import changed, files

from carom.tools.cli import main
from carom.tools.recording import Recording


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
    assert lines[1].startswith(f"       {world}:11:5: failed in frame 12 at 0.2 s: ")


def test_a_run_cut_short_is_not_judged(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a world expects holds for whole runs."""
    assert main(["run", str(world), "--frames", "5"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "Falling: 5 frames, 1 bodies"
    assert lines[5] == "  expectations  not asked of this run"


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
    assert files(tmp_path) == ["world.yaml"]


def test_an_output_that_cannot_be_written_ends_with_2_before_anything_runs(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every bad output is named, and not even the good one's folder is made."""
    (tmp_path / "file").write_text("")
    record, film, taken = tmp_path / "file" / "out" / "a.rrd", tmp_path / "good" / "a.mp4", tmp_path / "taken.png"
    taken.mkdir()
    assert main(["run", str(world), "--record", str(record), "--film", str(film), "--picture", str(taken)]) == 2
    assert capsys.readouterr().err == (
        f"cannot write {record}: {tmp_path / 'file'}: Not a directory; choose a folder that can be written\n"
        f"cannot write {taken}: it is a folder; name a file in it\n"
    )
    assert files(tmp_path) == ["file", "taken.png", "world.yaml"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["run", "--dt", "0"], "--dt: must be above 0 s; received '0'"),
        (["run", "--camera", "tpo"], "{world}: no camera is named 'tpo'; accepted: main, top; did you mean 'top'?"),
        (
            ["run", "--record", "deep/a.rrd", "--film", "deep/a"],
            "film deep/a: its suffix must name a format; received ''; accepted: .mp4, .webp, .gif",
        ),
        (["render", "--out", "a.png", "--at", "-1 s"], "--at: must be at least 0 s; received '-1 s'"),
    ],
)
def test_wrong_options_end_with_2_and_say_what_is_accepted(
    words: list[str], message: str, world: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Options are read like the values of a file."""
    assert main([words[0], str(world), *words[1:]]) == 2
    assert capsys.readouterr().err == message.format(world=world) + "\n"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["fmt", "a.yaml", "--chek"], "carom fmt: error: unrecognized arguments: --chek; did you mean '--check'?"),
        (["fmt", "a.yaml", "--to=3s"], "carom fmt: error: unrecognized arguments: --to=3s"),
        (["frmt", "a.yaml"], "did you mean 'fmt'?"),
        (["run", "a.yaml", "--integrator", "verlt"], "did you mean 'verlet'?"),
    ],
)
def test_words_of_no_command_end_with_2_by_its_own_usage(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """And the word that is near."""
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2
    told = capsys.readouterr().err
    assert told.startswith(f"usage: carom {words[0] if words[0] != 'frmt' else '[-h]'}")
    assert told.endswith(f"{message}\n")


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


def test_run_tells_who_gave_energy_and_who_took_it(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As a table below the summary, or as numbers: the floor takes m g h of a ball, and nothing else takes any."""
    path, taken = (
        changed(world, "duration: 0.5 s", "duration: 0.6 s"),
        -1000.0 * 4.0 / 3.0 * math.pi * 1e-3 * 9.81 * 0.9,
    )
    assert main(["run", path, "--ledger"]) == 0
    table = ["energy given and taken", f"  {'impacts':<22}{taken:>+14.6g} J", f"  {'in all':<22}{taken:>+14.6g} J"]
    assert capsys.readouterr().out.splitlines()[-3:] == table
    assert main(["run", path, "--ledger", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["ledger"]["impacts"] == pytest.approx(taken, rel=1e-12)
