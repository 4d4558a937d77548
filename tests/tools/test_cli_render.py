"""carom render: pictures of a world, and whole messages for what cannot be shown."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from command_lines import changed, files
from PIL import Image

from carom.tools.cli import main


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
    assert files(tmp_path) == ["world.yaml"]


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
