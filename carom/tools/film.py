"""Film: pictures written to files, one by one as PNG or in a row as H.264 in MP4."""

from __future__ import annotations

import subprocess
from collections import deque
from contextlib import suppress
from pathlib import Path
from typing import IO

import numpy as np
import numpy.typing as npt

from carom.ecs.errors import CaromError

Picture = npt.NDArray[np.uint8]
QUALITY = (
    20  # H.264's constant rate factor: 0 is lossless, 23 the encoder's own choice; below 18 no eye sees a difference
)
MESSAGE_LINES = 4  # how much of the encoder's last words is passed on when it fails


def save_png(path: Path, picture: Picture) -> None:
    """Write a picture (height, width, 3) as PNG, making its folder; compressed lightly, for speed."""
    from PIL import Image

    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.ascontiguousarray(picture)).save(path, format="PNG", compress_level=1)


class Film:
    """An MP4 that grows by a picture at a time and that browsers play, since its pixels are YUV 4:2:0.

    ``width`` and ``height`` (px) must be even, as 4:2:0 halves them; ``fps`` is in Hz. The encoder (imageio-ffmpeg's
    own ffmpeg) is another process, and so on another core; it ends the film properly whenever its input ends. So a film
    cut short, by an exception, Ctrl-C or even a kill of this process, stays and plays up to the last picture added. A
    film without any picture leaves no file.
    """

    def __init__(self, path: Path | str, width: int, height: int, fps: float = 30.0) -> None:
        if width % 2 or height % 2 or width < 2 or height < 2:
            raise CaromError(
                f"film {path}: width and height must be even and at least 2 px, received {width} x {height}"
            )
        if not fps > 0.0:
            raise CaromError(f"film {path}: fps must be above 0 Hz, received {fps:g} Hz")
        self.path, self.width, self.height, self.fps = Path(path), width, height, fps
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
        coding = ["-c:v", "libx264", "-preset", "veryfast", "-crf", str(QUALITY), "-pix_fmt", "yuv420p"]
        writing = ["-movflags", "+faststart", "-f", "mp4"]  # the index goes to the front, for browsers that stream
        program = [imageio_ffmpeg.get_ffmpeg_exe(), "-y", "-loglevel", "error"]
        return subprocess.Popen(
            [*program, *source, *coding, *writing, str(self.path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            start_new_session=True,  # Ctrl-C is for this process; the encoder goes on until its input ends
        )


def last_lines(stream: IO[bytes]) -> str:
    """Return the last lines of a stream read to its end."""
    return "; ".join(line.decode(errors="replace").strip() for line in deque(stream, MESSAGE_LINES))
