"""A recording holds what it takes to go on from it, and can be read however the run ended."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from recorded import assert_same_poses, falling_world, poses, record

from carom.ecs import NonFiniteError, restore_snapshot, snapshot_from_bytes, state_hash
from carom.tools.bench.killed import record_until_killed
from carom.tools.recorder.stream import application_id
from carom.tools.recording import Recording

pytestmark = pytest.mark.usefixtures("strict_rerun")


def test_a_snapshot_in_the_recording_restores_the_run_bit_by_bit(tmp_path: Path) -> None:
    """Into a world built anew from the same words."""
    simulation = falling_world()
    record(simulation, tmp_path / "run.rrd", 300)
    states = Recording(tmp_path / "run.rrd").saved_states()
    assert [saved.frame for saved in states] == [0, 240, 300]  # each second, and the end
    again = falling_world()
    restore_snapshot(again.world, snapshot_from_bytes(states[1].state, again.world))
    assert state_hash(again.world) == states[1].hash
    again.step(60)
    assert state_hash(again.world) == state_hash(simulation.world)


def test_settings_versions_and_the_world_file_travel_along(tmp_path: Path) -> None:
    """As text to read and as values."""
    record(falling_world(), tmp_path / "run.rrd", 4, title="falling", source="carom: 1\nname: falling\n")
    values = Recording(tmp_path / "run.rrd").static["/about"]
    assert values["world_file"] == ["carom: 1\nname: falling\n"]
    assert values["dt"] == [1 / 240]
    assert values["seed"] == [0]
    assert values["version_numpy"] == [np.__version__]
    assert "falling" in values["TextDocument:text"][0]


@pytest.mark.parametrize("title", ["a ball, a ramp", 'Ω: a/b "c" (1 + 2).', "x" * 300])
def test_any_title_is_taken_without_a_warning(title: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Rerun would exchange letters in the application's name and say so on stderr, in the middle of a run's output."""
    record(falling_world(), tmp_path / "run.rrd", 1, title=title)
    assert capfd.readouterr().err == ""


def test_worlds_of_different_titles_are_different_applications() -> None:
    """The viewer keeps a layout for each; what can be read in a title stays."""
    ids = [application_id(title) for title in ("a ball [1]", "a, b", "a; b", "x" * 300, "x" * 301)]
    assert ids[:3] == ["carom: a ball [1]", "carom: a- b a5b1d428", "carom: a- b bcd861dd"]
    assert len(set(ids)) == 5


def test_a_run_that_breaks_off_leaves_a_readable_recording(tmp_path: Path) -> None:
    """Up to the last frame before the NaN."""
    simulation = falling_world()

    def poison(world: Any, rows: Any) -> Any:
        """Push with a NaN from the hundredth frame on."""
        force = np.zeros((len(rows), 3))
        force[0] = np.nan if world.frame >= 100 else 0.0
        return force

    simulation.force_function(poison)
    with pytest.raises(NonFiniteError):
        record(simulation, tmp_path / "run.rrd", 300)
    assert Recording(tmp_path / "run.rrd").frames == list(range(0, 100, 4))


def test_a_kill_loses_at_most_the_last_second(tmp_path: Path) -> None:
    """Of simulated or of real time; what is left is exact and opens with a warning."""
    path = tmp_path / "killed.rrd"
    killed = record_until_killed(falling_world, path, 3.0)
    with pytest.warns(UserWarning, match=r"killed\.rrd was not finished: the run that wrote it was killed"):
        recording = Recording(path)
    newest = recording.frames[-1]
    assert newest > 0
    assert killed.lost(newest) <= 1.0
    simulation = falling_world()
    seen = {0: poses(simulation)}
    for _ in range(newest):
        simulation.step()
        seen[simulation.frame] = poses(simulation)
    for frame in recording.frames:
        assert_same_poses(recording, frame, seen[frame])
