"""What is asked of space is recorded: by whom, what it is called, and what it met."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carom.ecs import World, state_hash, system
from carom.systems.observer import observed
from carom.systems.queries import asked
from carom.systems.queries.space import ASKED, Space
from carom.systems.simulation import Simulation
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording

DOWN = (0.0, -1.0, 0.0)


@system(reads=ASKED)
def look_down(world: World, dt: float) -> None:
    """Ask what is below, within the step, three times where all may look: two meet the ground, one nothing."""
    Space(world).cast_rays([(0, 1, 3), (1, 1, 3), (0, 1, 3)], [DOWN, DOWN, (0, 1, 0)], (5.0, 5.0, 2.0), tag="feet")


def asking(path: Path | None, steps: int = 4) -> str:
    """Simulate a ball, asked of in the frames 1 and 2, and a system that asks in every step; return the last hash."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(name="ground", collider={"plane": {}})
    simulation.add(name="ball", collider={"sphere": {"radius": 0.5}}, body={}, transform={"position": (0.0, 3.0, 0.0)})
    simulation.schedule = simulation.schedule.insert(look_down, after="place_colliders")
    recorders = [] if path is None else [Recorder(path, every=2, detail="full")]
    with observed(simulation, *recorders):
        for _ in range(steps):
            space = simulation.space
            if simulation.frame == 1:
                met = space.cast_ray((0.0, 9.0, 0.0), DOWN)
                assert met is not None
                assert space.cast_ray((9.0, 9.0, 0.0), (0.0, 1.0, 0.0)) is None
                assert space.find_overlaps({"sphere": {"radius": 0.2}}, (0.0, 3.0, 0.0), tag="probe").depth[0] > 0.4
            if simulation.frame == 2:
                assert space.cast_shape({"sphere": {"radius": 0.1}}, (5.0, 3.0, 0.0), DOWN) is not None
                assert space.point_inside((0.0, -1.0, 7.0)).size == 1
                assert space.closest_point((0.0, 1.0, 9.0), 2.0) is not None
            simulation.step()
    return state_hash(simulation.world)


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of what was asked."""
    made = tmp_path_factory.mktemp("queries") / "a.rrd"
    asking(made)
    return made


def told(path: Path) -> list[tuple[Any, ...]]:
    """Return frame, query, system, tag and who was met, row by row."""
    table = Recording(path).table("queries").arrow().to_pylist()
    return [tuple(row[name] for name in ("frame", "query", "system", "tag", "entity.name")) for row in table]


def test_every_question_is_in_the_table(path: Path) -> None:
    """With the frame whose world it asked, the system that asked, hits first and then who met nobody."""
    feet = [("cast_rays", "look_down", "feet", name) for name in ("ground", "ground", None)]
    by_hand = {
        1: [
            ("cast_rays", "", "", "ball"),
            ("cast_rays", "", "", None),
            ("find_overlaps", "", "probe", "ball"),
        ],
        2: [
            ("cast_shapes", "", "", "ground"),
            ("points_inside", "", "", "ground"),
            ("closest_points", "", "", "ground"),
        ],
    }
    expected = [(frame, *row) for frame in range(1, 5) for row in feet + by_hand.get(frame, [])]
    assert told(path) == expected


def test_lines_lead_to_what_was_met(path: Path) -> None:
    """From the origin to the point of the answer, or as far as was looked; they are gone when nothing is asked."""
    series = read(path).series
    hits, misses = (series[f"/world/queries/{kind}", "LineStrips3D:strips"] for kind in ("hits", "misses"))
    lines = dict(zip(hits.frames, hits.values, strict=True))
    assert np.asarray(lines[4][0]).tolist() == [[0.0, 1.0, 3.0], [0.0, 0.0, 3.0]]
    ray = np.asarray(lines[1][2])
    assert ray[0].tolist() == [0.0, 9.0, 0.0]
    assert ray[1] == pytest.approx([0.0, 3.5 - 9.81 / 3600, 0.0], abs=2e-3)
    assert np.asarray(dict(zip(misses.frames, misses.values, strict=True))[1][1])[1].tolist() == [9.0, 109.0, 0.0]
    labels = series["/world/queries/hits", "LineStrips3D:labels"]
    assert labels.values[labels.frames.index(1)] == ["feet", "feet", "cast_rays", "probe"]


def test_no_bit_of_a_run_knows_of_it(path: Path) -> None:
    """Asked or not kept, the state is the same."""
    assert asking(None) == asking(path.with_name("b.rrd"))


def test_what_is_too_much_is_left_out_and_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A line of the log counts it."""
    monkeypatch.setattr(asked, "MOST", 2)
    asking(tmp_path / "a.rrd", steps=1)
    assert told(tmp_path / "a.rrd") == [(1, "cast_rays", "look_down", "feet", "ground")] * 2
    assert [line.text for line in Recording(tmp_path / "a.rrd").lines] == ["1 more answers of queries in this frame"]


def test_a_light_recording_keeps_no_questions(tmp_path: Path) -> None:
    """Nobody pays for what nobody asked for."""
    simulation = Simulation()
    recorder = Recorder(tmp_path / "a.rrd")
    recorder.begin(simulation)
    simulation.space.cast_ray((0.0, 1.0, 0.0), DOWN)
    recorder.end(simulation)
    assert simulation.world[asked.Asked].questions == []
    assert "queries" not in Recording(tmp_path / "a.rrd").tables()
