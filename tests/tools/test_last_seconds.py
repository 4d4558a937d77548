"""A ring is written when something goes wrong, a later recording from where it is asked for; both are replayed."""

from __future__ import annotations

from pathlib import Path

import pytest

from carom.ecs import state_hash
from carom.systems.observer import observed
from carom.systems.ring import Ring
from carom.systems.simulation import Simulation
from carom.tools import viewer
from carom.tools.cli import main
from carom.tools.recorder import Recorder, of_world
from carom.tools.recording import Recording
from carom.tools.replay import Replay
from carom.tools.retrace import Verdict, retrace
from carom.worlds import load_text

WORLD = """
carom: 1
name: drop
step: {dt: 1/100}
run: {duration: 3 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - name: ball
    collider: {sphere: {radius: 0.1}}
    body: {}
    material: {restitution: 0.8}
    transform: {position: [0, 5, 0]}
"""
FAILS = {
    "while it runs": ("expect: [{never: ball.position.y < 2}]", 79),  # g t^2 / 2 = 3 m at 0.782 s
    "at the end": (
        "expect: [{when: {impact: [floor, ball], nth: 99}, ball.position.y: {is: 0.1, within: 1 mm}}]",
        300,
    ),
}


class Seen:
    """An observer that does nothing."""

    def begin(self, simulation: Simulation) -> None:
        """Do nothing."""

    observe = end = begin


def verdict(path: Path) -> Verdict:
    """Replay the whole of a recording."""
    replay = Replay(path)
    return retrace(replay, replay.loaded_at(replay.first), replay.last)


@pytest.mark.parametrize("when", FAILS)
def test_the_last_seconds_before_a_failure_are_recorded(when: str, world: Path, tmp_path: Path) -> None:
    """From the last snapshot so far back on, to the frame that failed; the run goes on as if nothing were."""
    expected, last = FAILS[when]
    world.write_text(WORLD + expected)
    path = tmp_path / "rec.rrd"
    assert main(["run", str(world), "--record", str(path), "--ring", "0.3s"]) == 1
    recording = Recording(path)
    first = recording.frames[0]
    assert last - 60 < first <= last - 30
    assert first % 30 == 0
    assert recording.frames[-1] == last or last - recording.frames[-1] < 2  # 60 frames of 100 are recorded
    assert verdict(path).same
    plain = load_text(WORLD).simulation
    plain.step(last)
    assert Replay(path).states[last].hash == state_hash(plain.world)


