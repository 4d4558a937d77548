"""A recording is opened where it was asked for: at a frame, with an entity selected, in a window or a browser."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from threading import Thread

import numpy as np
import pytest
from browser import GRAPHICS, browser
from windowless import windowless

from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools import viewer
from carom.tools.cameras import Camera
from carom.tools.cli import main
from carom.tools.led_page import script
from carom.tools.recorder import Recorder
from carom.tools.showing import Spot, spot_in

COLORS = {"red": (1.0, 0.0, 0.0), "green": (0.0, 1.0, 0.0), "blue": (0.0, 0.0, 1.0)}


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of three balls of pure hue that move to the right, and of two white ones that look alike."""
    path = tmp_path_factory.mktemp("view") / "balls.rrd"
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    looks = {**COLORS, "pearl[0]": (1.0, 1.0, 1.0), "pearl[1]": (1.0, 1.0, 1.0)}
    for k, (name, color) in enumerate(looks.items()):
        simulation.add(
            name=name,
            transform={"position": (-1.5, 1.5 - 0.8 * k, 0.0)},
            motion={"linear": (1.0, 0.0, 0.0)},
            collider={"sphere": {"radius": 0.3}},
            body={},
            material={"color": color},
        )
    with observed(simulation, Recorder(path, camera=Camera((0.0, 0.0, 6.0)))):
        simulation.step(120)
        simulation.world.despawn(simulation.world.find("green"))
        simulation.step(20)
    return path


