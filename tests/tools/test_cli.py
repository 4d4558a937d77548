"""The command line: exit statuses, whole messages, and outputs that are there or not written at all."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from PIL import Image

from carom.tools.cli import COMMANDS, main
from carom.tools.recording import Recording
from carom.worlds import library

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
    assert files(tmp_path) == ["falling.yaml"]


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
    assert files(tmp_path) == ["falling.yaml", "file", "taken.png"]


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
    served = json.loads(capsys.readouterr().out)
    data, web = served["command"][6], served["command"][8]
    words = [str(path), "--serve-web", "--bind", "127.0.0.1", "--port", data, "--web-viewer-port", web]
    assert served["command"][1:] == words
    assert served["page"] == f"http://127.0.0.1:{web}/?url=rerun%2Bhttp%3A%2F%2F127.0.0.1%3A{data}%2Fproxy"


def test_render_photographs_a_moment(world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With any camera of the world."""
    picture = tmp_path / "out" / "a.png"
    assert main(["render", str(world), "--at", "0.1 s", "--camera", "top", "--out", str(picture)]) == 0
    assert capsys.readouterr().out == f"{picture}: frame 6, 0.1 s\n"
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_render_shows_a_motion_in_three_ways(world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A film of half a second in quarter speed has 60 pictures and one; a sheet 2 x 2; all come from one command."""
    film, sheet, strobe = tmp_path / "a.gif", tmp_path / "sheet.png", tmp_path / "strobe.png"
    outputs = ["--film", str(film), "--sheet", str(sheet), "--strobe", str(strobe)]
    how = ["--speed", "0.25x", "--count", "4", "--every", "0.05s", "--strobe-of", "b*", "--size", "80x50"]
    assert main(["render", str(world), *outputs, *how]) == 0
    assert capsys.readouterr().out == f"{film}, {sheet}, {strobe}: frame 30, 0.5 s\n"
    with Image.open(film) as image:
        assert (image.n_frames, image.size) == (61, (80, 50))
    with Image.open(sheet) as image:
        assert image.size == (2 * 88 + 8, 2 * 84 + 8)
    with Image.open(strobe) as image:
        assert image.size == (80, 50)


def test_render_shows_a_part_of_a_run_and_a_moment_beside_it(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """From 0.1 s for 0.2 s at 30 Hz are 7 pictures; the moment may lie before or behind."""
    film, picture = tmp_path / "a.webp", tmp_path / "a.png"
    part = ["--film", str(film), "--from", "0.1 s", "--duration", "0.2 s", "--json"]
    assert main(["render", str(world), *part, "--out", str(picture), "--at", "0.05 s"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told == {"picture": str(picture), "film": str(film), "frame": 3, "time": 0.05}
    with Image.open(film) as image:
        assert image.n_frames == 7


def test_a_world_that_runs_until_it_rests_is_shown_until_then(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The ball has fallen 0.9 m and lies still well before a second has passed."""
    rests = changed(world, "{duration: 0.5 s}", "{until: rest}")
    ends = []
    for kind, path in (("film", tmp_path / "a.gif"), ("sheet", tmp_path / "a.png")):
        assert main(["render", rests, f"--{kind}", str(path), "--json"]) == 0
        ends.append(json.loads(capsys.readouterr().out)["time"])
    assert (2 * 0.9 / 9.81) ** 0.5 < ends[0] < 1.0
    assert ends[1] == ends[0]
    with Image.open(tmp_path / "a.gif") as image:
        assert image.n_frames == 1 + int(ends[0] * 30.0 + 1e-9)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "nothing to write; accepted: --out, --depth, --ids, --film, --sheet, --strobe"),
        (["--film", "a.avi"],
         "film a.avi: its suffix must name a format; received '.avi'; accepted: .mp4, .webp, .gif"),
        (["--film", "a.mp4", "--size", "63x48"],
         "film a.mp4: width and height must be even and at least 2 px, received 63 x 48"),
        (["--film", "a.mp4", "--fps", "0"], "--fps: must be above 0 Hz; received '0'"),
        (["--film", "a.gif", "--fps", "60"],
         "film a.gif: fps must be above 0 Hz and at most 50 Hz in .gif, received 60 Hz"),
        (["--film", "a.mp4", "--speed", "0x"], "--speed: must be above 0; received '0'"),
        (["--film", "a.mp4", "--from", "-1 s"], "--from: must be at least 0 s; received '-1 s'"),
        (["--film", "a.mp4", "--from", "2 s"],
         "--from: must come before the end; received 2 s, and the world's run ends at 0.5 s"),
        (["--film", "a.mp4", "--from", "2 s", "--to", "1 s"],
         "--from: must come before the end; received 2 s, and --to is at 1 s"),
        (["--strobe", "a.png", "--every", "1 kg"],
         ("--every: must be a time; received '1 kg', which is a mass; accepted: a number in s, or one with a unit: "
          "s, ms, us, min, h, d")),
        (["--strobe", "a.png", "--strobe-of", "bal"],
         "--strobe-of: unknown entity; received 'bal'; accepted: floor, ball; did you mean 'ball'?"),
        (["--out", "a.png", "--speed", "2x", "--count", "3", "--to", "1 s", "--duration", "1 s"],
         ("--speed: goes with --film\n--count: goes with --sheet\n--to: goes with --film, --sheet or --strobe\n"
          "--duration: goes with --film, --sheet or --strobe\n--to and --duration: state one of them")),
        (["--sheet", "a.png", "--at", "1 s"], "--at: goes with --out, --depth or --ids"),
        (["--film", "a.mp4", "--camera", "main,top"],
         "--camera: several go with --out, --depth and --ids, and one with --film"),
    ],
)  # fmt: skip
def test_what_cannot_be_shown_ends_with_2_and_writes_nothing(
    words: list[str], message: str, world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """Each message names the option, what was received and what is accepted."""
    monkeypatch.chdir(tmp_path)
    assert main(["render", str(world), *words]) == 2
    assert capsys.readouterr().err == message + "\n"
    assert files(tmp_path) == ["falling.yaml"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--out", "a.jpg"], "argument --out: must end in .png, received 'a.jpg'"),
        (["--sheet", "a.png", "--count", "0"], "argument --count: must be a whole number from 1 on, received '0'"),
        (["--out", "a.png", "--size", "63"],
         "argument --size: must be a width and a height in px such as 1280x720, received '63'"),
    ],
)  # fmt: skip
def test_words_that_are_no_sizes_counts_or_pictures_are_wrong_usage(
    words: list[str], message: str, world: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By argparse, which leaves through SystemExit."""
    with pytest.raises(SystemExit, match="2"):
        main(["render", str(world), *words])
    assert capsys.readouterr().err.splitlines()[-1] == f"carom render: error: {message}"


def test_explain_schema_and_worlds_print(capsys: pytest.CaptureFixture[str]) -> None:
    """The commands that only tell."""
    assert main(["explain"]) == 0
    assert capsys.readouterr().out.startswith("phase")
    assert main(["explain", "--json"]) == 0
    assert {"phase", "system", "reads", "writes", "adds"} < json.loads(capsys.readouterr().out)[0].keys()
    assert main(["schema"]) == 0
    assert "properties" in json.loads(capsys.readouterr().out)
    assert main(["worlds"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines.index("impacts") < lines.index("joints")
    assert "  pong               Two dimensions, two paddles, no loss." in "\n".join(lines)
    assert main(["worlds", "--json"]) == 0
    listed = {world["name"]: world for world in json.loads(capsys.readouterr().out)}
    assert sorted(listed) == library.names()
    assert listed["pong"]["group"] == "impacts" and listed["pong"]["title"] == "Pong"


def test_who_reads_no_further_ends_a_command_quietly() -> None:
    """As `carom schema | head` does, which reads less than a pipe holds of all that is printed."""
    words = [sys.executable, "-m", "carom.tools.cli", "schema"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None and process.stderr is not None
        assert process.stdout.read(1) == b"{"
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 0


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
