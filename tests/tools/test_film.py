"""Films have the pictures they were given, and survive being cut short."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image, ImageSequence

from carom.ecs.errors import CaromError
from carom.tools.film import Film, save_png

WIDTH, HEIGHT = 64, 48


def picture(level: int) -> np.ndarray:
    """Return an even picture of one brightness."""
    return np.full((HEIGHT, WIDTH, 3), level, np.uint8)


def read(path: Path) -> tuple[str, np.ndarray]:
    """Return what ffmpeg says of the file and its pictures (n, h, w, 3)."""
    program = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(program, capture_output=True, check=True)
    return done.stderr.decode(), np.frombuffer(done.stdout, np.uint8).reshape(-1, HEIGHT, WIDTH, 3)


def test_a_film_holds_its_pictures_in_order(tmp_path: Path) -> None:
    """The file is H.264 at the size and rate asked for, with each picture once and its brightness kept."""
    path = tmp_path / "new" / "film.mp4"
    levels = np.linspace(20, 230, 45).astype(int)
    with Film(path, WIDTH, HEIGHT, fps=15) as film:
        for level in levels:
            film.add(picture(level)[::-1])
    about, frames = read(path)
    assert film.frames == 45
    assert all(
        word in about for word in ("Video: h264", "yuv420p", f"{WIDTH}x{HEIGHT}", "15 fps", "Duration: 00:00:03.00")
    )
    assert len(frames) == 45
    assert np.abs(frames.mean(axis=(1, 2, 3)) - levels).max() < 4  # lossy, and of 219 levels


@pytest.mark.parametrize("suffix", ["mp4", "webp", "gif"])
def test_an_aborted_film_stays_and_plays(tmp_path: Path, suffix: str) -> None:
    """An interrupt closes the film with every picture added before it."""
    path = tmp_path / f"film.{suffix}"
    with pytest.raises(KeyboardInterrupt), Film(path, WIDTH, HEIGHT) as film:
        for level in range(10):
            film.add(picture(level * 20))
        raise KeyboardInterrupt
    assert len(read(path)[1] if suffix == "mp4" else loop(path)[0]) == 10


@pytest.mark.parametrize("suffix", ["mp4", "webp", "gif"])
def test_a_film_whose_program_was_killed_plays(tmp_path: Path, suffix: str) -> None:
    """When the program is killed outright, at most the last picture is lost."""
    path = tmp_path / f"film.{suffix}"
    program = (
        "import os, sys, numpy; from carom.tools.film import Film\n"
        f"film = Film(sys.argv[1], {WIDTH}, {HEIGHT})\n"
        f"for level in range(20): film.add(numpy.full(({HEIGHT}, {WIDTH}, 3), level * 10, numpy.uint8))\n"
        "print(film._encoder.pid, flush=True); os.kill(os.getpid(), 9)"
    )
    killed = subprocess.run([sys.executable, "-c", program, path], capture_output=True, check=False)
    assert killed.returncode == -9
    wait_for(int(killed.stdout))
    assert (
        len(read(path)[1] if suffix == "mp4" else loop(path)[0]) >= 19
    )  # the last picture may still have been in this side of the pipe


def wait_for(process: int) -> None:
    """Wait until a process that is no child of ours has ended."""
    folder = Path(f"/proc/{process}/stat")
    for _ in range(200):
        if not folder.exists() or folder.read_text().rpartition(")")[2].split()[0] == "Z":
            return
        subprocess.run(["sleep", "0.05"], check=True)
    pytest.fail("the encoder did not end within 10 s")


def test_a_film_without_pictures_leaves_no_file(tmp_path: Path) -> None:
    """The file comes into being with the first picture, not with the film."""
    with Film(tmp_path / "film.mp4", WIDTH, HEIGHT):
        pass
    assert list(tmp_path.iterdir()) == []


def loop(path: Path) -> tuple[list[np.ndarray], int, float]:
    """Return the pictures of a WebP or GIF, how often it plays (0 is forever) and how long it is, s."""
    with Image.open(path) as image:
        pictures, milliseconds = [], 0
        for frame in ImageSequence.Iterator(image):
            pictures.append(np.asarray(frame.convert("RGB")))
            milliseconds += frame.info.get("duration", 0)
        return pictures, image.info.get("loop", -1), milliseconds / 1000.0


@pytest.mark.parametrize("suffix", ["webp", "gif", "GIF"])
def test_a_loop_holds_its_pictures_in_order(tmp_path: Path, suffix: str) -> None:
    """WebP and GIF play forever, each picture once in its brightness, for as long as the film is."""
    path = tmp_path / f"film.{suffix}"
    levels = np.linspace(20, 230, 45).astype(int)
    with Film(path, WIDTH, HEIGHT, fps=30) as film:
        for level in levels:
            film.add(picture(level))
    pictures, times, seconds = loop(path)
    assert (len(pictures), times) == (45, 0)
    assert abs(seconds - 1.5) < 0.011  # a hundredth of a second is the finest a GIF knows
    assert np.abs(np.mean(pictures, axis=(1, 2, 3)) - levels).max() < 6  # a GIF takes no colour from its last picture


@pytest.mark.parametrize("suffix", ["webp", "gif"])
def test_a_loop_may_have_any_size(tmp_path: Path, suffix: str) -> None:
    """Neither format needs even sizes."""
    path = tmp_path / f"film.{suffix}"
    with Film(path, 63, 47) as film:
        film.add(np.zeros((47, 63, 3), np.uint8))
    assert loop(path)[0][0].shape == (47, 63, 3)


def test_a_gif_keeps_the_colour_of_what_is_small_but_moves(tmp_path: Path) -> None:
    """A red square of 16 px crosses a picture with more than 256 grey and green tones."""
    across, down = np.meshgrid(np.arange(256), np.arange(128))
    ground = np.stack([across // 2, across, 2 * down], axis=2).astype(np.uint8)
    with Film(tmp_path / "film.gif", 256, 128) as film:
        for place in range(20):
            drawn = ground.copy()
            drawn[60:64, 12 * place : 12 * place + 4] = (220, 30, 40)
            film.add(drawn)
    for place, shown in enumerate(loop(tmp_path / "film.gif")[0]):
        assert np.abs(shown[60:64, 12 * place : 12 * place + 4].astype(int) - (220, 30, 40)).max() < 12


@pytest.mark.parametrize(
    ("path", "size", "fps", "message"),
    [
        ("a.mp4", (63, 48), 30.0, "film a.mp4: width and height must be even and at least 2 px, received 63 x 48"),
        ("a.mp4", (0, 48), 30.0, "film a.mp4: width and height must be even and at least 2 px, received 0 x 48"),
        ("a.gif", (0, 47), 30.0, "film a.gif: width and height must be at least 1 px, received 0 x 47"),
        ("a.mp4", (64, 48), 0.0, "film a.mp4: fps must be above 0 Hz, received 0 Hz"),
        ("a.gif", (64, 48), 60.0, "film a.gif: fps must be above 0 Hz and at most 50 Hz in .gif, received 60 Hz"),
        ("a", (64, 48), 30.0, "film a: its suffix must name a format; received ''; accepted: .mp4, .webp, .gif"),
    ],
)
def test_a_film_that_cannot_be_is_refused(path: str, size: tuple[int, int], fps: float, message: str) -> None:
    """Sizes, rates and names the format cannot have raise an error that names the rule and the value received."""
    with pytest.raises(CaromError) as caught:
        Film(path, *size, fps=fps)
    assert str(caught.value) == message


def test_a_film_of_no_known_kind_is_refused() -> None:
    """The error lists the suffixes there are and the one that is meant."""
    with pytest.raises(CaromError) as caught:
        Film("a.webq", 64, 48)
    assert str(caught.value) == (
        "film a.webq: its suffix must name a format; received '.webq'; accepted: .mp4, .webp, .gif; "
        "did you mean '.webp'?"
    )


def test_a_picture_of_another_size_is_refused(tmp_path: Path) -> None:
    """Only uint8 pictures of the film's own shape are accepted, and the error states both shapes."""
    path = tmp_path / "film.mp4"
    with pytest.raises(CaromError) as caught, Film(path, WIDTH, HEIGHT) as film:
        film.add(picture(0)[:-2])
    assert str(caught.value) == (
        f"film {path}: a picture must be uint8 of shape (48, 64, 3), received uint8 of shape (46, 64, 3)"
    )


def test_an_encoder_that_cannot_write_says_why(tmp_path: Path) -> None:
    """The error names the path and the exit code, and ends with the encoder's own reason."""
    folder = tmp_path / "film.mp4"
    folder.mkdir()
    with pytest.raises(CaromError) as caught, Film(folder, WIDTH, HEIGHT) as film:
        film.add(picture(0))
    assert str(caught.value).startswith(f"film {folder}: the encoder failed with code ")
    assert str(caught.value).endswith("Is a directory")


def test_a_png_holds_every_bit(tmp_path: Path) -> None:
    """A saved picture reads back equal in every pixel, and missing folders are made."""
    drawn = np.random.default_rng(0).integers(0, 256, (HEIGHT, WIDTH, 3), np.uint8)
    save_png(tmp_path / "new" / "picture.png", drawn[::-1])
    assert np.array_equal(np.asarray(Image.open(tmp_path / "new" / "picture.png")), drawn[::-1])