def hued(picture: np.ndarray, name: str) -> int:
    """Return how many pixels have that pure hue, however the light shades it."""
    channel = list(COLORS).index(name)
    others = np.delete(picture, channel, axis=2).max(axis=2)
    return int(((picture[..., channel] > 80) & (others < picture[..., channel].astype(int) // 3)).sum())


def test_a_frame_and_a_name_lead_to_a_spot(recorded: Path) -> None:
    """One that has a look of its own is its path, one of several that look alike an instance of theirs."""
    assert spot_in(recorded, 30, None) == Spot(30)
    assert spot_in(recorded, None, "red") == Spot(0, "/world/sphere/red")
    assert spot_in(recorded, 60, "pearl[1]") == Spot(60, "/world/sphere/pearl[#1]")


def test_what_is_not_in_a_recording_is_told(recorded: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With what is, before any viewer opens."""
    names = "red, green, blue, pearl[0], pearl[1]"
    unknown, later = "--select: unknown entity in frame", names.replace("green, ", "")
    for words, told in {
        "--frame 900": f"--frame: {recorded} holds no frame 900; accepted: 0 to 140",
        "--select blu": f"{unknown} 0; received 'blu'; accepted: {names}; did you mean 'blue'?",
        "--select green --frame 130": f"{unknown} 130; received 'green'; accepted: {later}",
        "--web --screenshot x.png": (
            "--web: serves browsers, and --screenshot writes a picture without one; leave out either"
        ),
    }.items():
        assert main(["view", str(recorded), *words.split()]) == 2
        assert capsys.readouterr().err == f"{told}\n"


def test_the_viewer_opens_at_the_frame_with_the_entity_selected(
    recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It stands at the frame, and draws a pale line around the ball that is selected, and around no other."""
    from PIL import Image
    from rerun.experimental import ViewerClient

    with windowless(tmp_path, monkeypatch) as url:
        status: list[int] = []
        shown = Thread(
            target=lambda: status.append(main(["view", str(recorded), "--frame", "90", "--select", "green"]))
        )
        shown.start()
        deadline = time.monotonic() + viewer.PATIENCE
        rims: dict[str, float] = {}
        while len(rims) < len(COLORS) or rims["green"] <= 0.5:  # its first pictures lack some balls
            assert time.monotonic() < deadline, rims
            time.sleep(0.5)
            if not viewer.listens(url):
                continue
            client = ViewerClient.connect(url)
            client.save_screenshot(str(tmp_path / "shot.png"))
            with Image.open(tmp_path / "shot.png") as image:
                picture = np.asarray(image.convert("RGB"))
            rims = {name: pale_rim(picture, name) for name in COLORS if hued(picture, name) > 300}
        assert max(rim for name, rim in rims.items() if name != "green") < 0.05, rims
        recording = client.get_state().recordings[0]
        assert (recording.current_timeline, recording.current_time) == ("frame", 90)
        client.run_command("ui.quit")
        shown.join(timeout=viewer.PATIENCE)
    assert status == [0]


def test_a_screenshot_needs_no_display(recorded: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It shows the balls of the frame it was asked for: in the last one of three is gone."""
    from PIL import Image

    for frame, there in ((60, {"red", "green", "blue"}), (140, {"red", "blue"})):
        out = tmp_path / "new" / f"{frame}.png"
        assert main(["view", str(recorded), "--frame", str(frame), "--screenshot", str(out)]) == 0
        assert capsys.readouterr().out == f"{out}\n"
        with Image.open(out) as image:
            assert image.size == (1600, 900)
            picture = np.asarray(image.convert("RGB"))
        assert {name for name in COLORS if hued(picture, name) > 300} == there
    assert out.stat().st_size < 150_000


def test_pages_ask_their_viewer_in_the_words_of_rerun() -> None:
    """These bytes are what Rerun 0.41 itself sends for the same; and a name ends no script."""
    asked = [b"2\x0f\x12\x07\n\x05frame\x1a\x02\x08Z(\x01", b"Z\x1b\n\x19ui.expand_selection_panel"]
    asked.append(b'"!\n\x1drecording://world/sphere/gree\x10\x01')
    text = script(90, "/world/sphere/gree")
    assert all(json.dumps(one.decode("latin-1")) in text for one in asked)
    assert json.dumps("frame\x1a\x03\x08\xac\x02").strip('"') in script(300, "")
    assert "\\u003c/script>" in script(1, "/world/</script>") and "world/</script>" not in script(1, "/world/</script>")


def pale_rim(picture: np.ndarray, name: str) -> float:
    """Return which part of the circle just around a ball of pure hue is nearly white."""
    channel = list(COLORS).index(name)
    others = np.delete(picture, channel, axis=2).max(axis=2)
    rows, columns = np.nonzero((picture[..., channel] > 80) & (others < picture[..., channel].astype(int) // 3))
    rows, columns = rows[columns < picture.shape[1] * 2 // 3], columns[columns < picture.shape[1] * 2 // 3]
    middle, radius = (np.median(rows), np.median(columns)), np.ptp(columns) / 2
    found = [
        any(
            picture[round(middle[0] + r * np.sin(angle)), round(middle[1] + r * np.cos(angle))].min() > 150
            for r in np.arange(radius - 2, radius + 5, 0.5)
        )
        for angle in np.linspace(0.0, 2 * np.pi, 60)
    ]
    return float(np.mean(found))


@pytest.mark.slow
@pytest.mark.parametrize("spot", [[], ["--frame", "90", "--select", "green"]])
def test_a_browser_shows_it(spot: list[str], recorded: Path, tmp_path: Path) -> None:
    """Rerun's web viewer, served by carom on ports of its own, draws the three balls with WebGL in a real browser.

    At the start on the left; in frame 90 in the middle, with a pale line around the one that is selected.
    """
    words = [sys.executable, "-m", "carom.tools.cli", "view", "--web", str(recorded), *spot]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as served:
        try:
            assert served.stdout
            told = re.fullmatch(r"open (\S+) in a browser; end with Ctrl-C\n", served.stdout.readline())
            assert told
            with browser(tmp_path / "profile", GRAPHICS) as page:
                page.open(told[1])
                deadline = time.monotonic() + viewer.PATIENCE
                place = pytest.approx(2.0 if spot else 0.8, abs=0.3)
                counts, rim, from_left = [0], 0.0, 0.0
                while min(counts) < 300 or (spot and rim < 0.5) or from_left != place:  # panels open last
                    assert time.monotonic() < deadline, (counts, rim, from_left)
                    time.sleep(0.5)
                    picture = page.picture()
                    counts = [hued(picture, name) for name in COLORS]
                    if min(counts) >= 300:
                        rim = pale_rim(picture, "green")
                        columns = np.nonzero((picture[:, :400, 0] > 80) & (picture[:, :400, 1:].max(axis=2) < 30))[1]
                        from_left = columns.min() / np.ptp(columns)  # of the red ball, in its diameters
            assert max(counts) < 2 * min(counts), "three balls of one size"
        finally:
            served.send_signal(signal.SIGINT)
    assert served.returncode == 130
