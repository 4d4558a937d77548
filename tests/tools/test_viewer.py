"""A real viewer sees it: Rerun's own opens a recording, moves through time and shows bodies where they are."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools import coloring
from carom.tools.cameras import Camera
from carom.tools.cli import main
from carom.tools.filming import shot_of
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording
from carom.tools.viewer import viewer_binary
from carom.worlds.builder import load_world

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
        if recordings and recordings[0].current_time == frame:
            break
        assert time.monotonic() < deadline, f"the viewer does not stay at frame {frame}: {recordings}"
    with Image.open(path) as image:
        picture = np.asarray(image.convert("RGB"))
    return picture[60:-60, : picture.shape[1] * 7 // 10]


def test_the_viewer_shows_the_balls_where_they_are_at_each_time(tmp_path: Path, viewer: Any) -> None:
    """Three balls of pure hue move to the right and nowhere else."""
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
    with observed(simulation, Recorder(tmp_path / "balls.rrd", camera=Camera((0.0, 0.0, 6.0)))):
        simulation.step(120)

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


def test_the_viewer_colours_instances_by_what_a_mode_tells(
    tmp_path: Path, viewer: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Balls that look alike are told apart by their layers, over the poses that all modes share."""
    import rerun.blueprint

    class OpenedAtLayers(rerun.blueprint.Tabs):  # type: ignore[misc]
        """Tabs with that of the layers in front, where there is one."""

        def __init__(self, *views: Any) -> None:
            names = [getattr(view, "name", None) for view in views]
            super().__init__(*views, active_tab=names.index("Layers") if "Layers" in names else 0)

    monkeypatch.setattr(rerun.blueprint, "Tabs", OpenedAtLayers)
    monkeypatch.setattr(coloring, "FEW", np.array([(0.5, 0.5, 0.5), (0.5, 0.5, 0.5), *COLORS.values()]))
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    simulation.layers(dict.fromkeys(COLORS))
    for k, name in enumerate(COLORS):
        collider, place = {"sphere": {"radius": 0.3}, "layer": name}, {"position": (-1.0, 1.0 - k, 0.0)}
        simulation.add(name=name, transform=place, collider=collider, body={})
    recorder = Recorder(tmp_path / "layers.rrd", camera=Camera((0.0, 0.0, 6.0)), detail="full")
    recorder.begin(simulation)
    simulation.step(10)
    recorder.observe(simulation)
    recorder.end(simulation)
    viewer.open(str(tmp_path / "layers.rrd"))
    picture = screenshot(viewer, 10, tmp_path / "layers.png")
    places = {name: pixels_of(picture, color) for name, color in COLORS.items()}
    counts = {name: len(found) for name, found in places.items()}
    assert min(counts.values()) > LEAST_PIXELS, counts
    heights = [places[name][:, 0].mean() for name in COLORS]
    assert heights == sorted(heights), "red above green above blue"


# Hue in degrees, least saturation and value: what tells these balls from cloth, wood and the lighter balls.
HUES = {"ball_1": (38.0, 52.0, 0.65, 150), "ball_2": (212.0, 232.0, 0.65, 100), "ball_4": (255.0, 280.0, 0.5, 70)}
CUE_SATURATION, CUE_VALUE = 0.12, 200


def hued_pixels(picture: npt.NDArray[np.uint8], name: str) -> npt.NDArray[np.int64]:
    """Return the places (n, 2: row, column) of the pixels of a ball of the billiards world."""
    high, low = picture.max(axis=2).astype(float), picture.min(axis=2).astype(float)
    saturation = (high - low) / np.maximum(high, 1.0)
    if name == "cue":
        return np.argwhere((saturation < CUE_SATURATION) & (high > CUE_VALUE))
    red, green, blue = np.moveaxis(picture.astype(float), 2, 0)
    spread = np.maximum(high - low, 1.0)
    hue = np.where(
        high == red,
        (green - blue) / spread,
        np.where(high == green, 2 + (blue - red) / spread, 4 + (red - green) / spread),
    )
    least, most, least_saturation, least_value = HUES[name]
    degrees = (60.0 * hue) % 360.0
    return np.argwhere((degrees > least) & (degrees < most) & (saturation > least_saturation) & (high > least_value))


@pytest.mark.slow
def test_the_balls_of_a_break_are_seen_where_the_simulation_has_them(tmp_path: Path, viewer: Any) -> None:
    """The demo's recording, its balls told apart by colour, through the world's own camera."""
    path = tmp_path / "billiards.rrd"
    assert main(["run", "billiards", "--record", str(path), "--frames", "480"]) == 0
    recording = Recording(path)
    names = recording.names(0)
    loaded = load_world("billiards")
    camera_from_world = np.linalg.inv(shot_of(loaded).camera(loaded.simulation.world).pose())
    viewer.open(str(path))
    screenshot(viewer, 240, tmp_path / "loading.png")
    rows, seen, moved = [], [], []
    for frame, looked_for in ((8, ("cue", "ball_1")), (480, ("cue", *HUES))):  # others hide each other in the rack
        picture = screenshot(viewer, frame, tmp_path / f"break-{frame}.png")
        for entity, pose in recording.poses(frame).items():
            if names[entity] not in looked_for or pose.position[1] < 0.0:
                continue
            places = hued_pixels(picture, names[entity])
            assert len(places) > 30, f"frame {frame}: {names[entity]} is {len(places)} px"
            x, y, z, _ = camera_from_world @ [*pose.position, 1.0]
            rows += [[1.0, 0.0, y / z], [0.0, 1.0, -x / z]]
            seen += list(np.median(places, axis=0))
            moved.append((names[entity], np.median(places, axis=0)))
    assert len(rows) >= 10
    # Three unknowns, the middle of the view and its scale, explain where all balls are seen at both times.
    (middle_row, middle_column, scale), *_ = np.linalg.lstsq(np.array(rows), np.array(seen), rcond=None)
    off = np.abs(np.array(rows) @ [middle_row, middle_column, scale] - seen)
    assert scale > 300.0
    assert off.max() < 6.0, list(zip(moved, off.reshape(-1, 2), strict=True))
    assert np.linalg.norm(np.ptp([place for name, place in moved if name == "cue"], axis=0)) > 50.0
