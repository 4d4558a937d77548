"""Who touches whom begins and ends once, whatever trembles; what strikes is heard with its speed and materials."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np
import pytest
from heaps import stirred_heap

from carom.ecs import restore_snapshot, state_hash, take_snapshot
from carom.ecs.errors import DeclarationError
from carom.ecs.relations.hit import Hit
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.touching import ContactBegin, ContactEnd, Touching
from carom.systems.materials import Materials
from carom.systems.simulation import Simulation
from carom.worlds import load_world

G = 9.81
BALL = {"sphere": {"radius": 0.5}}
BOX = {"box": {"size": (1.0, 1.0, 1.0)}}
Event = tuple[str, float, int, int]


def on_the_ground(collider: dict[str, Any], height: float, **words: Any) -> tuple[Simulation, int, int]:
    """Return a world with ground and a body so high above it."""
    simulation = Simulation(dt=1 / 60)
    ground = simulation.add(collider={"plane": {}}, material={"restitution": {"value": 0.0, "combine": "average"}})
    body = simulation.add(collider=collider, body={}, transform={"position": (0.0, 0.5 + height, 0.0)}, **words)
    return simulation, ground, body


def told(simulation: Simulation) -> list[Event]:
    """Return (what, time, a, b) of the contacts that began and ended in the last step."""
    tables = ((kind, simulation.world[kind]) for kind in (ContactBegin, ContactEnd))
    return [
        (kind.key, float(table.time[row]), int(table.a[row]), int(table.b[row]))
        for kind, table in tables
        for row in range(table.count)
    ]


def events(simulation: Simulation, steps: int) -> list[Event]:
    """Return the same of each of the next steps."""
    found = []
    for _ in range(steps):
        simulation.step()
        found += told(simulation)
    return found


def touching(simulation: Simulation) -> dict[tuple[int, int], float]:
    """Return since when which pairs touch."""
    table = simulation.world[Touching]
    return {(int(table.a[row]), int(table.b[row])): float(table.since[row]) for row in range(table.count)}


@pytest.mark.parametrize("collider", [BALL, BOX, {"cylinder": {"radius": 0.5, "length": 1.0}}])
@pytest.mark.parametrize("height", [0.0, 0.3])
def test_what_comes_to_rest_begins_to_touch_once(collider: dict[str, Any], height: float) -> None:
    """In ten seconds nothing ends; what falls begins at the time of its impact, sqrt(2 h / g)."""
    simulation, ground, body = on_the_ground(collider, height)
    began = sqrt(2.0 * height / G) if height else 1 / 60
    assert events(simulation, 600) == [("contact_begin", pytest.approx(began, abs=1e-9), ground, body)]
    assert touching(simulation) == {(ground, body): pytest.approx(began, abs=1e-9)}


def test_a_bounce_begins_and_ends() -> None:
    """Each bounce of a ball begins at its impact, e^n apart, and ends with the step that has it."""
    simulation, _, _ = on_the_ground(BALL, 1.0, material={"restitution": {"value": 0.8, "combine": "max"}})
    first, flight = sqrt(2.0 / G), 2.0 * 0.8 * sqrt(2.0 / G)
    impacts = [first + flight * (1.0 - 0.8**n) / (1.0 - 0.8) for n in range(6)]
    found = events(simulation, round(60 * impacts[-1]) + 3)
    assert [what for what, *_ in found] == ["contact_begin", "contact_end"] * 6
    assert [time for _, time, *_ in found[::2]] == pytest.approx(impacts, abs=1e-9)
    assert [time for _, time, *_ in found[1::2]] == pytest.approx(np.ceil(60 * np.array(impacts)) / 60, abs=1e-9)


def test_a_ricochet_that_detection_has_forgotten() -> None:
    """A ball at 300 m/s strikes a wall and is so far away by the end of the step that no contact is left of it."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    wall = simulation.add(collider={"box": {"size": (1.0, 9.0, 9.0)}}, material={"restitution": 1.0})
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0},
        transform={"position": (-1.6, 0.0, 0.0)}, motion={"linear": (300.0, 0.0, 0.0)},
    )  # fmt: skip
    assert events(simulation, 3) == [
        ("contact_begin", pytest.approx(1.0 / 300.0, abs=1e-12), wall, ball),
        ("contact_end", pytest.approx(1 / 60), wall, ball),
    ]


