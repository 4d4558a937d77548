"""Substeps that are taken at once lead where the systems of the frame lead one by one, and say what each took."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from onlookers import looked_on

from carom.ecs import Timings, World, state_hash, system
from carom.ecs.components.flight import Flight
from carom.ecs.relations.impact import Impact
from carom.systems import going_on
from carom.systems.continuous import Fast
from carom.systems.going_on import DONE_AT_ONCE
from carom.systems.kernels.substeps import take_substeps
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation
from carom.worlds import load_world

SPHERE = {"sphere": {"radius": 0.2}}


def struck(**settings: object) -> Simulation:
    """Return balls in a row, the first of which comes fast: those behind leave what detection foresaw in mid-flight.

    A small box is so fast that it is looked after on its way.
    """
    simulation = Simulation(checked=False, **settings)
    simulation.add(collider={"plane": {}})
    for k in range(6):
        simulation.add(
            collider=SPHERE, body={"mass": 1.0}, material={"restitution": 0.9},
            transform={"position": (0.45 * k, 0.2 + 0.3 * (k % 2), 0.01 * k)},
            motion={"linear": (9.0 if k == 0 else 0.0, 0.0, 0.0)},
        )  # fmt: skip
    simulation.add(
        collider={"box": {"size": (0.02, 0.02, 0.02)}}, body={},
        transform={"position": (0.9, 0.25, 9.0)}, motion={"linear": (0.0, 1.0, -200.0)},
    )  # fmt: skip
    return simulation


@pytest.mark.parametrize("world", ["billiards", "heap", "dominoes", "cannon", "trap", "leaning_tower", "blast"])
def test_the_same_comes_out_whether_somebody_looks_on_or_not(world: str) -> None:
    """To the last bit, impacts and their order too."""
    alone, seen = load_world(world).simulation, looked_on(load_world(world).simulation)
    alone.checked = seen.checked = False
    for _ in range(90):
        for simulation in (alone, seen):
            simulation.step()
        assert state_hash(alone.world) == state_hash(seen.world)
        one, other = alone.world[Impact], seen.world[Impact]
        assert one.count == other.count
        for column in ("a", "b", "time", "speed", "impulse", "work", "point", "normal", "friction_impulse"):
            assert np.array_equal(getattr(one, column)[: one.count], getattr(other, column)[: one.count])


@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
def test_the_same_comes_out_where_others_are_met_whom_nobody_foresaw(integrator: str) -> None:
    """In the middle of a flight, and between two substeps."""
    alone, seen = struck(integrator=integrator), looked_on(struck(integrator=integrator))
    for _ in range(60):
        for simulation in (alone, seen):
            simulation.step()
        assert state_hash(alone.world) == state_hash(seen.world)
    timings = alone.world[Timings]
    in_flight, begun = timings["sense"].calls, timings["begin_substep"].calls
    assert in_flight > 0, "no flight was stopped"
    assert begun - 60 - in_flight > 0, "no substep was begun anew between two"


def spun() -> Simulation:
    """Return a box, a hull and a capsule that turn fast on a mesh, and a box that does on another box."""
    simulation = Simulation(checked=False)
    slab = np.array([(x, y, z) for x in (-9.0, 9.0) for y in (-1.0, 0.0) for z in (-9.0, 9.0)])
    simulation.add(collider={"shape": Mesh(hull_of(slab))}, material={"friction": 0.0})
    simulation.add(collider={"box": {"size": (2.0, 1.0, 2.0)}}, transform={"position": (20.0, -0.5, 0.0)})
    box = {"box": {"size": (0.4, 0.4, 0.4)}}
    hull = {"convex": {"points": [(x, y, z) for x in (-0.2, 0.2) for y in (-0.2, 0.2) for z in (-0.1, 0.1)]}}
    for x, shape in ((0.0, box), (2.0, hull), (4.0, {"capsule": {"radius": 0.1, "length": 0.4}}), (20.0, box)):
        simulation.add(
            collider=shape, body={}, transform={"position": (x, 0.3, 0.0)}, motion={"angular": (9.0, 30.0, 0.0)}
        )
    return simulation


def test_the_same_comes_out_where_somebody_fast_is_looked_after(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a mesh and on a solid; who turns fast near others is looked at again in the middle of a flight."""
    alone, seen, looked_after = spun(), looked_on(spun()), 0

    def counted(*arguments: object) -> object:
        nonlocal looked_after
        looked_after += len(alone.world[Fast].pairs)
        return take_substeps(*arguments)

    monkeypatch.setattr(going_on, "take_substeps", counted)
    for _ in range(60):
        for simulation in (alone, seen):
            simulation.step()
        assert state_hash(alone.world) == state_hash(seen.world)
    assert looked_after > 60
    assert alone.world[Timings]["go_on"].calls > 60, "no flight was stopped to look"


