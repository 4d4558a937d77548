"""Recordings hold what was simulated: poses, contacts, impacts and plots are read back and compared."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from recorded import BLUE, RED, assert_same_poses, ball, falling_world, poses, record

from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.touching import ContactBegin, ContactEnd
from carom.systems.ledger import Ledger
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.recorder import Recorder
from carom.tools.recorder.tracks.contacts import Contacts
from carom.tools.recording import Recording

pytestmark = pytest.mark.usefixtures("strict_rerun")


def test_every_recorded_pose_is_the_simulations_in_float32(tmp_path: Path) -> None:
    """Spheres, a capsule and a shape that sits off its body's origin."""
    seen = record(falling_world(), tmp_path / "run.rrd", 300)
    recording = Recording(tmp_path / "run.rrd")
    assert recording.frames == list(range(0, 301, 4))  # dt 1/240: every fourth step makes 60 frames a second
    assert recording.times[240] == pytest.approx(1.0, abs=1e-9)
    for frame in recording.frames:
        assert_same_poses(recording, frame, seen[frame])


def test_every_asks_for_other_frames(tmp_path: Path) -> None:
    """Counted in steps."""
    record(falling_world(), tmp_path / "run.rrd", 30, every=10)
    assert Recording(tmp_path / "run.rrd").frames == [0, 10, 20, 30]


def test_bodies_that_come_and_go_keep_their_identity(tmp_path: Path) -> None:
    """Also those that change colour or hide, and one that takes the row of another."""
    simulation = falling_world()
    with observed(simulation, Recorder(tmp_path / "run.rrd", every=1)):
        seen = {0: poses(simulation)}
        for frame in range(1, 61):
            if frame == 10:
                simulation.world.despawn(simulation.world.find("ball[2]"), simulation.world.find("capsule"))
            if frame == 20:
                ball(simulation, "late", (0.0, 2.0, 0.0), BLUE)  # takes the row of one that went, as another entity
            if frame == 30:
                simulation["late"].visual.color = (*RED, 1.0)
            if frame == 40:
                simulation["late"].visual.visible = False
            simulation.step()
            seen[frame] = poses(simulation)
    recording = Recording(tmp_path / "run.rrd")
    for frame, expected in seen.items():
        assert_same_poses(recording, frame, expected)
    assert "late" in recording.names(25).values()
    assert "capsule" in recording.names(5).values()


def test_contacts_are_recorded_with_both_colliders_and_exact_numbers(tmp_path: Path) -> None:
    """Points are float32, as Rerun draws them; numbers stay float64."""
    simulation = falling_world()
    with observed(simulation, Recorder(tmp_path / "run.rrd", every=1)):
        seen = {}
        for _ in range(200):
            simulation.step()
            contact = simulation.world[Contact]
            touching = (contact.depth[: contact.count] >= 0.0) | (contact.impulse[: contact.count] > 0.0)
            columns = ("a", "b", "point", "normal", "depth", "impulse")
            rows = {name: getattr(contact, name)[: contact.count][touching] for name in columns}
            seen[simulation.frame] = rows | {"speed": Contacts().rows(simulation)["speed"]}
    recording = Recording(tmp_path / "run.rrd")
    assert sum(len(rows["a"]) for rows in seen.values()) > 20
    for frame, expected in seen.items():
        received = recording.contacts(frame)
        assert np.array_equal(received["point"], expected["point"].astype(np.float32))
        for name in ("a", "b", "normal", "depth", "impulse", "speed"):
            assert np.array_equal(received[name], expected[name]), (frame, name)


def test_speed_of_a_contact_is_that_of_both_surfaces_along_its_normal() -> None:
    """Travel, and the spin about the centre of mass; one that stands gives nothing, and one that is gone neither."""
    simulation = Simulation()
    floor = simulation.add(name="floor", collider={"plane": {}})
    one = ball(simulation, "one", (0.0, 0.0, 0.0))
    other = ball(simulation, "other", (0.2, 0.0, 0.0))
    simulation["one"].motion.linear, simulation["one"].motion.angular = (3.0, 5.0, 7.0), (0.0, 0.0, 2.0)
    simulation["other"].motion.linear = (-0.5, 1.0, 0.0)
    with simulation.world.faces(None):  # as a system has it
        simulation.world.resize(Contact, 4)
        contact = simulation.world[Contact]
        contact.a[:4], contact.b[:4] = [one, one, one, floor], [other, other, floor, floor]
        contact.point[:4], contact.normal[:4], contact.depth[:4] = (0.1, 0.1, 0.0), (1.0, 0.0, 0.0), [-1e-9, 0, 0, 0]
    rows = Contacts().rows(simulation)
    assert rows["speed"] == pytest.approx([3.0 - 0.2 + 0.5, 3.0 - 0.2, 0.0], abs=1e-6)
    assert rows["b"].tolist() == [other, floor, floor], "those that only may touch are left out"
    simulation.world.despawn(other)
    assert Contacts().rows(simulation)["speed"][0] == pytest.approx(2.8, abs=1e-6)