def test_where_nothing_fails_nothing_is_written(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Which is told; only a whole run is judged."""
    path = tmp_path / "rec.rrd"
    assert main(["run", str(world), "--record", str(path), "--ring", "1s"]) == 0
    assert capsys.readouterr().err == f"nothing failed, so that {path} is not written\n"
    world.write_text(WORLD + FAILS["while it runs"][0])
    assert main(["run", str(world), "--record", str(path), "--ring", "1s", "--frames", "200"]) == 0
    out, err = capsys.readouterr()
    assert err == f"nothing failed, so that {path} is not written\n"
    assert "recording" not in out
    assert not path.exists()


def test_an_interrupted_run_leaves_its_last_seconds(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Up to the frame it was interrupted in."""
    step = Simulation.step

    def interrupted(simulation: Simulation) -> None:
        """Step, but not beyond frame 150."""
        if simulation.frame == 150:
            raise KeyboardInterrupt
        step(simulation)

    monkeypatch.setattr(Simulation, "step", interrupted)
    path = tmp_path / "rec.rrd"
    assert main(["run", str(world), "--record", str(path), "--ring", "500 ms"]) == 130
    told = f"interrupted in frame 150; the last 0.5 s or more: carom view {path}\n"
    assert capsys.readouterr().err == told
    assert (Replay(path).first, Replay(path).last) == (100, 150)


def test_what_led_to_a_number_that_is_none_is_recorded(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Up to the frame before it; the replay of one more ends the same way."""
    world.write_text(WORLD.replace("body: {}", "body: {mass: 1}") + "forces: [{constant_push: {force: [1e308, 0, 0]}}]")
    path = tmp_path / "rec.rrd"
    assert main(["run", str(world), "--record", str(path), "--ring", "2s"]) == 1
    err = capsys.readouterr().err
    assert err.endswith(f"; the last 2 s or more: carom view {path}\n")
    assert Replay(path).first == 0
    assert verdict(path).same


def test_a_recording_may_begin_later(world: Path, tmp_path: Path) -> None:
    """The rest of the run is the same, and is replayed from there; from Python too."""
    path, whole = tmp_path / "late.rrd", tmp_path / "whole.rrd"
    assert main(["run", str(world), "--record", str(path), "--record-from", "1.25 s"]) == 0
    assert main(["run", str(world), "--record", str(whole)]) == 0
    assert Recording(path).frames[:3] == [125, 126, 128]
    assert (Replay(path).first, Replay(path).last) == (125, 300)
    assert Replay(path).states[300].hash == Replay(whole).states[300].hash
    assert verdict(path).same
    assert main(["replay", str(path)]) == 0
    loaded = load_text(WORLD)
    simulation = loaded.simulation
    simulation.step(40)
    with observed(simulation, Recorder(path, source=loaded.source_text)):
        simulation.step(150)
    assert (Replay(path).first, Replay(path).last) == (40, 190)
    assert verdict(path).same


def test_a_recording_that_never_begins_is_told(world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Where the run was over before the time that was asked for."""
    path = tmp_path / "late.rrd"
    world.write_text(WORLD.replace("{duration: 3 s}", "{until: rest, at_most: 60 s, rest_speed: 1}"))
    if main(["run", str(world), "--record", str(path), "--record-from", "59 s"]) == 2:
        pytest.fail(capsys.readouterr().err)
    assert "before anything was recorded" in capsys.readouterr().err
    assert not path.exists()


def test_what_was_done_by_hand_is_told_in_what_a_ring_shows(tmp_path: Path) -> None:
    """So that a replay writes it again."""
    loaded, path = load_text(WORLD), tmp_path / "rec.rrd"
    simulation = loaded.simulation
    ring = Ring.of_seconds(1.0, simulation)
    ring.begin(simulation)
    simulation.observers.append(ring)
    simulation.step(130)
    simulation["ball"].motion.linear = (0.0, 3.0, 1.0)
    simulation.step(60)
    ring.show(simulation, Recorder(path, every=1, source=loaded.source_text))
    assert Recording(path).edits() == {131: "Motion"}
    assert verdict(path).same
    assert Replay(path).states[190].hash == state_hash(simulation.world)


def test_a_viewer_is_sent_all_of_a_run(world: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever part of it the file holds."""
    made, path = [], tmp_path / "rec.rrd"

    def recorder(loaded: object, shot: object, path: Path | None, *, live: str | None, **chosen: object) -> Seen:
        """Note where a recorder writes to."""
        made.append((path, live))
        return Seen()

    monkeypatch.setattr(of_world, "recorder_of", recorder)
    monkeypatch.setattr(viewer, "running_viewer", lambda url: "there")
    for part in ([], ["--ring", "1s"], ["--record-from", "50 ms"]):
        assert main(["run", str(world), "--frames", "9", "--record", str(path), "--live", *part]) == 0
    assert made == [(path, "there"), *2 * [(None, "there"), (path, None)]]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--ring", "1s"], "--ring: goes with --record FILE, the recording it is of"),
        (["--record-from", "1s"], "--record-from: goes with --record FILE, the recording it is of"),
        (["--record", "a.rrd", "--ring", "0"], "--ring: must be above 0 s; received '0'"),
        (
            ["--record", "a.rrd", "--record-from", "3.01s"],
            "--record-from: must be within the run, which ends at 3 s; received 3.01 s",
        ),
        (
            ["--record", "a.rrd", "--record-from", "2s", "--ring", "1s"],
            "--record-from: goes with a recording to the end of the run, --ring makes another; leave one",
        ),
    ],
)
def test_options_that_cannot_be_are_refused(
    options: list[str], message: str, world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before anything runs."""
    options = [str(tmp_path / word) if word.endswith(".rrd") else word for word in options]
    assert main(["run", str(world), *options]) == 2
    assert capsys.readouterr().err == f"{message}\n"
    assert list(tmp_path.iterdir()) == [world]
