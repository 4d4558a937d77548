"""The ledger: what is booked is the change of energy, and each entry is what physics says of it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, World, state_hash, system
from carom.ecs.spatial import quaternion
from carom.systems.bookkeeping import STAGES, Bookkeeping
from carom.systems.energy import total_energy
from carom.systems.ledger import KINDS, Ledger
from carom.systems.simulation import Simulation
from carom.worlds import load_world
from carom.worlds.library import names

DRY = {"restitution": 0.0, "friction": 0.5}


def steps_kept(simulation: Simulation, count: int) -> Ledger:
    """Take steps and return the ledger; the entries of each sum up to its change, but for rounding."""
    ledger = simulation.keep_ledger()
    for _ in range(count):
        before = abs(total_energy(simulation.world))
        simulation.step()
        rounding = 1e-13 * (before + sum(map(abs, ledger.entries.values())) + 1.0)
        assert sum(ledger.entries.values()) == pytest.approx(ledger.change, abs=rounding)
    return ledger


@pytest.mark.parametrize("name", names())
def test_every_joule_of_every_library_world_is_booked(name: str) -> None:
    """Within rounding, in each of 90 steps."""
    steps_kept(load_world(name).simulation, 90)


@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
def test_what_integrators_gain_from_free_fall(integrator: str) -> None:
    """Euler gains m (g h)^2 / 2 a substep, semi-implicit Euler loses as much, Verlet neither; gravity gives nothing."""
    simulation = Simulation(dt=1 / 60, integrator=integrator, substeps=4)
    simulation.add(body={"mass": 2.0}, collider={"sphere": {"radius": 0.1}}, motion={"linear": (3.0, 5.0, 0.0)})
    entries = steps_kept(simulation, 30).since
    gained = {"euler": 1.0, "semi_implicit": -1.0, "verlet": 0.0}[integrator] * 120 * 0.5 * 2.0 * (9.81 / 240) ** 2
    assert entries["integration"] == pytest.approx(gained, rel=1e-9, abs=1e-12)
    assert entries["gravity"] == pytest.approx(0.0, abs=1e-12)


def test_an_impact_takes_what_restitution_leaves_out() -> None:
    """Each takes (1 - e^2) of the energy of motion along the normal; nothing else takes any."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    hard = {"restitution": 0.6, "friction": 0.0}
    for normal in ((1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)):
        simulation.add(collider={"plane": {"normal": normal, "offset": -1.0}}, material=hard)
    ball = simulation.add(
        name="ball", collider={"sphere": {"radius": 0.1}}, body={"mass": 2.0}, material=hard,
        motion={"linear": (4.0, 1.0, 0.0)},
    )  # fmt: skip
    ledger = steps_kept(simulation, 100)
    strikes = round(math.log(abs(simulation[ball].motion.linear[0]) / 4.0, 0.6))
    assert strikes > 1
    assert ledger.since["impacts"] == pytest.approx(0.5 * 2.0 * 16.0 * (0.36**strikes - 1.0), rel=1e-12)
    assert sum(map(abs, ledger.since.values())) == pytest.approx(-ledger.since["impacts"], rel=1e-12)


def test_friction_takes_its_force_times_the_way() -> None:
    """A cube slides: it loses mu m g times the way, and contacts give it less than 0.1 mJ as it settles."""
    simulation = Simulation(dt=1 / 240)
    floor = simulation.add(collider={"plane": {}}, material=DRY)
    cube = simulation.add(
        collider={"box": {"size": (0.2, 0.2, 0.2)}}, body={"mass": 3.0}, material=DRY,
        transform={"position": (0.0, 0.1, 0.0)}, motion={"linear": (2.0, 0.0, 0.0)},
    )  # fmt: skip
    ledger = simulation.keep_ledger()
    simulation.step(60)
    began, way = 0.5 * 3.0 * 4.0, simulation[cube].transform.position[0]
    speed = simulation[cube].motion.linear[0]
    assert ledger.since["friction"] == pytest.approx(0.5 * 3.0 * speed**2 - began, abs=1e-4)
    way += 0.5 * (2.0 - speed) * simulation.settings.dt / 4  # the way is that of the velocity after each substep
    assert ledger.since["friction"] == pytest.approx(-0.5 * 3.0 * 9.81 * way, rel=1e-4)
    by_pairs = ledger.dissipation
    assert {*by_pairs.a.tolist(), *by_pairs.b.tolist()} == {floor, cube}
    assert by_pairs.friction.sum() == pytest.approx(ledger.entries["friction"], rel=1e-9)
    assert by_pairs.contacts.sum() == pytest.approx(ledger.entries["contacts"], rel=1e-9)
    assert by_pairs.work.sum() == pytest.approx(ledger.entries["friction"] + ledger.entries["contacts"], rel=1e-9)


