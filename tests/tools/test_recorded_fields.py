"""Fields are recorded where they act, as their laws have them at these points, and again when they change."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import polars
import pytest

from carom.ecs import state_hash
from carom.ecs.column import Floats
from carom.systems.forces.gusts import WAVES, waves
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording

FRAMES, DT, SEED = 12, 1 / 60, 3
PUSHED_FROM = 0.1  # s, when the whirlwind ends
BOX = {"size": (2.0, 1.0, 1.0), "position": (0.0, 5.0, 0.0)}
LOWER, UPPER = (-4.75, -2.75, -3.375), (5.75, 7.75, 1.875)  # a quarter more than what is there at the start, each way
GUST, GUST_TIME, DRAG = 0.5, 0.8, 0.25


def windy(path: Path | None = None) -> Simulation:
    """Simulate two balls in all kinds of fields, and record them."""
    simulation = Simulation(dt=DT, gravity=(0.0, -10.0, 0.0), seed=SEED)
    gusty = place(simulation, (3.5, 5.5, 0.5))
    place(simulation, (-2.5, -0.5, -2.0))
    simulation.force("wind", velocity=(3.0, 0.0, -1.0), region={"box": BOX})
    simulation.force("wind", velocity=(1.0, 0.0, 0.0), gust=GUST, gust_time=GUST_TIME, entities=[gusty])
    simulation.force("vortex", circulation=8.0, axis=(0.0, 2.0, 0.0), rise=0.5, during=(0.0, PUSHED_FROM))
    simulation.force("gravity_well", strength=5.0, position=(1.0, 2.0, 0.0), radius=1.5)
    simulation.force("attraction", strength=2.0, power=1)
    simulation.force("linear_drag", coefficient=DRAG)
    simulation.force("buoyancy", level=0.5, current=(0.0, 0.0, 2.0))
    region = {"sphere": {"radius": 2.0}}
    simulation.force("constant_push", force=(0.0, 4.0, 0.0), region=region, during=(PUSHED_FROM, "end"))
    simulation.force("lift", area=0.1)
    return recorded(simulation, path)


def place(simulation: Simulation, position: tuple[float, float, float]) -> int:
    """Add a ball."""
    return simulation.add(collider={"sphere": {"radius": 0.5}}, body={"mass": 2.0}, transform={"position": position})


def recorded(simulation: Simulation, path: Path | None) -> Simulation:
    """Simulate, and record every frame where a path is told."""
    recorders = [] if path is None else [Recorder(path, every=1, detail="full")]
    with observed(simulation, *recorders):
        simulation.step(FRAMES)
    return simulation


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of the windy world."""
    made = tmp_path_factory.mktemp("fields") / "windy.rrd"
    windy(made)
    return made


@pytest.fixture(scope="module")
def table(path: Path) -> Any:
    """Return its fields."""
    return Recording(path).table("fields").polars()


def told(table: Any, field: str, frame: int = FRAMES) -> tuple[Floats, Floats, Floats]:
    """Return points, forces and flows of a field in a frame."""
    rows = table.filter((polars.col("field") == field) & (polars.col("frame") == frame))
    point, force, flow = (
        rows.select(f"{name}.{axis}" for axis in "xyz").to_numpy() for name in ("point", "force", "flow")
    )
    return point, force, flow


def whirl(point: Floats) -> Floats:
    """Return the velocity of a vortex about y with a core of 1 m."""
    away = np.hypot(point[:, 0], point[:, 2])
    rate = 8.0 / (2.0 * pi * np.maximum(away, 1.0) ** 2)
    rise = np.where(away < 1.0, 0.5, 0.0)
    return np.stack([rate * point[:, 2], rise, -rate * point[:, 0]], axis=1)


def test_forces_are_those_on_a_kilogram_at_rest(table: Any) -> None:
    """A well is that of an even ball, an attraction a spring, a push the same everywhere."""
    point, force, flow = told(table, "gravity well")
    away = point - (1.0, 2.0, 0.0)
    distance = np.linalg.norm(away, axis=1, keepdims=True)
    assert (distance < 1.5).any()
    assert force == pytest.approx(-5.0 * away / np.maximum(distance, 1.5) ** 3, rel=1e-6, abs=1e-6)
    point, force, _ = told(table, "attraction")
    assert force == pytest.approx(-2.0 * point, rel=1e-6, abs=1e-6)
    _, force, _ = told(table, "constant push")
    assert (force == (0.0, 4.0, 0.0)).all()
    assert not flow.any()


