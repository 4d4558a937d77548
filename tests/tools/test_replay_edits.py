"""What code outside the step wrote between two steps is written again, or told."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from replays import BALLS, record, replayed

from carom.ecs import Motion, Name, Transform, state_hash
from carom.tools.cli import main
from carom.tools.replay import Replay
from carom.worlds import load_text, load_world


def test_what_was_written_between_two_steps_is_written_again(tmp_path: Path) -> None:
    """Poses, velocities, names, and forces in every step: any frame is what it was, to the bit."""

    def meddle(simulation: Any) -> None:
        """Push one, now and then throw the other, who sleeps meanwhile, and call it something else."""
        simulation["left"].external_force.force = (0.1 * simulation.frame, 3.0, 0.0)
        if simulation.frame % 40 == 0:
            with simulation.world.edit(Motion) as motion, simulation.world.edit(Transform) as transform:
                motion.linear[2], motion.asleep[2] = (0.0, 0.0, 0.01 * simulation.frame), False
                transform.position[2, 1] += 0.5
            with simulation.world.edit(Name) as name:
                name.text[2] = f"thrown in {simulation.frame}"

    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 200, dict.fromkeys(range(200), meddle))
    verdict = replayed(tmp_path / "a.rrd")
    assert (verdict.same, verdict.full, verdict.last) == (True, 200, 200)
    replay = Replay(tmp_path / "a.rrd")
    for frame in (41, 59, 119, 161, 199):
        assert state_hash(replay.simulation_at(frame).world) == hashes[frame]


def test_to_open_a_component_wakes_as_it_did(tmp_path: Path) -> None:
    """Also where nothing was written."""

    def look(simulation: Any) -> None:
        """Open what is not written."""
        with simulation.world.edit(Transform):
            pass

    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 200, {150: look, 190: look})
    assert Replay(tmp_path / "a.rrd").recording.edits() == {151: "Transform", 191: "Transform"}
    assert state_hash(Replay(tmp_path / "a.rrd").simulation_at(199).world) == hashes[199]


def test_a_component_exchanged_between_two_steps_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With the frame, the entity and the column; all around it is the same."""

    def push(simulation: Any) -> None:
        """Give a velocity, between frames 150 and 151."""
        simulation.world.attach(simulation.world.find("left"), Motion(linear=(0.0, 0.0, 3.0)))

    record(load_text(BALLS), tmp_path / "a.rrd", 300, {150: push})
    (parting,) = replayed(tmp_path / "a.rrd").partings
    assert (parting.first, parting.last, parting.seen, parting.entity) == (120, 151, None, "")
    found = parting.difference
    assert found is not None
    assert (found.frame, found.entity, found.component, found.column) == (151, "left", "Motion", "linear")
    assert main(["replay", str(tmp_path / "a.rrd")]) == 1
    told = capsys.readouterr().out
    pattern = (
        r"PATH: frames 0 to 300 simulated again: "
        r"not the same; the first is what was recorded, the second what came out now\n"
        r"  from 1 s to 1\.25833 s \(frames 120 to 151\):\n"
        r"    code outside the step changed who lives before frame 151\n"
        r"    frame 151: Motion\.linear\[2\] of entity 'left' is \S+ in the first and \S+ in the second, "
        r"\d+ ulps apart\n"
    )
    assert re.fullmatch(pattern.replace("PATH", re.escape(str(tmp_path / "a.rrd"))), told), told


def test_edits_in_quick_succession_are_told_with_the_frame_in_which_they_show(tmp_path: Path) -> None:
    """Only the first leaves a snapshot; who goes is told, and what was written meanwhile is the same."""

    def push(simulation: Any) -> None:
        """Give a velocity."""
        simulation["right"].motion.linear = (0.0, 1.0, 0.0)

    def remove(simulation: Any) -> None:
        """Take one away."""
        simulation.world.despawn(simulation.world.find("left"))

    record(load_text(BALLS), tmp_path / "a.rrd", 130, {10: push, 20: push, 30: remove})
    verdict = replayed(tmp_path / "a.rrd")
    told = [(parting.first, parting.last, parting.seen, parting.entity) for parting in verdict.partings]
    assert told == [(11, 120, 32, "left")]
    assert [parting.edits for parting in verdict.partings] == [{21: "Motion", 31: "who lives"}]
    assert str(verdict.partings[0].difference) == "frame 120: entity 'left' lives only in the second"


def test_what_a_step_itself_changes_is_no_edit(tmp_path: Path) -> None:
    """A world whose sensor gives another layer to who enters."""
    loaded = load_world("trap")
    record(loaded, tmp_path / "a.rrd", 240)
    assert Replay(tmp_path / "a.rrd").recording.edits() == {}


def test_an_edit_before_the_first_step_is_told(tmp_path: Path) -> None:
    """The recording then begins with what its world file does not make; all after it is as recorded."""
    loaded = load_text(BALLS)
    loaded.simulation["right"].motion.linear = (0.0, 1.0, 0.0)
    record(loaded, tmp_path / "a.rrd", 130)
    (parting,) = replayed(tmp_path / "a.rrd").partings
    assert parting.text(1 / 120) == (
        "from 0 s to 0 s (frames 0 to 0):\n"
        "    frame 0: Motion.linear[1] of entity 'right' is 1.0 in the first and 0.0 in the second, "
        "4607182418800017408 ulps apart"
    )


def test_a_force_of_python_is_told_as_another_step(tmp_path: Path) -> None:
    """It is in no file, so that the replay does without."""
    loaded = load_text(BALLS)
    loaded.simulation.force_function(lambda world, rows: np.ones((len(rows), 3)), name="blow")
    record(loaded, tmp_path / "a.rrd", 60)
    verdict = replayed(tmp_path / "a.rrd")
    assert not verdict.same
    assert verdict.changes == ["the step was another: systems only then: blow; only here: none"]