def test_impacts_of_every_step_become_lines_at_their_own_time(tmp_path: Path) -> None:
    """Not at the time of the next recorded frame."""
    simulation = Simulation(dt=1 / 240)
    simulation.add(name="floor", collider={"plane": {}})
    ball(simulation, "ball", (0.0, 0.3, 0.0))
    ball(simulation, "still", (1.0, 0.05, 0.0))
    loud = simulation.settings.hit_speed
    struck: list[float] = []
    speeds: list[float] = []
    others: list[tuple[float, str]] = []
    with observed(simulation, Recorder(tmp_path / "run.rrd")):
        for _ in range(120):
            simulation.step()
            impact = simulation.world[Impact]
            struck += list(impact.time[: impact.count])
            speeds += list(impact.speed[: impact.count])
            for kind, deed in ((ContactBegin, "touch"), (ContactEnd, "part")):
                table = simulation.world[kind]
                names = simulation.world.names_told(table.b[: table.count])
                others += [(t, f"floor and {name} {deed}") for t, name in zip(table.time.tolist(), names, strict=False)]
    recording = Recording(tmp_path / "run.rrd")
    lines, table = recording.lines, recording.table("impacts").polars()
    assert len(struck) > 0
    assert table["time"].to_list() == struck
    assert table["speed"].to_list() == speeds
    assert set(table["b.name"]) == {"ball"}
    strikes = [line for line in lines if "strike" in line.text]
    assert [line.time for line in strikes] == pytest.approx(struck, abs=1e-9)
    assert strikes[0].text.startswith("floor and ball strike at 2.21 m/s, ")
    assert [line.level for line in strikes] == ["INFO" if speed >= loud else "DEBUG" for speed in speeds]
    told = [(line.time, line.text) for line in lines if line not in strikes]
    assert {text for _, text in told} == {"floor and still touch", "floor and ball part"}
    unheard = [(time, text) for time, text in others if time not in struck]
    assert sorted(told) == [(pytest.approx(time, abs=1e-9), text) for time, text in sorted(unheard)]


def test_plots_hold_energy_overlap_and_counts(tmp_path: Path) -> None:
    """In full precision."""
    from carom.systems.energy import total_energy

    simulation = falling_world()
    before = total_energy(simulation.world)
    record(simulation, tmp_path / "run.rrd", 40)
    recording = Recording(tmp_path / "run.rrd")
    assert recording.plot("plots/energy/total")[0] == before
    assert recording.plot("plots/energy/total")[40] == total_energy(simulation.world)
    assert recording.plot("plots/counts/bodies")[40] == 8
    assert recording.plot("plots/overlap/deepest_mm").keys() == set(recording.frames)


def test_who_dissipates_is_recorded(tmp_path: Path) -> None:
    """Of every step, by pair; all rows together are what the ledger holds."""
    simulation = Simulation(dt=1 / 240)
    rough = {"friction": 0.4, "restitution": 0.3}
    simulation.add(name="floor", collider={"plane": {}}, material=rough)
    for k in range(3):
        place, motion = {"position": (0.5 * k, 0.3 + 0.1 * k, 0.0)}, {"linear": (1.0 - k, 0.0, 0.0)}
        box = {"box": {"size": (0.3, 0.3, 0.3)}}
        simulation.add(name=f"box {k}", collider=box, body={}, material=rough, transform=place, motion=motion)
    ledger = simulation.keep_ledger()
    record(simulation, tmp_path / "a.rrd", 120)
    table = Recording(tmp_path / "a.rrd").table("dissipation").pandas()
    assert {"floor", "box 0", "box 1", "box 2"} <= {*table["a.name"], *table["b.name"]}
    for kind in ("contacts", "friction", "impacts"):
        assert abs(ledger.since[kind]) > 1e-3
        assert table[kind].sum() == pytest.approx(ledger.since[kind], rel=1e-9)


def test_a_ledger_that_is_kept_is_recorded(tmp_path: Path) -> None:
    """Each entry is a curve of what was given until then; without a ledger there is none."""
    for name, kept in (("kept", True), ("none", False)):
        simulation = falling_world()
        ledger = simulation.keep_ledger() if kept else Ledger()
        record(simulation, tmp_path / f"{name}.rrd", 40)
        recording = Recording(tmp_path / f"{name}.rrd")
        curves = {entry: recording.plot(f"plots/ledger/{entry}") for entry in ("impacts", "gravity")}
        assert {entry: curve[40] for entry, curve in curves.items() if curve} == {
            entry: ledger.since[entry] for entry in curves if kept
        }
