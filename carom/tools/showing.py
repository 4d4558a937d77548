"""Showing: a recording in the viewer's window or in a browser, at a frame and with an entity selected."""

from __future__ import annotations

import subprocess
import time
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING
from urllib.parse import quote

from carom.ecs.errors import CaromError
from carom.tools.led_page import STEADY, led_pages
from carom.tools.recorder.stream import FRAME
from carom.tools.recording import Recording
from carom.tools.viewer import PATIENCE, address, answers, free_port, start_viewer, viewer_binary
from carom.worlds.errors import WordError
from carom.worlds.names import known

if TYPE_CHECKING:
    from rerun.experimental import ViewerClient

WIDTH, HEIGHT = 1600, 900  # px, of a picture of the viewer
COLORS = 128  # of it: the viewer has few, and the file is a third as large
SETTLED = 1.0  # s that a viewer takes to draw what it was led to


@dataclass(frozen=True)
class Spot:
    """Where to look in a recording: a frame, and the path of what is selected in Rerun's words, empty for nothing."""

    frame: int
    selected: str = ""


def spot_in(path: Path, frame: int | None, name: str | None) -> Spot:
    """Return where a frame and an entity's name lead in a recording; without a frame it is the first.

    One of several that look alike is an instance of their path. Raises CaromError for what is not there.
    """
    recording = Recording(path)
    if not recording.frames:
        raise CaromError(f"{path} holds no frame")
    first, last = recording.frames[0], recording.frames[-1]
    frame = first if frame is None else frame
    if not first <= frame <= last:
        raise CaromError(f"--frame: {path} holds no frame {frame}; accepted: {first} to {last}")
    if name is None:
        return Spot(frame)
    names = dict(sorted(recording.names(frame).items()))
    try:
        known(f"entity in frame {frame}", name, names.values())
    except WordError as fault:
        raise CaromError(fault.line("--select")) from None
    entity = next(handle for handle, called in names.items() if called == name)
    at, alike = recording.place(entity, frame)
    number = f"[#{alike.index(entity)}]" if len(alike) > 1 else ""
    return Spot(frame, at + number)


def show(path: Path, spot: Spot | None) -> int:
    """Open a window, wait until it is closed, and return its exit status."""
    if spot is None:
        return subprocess.run([str(viewer_binary()), str(path)], check=False).returncode
    port = free_port()
    process = start_viewer(port)
    _look(address(port), path.resolve(), spot)
    return process.wait()


def picture(path: Path, spot: Spot, out: Path) -> None:
    """Write what a viewer without a window shows (PNG)."""
    from PIL import Image

    port = free_port()
    process = start_viewer(port, "--headless", "--window-size", f"{WIDTH}x{HEIGHT}")
    try:
        viewer = _look(address(port), path.resolve(), spot)
        time.sleep(SETTLED)
        shown = Image.open(BytesIO(viewer.take_screenshot())).convert("RGB")
    finally:
        process.kill()
        process.wait()
    shown.quantize(COLORS).save(out, optimize=True)


def _look(url: str, path: Path, spot: Spot) -> ViewerClient:
    """Lead a viewer to a spot in a recording."""
    from rerun.experimental import ViewerClient

    viewer = ViewerClient.connect(url)
    viewer.open(str(path))
    there, deadline = 0, time.monotonic() + PATIENCE
    while there < STEADY and time.monotonic() < deadline:
        viewer.set_time(FRAME, sequence=spot.frame, play_state="paused")
        time.sleep(0.2)
        there = there + 1 if any(each.current_time == spot.frame for each in viewer.get_state().recordings) else 0
    if spot.selected:
        viewer.open(f"recording:/{spot.selected}")
        viewer.run_command("ui.expand_selection_panel")
    return viewer


class Service:
    """A recording for browsers of this machine: the command ``words`` serves it, at the address ``page``.

    With a spot that page leads there, and is served by `run` alone.
    """

    def __init__(self, path: Path, spot: Spot | None = None) -> None:
        data, self._port = free_port(), free_port()
        self._spot, self._led = spot, free_port() if spot else self._port
        ports = "--port", str(data), "--web-viewer-port", str(self._port)
        self.words = [str(viewer_binary()), str(path), "--serve-web", "--bind", "127.0.0.1", *ports]
        self.page = f"http://127.0.0.1:{self._led}/?url={quote(address(data), safe='')}"

    def run(self) -> int:
        """Serve it until that is ended, tell the page as soon as it is there, and return the exit status."""
        process = subprocess.Popen(self.words, stderr=subprocess.DEVNULL)
        try:
            while process.poll() is None and not answers("127.0.0.1", self._port):
                time.sleep(0.05)
            if self._spot:
                pages = led_pages(self._led, f"http://127.0.0.1:{self._port}", self._spot.frame, self._spot.selected)
                Thread(target=pages.serve_forever, daemon=True).start()
            print(f"open {self.page} in a browser; end with Ctrl-C", flush=True)
            return process.wait()
        finally:
            process.kill()
            process.wait()