def test_a_belt_gives_what_its_friction_does() -> None:
    """What is laid on a belt of 1 m/s ends with m v^2 / 2, all of it by friction."""
    simulation = Simulation()
    simulation.add(
        collider={"box": {"size": (9.0, 1.0, 1.0)}, "surface_velocity": (1.0, 0.0, 0.0)}, material=DRY,
        transform={"position": (0.0, -0.5, 0.0)},
    )  # fmt: skip
    place = {"position": (-3.0, 0.1, 0.0)}
    simulation.add(collider={"box": {"size": (0.2, 0.2, 0.2)}}, body={"mass": 3.0}, material=DRY, transform=place)
    assert steps_kept(simulation, 60).since["friction"] == pytest.approx(0.5 * 3.0, rel=1e-3)


def test_each_of_two_drags_and_of_two_forces_has_its_own() -> None:
    """At constant velocity drag takes c v^2 a second, 5e-6 more within substeps; what pushes gives force times way."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0}, motion={"linear": (2.0, 0.0, 0.0)})
    simulation.force("linear_drag", coefficient=1.5)
    simulation.force("constant_push", force=(5.0, 0.0, 0.0))
    simulation.force_function(lambda world, rows: np.tile((-2.0, 0.0, 0.0), (len(rows), 1)), name="headwind")
    entries = steps_kept(simulation, 60).since
    assert entries["linear_drag"] == pytest.approx(-1.5 * 4.0, rel=1e-5)
    assert entries["constant_push"] == pytest.approx(5.0 * 2.0, rel=1e-5)
    assert entries["headwind"] == pytest.approx(-2.0 * 2.0, rel=1e-5)


def test_a_torque_gives_itself_times_the_angle() -> None:
    """An uneven body that turns about its own axis: 3 N m for 1 s on 2 kg m2 are 9/4 J."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    body = {"mass": 1.0, "inertia": (1.0, 2.0, 2.5)}
    top = simulation.add(collider={"sphere": {"radius": 0.1}}, body=body)
    ledger = simulation.keep_ledger()
    for _ in range(60):
        simulation[top].external_force.torque = (0.0, 3.0, 0.0)
        simulation.step()
    assert ledger.since["external"] == pytest.approx(9.0 / 4.0, rel=1e-12)


def everything(integrator: str, seed: int) -> Simulation:
    """Return a heap of all shapes, some locked, damped, off balance or carried, in a wind, with drags and pushes."""
    generator = np.random.default_rng(seed)
    simulation = Simulation(dt=1 / 60, integrator=integrator, sleeping=True)
    material = {"restitution": 0.4, "friction": 0.6, "rolling_friction": 0.01, "spinning_friction": 0.01}
    simulation.add(collider={"plane": {}}, material=material)
    way = ({"at": 0.0, "position": (0.0, 0.2, 0.0)}, {"at": 1.0, "position": (1.0, 0.4, 0.0)})
    lift = {"box": {"size": (2.0, 0.2, 2.0)}}
    simulation.add(collider=lift, body={"type": "kinematic"}, keyframes=way, material=material)
    shapes: list[dict[str, Any]] = [
        {"sphere": {"radius": 0.3}}, {"box": {"size": (0.5, 0.4, 0.7)}}, {"capsule": {"radius": 0.2, "length": 0.5}},
        {"cylinder": {"radius": 0.3, "length": 0.5}},
    ]  # fmt: skip
    for k in range(16):
        body: dict[str, Any] = {"mass": 1.0 + k % 3, "linear_damping": 0.1 * (k % 2), "angular_damping": 0.2 * (k % 3)}
        body |= {"locked": ["rotation_x", "z"]} if k == 5 else {}
        body |= {"center_of_mass": (0.05, 0.0, 0.02)} if k == 6 else {}
        simulation.add(
            collider=shapes[k % 4], body=body, material=material,
            transform={
                "position": generator.uniform((-1.5, 0.5, -1.5), (1.5, 3.0, 1.5)),
                "rotation": quaternion.normalise(generator.normal(size=4)),
            },
            motion={"linear": generator.normal(size=3), "angular": generator.normal(size=3)} if k != 5 else {},
        )  # fmt: skip
    simulation.force("wind", velocity=(1.0, 0.0, 0.5))
    simulation.force("linear_drag", coefficient=0.2)
    simulation.force("quadratic_drag", area=0.3)
    simulation.force("mutual_gravitation", constant=0.1, softening=0.1)
    return simulation


