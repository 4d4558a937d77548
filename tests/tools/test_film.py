"""Films have the pictures they were given, and survive being cut short."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

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


def test_an_aborted_film_stays_and_plays(tmp_path: Path) -> None:
    """An interrupt closes the film with every picture added before it."""
    path = tmp_path / "film.mp4"
    with pytest.raises(KeyboardInterrupt), Film(path, WIDTH, HEIGHT) as film:
        for level in range(10):
            film.add(picture(level * 20))
        raise KeyboardInterrupt
    assert len(read(path)[1]) == 10


def test_a_film_whose_program_was_killed_plays(tmp_path: Path) -> None:
    """When the program is killed outright, at most the last picture is lost."""
    path = tmp_path / "film.mp4"
    program = (
        "import os, sys, numpy; from carom.tools.film import Film\n"
        f"film = Film(sys.argv[1], {WIDTH}, {HEIGHT})\n"
        f"for level in range(20): film.add(numpy.full(({HEIGHT}, {WIDTH}, 3), level * 10, numpy.uint8))\n"
        "print(film._encoder.pid, flush=True); os.kill(os.getpid(), 9)"
    )
    killed = subprocess.run([sys.executable, "-c", program, path], capture_output=True, check=False)
    assert killed.returncode == -9
    wait_for(int(killed.stdout))
    assert len(read(path)[1]) >= 19  # the last picture may still have been in this side of the pipe


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


@pytest.mark.parametrize(
    ("size", "fps", "message"),
    [
        ((63, 48), 30.0, "film a.mp4: width and height must be even and at least 2 px, received 63 x 48"),
        ((0, 48), 30.0, "film a.mp4: width and height must be even and at least 2 px, received 0 x 48"),
        ((64, 48), 0.0, "film a.mp4: fps must be above 0 Hz, received 0 Hz"),
    ],
)
def test_a_film_that_cannot_be_is_refused(size: tuple[int, int], fps: float, message: str) -> None:
    """Odd or empty sizes and a rate of zero raise an error that names the rule and the value received."""
    with pytest.raises(CaromError) as caught:
        Film("a.mp4", *size, fps=fps)
    assert str(caught.value) == message


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