def test_media_flow_as_their_laws_say(table: Any) -> None:
    """A wind within its region, a whirlwind, a current below the surface, and gusts at their times."""
    _, force, flow = told(table, "wind")
    assert (flow == (3.0, 0.0, -1.0)).all()
    assert not force.any()
    point, _, flow = told(table, "vortex", frame=3)
    assert flow == pytest.approx(whirl(point), rel=1e-6, abs=1e-6)
    point, _, flow = told(table, "buoyancy")
    assert point[:, 1].max() <= 0.5
    assert (flow == (0.0, 0.0, 2.0)).all()
    rates, phases = waves(SEED, 1)
    for frame in range(FRAMES + 1):
        _, _, flow = told(table, "wind 2", frame)
        noise = GUST * np.sqrt(2.0 / WAVES) * np.sin(rates * frame * DT / GUST_TIME + phases).sum(axis=1)
        assert flow == pytest.approx(
            np.broadcast_to(np.array((1.0, 0.0, 0.0)) + noise, flow.shape), rel=1e-12, abs=1e-12
        )


def test_drags_push_who_is_at_rest_in_a_medium(table: Any) -> None:
    """By what all bodies meet: the wind in its region and the whirlwind, not the gusts around one of them."""
    point, force, flow = told(table, "linear drag", frame=3)
    middle, half = np.array(BOX["position"]), 0.5 * np.array(BOX["size"])
    windy = (np.abs(point - middle) <= half).all(axis=1)
    assert windy.any() and not windy.all()
    met = whirl(point) + np.where(windy[:, None], (3.0, 0.0, -1.0), 0.0)
    assert force == pytest.approx(DRAG * met, rel=1e-6, abs=1e-6)
    assert not flow.any()
    point, _, _ = told(table, "linear drag")  # without the whirlwind there is none elsewhere
    assert (np.abs(point - middle) <= half).all()


def test_points_fill_the_region_of_a_law_or_the_world(table: Any) -> None:
    """Nine along the longest edge, evenly, those of a sphere within it; what flies nowhere, such as wings, has none."""
    point, _, _ = told(table, "wind 2")
    assert len(point) == 9 * 9 * 4
    for axis, count in enumerate((9, 9, 4)):
        half = 0.5 * (UPPER[axis] - LOWER[axis]) / count
        middles = np.linspace(LOWER[axis] + half, UPPER[axis] - half, count)
        assert np.unique(point[:, axis]) == pytest.approx(middles, rel=1e-6)
    point, _, _ = told(table, "wind")
    assert np.ptp(point, axis=0) == pytest.approx((2.0 * 8 / 9, 1.0 * 3 / 4, 1.0 * 3 / 4))
    point, _, _ = told(table, "constant push")
    assert np.linalg.norm(point, axis=1).max() <= 2.0
    assert len(point) > 0.4 * 9**3  # pi / 6 of a cube
    assert "lift" not in table["field"].to_list()


def test_fields_are_written_when_they_change(tmp_path: Path) -> None:
    """What stays is there once; a law that begins and ends makes the frames of both new, one that is added its own."""
    still = Simulation(dt=DT)
    place(still, (0.0, 5.0, 0.0))
    still.force("gravity_well", strength=1.0)
    assert frames_of(recorded_at(still, tmp_path / "still.rrd")) == [0]
    passing = Simulation(dt=DT)
    place(passing, (0.0, 5.0, 0.0))
    passing.force("constant_push", force=(1.0, 0.0, 0.0), during=(2.5 * DT, 5.5 * DT))
    path = recorded_at(passing, tmp_path / "passing.rrd")
    assert frames_of(path) == [3, 6]
    assert set(Recording(path).table("fields").polars()["frame"].to_list()) == {3}, "in frame 6 there is none any more"


def recorded_at(simulation: Simulation, path: Path) -> Path:
    """Record a simulation there."""
    recorded(simulation, path)
    return path


def frames_of(path: Path) -> list[int]:
    """Return the frames in which fields were written."""
    return read(path).series["/world/fields", "force"].frames


def test_a_world_without_fields_has_no_table(tmp_path: Path) -> None:
    """Drag in still air is none."""
    simulation = Simulation(dt=DT)
    place(simulation, (0.0, 5.0, 0.0))
    simulation.force("linear_drag", coefficient=1.0)
    assert "fields" not in Recording(recorded_at(simulation, tmp_path / "none.rrd")).tables()


def test_arrows_point_along_fields_and_are_cut(path: Path, table: Any) -> None:
    """The median is 0.6 of the way from point to point, none longer than 1.2."""
    series = read(path).series
    names = np.array(series["/world/fields", "field"].at(FRAMES)[1])
    arrows = series["/world/fields", "Arrows3D:vectors"].at(FRAMES)[1][names == "gravity well"]
    _, force, _ = told(table, "gravity well")
    lengths, sizes = np.linalg.norm(arrows, axis=1), np.linalg.norm(force, axis=1)
    assert np.median(lengths) == pytest.approx(0.6 * 10.5 / 9, rel=1e-6)
    assert lengths.max() == pytest.approx(1.2 * 10.5 / 9, rel=1e-6)
    assert arrows / lengths[:, None] == pytest.approx(force / sizes[:, None], abs=1e-6)


def test_who_looks_at_fields_changes_nothing(path: Path, tmp_path: Path) -> None:
    """The same bits of state, with and without a recording."""
    assert state_hash(windy(tmp_path / "again.rrd").world) == state_hash(windy().world)
