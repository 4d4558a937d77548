"""Recordings hold joints and springs as the simulation had them, and draw them where they are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import polars
import pytest

from carom.ecs.components.joint import Joint
from carom.ecs.components.spring import Spring
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recorder.tracks.joints import OF_JOINTS, OF_SPRINGS
from carom.tools.recording import Recording

BALL = {"collider": {"sphere": {"radius": 0.1}}, "body": {"mass": 2.0}}
FRAMES = 40


def scene() -> Simulation:
    """Return a door with a motor and limits, a weight on a joint that soon breaks, and a bob on a spring."""
    simulation = Simulation(dt=1 / 60)
    for name, x in (("door", 0.0), ("weight", 3.0), ("bob", 6.0)):
        simulation.add(name=name, transform={"position": (x + 0.5, 0.0, 0.0)}, **BALL)
    hinge = {"b": "door", "at": (0.0, 0.0, 0.0), "axis": (0.0, 1.0, 0.0), "limits": (-0.1, 0.2)}
    simulation.add(name="hinge", joint={"hinge": hinge | {"motor": {"speed": 2.0, "most": 3.0}}})
    simulation.add(name="weak", joint={"ball": {"b": "weight", "at": (3.0, 0.0, 0.0), "break_force": 40.0}})
    bob = simulation.world.find("bob")
    simulation.add(name="coil", spring={"b": bob, "anchor_a": (6.5, 1.0, 0.0), "stiffness": 30.0, "rest_length": 0.5})
    return simulation


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[dict[str, Any]]]:
    """Return a recording in full, and what the tables held in each of its frames, by name and column."""
    path, simulation = tmp_path_factory.mktemp("joints") / "rec.rrd", scene()
    with observed(simulation, Recorder(path, every=1, detail="full")):
        told = [held(simulation)]
        for _ in range(FRAMES):
            simulation.step()
            told.append(held(simulation))
    return path, told


def held(simulation: Simulation) -> dict[str, Any]:
    """Return copies of the columns, by name of the joint or spring."""
    found, world = {}, simulation.world
    for kind, names in ((Joint, OF_JOINTS), (Spring, OF_SPRINGS)):
        for row in world.row_numbers(kind):
            found[world.name(world.entity(row))] = {name: np.array(getattr(world[kind], name)[row]) for name in names}
    return found


def test_every_column_of_every_frame_is_there(recorded: tuple[Path, list[dict[str, Any]]]) -> None:
    """To the last bit, until a joint breaks; ways by their numbers, vectors by letters."""
    path, told = recorded
    for table in ("joints", "springs"):
        rows = Recording(path).table(table).polars()
        for frame, now in enumerate(told):
            here = rows.filter(polars.col("frame") == frame)
            columns = OF_JOINTS if table == "joints" else OF_SPRINGS
            expected = {name: values for name, values in now.items() if set(values) == set(columns)}
            assert sorted(here["name"]) == sorted(expected)
            for row in here.iter_rows(named=True):
                for column, value in expected[row["name"]].items():
                    parts = [row[column]] if value.ndim == 0 else [
                        row[f"{column}.{'xyz'[k] if value.size == 3 else k}"] for k in range(value.size)
                    ]  # fmt: skip
                    assert parts == value.ravel().tolist()
    assert any(now["hinge"]["limit"][3] == 1 for now in told)
    assert told[-1]["hinge"]["effort"][3] == pytest.approx(3.0, rel=1e-9)


def test_what_breaks_is_in_the_log(recorded: tuple[Path, list[dict[str, Any]]]) -> None:
    """Once, with what it bore."""
    path, _ = recorded
    lines = [line for line in Recording(path).table("log").polars()["text"] if "breaks" in line]
    assert len(lines) == 1
    assert lines[0].startswith("weak breaks under 4")
    assert lines[0].endswith(" N and 0 N m")


def test_lines_go_by_the_anchors(recorded: tuple[Path, list[dict[str, Any]]]) -> None:
    """The hinge from the world to the centre of its door, the spring from anchor to anchor."""
    path, _ = recorded
    series = read(path).series
    strips, zigzags = (series[(f"/world/{name}", "LineStrips3D:strips")].at(0) for name in ("joints", "springs"))
    assert strips is not None
    assert np.array(strips[1][0]) == pytest.approx(np.array([[0.0, 0.0, 0.0]] * 3 + [[0.5, 0.0, 0.0]]), abs=1e-6)
    assert zigzags is not None
    zigzag = np.array(zigzags[1][0])
    assert zigzag[[0, -1]] == pytest.approx(np.array([[6.5, 1.0, 0.0], [6.5, 0.0, 0.0]]), abs=1e-6)
    assert np.ptp(zigzag[:, 0]) == pytest.approx(0.1, abs=1e-6)