def scattered(integrator: str, **settings: object) -> Simulation:
    """Return bodies of all kinds that fall and tumble, too far apart to meet, more than are taken together."""
    simulation, random = Simulation(checked=False, integrator=integrator, **settings), np.random.default_rng(4)
    solid, none = {"box": {"size": (0.6, 0.4, 0.2)}}, (0.0, 0.0, 0.0)
    kinds: list[dict[str, object]] = [
        {"mass": 1.0}, {"mass": 2.0, "center_of_mass": (0.1, 0.0, 0.05)}, {"locked": ["y"], "gravity_scale": 0.0},
        {"type": "kinematic"}, {"mass": 1.0, "gravity_scale": -0.5}, {"mass": 1.0, "inertia": (0.1, 0.2, 0.25)},
    ]  # fmt: skip
    for k, place in enumerate(np.ndindex(8, 8, 9)):
        simulation.add(
            collider=solid, body=kinds[k // 8 % len(kinds)] if k % 3 else kinds[0],
            transform={"position": 5.0 * np.array(place)},
            motion={"linear": random.normal(size=3) * (1, 0, 1), "angular": random.normal(size=3) if k % 7 else none},
        )  # fmt: skip
    return simulation


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
def test_the_same_comes_out_where_nobody_meets_anybody(integrator: str, threads: int) -> None:
    """All substeps of some bodies are taken before those of others; and none is left to be taken by itself."""
    alone, seen = scattered(integrator, threads=threads), looked_on(scattered(integrator, threads=threads))
    for _ in range(30):
        alone.step(), seen.step()
        assert state_hash(alone.world) == state_hash(seen.world)
        for column in ("start_center", "start_linear", "turned", "time", "acceleration"):
            assert np.array_equal(getattr(alone.world[Flight], column), getattr(seen.world[Flight], column)), column
    assert alone.world[Timings]["kick"].calls == 1, "before it was known what pulls at them"


def test_where_one_is_slowed_down_all_go_substep_by_substep() -> None:
    """Where it leaves its reach is not known beforehand; as ever, no bit depends on that."""
    alone, seen = scattered("verlet"), looked_on(scattered("verlet"))
    for simulation in (alone, seen):
        simulation.add(collider=SPHERE, body={"linear_damping": 0.5}, transform={"position": (-9.0, 0.0, 0.0)})
    for _ in range(3):
        alone.step(), seen.step()
        assert state_hash(alone.world) == state_hash(seen.world)
    assert alone.world[Timings]["kick"].calls >= 3


def test_checked_mode_takes_the_same_way() -> None:
    """What users run is what is held to what it declares."""
    plain, checked = struck(), struck()
    checked.checked = True
    for _ in range(30):
        plain.step(), checked.step()
        assert state_hash(plain.world) == state_hash(checked.world)
    assert checked.world[Timings]["go_on"].calls > 0


def test_what_each_system_took_is_told() -> None:
    """As if it had run by itself, once a step."""
    simulation = struck()
    simulation.step(120)
    timings = simulation.world[Timings]
    assert timings["go_on"].calls >= 120
    for name in DONE_AT_ONCE:
        assert timings[name].calls > 0, name
        assert timings[name].seconds > 0.0, name
    assert timings["go_on"].seconds > 0.0


@system()
def look_on(world: World, dt: float) -> None:
    """Do nothing; but it is not carom's."""


def insert(simulation: Simulation) -> None:
    """Let a system run that is not carom's."""
    simulation.schedule = simulation.schedule.insert(look_on, after="kick")


def join(simulation: Simulation) -> None:
    """Hang a body on a joint."""
    simulation.add(name="hung", collider=SPHERE, body={}, transform={"position": (0.0, 5.0, 0.0)})
    simulation.add(joint={"ball": {"b": "hung", "at": (0.0, 6.0, 0.0)}})


def spread_a_sensor(simulation: Simulation) -> None:
    """Ask who comes and goes."""
    simulation.add(collider={"sphere": {"radius": 3.0}, "sensor": True})


def blow(simulation: Simulation) -> None:
    """Let a force act that is not the same in all substeps."""
    simulation.force("wind", velocity=(1.0, 0.0, 0.0))
    simulation.force("quadratic_drag", area=1.0)


@pytest.mark.parametrize("ask", [looked_on, insert, join, spread_a_sensor, blow])
def test_who_asks_for_more_has_the_systems_run_one_by_one(ask: Callable[[Simulation], object]) -> None:
    """So that nothing that they do is left out."""
    simulation = struck()
    ask(simulation)
    simulation.step()
    timings = simulation.world[Timings]
    assert timings["go_on"].calls == 0
    assert timings["kick"].calls == 4