@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
def test_all_at_once_is_booked(integrator: str) -> None:
    """Whatever meets whatever, with torques, edits and bodies that come and go between steps, until all sleep."""
    simulation = everything(integrator, 7)
    ledger = simulation.keep_ledger()
    for frame in range(150):
        body = simulation.world.entities(simulation.world.row_numbers(Motion))[5 + frame % 7]
        if frame % 10 == 3:
            simulation[body].external_force.torque = (1.0, 2.0, -1.0)
            simulation[body].motion.linear = (1.0, 1.0, 0.0)
        before = abs(total_energy(simulation.world))
        simulation.step()
        rounding = 1e-13 * (before + sum(map(abs, ledger.entries.values())) + 1.0)
        assert sum(ledger.entries.values()) == pytest.approx(ledger.change, abs=rounding), frame
        for kind in KINDS:
            by_pairs = getattr(ledger.dissipation, kind).sum()
            assert by_pairs == pytest.approx(ledger.entries[kind], rel=1e-9, abs=rounding), (frame, kind)
    kinds = {name for name, energy in ledger.since.items() if abs(energy) > 1e-6}
    expected = {"contacts", "friction", "impacts", "integration", "damping", "linear_drag", "quadratic_drag", "edits"}
    assert expected | {"external", "mutual_gravitation"} <= kinds


def test_who_falls_asleep_loses_what_motion_was_left() -> None:
    """A sphere that rolls at 1 cm/s is stopped after half a second: 7/10 m v^2."""
    simulation = Simulation(sleeping=True)
    simulation.add(collider={"plane": {}})
    simulation.add(
        collider={"sphere": {"radius": 0.5}}, body={"mass": 2.0}, transform={"position": (0.0, 0.5, 0.0)},
        motion={"linear": (0.01, 0.0, 0.0), "angular": (0.0, 0.0, -0.02)},
    )  # fmt: skip
    assert steps_kept(simulation, 40).since["sleep"] == pytest.approx(-0.7 * 2.0 * 1e-4, rel=1e-6)


def test_a_system_of_somebody_else_is_booked_under_its_name() -> None:
    """One that doubles velocities gives three times the energy of motion there was."""

    @system(writes=(Motion,))
    def double(world: World, dt: float) -> None:
        """Double every velocity."""
        linear = world[Motion].linear
        linear *= 2.0

    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={"mass": 2.0}, motion={"linear": (1.0, 0.0, 0.0)})
    simulation.schedule = simulation.schedule.insert(double, after="clear_inputs")
    assert steps_kept(simulation, 1).entries["double"] == pytest.approx(3.0, rel=1e-12)


def test_keeping_a_ledger_changes_no_bit() -> None:
    """Bodies do not feel that somebody counts."""
    hashes = []
    for keeps in (False, True):
        simulation = everything("verlet", 3)
        if keeps:
            simulation.keep_ledger()
        simulation.step(60)
        hashes.append(state_hash(simulation.world))
    assert hashes[0] == hashes[1]


def test_an_error_of_the_solver_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    """What adds energy behind the back of all systems is in no entry: the sum misses the change by it."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    ball = simulation.add(collider={"sphere": {"radius": 0.5}}, body={"mass": 2.0}, motion={"linear": (1.0, 0.0, 0.0)})
    ledger, end = simulation.keep_ledger(), Bookkeeping._end

    def cheat(books: Bookkeeping) -> None:
        with simulation.world.edit(Motion) as motion:
            motion.linear[simulation.world.row(ball)] = (2.0, 0.0, 0.0)
        end(books)

    monkeypatch.setitem(STAGES, "check_finite", cheat)
    simulation.step()
    assert ledger.change - sum(ledger.entries.values()) == pytest.approx(3.0, rel=1e-12)
