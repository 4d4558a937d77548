"""A real viewer sees it: Rerun's own viewer opens a recording, moves through time and shows the bodies where they are."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.recorder import Recorder
from carom.tools.viewer import viewer_binary

PATIENCE = 60.0  # s, on a busy machine
COLORS = {"red": (1.0, 0.0, 0.0), "green": (0.0, 1.0, 0.0), "blue": (0.0, 0.0, 1.0)}
LEAST_PIXELS = 300


def free_port() -> int:
    """Return a port nobody listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@pytest.fixture
def viewer() -> Iterator[Any]:
    """Start the viewer without a window and end its whole process group."""
    from rerun.experimental import ViewerClient

    client = ViewerClient.spawn(
        headless=True, port=free_port(), executable_path=str(viewer_binary()), detach_process=True
    )
    yield client
    client.quit()


def pixels_of(picture: npt.NDArray[np.uint8], color: tuple[float, float, float]) -> npt.NDArray[np.int64]:
    """Return the places (n, 2: row, column) of pixels of one pure hue, however the light shades it."""
    channel = int(np.argmax(color))
    bright = picture[..., channel].astype(int)
    others = np.delete(picture, channel, axis=2).max(axis=2)
    return np.argwhere((bright > 80) & (others < bright // 3))


def screenshot(viewer: Any, frame: int, path: Path) -> npt.NDArray[np.uint8]:
    """Move the viewer to a frame and photograph the part of its window that shows the world."""
    from PIL import Image

    deadline = time.monotonic() + PATIENCE
    while True:
        viewer.set_time("frame", sequence=frame)
        time.sleep(1.0)  # the viewer loads and draws on its own time, and jumps to the end when it has loaded
        viewer.save_screenshot(str(path))
        recordings = viewer.get_state().recordings
        if recordings and recordings[0].current_time == frame or time.monotonic() > deadline:
            break
    with Image.open(path) as image:
        picture = np.asarray(image.convert("RGB"))
    return picture[60:-60, : picture.shape[1] * 7 // 10]


def test_the_viewer_shows_the_balls_where_they_are_at_each_time(tmp_path: Path, viewer: Any) -> None:
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    for k, (name, color) in enumerate(COLORS.items()):
        simulation.add(
            name=name,
            transform={"position": (-1.0, 1.0 - k, 0.0)},
            motion={"linear": (1.0, 0.0, 0.0)},
            collider={"sphere": {"radius": 0.3}},
            body={},
            material={"color": color},
        )
    recorder = Recorder(tmp_path / "balls.rrd", camera=Camera((0.0, 0.0, 6.0)))
    simulation.observers.append(recorder)
    recorder.begin(simulation)
    simulation.step(120)
    recorder.end(simulation)

    viewer.open(str(tmp_path / "balls.rrd"))
    screenshot(viewer, 60, tmp_path / "loading.png")
    middles = {}
    for frame in (0, 120):
        picture = screenshot(viewer, frame, tmp_path / f"{frame}.png")
        found = {name: pixels_of(picture, color) for name, color in COLORS.items()}
        counts = {name: len(places) for name, places in found.items()}
        assert min(counts.values()) > LEAST_PIXELS, f"frame {frame}: pixels by colour {counts}"
        assert max(counts.values()) < 2 * min(counts.values())
        middles[frame] = {name: places.mean(axis=0) for name, places in found.items()}
    for name in COLORS:
        across = middles[120][name] - middles[0][name]
        assert across[1] > 100.0, f"{name} moved by {across} px"
        assert abs(across[0]) < 5.0
    heights = [middles[0][name][0] for name in COLORS]
    assert heights == sorted(heights), "red above green above blue"
