"""Film: pictures written to files, one by one as PNG or in a row as MP4, WebP or GIF."""

from __future__ import annotations

import math
import subprocess
from collections import deque
from contextlib import suppress
from pathlib import Path
from typing import IO, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.errors import CaromError, did_you_mean

Picture = npt.NDArray[np.uint8]
QUALITY = (
    20  # H.264's constant rate factor: 0 is lossless, 23 the encoder's own choice; below 18 no eye sees a difference
)
WEBP_QUALITY = 85  # of 100; 75 is the encoder's own choice, and shows on the rims of bodies
PALETTE_PICTURES, PALETTE_MEMORY = 100, 256e6  # a GIF's 256 colours are theirs: they wait for it, at 4 bytes a pixel
MESSAGE_LINES = 4  # how much of the encoder's last words is passed on when it fails


class Format(NamedTuple):
    """A format of films: the encoder's words for it, whether sizes must be even, and its highest rate (Hz).

    ``{waiting}`` among the words stands for how many pictures may wait for the colours.
    """

    coding: str
    even: bool = False
    fastest: float = math.inf


# What moves weighs most among a GIF's colours. Its dots, in an ordered pattern, stay where they are from picture to
# picture, so that only what moves is stored.
COLORS = "split[all][some];[some]trim=end_frame={waiting},palettegen=stats_mode=diff[palette]"
DOTS = "[all][palette]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle"
FORMATS = {
    # 4:2:0 is for browsers; the index goes to the front, for those that stream.
    ".mp4": Format(f"-c:v libx264 -preset veryfast -crf {QUALITY} -pix_fmt yuv420p -movflags +faststart -f mp4", True),
    # Its times are whole milliseconds.
    ".webp": Format(f"-c:v libwebp_anim -quality {WEBP_QUALITY} -loop 0 -f webp", fastest=1000.0),
    # Its times are hundredths of a second, and browsers slow those below two down.
    ".gif": Format(f"-filter_complex {COLORS};{DOTS} -loop 0 -f gif", fastest=50.0),
}


def save_png(path: Path, picture: Picture) -> None:
    """Write a picture (height, width, 3) as PNG, making its folder; compressed lightly, for speed."""
    from PIL import Image

    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.ascontiguousarray(picture)).save(path, format="PNG", compress_level=1)


class Film:
    """A film that grows by a picture at a time, in the format that its suffix names; WebP and GIF play in a loop.

    ``width`` and ``height`` (px) must be even for MP4, whose colours are stored at half the size; ``fps`` is in Hz, at
    most 50 for GIF. A GIF's 256 colours are those of its first pictures, 100 up to 800 x 800 px. The encoder
    (imageio-ffmpeg's own ffmpeg) is another process, and so on another core; it ends the film properly whenever its
    input ends. So a film cut short, by an exception, Ctrl-C or even a kill of this process, stays and plays up to the
    last picture added. A film without any picture leaves no file.
    """

    def __init__(self, path: Path | str, width: int, height: int, fps: float = 30.0) -> None:
        self.path, self.width, self.height, self.fps = Path(path), width, height, fps
        suffix = self.path.suffix.lower()
        if suffix not in FORMATS:
            parts = f"received {suffix!r}", f"accepted: {', '.join(FORMATS)}", did_you_mean(suffix, FORMATS)
            raise CaromError(f"film {path}: its suffix must name a format; {'; '.join(filter(None, parts))}")
        self._format = FORMATS[suffix]
        even = self._format.even
        if (even and (width % 2 or height % 2)) or min(width, height) < 1 + even:
            rule = "even and at least 2" if even else "at least 1"
            raise CaromError(f"film {path}: width and height must be {rule} px, received {width} x {height}")
        if not 0.0 < fps <= self._format.fastest:
            most = "" if math.isinf(self._format.fastest) else f" and at most {self._format.fastest:g} Hz in {suffix}"
            raise CaromError(f"film {path}: fps must be above 0 Hz{most}, received {fps:g} Hz")
        self.frames = 0
        self._encoder: subprocess.Popen[bytes] | None = None

    def add(self, picture: Picture) -> None:
        """Append a picture (height, width, 3); raise CaromError when its size is another or the encoder fails."""
        if picture.shape != (self.height, self.width, 3) or picture.dtype != np.uint8:
            raise CaromError(
                f"film {self.path}: a picture must be uint8 of shape {(self.height, self.width, 3)}, "
                f"received {picture.dtype} of shape {picture.shape}"
            )
        if self._encoder is None:
            self._encoder = self._start()
        assert self._encoder.stdin is not None
        try:
            self._encoder.stdin.write(np.ascontiguousarray(picture).data)
        except BrokenPipeError:
            self.close()
            raise CaromError(f"film {self.path}: the encoder ended before the film did") from None
        self.frames += 1

    def close(self) -> None:
        """End the film; raise CaromError with the encoder's words when it failed."""
        encoder, self._encoder = self._encoder, None
        if encoder is None:
            return
        assert encoder.stdin is not None and encoder.stderr is not None
        with suppress(BrokenPipeError):  # the encoder ended first; its return code says so
            encoder.stdin.close()
        words = last_lines(encoder.stderr)
        encoder.stderr.close()
        if encoder.wait() != 0:
            raise CaromError(f"film {self.path}: the encoder failed with code {encoder.returncode}: {words}")

    def __enter__(self) -> Film:
        return self

    def __exit__(self, *fault: object) -> None:
        self.close()

    def _start(self) -> subprocess.Popen[bytes]:
        import imageio_ffmpeg

        self.path.parent.mkdir(parents=True, exist_ok=True)
        source = [
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgb24",
            "-s",
            f"{self.width}x{self.height}",
            "-r",
            str(self.fps),
            "-i",
            "-",
        ]
        waiting = max(1, min(PALETTE_PICTURES, int(PALETTE_MEMORY / (4 * self.width * self.height))))
        coding = self._format.coding.format(waiting=waiting).split()
        program = [imageio_ffmpeg.get_ffmpeg_exe(), "-y", "-loglevel", "error"]
        return subprocess.Popen(
            [*program, *source, *coding, str(self.path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            start_new_session=True,  # Ctrl-C is for this process; the encoder goes on until its input ends
        )


def last_lines(stream: IO[bytes]) -> str:
    """Return the last lines of a stream read to its end."""
    return "; ".join(line.decode(errors="replace").strip() for line in deque(stream, MESSAGE_LINES))