@pytest.mark.parametrize("which", [0, 1])
def test_who_goes_touches_no_more(which: int) -> None:
    """When one of a pair is removed the contact ends, under the handle that is gone."""
    simulation, ground, body = on_the_ground(BOX, 0.0)
    simulation.step(30)
    simulation.world.despawn((ground, body)[which])
    assert events(simulation, 2) == [("contact_end", pytest.approx(0.5), ground, body)]
    assert touching(simulation) == {}


def test_who_touches_is_who_began_and_did_not_end() -> None:
    """Begun and ended contacts add up to those that are, in every step; all in order of time and handles."""
    simulation = stirred_heap()
    pairs: dict[tuple[int, int], float] = {}
    for _ in range(240):
        simulation.step()
        found = told(simulation)
        assert found == sorted(found)
        for what, _, a, b in found:
            if what == "contact_end":
                pairs.pop((a, b))
        for what, time, a, b in found:
            if what == "contact_begin":
                assert (a, b) not in pairs
                pairs[a, b] = time
        assert touching(simulation) == pairs
    assert len(pairs) > 20


def test_threads_and_snapshots_change_nothing() -> None:
    """The same events to the last bit with 1, 2 and 4 threads, and from a snapshot taken in the middle."""
    simulation = stirred_heap()
    first, kept = events(simulation, 60), take_snapshot(simulation.world)
    rest = events(simulation, 60)
    for threads in (2, 4):
        assert events(stirred_heap(threads=threads), 120) == first + rest
    again = stirred_heap()
    restore_snapshot(again.world, kept)
    assert events(again, 60) == rest
    assert state_hash(again.world) == state_hash(simulation.world)


@pytest.mark.parametrize("collider", [BALL, BOX])
def test_a_plastic_landing_is_a_hit(collider: dict[str, Any]) -> None:
    """A body without restitution that falls 0.2 m lands at sqrt(2 g h), with the impulse that stops it."""
    simulation = Simulation()
    simulation.material("stone", restitution=0.0, density=2000.0)
    simulation.material("wood", restitution=0.0, density=500.0)
    ground = simulation.add(collider={"plane": {}}, material="stone")
    body = simulation.add(collider=collider, body={}, material="wood", transform={"position": (0.0, 0.7, 0.0)})
    rows = []
    for _ in range(120):
        simulation.step()
        hit = simulation.world[Hit]
        rows += [{name: getattr(hit, name)[row].copy() for name in Hit.columns} for row in range(hit.count)]
    (row,) = rows
    speed = sqrt(2.0 * G * 0.2)
    assert (row["a"], row["b"]) == (ground, body)
    assert [simulation.world[Materials].name(int(row[key])) for key in ("material_a", "material_b")] == [
        "stone",
        "wood",
    ]
    assert row["time"] == pytest.approx(sqrt(2.0 * 0.2 / G), abs=1e-9)
    assert row["speed"] == pytest.approx(speed, abs=1e-9)
    assert row["impulse"] == pytest.approx(simulation[body].rigid_body.mass * speed, rel=1e-9)
    assert row["normal"] == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)
    assert row["point"] == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)


def test_hits_are_the_impacts_that_are_fast_enough() -> None:
    """In a break of pool: those of its impacts at 0.5 m/s or more, in order; a material without a name has -1."""
    simulation = load_world("billiards", hit_speed=0.5).simulation
    materials, loud, soft = simulation.world[Materials], 0, 0
    for _ in range(120):
        simulation.step()
        hit, impact = simulation.world[Hit], simulation.world[Impact]
        rows = [
            (float(impact.time[k]), int(impact.a[k]), int(impact.b[k]), float(impact.speed[k]))
            for k in range(impact.count)
        ]
        heard = sorted(row for row in rows if row[3] >= 0.5)
        assert [
            (float(hit.time[k]), int(hit.a[k]), int(hit.b[k]), float(hit.speed[k])) for k in range(hit.count)
        ] == heard
        loud, soft = loud + len(heard), soft + len(rows) - len(heard)
        assert {materials.name(int(number)) for number in hit.material_b[: hit.count]} <= {"ball", "cushion", "cloth"}
    assert loud > 15
    assert soft > 15
    assert materials.name(-1) == ""


def test_a_hit_speed_of_none_is_refused() -> None:
    """The threshold is a speed above 0."""
    with pytest.raises(DeclarationError, match=r"^hit_speed must be finite and above 0 m/s, received 0$"):
        Simulation(hit_speed=0.0)
