"""What `full` records is what was simulated: every column of every frame, bit by bit; what Rerun draws in float32."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import polars
import pytest

from carom.ecs import ColliderPose, Motion, RigidBody, World
from carom.ecs.relations.contact import Contact
from carom.systems.bodies import centers_of_mass
from carom.systems.free_body import loads
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recorder.persistence import both
from carom.tools.recording import Recording

BOX = {"box": {"size": (0.2, 0.2, 0.2)}}
FRAMES = 90


class Tracked:
    """A recording of `full`, and what the world held in each of its frames."""

    def __init__(self, path: Path) -> None:
        self.simulation = simulation = scene()
        self.worlds: dict[int, dict[str, Any]] = {}
        with observed(simulation, Recorder(path, every=1, detail="full")):
            self.worlds[0] = held(simulation)
            for frame in range(1, FRAMES + 1):
                if frame == 20:
                    simulation.world.despawn(simulation.world.find("first"))
                if frame == 30:
                    add_box(simulation, "late", (0.0, 0.8, 0.0))  # takes the row of the one that went
                simulation.step()
                self.worlds[frame] = held(simulation)
        self.recording_path, self.recording = path, Recording(path)
        self.tables = {name: self.recording.table(name).polars() for name in self.recording.tables()}

    def rows(self, table: str, frame: int) -> Any:
        """Return the rows of a frame."""
        return self.tables[table].filter(polars.col("frame") == frame)


def scene() -> Simulation:
    """Return boxes and a ball that fall on a floor, with one that rests from the start, and a push."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, -10.0, 0.0))
    simulation.material("rubber", friction=0.9, restitution=0.3)
    simulation.layers({"toys": None})
    simulation.add(name="floor", collider={"plane": {}})
    add_box(simulation, "first", (-1.0, 1.0, 0.0))
    add_box(simulation, "rests", (1.0, 0.1, 0.0))
    add_box(simulation, "turns", (0.3, 0.6, 0.0), {"angular": (1.0, 2.0, 3.0), "linear": (0.5, 0.0, 0.0)})
    simulation.add(
        name="ball", transform={"position": (0.0, 0.4, 1.0)}, body={}, material="rubber",
        collider={"sphere": {"radius": 0.1}, "layer": "toys"},
    )  # fmt: skip
    simulation.force("constant_push", [simulation.world.find("ball")], force=(0.5, 0.0, 0.0))
    return simulation


def add_box(simulation: Simulation, name: str, position: tuple[float, float, float], motion: Any = None) -> None:
    """Add a box of 20 cm."""
    words = {} if motion is None else {"motion": motion}
    simulation.add(name=name, transform={"position": position}, collider=BOX, body={}, **words)


def held(simulation: Simulation) -> dict[str, Any]:
    """Return copies of what tracks record."""
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    found, pose = loads(simulation), world[ColliderPose]
    boxed = np.nonzero(np.isfinite(pose.lower).all(axis=1) & (pose.lower < pose.upper).all(axis=1))[0]
    return {
        "bodies": world.entities(rows), "linear": world[Motion].linear[rows], "angular": world[Motion].angular[rows],
        "asleep": world[Motion].asleep[rows], "still": world[Motion].still[rows],
        "center": centers_of_mass(world, rows),
        "loaded": world.entities(found.body), "force": found.force, "source": found.name, "point": found.point,
        "boxed": world.entities(boxed), "lower": pose.lower[boxed], "upper": pose.upper[boxed],
        "contacts": contacts_of(world),
    }  # fmt: skip


def contacts_of(world: World) -> dict[str, Any]:
    """Return the columns of both tables."""
    names = ("a", "b", "feature", "depth", "normal", "impulse", "friction_impulse", "friction", "point", "by_fcl")
    return {name: both(world, name) for name in (*names, "warm_normal")} | {"awake": world[Contact].count}


@pytest.fixture(scope="module")
def tracked(tmp_path_factory: pytest.TempPathFactory) -> Tracked:
    """Record once for all."""
    return Tracked(tmp_path_factory.mktemp("full") / "full.rrd")


def columns(rows: Any, name: str) -> Any:
    """Return a vector (n, 3) of a table."""
    return rows.select(f"{name}.{axis}" for axis in "xyz").to_numpy()


