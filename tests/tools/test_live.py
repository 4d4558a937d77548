"""A run is shown while it runs: a viewer is sent what a file holds, may go away, and time is paced."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from rerun.blueprint.components import PlayState
from windowless import windowless

from carom.systems.simulation import Simulation
from carom.tools import pace, viewer
from carom.tools.cli import main
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording
from carom.tools.session import run
from carom.worlds.builder import load_world


class Receiver:
    """Rerun's own server without a window, which saves what it is sent."""

    def __init__(self, path: Path) -> None:
        self.path, port = path, viewer.free_port()
        words = [str(viewer.viewer_binary()), "--save", str(path), "--bind", "127.0.0.1", "--port", str(port)]
        self.process = subprocess.Popen(words, stderr=subprocess.DEVNULL)
        self.url = viewer.address(port)
        while not viewer.listens(self.url):
            assert self.process.poll() is None
            time.sleep(0.05)

    def frames(self, last: int) -> Recording:
        """Return what has been saved once the last frame is there."""
        while True:
            recording = Recording(self.path)
            if recording.frames and recording.frames[-1] >= last:
                return recording
            time.sleep(0.1)


@pytest.fixture
def receiver(tmp_path: Path) -> Iterator[Receiver]:
    """Start a receiver and end it."""
    made = Receiver(tmp_path / "sent.rrd")
    yield made
    made.process.kill()
    made.process.wait()


def play_state(path: Path) -> list[int]:
    """Return what the blueprint of a recording says of its clock: a number of Rerun's."""
    from rerun.chunk import RrdReader

    reader = RrdReader(str(path))
    chunks = (chunk for store in reader.blueprints() for chunk in reader.stream(store=store).to_chunks())
    panels = [chunk.to_record_batch() for chunk in chunks if chunk.entity_path == "/time_panel"]
    columns = [panel.column(name) for panel in panels for name in panel.schema.names if name.endswith(":play_state")]
    return [state[0] for column in columns for state in column.to_pylist()]


@pytest.mark.filterwarnings("ignore:.*was not finished", "ignore:.*no footer")
def test_a_viewer_is_sent_what_the_file_holds(tmp_path: Path, receiver: Receiver) -> None:
    """One recorder, two sinks, the same poses, contacts, curves and log."""
    loaded = load_world("bounce")
    run(loaded, [Recorder(tmp_path / "kept.rrd", live=receiver.url, source=loaded.source_text)], frames=90)
    kept = Recording(tmp_path / "kept.rrd")
    sent = receiver.frames(kept.frames[-1])
    assert sent.frames == kept.frames and len(kept.frames) > 40
    assert sent.lines == kept.lines and kept.lines
    for frame in kept.frames:
        mine, theirs = kept.poses(frame), sent.poses(frame)
        assert mine.keys() == theirs.keys()
        for entity, pose in mine.items():
            assert all(map(np.array_equal, pose, theirs[entity]))
        ours, others = kept.contacts(frame), sent.contacts(frame)
        assert ours.keys() == others.keys()
        assert all(np.array_equal(ours[name], others[name]) for name in ours)
    assert sent.plot("plots/energy/total") == kept.plot("plots/energy/total")
    assert play_state(tmp_path / "kept.rrd") == [PlayState.Paused.value]
    assert play_state(receiver.path) == [PlayState.Following.value]


def test_a_run_goes_on_when_the_viewer_goes_away(
    tmp_path: Path, receiver: Receiver, capsys: pytest.CaptureFixture[str]
) -> None:
    """It says so once, and the file is whole."""

    class Leaving:
        def begin(self, simulation: Simulation) -> None: ...

        def observe(self, simulation: Simulation) -> None:
            if simulation.frame == 40:
                receiver.process.kill()
                receiver.process.wait()

        def end(self, simulation: Simulation) -> None: ...

    loaded = load_world("bounce")
    summary = run(loaded, [Leaving(), Recorder(tmp_path / "kept.rrd", live=receiver.url)])
    assert not summary.failures
    told = f"warning: the viewer at {receiver.url} has gone away; the run goes on\n"
    assert capsys.readouterr().err.count(told) == 1
    assert Recording(tmp_path / "kept.rrd").frames[-1] == summary.frames == 240


def test_a_recorder_needs_somewhere_to_write() -> None:
    """A file, a viewer or both."""
    from carom.ecs.errors import CaromError

    with pytest.raises(CaromError) as told:
        Recorder()
    assert str(told.value) == "a recorder writes to a file, to a viewer or to both; state its path or live="


@pytest.mark.parametrize("speed", [0.5, 1.0, 4.0])
def test_simulated_time_is_held_to_real_time(speed: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """By a clock that passes only in sleep and in two steps that take long, which are caught up with."""

    class Clock:
        now = 100.0

        def monotonic(self) -> float:
            return self.now

        def sleep(self, seconds: float) -> None:
            assert seconds >= 0.0
            self.now += seconds

    clock, simulation = Clock(), Simulation(dt=1 / 64)
    monkeypatch.setattr(pace, "time", clock)
    paced = pace.Pace(speed)
    simulation.observers.append(paced)
    paced.begin(simulation)
    for frame in range(1, 65):
        simulation.step()
        assert clock.now == 100.0 + simulation.time / speed
        clock.now += 0.003 if frame in (20, 40) else 0.0


def test_live_tells_where_no_viewer_is(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """And what is no address of one, before anything runs."""
    url = viewer.address(viewer.free_port())
    accepted = "accepted: rerun+http://HOST:PORT/proxy"
    for given, told in {
        f"--viewer {url}": f"no viewer listens at {url}; start one there with: rerun",
        "--viewer here:1": f"'here:1' is no address of a viewer; {accepted}",
        "--viewer rerun+http://a:b/proxy": f"'rerun+http://a:b/proxy' is no address of a viewer; {accepted}",
        "--live --speed fast": "--speed: is not a number; received 'fast'; accepted: a number",
    }.items():
        assert main(["run", "bounce", *given.split()]) == 2
        assert capsys.readouterr().err == f"{told}\n"
    monkeypatch.setattr(viewer, "PORT", viewer.free_port())
    monkeypatch.setattr(viewer, "has_display", lambda: False)
    assert main(["run", "bounce", "--live"]) == 2
    assert capsys.readouterr().err == (
        f"no viewer listens at {viewer.address(viewer.PORT)}, and there is no display to open one on; "
        "serve one to a browser: rerun --serve-web\n"
    )


@pytest.mark.filterwarnings("ignore:.*Popen.__del__")  # the viewer goes on when carom is done with it
def test_live_starts_a_viewer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where none runs; it outlives the run and has all of it."""
    from rerun.experimental import ViewerClient

    with windowless(tmp_path, monkeypatch) as url:
        assert main(["run", "bounce", "--live", "--frames", "60"]) == 0
        client = ViewerClient.connect(url)
        deadline = time.monotonic() + viewer.PATIENCE
        ends: set[int] = set()
        views: set[str] = set()
        while 60 not in ends or "World" not in views:  # both need not be there at once
            assert time.monotonic() < deadline, (ends, views)
            time.sleep(0.2)
            state = client.get_state()
            ends = {line.end for each in state.recordings for line in each.timelines if line.name == "frame"}
            views = {view.name for view in state.views}
