"""What a recording tells of the solver is what it did in these frames, told again from a light recording or at once."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import polars
import pytest

from carom.ecs import System, Transform
from carom.ecs.components.joint import Joint
from carom.ecs.timings import Timings
from carom.systems.continuous import Fast
from carom.systems.detection.answered import Answered
from carom.systems.observer import observed
from carom.systems.progress import Progress
from carom.systems.simulation import Simulation
from carom.systems.solving import Solving
from carom.tools.cli import main
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording
from carom.worlds import load_text

FIRST, LAST = 20, 34
WORLD = """
carom: 1
name: heap and bullet
run: {frames: 40}
prefabs:
  box: {collider: {box: {size: [1, 1, 1]}}, body: {}}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: wall, collider: {box: {size: [0.05, 4, 4]}}, transform: {position: [10, 2, 0]}}
  - {name: lower, prefab: box, transform: {position: [0, 0.55, 0]}}
  - {name: upper, prefab: box, transform: {position: [0.1, 1.65, 0.1]}}
  - {name: knob, parent: {entity: upper, position: [0, 0.6, 0]}, visual: {sphere: {radius: 0.1}}}
  - name: bullet
    collider: {box: {size: [0.4, 0.05, 0.05]}}
    body: {gravity_scale: 0}
    transform: {position: [-14, 2, 1.5]}
    motion: {linear: [60, 0, 0], angular: [0, 0, 100]}