def test_velocities_are_those_of_every_body(tracked: Tracked) -> None:
    """In float64, of those too that come late, by their handles; centres of mass are drawn, in float32."""
    for frame, world in tracked.worlds.items():
        rows = tracked.rows("velocities", frame)
        assert np.array_equal(rows["body"], world["bodies"])
        for name in ("linear", "angular"):
            assert np.array_equal(columns(rows, name), world[name])
        assert np.array_equal(columns(rows, "center"), world["center"].astype(np.float32))


def test_bodies_that_come_and_go_keep_their_identity(tracked: Tracked) -> None:
    """Who took the row of another is another, in every table."""
    for table, who in (("velocities", "body"), ("forces", "body"), ("bounds", "collider"), ("states", "body")):
        frames = {
            name: tracked.tables[table].filter(polars.col(f"{who}.name") == name)["frame"] for name in ("first", "late")
        }
        assert frames["first"].max() == 19, table
        assert frames["late"].min() == 30, table
        handles = tracked.tables[table].filter(polars.col(f"{who}.name").is_in(["first", "late"]))
        assert handles.group_by(f"{who}.name").agg(polars.col(who).n_unique())[who].to_list() == [1, 1]
        assert handles[who].n_unique() == 2


def test_forces_are_all_contributions(tracked: Tracked) -> None:
    """As the free-body diagram has them; on a body that rests they add up to nothing."""
    for frame, world in tracked.worlds.items():
        rows = tracked.rows("forces", frame)
        assert np.array_equal(rows["body"], world["loaded"])
        assert rows["source"].to_list() == world["source"]
        assert np.array_equal(columns(rows, "force"), world["force"])
        assert np.array_equal(columns(rows, "point"), world["point"].astype(np.float32))
    assert set(tracked.tables["forces"]["source"]) == {"gravity", "constant push", "normal", "friction"}
    rests = tracked.rows("forces", FRAMES).filter(polars.col("body.name") == "rests")
    weight = abs(rests.filter(polars.col("source") == "gravity")["force.y"][0])
    assert weight == pytest.approx(80.0, rel=1e-12)  # 1000 kg/m3 (0.2 m)^3 10 m/s2
    assert np.abs(columns(rests, "force").sum(axis=0)).max() < 1e-3 * weight


def test_bounds_are_those_of_the_last_step(tracked: Tracked) -> None:
    """Of every collider that has an end; before the first step there are none."""
    for frame, world in tracked.worlds.items():
        rows = tracked.rows("bounds", frame)
        assert np.array_equal(rows["collider"], world["boxed"])
        for name in ("lower", "upper"):
            assert np.array_equal(columns(rows, name), world[name])
    assert set(tracked.tables["bounds"]["collider.name"]) == {"first", "rests", "turns", "ball", "late"}


def test_manifolds_are_all_points(tracked: Tracked) -> None:
    """Of pairs that touch, may touch or sleep, with who found them."""
    for frame, world in tracked.worlds.items():
        rows, expected = tracked.rows("manifolds", frame), world["contacts"]
        for name in ("a", "b", "feature", "depth", "impulse", "friction"):
            assert np.array_equal(rows[name], expected[name])
        for name in ("normal", "friction_impulse"):
            assert np.array_equal(columns(rows, name), expected[name])
        assert np.array_equal(columns(rows, "point"), expected["point"].astype(np.float32))
        assert np.array_equal(rows["found_by"] == "FCL", expected["by_fcl"])
        touching = (expected["depth"] >= 0.0) | (expected["impulse"] > 0.0)
        asleep = np.arange(len(touching)) >= expected["awake"]
        assert np.array_equal(rows["state"] == "asleep", asleep)
        assert np.array_equal(rows["state"] == "touching", touching & ~asleep)
    assert set(tracked.tables["manifolds"]["state"]) == {"touching", "speculative", "asleep"}


def test_points_that_go_on_age_and_start_warm(tracked: Tracked) -> None:
    """The corners of a box that rests: from the impulse of the step before, and from none at first."""
    rests = tracked.tables["manifolds"].filter(polars.col("b.name") == "rests")
    corner = rests.filter(polars.col("feature") == rests["feature"][0]).sort("frame")
    assert corner["frame"].to_list() == list(range(1, FRAMES + 1))
    assert corner["age"].to_list() == pytest.approx(np.arange(FRAMES) / 60, abs=1e-12)
    warm = []
    for frame in range(1, FRAMES + 1):
        held = tracked.worlds[frame]["contacts"]
        one = (held["b"] == corner["b"][0]) & (held["feature"] == corner["feature"][0])
        warm.append(held["warm_normal"][one][0])
    assert corner["warm_start"].to_list() == [0.0, *warm[:-1]]
    assert min(warm) > 0.0


