"""Events of world files: when they are carried out, what they do, how they are replayed and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, restore_snapshot, state_hash, take_snapshot
from carom.ecs.errors import DeclarationError
from carom.systems.energy import total_energy
from carom.systems.events import Events
from carom.systems.free_body import loads
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.recorder import Recorder
from carom.tools.replay import Replay
from carom.tools.retrace import retrace
from carom.worlds import LoadedWorld, WorldError, load_text

WORLD = """carom: 1
gravity: [0, 0, 0]
step: {dt: 1/100}
materials: {ice: {friction: 0}}
prefabs: {ball: {collider: {sphere: {radius: 10 cm}}, body: {mass: 2 kg}, material: ice}}
entities:
  - {name: ball, prefab: ball}
  - {name: hung, prefab: ball, transform: {position: [5, 0, 0]}, motion: {linear: [0, 3, 0]}}
  - {name: rod, joint: {distance: {b: hung, anchor_a: [6, 0, 0]}}}
  - {name: lift, collider: {box: {size: [1, 1, 1]}}, body: {type: kinematic}, transform: {position: [0, 9, 0]},
     motion: {linear: [1, 0, 0]}}
events:
"""


def load(*events: str) -> LoadedWorld:
    """Load a world with these events."""
    return load_text(WORLD + "".join(f"  - {{{event}}}\n" for event in events), checked=True)


def faults(*events: str) -> list[str]:
    """Return the messages about events; their lines begin at 13."""
    with pytest.raises(WorldError) as caught:
        load(*events)
    return str(caught.value).splitlines()


@pytest.mark.parametrize(
    ("at", "first"), [("0 s", 1), ("0.1 s", 11), ("0.105 s", 11), ("0.11 s", 12), ("0.0999 s", 10)]
)
def test_it_is_done_at_the_start_of_the_step_that_contains_its_time(at: str, first: int) -> None:
    """A time between two steps is the start of the later one, whatever its last bit: the whole step is flown."""
    simulation = load(f"at: {at}, impulse: {{entities: [ball], linear: [4 N s, 0, 0]}}").simulation
    simulation.step(first - 1)
    assert simulation["ball"].transform.position.tolist() == [0.0, 0.0, 0.0]
    simulation.step()
    assert simulation["ball"].motion.linear.tolist() == [2.0, 0.0, 0.0]
    assert simulation["ball"].transform.position[0] == pytest.approx(2.0 / 100, rel=1e-12)
    simulation.step(5)
    assert simulation["ball"].motion.linear.tolist() == [2.0, 0.0, 0.0]


def test_a_time_beyond_all_counts_of_frames_never_comes() -> None:
    """Divided by the step it has no number."""
    simulation = load("at: 1e308 s, impulse: {entities: [ball], linear: [4 N s, 0, 0]}").simulation
    simulation.step(5)
    assert simulation["ball"].motion.linear.tolist() == [0.0, 0.0, 0.0]


def test_an_impulse_off_the_centre_turns() -> None:
    """J / m and r x J / I, I = 2/5 m r^2; an angular impulse adds to it; the list of forces names its source."""
    words = "at: 0 s, impulse: {entities: [ball], linear: [0, 4, 0], angular: [0.02, 0, 0], at: [0.1, 0, 0]}"
    simulation = load(words).simulation
    simulation.step()
    inertia = 0.4 * 2.0 * 0.01
    assert simulation["ball"].motion.linear == pytest.approx((0.0, 2.0, 0.0), rel=1e-12)
    assert simulation["ball"].motion.angular == pytest.approx((0.02 / inertia, 0.0, 0.4 / inertia), rel=1e-12)
    told = loads(simulation)
    which = told.name.index("impulse")
    assert told.force[which] / 100.0 == pytest.approx((0.0, 4.0, 0.0), rel=1e-12)
    assert told.point[which] == pytest.approx((0.1, 0.0, 0.0), rel=1e-12)


def test_release_lets_go_of_joints_and_lets_kinematic_bodies_fall() -> None:
    """Who was swung flies on along a line; the lift keeps its velocity and then obeys an impulse."""
    loaded = load("at: 0.5 s, release: [rod, lift]", "at: 0.6 s, impulse: {entities: [lift], linear: [0, 1000, 0]}")
    simulation = loaded.simulation
    simulation.step(50)
    velocity = simulation["hung"].motion.linear.copy()
    simulation.step(9)
    assert abs(velocity[0]) > 1.0
    assert simulation["hung"].motion.linear == pytest.approx(velocity, abs=1e-12)
    assert simulation["lift"].motion.linear == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
    simulation.step(2)
    mass = simulation.world[RigidBody].mass[simulation.world.row(simulation.world.find("lift"))]
    assert mass == 1000.0
    assert simulation["lift"].motion.linear == pytest.approx((1.0, 1.0, 0.0), abs=1e-12)


def test_events_of_one_step_are_done_in_their_order() -> None:
    """Who is released or spawned first can be pushed at the same time."""
    simulation = load(
        "at: 0 s, release: [lift]",
        "at: 0 s, spawn: {name: late, prefab: ball, transform: {position: [0, 0, 7]}}",
        "at: 0 s, impulse: {entities: [lift, late], linear: [0, 1000, 0]}",
    ).simulation
    simulation.step()
    assert simulation["lift"].motion.linear == pytest.approx((1.0, 1.0, 0.0), abs=1e-12)
    assert simulation["late"].motion.linear == pytest.approx((0.0, 500.0, 0.0), abs=1e-12)


def test_spawn_and_despawn() -> None:
    """Who is spawned is there from that step on, with its words over the prefab's, and later events name it."""
    simulation = load(
        "at: 0.1 s, spawn: {name: late, prefab: ball, body: {mass: 3 kg}, transform: {position: [0, 0, 7]},"
        " motion: {linear: [0, 0, 1]}, grid: {count: [2, 1, 1], spacing: 1}}",
        "at: 0.2 s, impulse: {entities: [late], linear: [3, 0, 0]}",
        'at: 0.3 s, despawn: ["late[1,*", ball]',
    ).simulation
    simulation.step(10)
    assert "late[0,0,0]" not in simulation.world.names()
    simulation.step()
    assert simulation["late[1,0,0]"].transform.position == pytest.approx((1.0, 0.0, 7.01), abs=1e-12)
    simulation.step(10)
    assert simulation["late[0,0,0]"].motion.linear == pytest.approx((1.0, 0.0, 1.0), abs=1e-12)
    simulation.step(10)
    assert simulation.world.names() == ["hung", "rod", "lift", "late[0,0,0]"]