"""


pytestmark = pytest.mark.usefixtures("strict_rerun")


class Truth:
    """What a simulation itself says of each frame."""

    def __init__(self, simulation: Simulation) -> None:
        self.simulation, self.solving = simulation, Solving(simulation)
        self.poses: dict[tuple[int, int], Any] = {}
        self.fast: dict[int, set[frozenset[str]]] = {}
        simulation.hearers.append(self.note)

    def note(self, system: System) -> None:
        """Keep where bodies are after each substep, and who is looked after."""
        world = self.simulation.world
        frame, part = world.frame, world[Progress].substep
        if system.name == "relax":
            columns = world[Transform].position, world[Transform].rotation
            self.poses[frame, part] = [column.astype(np.float32) for column in columns]
        if system.name == "find_contacts":
            self.fast[frame] = set()
        if frame in self.fast:  # also who is looked after from an impact on
            pairs = world.entities(world[Fast].pairs.ravel()).reshape(-1, 2)
            self.fast[frame] |= {frozenset(world.name(entity) for entity in pair) for pair in pairs}


@pytest.fixture(scope="module")
def part(tmp_path_factory: pytest.TempPathFactory) -> tuple[Recording, Simulation, Truth, list[Any], list[Any]]:
    """Return some frames recorded in detail by a replay; the simulation, and what it says of sweeps and levels."""
    folder = tmp_path_factory.mktemp("solver")
    world, whole, part = folder / "world.yaml", folder / "rec.rrd", folder / "part.rrd"
    world.write_text(WORLD)
    assert main(["run", str(world), "--record", str(whole)]) == 0
    frames = ["--from", str(FIRST), "--to", str(LAST)]
    assert main(["replay", str(whole), *frames, "--out", str(part), "--detail", "solver"]) == 0
    simulation = load_text(WORLD).simulation
    simulation.step(FIRST)
    truth, sweeps, levels = Truth(simulation), [], []
    for frame in range(FIRST + 1, LAST + 1):
        simulation.step()
        sweeps += [(frame, sweep) for sweep in truth.solving.sweeps]
        levels += [(frame, level) for level in truth.solving.levels]
    return Recording(part), simulation, truth, sweeps, levels


def test_sweeps_and_levels_are_those_of_the_run(part: Any) -> None:
    """Every number of each of them."""
    recording, _, _, sweeps, levels = part
    table = recording.table("sweeps").polars()
    columns = ["frame", "time", "part", "stage", "number", "residual", "residual_sum"]
    assert table.columns == columns
    assert table.rows() == [(frame, *(getattr(sweep, name) for name in columns[1:])) for frame, sweep in sweeps]
    table = recording.table("levels").polars()
    assert table.rows() == [(frame, level.time, level.part, *level[2:]) for frame, level in levels]
    number = Counter((frame, sweep.part) for frame, sweep in sweeps)
    assert len(number) == 4 * (LAST - FIRST)
    assert set(number.values()) == {5, 2}  # where the rod is measured anew on its way, nothing is relaxed


def test_a_substep_is_told_in_one_row(part: Any) -> None:
    """Of its sweeps the last of each stage, of its levels the sums."""
    recording, _, _, sweeps, levels = part
    table = recording.table("solver").polars()
    assert table.height == 4 * (LAST - FIRST)
    for row in table.iter_rows(named=True):
        held = [sweep for frame, sweep in sweeps if (frame, sweep.part) == (row["frame"], row["part"])]
        of_it = [level for frame, level in levels if (frame, level.part) == (row["frame"], row["part"])]
        relaxed = [sweep.residual for sweep in held if sweep.stage == "relax"]
        assert row["solved"] == held[1].residual
        assert np.isnan(row["relaxed"]) if not relaxed else row["relaxed"] == relaxed[-1]
        assert (row["open"], row["sliding"]) == (held[-1].open, held[-1].sliding)
        assert row["levels"] == len(of_it)
        assert row["manifolds"] == sum(level.manifolds for level in of_it) >= 2
        assert row["points"] == sum(level.points for level in of_it) >= 8
        assert row["warm"] == row["points"] - held[0].open
    relaxed = polars.col("relaxed").fill_nan(None).max().fill_null(0.0)  # where nothing is, the curve is at 0
    worst = table.group_by("frame", maintain_order=True).agg(polars.max("solved"), relaxed)
    curves = recording.table("residual").polars().filter(polars.col("frame") > FIRST)
    assert curves.select("frame", "solve", "relax").rows() == worst.rows()


def test_poses_of_every_substep_are_there(part: Any) -> None:
    """Of what others carry too; those of frames are as they would be without."""
    recording, simulation, truth, _, _ = part
    world, table = simulation.world, recording.table("substeps").polars()
    assert table.columns[:5] == ["frame", "part", "time", "entity", "name"]
    for (frame, number), (positions, rotations) in truth.poses.items():
        at = table.filter((polars.col("frame") == frame) & (polars.col("part") == number))
        assert at["time"][0] == pytest.approx((frame - 1 + number / 4) / 60, abs=1e-9)
        found = {row["name"]: row for row in at.iter_rows(named=True)}
        assert found.keys() == {"floor", "wall", "lower", "upper", "knob", "bullet"}
        for name in found.keys() - {"knob"}:
            row = world.row(world.find(name))
            assert tuple(positions[row]) == tuple(found[name][f"position.{axis}"] for axis in "xyz")
            assert tuple(rotations[row]) == tuple(found[name][f"rotation.{axis}"] for axis in "xyzw")
        lifts = [found["knob"][f"position.{axis}"] - found["upper"][f"position.{axis}"] for axis in "xyz"]
        assert lifts == pytest.approx([0.0, 0.6, 0.0], abs=2e-3)
    frames = table.filter(polars.col("part") == 4).drop("part")
    assert frames.rows() == recording.table("bodies").polars().select(frames.columns).rows()


def test_who_was_fast_is_told_with_when_they_struck(part: Any) -> None:
    """In the frame of the impact alone is there a time, between those of two frames."""
    recording, _, truth, _, _ = part
    table = recording.table("fast").polars()
    told: dict[int, set[frozenset[str]]] = {frame: set() for frame in truth.fast}
    for row in table.iter_rows(named=True):
        told[row["frame"]].add(frozenset((row["a.name"], row["b.name"])))
    assert told == truth.fast
    assert {frozenset(("bullet", "wall"))} == set.union(*map(set, told.values()))
    impacts = recording.table("impacts").polars().group_by("frame", "a.name", "b.name").agg(polars.all().first())
    known = {(row["frame"], frozenset((row["a.name"], row["b.name"]))): row for row in impacts.iter_rows(named=True)}
    struck = table.filter(polars.col("struck").is_not_nan())
    assert 60 * struck["struck"][0] == pytest.approx(24, abs=0.5)
    for row in table.iter_rows(named=True):
        impact = known.get((row["frame"], frozenset((row["a.name"], row["b.name"]))))
        found = (None, None) if np.isnan(row["struck"]) else (row["struck"], row["speed"])
        assert found == ((impact["time"], impact["speed"]) if impact else (None, None))


def test_ways_of_measuring_are_counted(tmp_path: Path) -> None:
    """By each recorded frame, since the one before; in all as many as the simulation says."""
    simulation, path = load_text(WORLD).simulation, tmp_path / "a.rrd"
    simulation.step(10)
    before = Counter(vars(simulation.world[Answered]))
    with observed(simulation, Recorder(path, every=3, detail="solver")):
        simulation.step(26)
    assert not simulation.hearers
    table = Recording(path).table("detection").polars()
    assert table["frame"].to_list() == [10, *range(12, 37, 3)]
    for name, count in vars(simulation.world[Answered]).items():
        assert table[name].sum() == count - before[name]
    assert table["recycled"].sum() > 0
    assert Recording(path).table("solver").polars()["frame"].unique().to_list() == list(range(11, 37))
    ends = Recording(path).table("substeps").polars().filter(polars.col("part") == 4)
    assert ends["frame"].unique().to_list() == list(range(10, 37))


def test_every_system_that_ran_has_its_milliseconds(tmp_path: Path) -> None:
    """Also a Python force without a name; from `full` on. The dearest are beside each other, all others below them."""
    simulation, path = load_text(WORLD).simulation, tmp_path / "a.rrd"
    simulation.force_function(lambda world, rows: np.zeros((len(rows), 3)))
    with observed(simulation, Recorder(path, every=1, detail="full")):
        simulation.step(3)
    table = Recording(path).table("milliseconds")
    timings: Timings = simulation.world[Timings]
    spent = {name.strip("()<>"): 1e3 * timing.last_seconds for name, timing in timings.items() if timing.last_calls}
    rows = table.polars()
    assert rows["frame"].to_list() == [1, 2, 3]
    assert rows.row(2, named=True) == {"frame": 3, "time": 0.05} | spent
    assert table.arrow().schema.field("lambda").metadata[b"unit"] == b"ms"
    names = [at.removeprefix("/plots/milliseconds/") for at, _ in read(path).series if "milliseconds" in at]
    seen = {name for name in names if "/" not in name}
    assert len(seen) == 8 and {name.removeprefix("others/") for name in names} == spent.keys()
    middle = {name: sorted(rows[name])[1] for name in spent if rows[name].is_not_nan().all()}
    assert min(middle[name] for name in seen & middle.keys()) >= max(middle[name] for name in middle.keys() - seen)


def test_joints_alone_leave_no_contact_open(tmp_path: Path) -> None:
    """Where nothing touches but a joint is solved there are sweeps, without levels and with nothing left."""
    simulation, path = Simulation(), tmp_path / "a.rrd"
    bob = simulation.add(collider={"sphere": {"radius": 0.1}}, body={}, transform={"position": (1.0, 0.0, 0.0)})
    simulation.world.spawn(Joint(b=bob, a=-1, anchor_b=(-1.0, 0.0, 0.0), mode=(1, 1, 1, 0, 0, 0)))
    with observed(simulation, Recorder(path, every=1, detail="solver")):
        simulation.step(3)
    table = Recording(path).table("solver").polars()
    assert table.height == 12
    for name in ("levels", "groups", "manifolds", "points", "warm", "solved", "relaxed", "open"):
        assert table[name].sum() == 0
    assert "levels" not in Recording(path).tables()