def test_states_tell_who_sleeps_and_who_keeps_whom_awake(tracked: Tracked) -> None:
    """The box that rests is slow enough at once and sleeps after half a second; who falls is awake."""
    for frame, world in tracked.worlds.items():
        rows = tracked.rows("states", frame)
        assert np.array_equal(rows["body"], world["bodies"])
        assert np.array_equal(rows["state"] == "asleep", world["asleep"])
        assert np.array_equal(rows["still"], world["still"])
        assert np.array_equal(rows["kept_awake_by"] == -1, world["asleep"])
    rests = tracked.tables["states"].filter(polars.col("body.name") == "rests")
    states = rests["state"].to_list()
    asleep = states.index("asleep")
    assert states[:2] == ["awake", "eligible"]
    assert set(states[1:asleep]) == {"eligible"}
    assert rests["still"][asleep - 1] == pytest.approx(0.5, abs=1.01 / 60)
    alone = rests.filter(polars.col("state") != "asleep")
    assert set(alone["kept_awake_by.name"]) == {"rests"}
    ball = tracked.rows("states", 5).filter(polars.col("body.name") == "ball")
    assert ball["state"].to_list() == ["awake"]
    sleep = tracked.tables["sleep"]
    counted = tracked.tables["states"].filter(polars.col("state") == "asleep").group_by("frame").len()
    assert dict(counted.rows()) == dict(sleep.filter(polars.col("asleep") > 0).select("frame", "asleep").rows())


def test_colliders_are_told_when_they_change(tracked: Tracked) -> None:
    """In the first frame and where somebody came or went: layers, materials and shapes by name."""
    table = tracked.tables["colliders"]
    assert sorted(set(table["frame"])) == [0, 20, 30]
    rows = table.filter((polars.col("frame") == 0) & (polars.col("collider.name") == "ball"))
    ball = rows.to_dicts()[0]
    told = {name: ball[name] for name in ("shape", "layer", "collides_with", "material", "friction", "restitution")}
    assert told == {
        "shape": "sphere", "layer": "toys", "collides_with": "default,toys", "material": "rubber", "friction": 0.9,
        "restitution": 0.3,
    }  # fmt: skip
    floor = table.filter((polars.col("frame") == 30) & (polars.col("collider.name") == "floor")).to_dicts()[0]
    assert (floor["body"], floor["body.name"], floor["shape"], floor["material"]) == (-1, None, "plane", "")


def test_trails_go_from_frame_to_frame(tracked: Tracked) -> None:
    """Of those who were there in both and moved, from where they were to where they are."""
    strips = read(tracked.recording_path).series["/world/trails", "LineStrips3D:strips"]
    assert strips.frames == list(range(FRAMES + 1))
    assert len(strips.values[0]) == 0
    for frame in range(1, FRAMES + 1):
        before, now = tracked.worlds[frame - 1], tracked.worlds[frame]
        both_there = [entity for entity in sorted(before["bodies"].tolist()) if entity in now["bodies"]]
        ways = [[one["center"][one["bodies"].tolist().index(entity)] for one in (before, now)] for entity in both_there]
        expected = [way for way in ways if (way[0] != way[1]).any()]
        assert np.array_equal(np.array(strips.values[frame], np.float32), np.array(expected, np.float32))


def test_of_some_alone_nobody_else_is_recorded(tmp_path: Path) -> None:
    """In tables, trails and shapes; whom they touch is in their contacts."""
    simulation, path = scene(), tmp_path / "ball.rrd"
    recorder = Recorder(path, every=1, detail="full", only=["ball"])
    recorder.begin(simulation)
    for _ in range(20):
        simulation.step()
        recorder.observe(simulation)
    recorder.end(simulation)
    recording, series = Recording(path), read(path).series
    for table, who in (("velocities", "body"), ("forces", "body"), ("bounds", "collider"), ("states", "body")):
        assert set(recording.table(table).polars()[f"{who}.name"]) == {"ball"}, table
    manifolds = recording.table("manifolds").polars()
    assert set(zip(manifolds["a.name"], manifolds["b.name"], strict=True)) == {("floor", "ball")}
    assert [len(ways) for ways in series["/world/trails", "LineStrips3D:strips"].values] == [0, *[1] * 20]
    assert list(series["/world/shapes/balls", "Ellipsoids3D:labels"].values) == [["ball"]]
    assert list(series["/world/shapes/boxes", "Boxes3D:labels"].values) == [[]]