def test_who_sleeps_is_woken_and_a_still_world_goes_on() -> None:
    """An explosion wakes who it pushes; a world in which nobody moves takes in who is spawned, at once."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    simulation.event(1.5, spawn={"name": "drop", "collider": {"sphere": {"radius": 0.1}}, "body": {},
                                 "transform": {"position": (0.0, 5.0, 0.0)}})  # fmt: skip
    simulation.step(91)
    assert simulation["drop"].transform.position[1] < 5.0
    simulation.step(600)
    row = simulation.world.row(simulation.world.find("drop"))
    assert simulation.world[Motion].asleep[row]
    simulation.event(simulation.time, explode={"position": (-0.3, 0.1, 0.0), "impulse": 500.0})
    simulation.step()
    assert simulation["drop"].motion.linear[0] > 0.5


def test_the_ledger_knows_what_events_gave() -> None:
    """Impulses, who comes and who goes are booked as events; the sum stays that of all energy."""
    simulation = load(
        "at: 0.1 s, impulse: {entities: [ball], linear: [4, 0, 0]}",
        "at: 0.2 s, despawn: [hung]",
        "at: 0.3 s, spawn: {prefab: ball, transform: {position: [0, 0, 7]}, motion: {linear: [0, 0, 5]}}",
    ).simulation
    ledger, before = simulation.keep_ledger(), total_energy(simulation.world)
    simulation.step(50)
    assert ledger.since["events"] == pytest.approx(4.0 - 9.0 + 25.0, rel=1e-3)  # the distance joint lost a little
    assert sum(ledger.since.values()) == pytest.approx(total_energy(simulation.world) - before, abs=1e-12)


def test_a_recording_is_replayed_and_a_snapshot_goes_on_to_the_same_bits(tmp_path: Path) -> None:
    """Events are no edits from outside: the replay carries them out itself."""
    loaded = load(
        "at: 0.05 s, explode: {position: [-1, 0.3, 0], impulse: 50 N s}",
        "at: 0.1 s, spawn: {name: late, prefab: ball, transform: {position: [0, 0, 7]}}",
        "at: 0.15 s, release: [rod, lift]",
        "at: 0.2 s, despawn: [late]",
    )
    simulation = loaded.simulation
    with observed(
        simulation, Recorder(tmp_path / "a.rrd", title="events", source=loaded.source_text, files={}, detail="full")
    ):
        simulation.step(8)
        kept = take_snapshot(simulation.world)
        simulation.step(22)
    simulation.observers.clear()
    replay = Replay(tmp_path / "a.rrd")
    verdict = retrace(replay, replay.loaded(), replay.last)
    assert (verdict.same, verdict.full, verdict.changes, verdict.notes) == (True, 30, [], [])
    assert replay.recording.edits() == {}
    assert set(replay.recording.table("forces").arrow()["source"].to_pylist()) == {"explosion", "joint"}
    reached = state_hash(simulation.world)
    restore_snapshot(simulation.world, kept)
    simulation.step(22)
    assert state_hash(simulation.world) == reached


@pytest.mark.parametrize(
    ("event", "message"),
    [
        ("at: 1 s", ("w:13:5: events.0: must state one action; received none; "
         "accepted: impulse, explode, release, despawn, spawn")),
        ("at: 1 s, release: [rod], despawn: [rod]", ("w:13:5: events.0: must state one action; "
         "received release, despawn; accepted: impulse, explode, release, despawn, spawn")),
        ("at: 1 s, release: [ball, rob]", ("w:13:31: events.0.release.1: unknown entity; received 'rob'; "
         "accepted: ball, hung, rod, lift; did you mean 'rod'?")),
        ("at: 1 s, impulse: {entities: [rod], linear: [1, 0, 0]}",
         "w:13:36: events.0.impulse.entities.0: has no body; received 'rod'"),
        ("at: 1 s, impulse: {entities: [ball]}",
         "w:13:15: events.0.impulse: must give linear or angular, received neither"),
        ("at: -1 s, despawn: [ball]", "w:13:6: events.0.at: must be at least 0 s; received '-1 s'"),
        ("at: 1 s, explode: {impulse: 0}", "w:13:25: events.0.explode.impulse: must be above 0 N s; received 0"),
        ("at: 1 s, spawn: {name: ball, prefab: ball}", ("w:13:23: events.0.spawn.name: two entities of one name; "
         "received 'ball', also of entities.0 at line 7")),
        ("at: 1 s, spawn: {prefab: bal}", ("w:13:23: events.0.spawn.prefab: unknown prefab; received 'bal'; "
         "accepted: ball; did you mean 'ball'?")),
        ("at: 1 s, spawn: {collider: {plane: {}}, body: {}}", ("w:13:34: events.0.spawn.collider.plane: "
         "only a static entity may have it; remove body")),
    ],
)  # fmt: skip
def test_one_fault_one_line(event: str, message: str) -> None:
    """Each wrong word is told in one line: where, what, what was received and what is accepted."""
    assert faults(event) == [message.replace("w:", "world.yaml:", 1)]


def test_all_faults_at_once() -> None:
    """A fault of one event hides nothing about the others."""
    assert len(faults("at: 1 s", "at: x, despawn: [ball]", "at: 1 s, despawn: [nobody]")) == 3


def test_python_refuses_in_the_same_words() -> None:
    """And adds nothing."""
    simulation = Simulation()
    wrong: list[tuple[float, dict[str, Any], str]] = [
        (1.0, {"explod": {}}, ("must state one action; received explod; "
         "accepted: impulse, explode, release, despawn, spawn")),
        (-1.0, {"despawn": ["a"]}, "at: must be finite and at least 0 s, received -1"),
        (1.0, {"release": "pin"}, "release: must be a list of names; received 'pin'; accepted: ['pin']"),
    ]  # fmt: skip
    for at, action, fault in wrong:
        with pytest.raises(DeclarationError) as caught:
            simulation.event(at, **action)
        assert str(caught.value) == fault
    assert simulation.world[Events].entries == []
    assert np.shape(simulation.world[Events].pushed) == (0,)
