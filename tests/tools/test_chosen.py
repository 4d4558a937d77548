"""Who is chosen: recordings of some alone, and bodies with paths, plots, labels and lanes of their own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, Parent, RigidBody, Transform, state_hash
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.ecs.relations.touching import Touching
from carom.systems.energy import kinetic_energy, potential_energy
from carom.systems.simulation import Simulation
from carom.tools.cli import main
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording

WORLD = """
carom: 1
run: {frames: 120}
entities:
  - {name: ground, collider: {plane: {}}}
  - {name: crate, collider: {box: {size: [1, 1, 1]}}, body: {mass: 2}, transform: {position: [0, 0.7, 0]}}
  - {name: rain, grid: {count: [2, 1, 2], spacing: 1, origin: [3, 0.9, 0]}, collider: {sphere: {radius: 0.2}}, body: {}}
  - {name: gate, collider: {box: {size: [1, 0.3, 1]}, sensor: true}, transform: {position: [0, 0.2, 0]}}
"""


@pytest.fixture(scope="module")
def world(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the file of a world in which a crate and four balls fall on the ground."""
    path = tmp_path_factory.mktemp("chosen") / "world.yaml"
    path.write_text(WORLD)
    return path


def test_only_those_chosen_are_recorded(world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Their poses, contacts, impacts and lines; those they touch keep their names; it is replayed to the same bits."""
    every, some = tmp_path / "all.rrd", tmp_path / "some.rrd"
    assert main(["run", str(world), "--record", str(every)]) == 0
    assert main(["run", str(world), "--record", str(some), "--only", "rain", "--promote", "rain[0,0,1]"]) == 0
    whole, part = Recording(every), Recording(some)
    rain = {f"rain[{x},0,{z}]" for x in (0, 1) for z in (0, 1)}
    for frame in (0, 60, 120):
        assert set(part.names(frame).values()) == rain
        for entity, pose in part.poses(frame).items():
            assert all(map(np.array_equal, pose, whole.poses(frame)[entity]))
    for name in ("contacts", "impacts"):
        expected = [row for row in rows(whole, name) if {row["a.name"], row["b.name"]} & rain]
        assert rows(part, name) == expected and len(expected) > 3, name
        assert {row["a.name"] for row in expected} == {"ground"}
    assert [line for line in whole.lines if "rain" in line.text] == part.lines
    assert len(part.lines) < len(whole.lines)
    capsys.readouterr()
    assert main(["replay", str(some)]) == 0
    assert "the same, bit for bit" in capsys.readouterr().out


def rows(recording: Recording, table: str) -> list[dict[str, Any]]:
    """Return the rows of a table."""
    found: list[dict[str, Any]] = recording.table(table).arrow().to_pylist()
    return found


def test_a_query_chooses_whoever_it_finds(tmp_path: Path) -> None:
    """Bodies but those that are static, one that comes later too; the recording says by what they were chosen."""
    simulation, path = Simulation(dt=1 / 60), tmp_path / "query.rrd"
    words: dict[str, Any] = {"collider": {"sphere": {"radius": 0.2}}, "body": {}}
    simulation.add(name="ground", collider={"plane": {}})
    simulation.add(name="early", transform={"position": (0.0, 0.1, 0.0)}, **words)
    bodies = simulation.world.query(RigidBody, without=Parent)
    recorder = Recorder(path, every=1, only=bodies, promote=bodies)
    simulation.observers.append(recorder)
    recorder.begin(simulation)
    simulation.step(2)
    simulation.add(name="late", transform={"position": (1.0, 0.1, 0.0)}, **words)
    simulation.step(2)
    recorder.end(simulation)
    recording = Recording(path)
    assert [set(recording.names(frame).values()) for frame in (2, 4)] == [{"early"}, {"early", "late"}]
    assert {row["entity.name"] for row in rows(recording, "promoted") if row["frame"] == 4} == {"early", "late"}
    assert list(recording.static["/about"]["only"]) == ["RigidBody", "without Parent"]


def test_an_unknown_name_is_told(world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """And nothing is written."""
    path = tmp_path / "a.rrd"
    for option in ("--only", "--promote"):
        assert main(["run", str(world), "--record", str(path), option, "crat"]) == 2
        names = "ground, crate, rain[0,0,0], rain[0,0,1], rain[1,0,0], rain[1,0,1], gate"
        told = f"{option}: unknown entity; received 'crat'; accepted: {names}; did you mean 'crate'?\n"
        assert capsys.readouterr().err == told
    assert not path.exists()


def falling(path: Path, **options: Any) -> tuple[Simulation, list[dict[str, Any]]]:
    """Record a crate that falls and slides to rest beside balls; return what the simulation had in every frame."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(name="ground", collider={"plane": {}})
    crate = simulation.add(
        name="crate",
        collider={"box": {"size": (1.0, 1.0, 1.0)}},
        body={"mass": 2.0},
        transform={"position": (0.0, 0.7, 0.0)},
        motion={"linear": (1.0, 0.0, 0.0)},
    )
    recorder = Recorder(path, every=1, **options)
    simulation.observers.append(recorder)
    seen, touches = [], "nobody"
    recorder.begin(simulation)
    for frame in range(121):
        if frame:
            simulation.step()
        world = simulation.world
        row = world.row(crate)
        contact = world[SleepingContact if world[Motion].asleep[row] else Contact]
        live = slice(0, contact.count)
        sign = np.where(contact.b[live] == crate, 1.0, -1.0)[:, None] / simulation.settings.dt
        before, touches = touches, "ground" if world[Touching].count else "nobody"
        seen.append(
            {
                "frame": frame,
                "before": before,
                "touches": touches,
                "position": world[Transform].position[row].tolist(),
                "speed": float(np.linalg.norm(world[Motion].linear[row])),
                "kinetic": kinetic_energy(world),
                "potential": potential_energy(world),
                "normal": (sign * contact.impulse[live, None] * contact.normal[live]).sum(axis=0).tolist(),
                "friction": (sign * contact.friction_impulse[live]).sum(axis=0).tolist(),
                "asleep": bool(world[Motion].asleep[row]),
                "hash": state_hash(world),
            }
        )
    recorder.end(simulation)
    return simulation, seen


def test_a_promoted_body_is_told_of_in_full(tmp_path: Path) -> None:
    """What the table holds is what the simulation had: the pose, speed, energies and forces of each frame."""
    _, seen = falling(tmp_path / "a.rrd", promote=["crate"])
    table = rows(Recording(tmp_path / "a.rrd"), "promoted")
    assert [row["frame"] for row in table] == list(range(121))
    assert {row["entity.name"] for row in table} == {"crate"}
    for row, had in zip(table, seen, strict=True):
        assert [row[f"position.{axis}"] for axis in "xyz"] == had["position"]
        for name in ("speed", "kinetic", "potential"):
            assert row[name] == pytest.approx(had[name], rel=1e-12, abs=1e-12)
        for name in ("normal", "friction"):
            assert [row[f"{name}.{axis}"] for axis in "xyz"] == pytest.approx(had[name], rel=1e-9, abs=1e-9)
        assert [row[f"joint.{axis}"] for axis in "xyz"] == [0.0, 0.0, 0.0]
        assert [row[f"applied.{axis}"] for axis in "xyz"] == pytest.approx([0.0, -2.0 * 9.81, 0.0], abs=0.02)
    assert max(row["normal.y"] for row in table) > 20.0 and min(row["friction.x"] for row in table) < -1.0


def test_a_promoted_body_has_a_path_a_label_curves_and_a_lane(tmp_path: Path) -> None:
    """The label stands where it does; the lane says when it falls asleep; no bit of the run knows of it."""
    _, seen = falling(tmp_path / "a.rrd", promote=["crate"])
    _, plain = falling(tmp_path / "b.rrd")
    assert [had["hash"] for had in seen] == [had["hash"] for had in plain]
    series = read(tmp_path / "a.rrd").series
    labels = series["/world/labels/crate", "Points3D:positions"]
    assert np.array_equal(labels.values[50][0], np.array(seen[50]["position"], np.float32))
    speeds = series["/promoted/crate/speed/speed", "Scalars:scalars"]
    assert [float(value[0]) for value in speeds.values] == pytest.approx([had["speed"] for had in seen])
    sizes = series["/promoted/crate/force/normal", "Scalars:scalars"]
    assert float(sizes.values[100][0]) == pytest.approx(np.linalg.norm(seen[100]["normal"]))
    lane = series["/lanes/sleep/crate", "StateChange:state"]
    fell = [had["asleep"] for had in seen].index(True)
    assert list(zip(lane.frames, [value[0] for value in lane.values], strict=True)) == [(0, "awake"), (fell, "asleep")]
    lane = series["/lanes/touching/crate", "StateChange:state"]
    told = [(0, "nobody"), *((had["frame"], had["touches"]) for had in seen if had["touches"] != had["before"])]
    assert {"nobody", "ground"} == {state for _, state in told}
    assert list(zip(lane.frames, [value[0] for value in lane.values], strict=True)) == told


def test_a_recording_of_nobody_visible_is_a_table_without_rows(world: Path, tmp_path: Path) -> None:
    """With its columns; and whom it is of is told by name."""
    path = tmp_path / "a.rrd"
    assert main(["run", str(world), "--record", str(path), "--only", "gate"]) == 0
    recording = Recording(path)
    assert recording.table("bodies").arrow().num_rows == 0
    assert "position.x" in recording.table("bodies").arrow().column_names
    assert {row["sensor.name"] for row in rows(recording, "triggers")} == {"gate"}


def test_one_promoted_of_many_alike_is_drawn_alone(world: Path, tmp_path: Path) -> None:
    """At a path called by its full name."""
    path = tmp_path / "a.rrd"
    assert main(["run", str(world), "--record", str(path), "--frames", "4", "--promote", "rain[0,0,1]"]) == 0
    recording = Recording(path)
    handles = {name: handle for handle, name in recording.names(0).items()}
    assert recording.place(handles["rain[0,0,1]"], 0) == (r"/world/sphere/rain\[0\,0\,1\]", [handles["rain[0,0,1]"]])
    assert len(recording.place(handles["rain[0,0,0]"], 0)[1]) == 3


def test_occupants_of_a_sensor_are_a_table_and_a_lane(world: Path, tmp_path: Path) -> None:
    """From the frame in which the crate came in."""
    path = tmp_path / "a.rrd"
    assert main(["run", str(world), "--record", str(path)]) == 0
    recording = Recording(path)
    entered = next(line for line in recording.lines if line.text == "crate enters gate")
    table = rows(recording, "triggers")
    assert {(row["sensor.name"], row["entity.name"]) for row in table} == {("gate", "crate")}
    assert [row["frame"] for row in table] == list(range(entered.frame, 121))
    assert [row["since"] for row in table] == pytest.approx([entered.time] * len(table), abs=1e-9)
    lane = read(path).series["/lanes/triggers/gate", "StateChange:state"]
    told = list(zip(lane.frames, [value[0] for value in lane.values], strict=True))
    assert told == [(0, "empty"), (entered.frame, "crate")]
