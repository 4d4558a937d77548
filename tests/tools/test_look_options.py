"""What the command line says about looks reaches pictures, films, sheets and strobes alike."""

from __future__ import annotations

import subprocess
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

from carom.tools.cli import main

WORLD = """
carom: 1
run: {duration: 0.5 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: ball, collider: {sphere: {radius: 0.3}}, body: {}, transform: {position: [0, 1, 0]}}
cameras: {main: {position: [0, 0.6, 4], target: [0, 0.6, 0], fov: 50 deg}}
render: {width: 160, height: 120}
"""
LOOK = ("--overlay", "velocities,trails,stamp", "--color", "speed", "--plot", "energy", "speed(ball)")


def written(path: Path) -> np.ndarray:
    """Return the last picture of a file."""
    if path.suffix == ".mp4":
        program = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
        done = subprocess.run(program, capture_output=True, check=True)
        return np.frombuffer(done.stdout, np.uint8).reshape(-1, 120, 160, 3)[-1].astype(int)
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


@pytest.mark.parametrize(
    "words", [("--out", "a.png", "--at", "0.3s"), ("--film", "a.mp4"), ("--sheet", "a.png"), ("--strobe", "a.png")]
)
def test_whatever_render_writes_shows_the_look(world: Path, tmp_path: Path, words: tuple[str, ...]) -> None:
    """The corner with the stamp is dark, and the ball has another colour; without a look it is neither."""
    option, name, *rest = words
    seen = []
    for number, look in enumerate(((), LOOK)):
        path = tmp_path / f"{number}{name}"
        assert main(["render", str(world), option, str(path), *rest, *look]) == 0
        seen.append(written(path))
    plain, looked = seen
    assert plain.shape == looked.shape
    different = np.abs(looked - plain).max(axis=2) > 60
    assert different.sum() > 200
    if option != "--sheet":
        stamp = (slice(-26, -10), slice(10, 60))
        assert np.median(looked[stamp]) < np.median(plain[stamp]) - 40


def test_run_draws_its_last_picture_with_all_it_has_seen(world: Path, tmp_path: Path) -> None:
    """A picture at the end of a run has the trail of the whole run."""
    for name, look in (("plain", ()), ("trailed", ("--overlay", "trails"))):
        assert main(["run", str(world), "--picture", str(tmp_path / f"{name}.png"), *look]) == 0
    plain, trailed = written(tmp_path / "plain.png"), written(tmp_path / "trailed.png")
    rows = np.nonzero((trailed != plain).any(axis=2))[0]
    metre = 60.0 / np.tan(np.radians(25.0)) / 4.0
    assert (rows.min(), rows.max()) == pytest.approx((60.0 - 0.4 * metre, 60.0 + 0.3 * metre), abs=3.0)


def test_unknown_words_end_with_2_and_say_what_there_is(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """From the command line and, found by check, from the file."""
    assert main(["render", str(world), "--out", "a.png", "--overlay", "stmp"]) == 2
    assert "overlays: unknown overlay; received 'stmp'; accepted: axes, bounds, contacts, " in capsys.readouterr().err
    world.write_text(WORLD.replace("height: 120", "height: 120, color: sped, plots: [enrgy]"))
    assert main(["check", str(world)]) == 2
    said = capsys.readouterr().err
    line = 1 + WORLD[: WORLD.index("height: 120")].count("\n")
    assert f"{world}:{line}:" in said and ": render.color: unknown mode of colour; received 'sped'; " in said
    assert ": render.plots.0: is no value of the world; received 'enrgy'" in said and said.count(f":{line}:") == 2
