"""Springs as forces follow the integrator to the last bits, and keep momentum; soft ones never grow."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.ecs import DeclarationError, Motion, Transform
from carom.ecs.components.joint import FREE, LINE, Joint
from carom.ecs.components.spring import Spring
from carom.systems.energy import angular_momentum, momentum, potential_energies, total_energy
from carom.systems.simulation import Simulation
from carom.worlds import WorldError
from carom.worlds.builder import load_text

ISSUE = math.sqrt(50.0 * (1.0 + 1.0 / 3.0))  # 8.164966 rad/s


def weightless(**settings: Any) -> Simulation:
    """Return a simulation without gravity."""
    return Simulation(gravity=(0.0, 0.0, 0.0), **settings)


def two_masses(velocity: tuple[float, float, float] = (0.0, 0.0, 0.0), **settings: Any) -> Simulation:
    """Return 1 kg and 3 kg on a spring of 50 N/m and 1 m, drawn 0.2 m longer."""
    simulation = weightless(**settings)
    light = simulation.add(name="light", body={"mass": 1.0}, motion={"linear": velocity})
    heavy = simulation.add(
        name="heavy", body={"mass": 3.0}, transform={"position": (1.2, 0.0, 0.0)}, motion={"linear": velocity}
    )
    simulation.add(name="spring", spring={"a": light, "b": heavy, "rest_length": 1.0, "stiffness": 50.0})
    return simulation


def stretches(simulation: Simulation, steps: int) -> np.ndarray:
    """Return how much longer than 1 m two masses are apart after each step, from the start on."""
    found = []
    for _ in range(steps):
        apart = simulation["heavy"].transform.position - simulation["light"].transform.position
        found.append(float(np.sqrt((apart * apart).sum())) - 1.0)
        simulation.step()
    return np.array(found)


def test_two_masses_swing_at_the_frequency_of_their_reduced_mass() -> None:
    """8.164966 rad/s within 1e-3: what comes before and after sums up to 2 cos(w dt) of what is between."""
    stretch = stretches(two_masses(dt=1 / 240), 2400)
    cosine = 0.5 * (stretch[1:-1] * (stretch[2:] + stretch[:-2])).sum() / (stretch[1:-1] ** 2).sum()
    assert math.acos(cosine) * 240 == pytest.approx(8.164966, abs=1e-3)


@pytest.mark.parametrize("dt", [1 / 30, 1 / 120])
def test_verlet_is_the_leapfrog(dt: float) -> None:
    """Drift, kick, drift turns by the angle of which the cosine is 1 - (w h)^2 / 2, for ever."""
    stretch = stretches(two_masses(dt=dt, substeps=1), 600)
    angle = math.acos(1.0 - 0.5 * (ISSUE * dt) ** 2)
    assert stretch == pytest.approx(0.2 * np.cos(angle * np.arange(600)), abs=1e-11)


@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
def test_momentum_is_kept(integrator: str) -> None:
    """Within 1e-12 of m v in every step."""
    simulation = two_masses((0.3, -2.0, 1.0), dt=1 / 240, integrator=integrator)
    before = momentum(simulation.world)
    for _ in range(480):
        simulation.step()
        assert momentum(simulation.world) == pytest.approx(before, abs=1e-12 * np.abs(before).max())


def damped(dt: float, steps: int, damping: float = 2.0) -> float:
    """Return where 1 kg on 100 N/m is after so many steps, from 1 m."""
    simulation = weightless(dt=dt, substeps=1)
    mass = simulation.add(body={"mass": 1.0}, transform={"position": (1.0, 0.0, 0.0)})
    simulation.add(spring={"a": mass, "stiffness": 100.0, "damping": damping})
    simulation.step(steps)
    return float(simulation[mass].transform.position[0])


def test_a_damped_spring_meets_the_closed_form() -> None:
    """-0.336852 m within 1e-4 at dt 1/480; half of dt leaves a quarter of the error."""
    frequency = math.sqrt(99.0)
    exact = math.exp(-1.0) * (math.cos(frequency) + math.sin(frequency) / frequency)
    assert exact == pytest.approx(-0.336852, abs=1e-6)
    coarse, fine = damped(1 / 480, 480) - exact, damped(1 / 960, 960) - exact
    assert abs(coarse) < 1e-4
    assert coarse / fine == pytest.approx(4.0, abs=0.1)


def test_a_damper_feels_the_velocity_of_the_middle() -> None:
    """To rounding what is predicted: the last acceleration brings velocities to the middle of the substep."""
    h, place, speed, pull = 1 / 60, 1.0, 0.0, 0.0
    for _ in range(60):
        middle = place + 0.5 * h * speed
        pull = -100.0 * middle - 2.0 * (speed + 0.5 * h * pull)
        place, speed = place + h * (speed + 0.5 * h * pull), speed + h * pull
    assert damped(h, 60) == pytest.approx(place, abs=1e-12)


def test_energy_goes_to_and_fro_and_is_not_lost() -> None:
    """Verlet keeps it within (w h)^2 / 4 of what the spring began with; the ledger books nothing to the spring."""
    simulation = two_masses(dt=1 / 60)
    ledger, held = simulation.keep_ledger(), 0.5 * 50.0 * 0.2**2
    assert potential_energies(simulation.world)["springs"] == pytest.approx(held, rel=1e-12)
    for _ in range(600):
        simulation.step()
        assert total_energy(simulation.world) == pytest.approx(held, rel=0.26 * (ISSUE / 240) ** 2)
        assert sum(ledger.entries.values()) == pytest.approx(ledger.change, abs=1e-13)
    assert ledger.since["springs"] == pytest.approx(0.0, abs=1e-6)


def test_a_damper_loses_what_it_is_told_to() -> None:
    """All the energy of a spring goes into its damper, and the ledger says so."""
    simulation = weightless(dt=1 / 60)
    mass = simulation.add(body={"mass": 1.0}, transform={"position": (1.0, 0.0, 0.0)})
    simulation.add(spring={"a": mass, "stiffness": 100.0, "damping": 20.0})
    ledger = simulation.keep_ledger()
    simulation.step(300)
    assert ledger.since["springs"] == pytest.approx(-50.0, rel=1e-3)


def test_anchors_turn_bodies() -> None:
    """Off the centre of mass a pull is a torque; one body gets what the other loses, about any point."""
    simulation = weightless(dt=1 / 240)
    one = simulation.add(name="one", body={"mass": 2.0, "inertia": (0.02, 0.2, 0.2)})
    two = simulation.add(
        name="two", body={"mass": 1.0, "inertia": (0.1, 0.1, 0.1), "center_of_mass": (0.1, 0.0, 0.0)},
        transform={"position": (0.0, 2.0, 0.5)}, motion={"angular": (0.0, 0.0, 1.0)},
    )  # fmt: skip
    ends = {"anchor_a": (0.5, 0.0, 0.0), "anchor_b": (-0.5, 0.0, 0.0)}
    simulation.add(name="spring", spring={"a": one, "b": two, "rest_length": 1.0, "stiffness": 30.0, **ends})
    energy, spin = total_energy(simulation.world), angular_momentum(simulation.world)
    simulation.step(480)
    assert abs(simulation["one"].motion.angular).max() > 0.1
    assert total_energy(simulation.world) == pytest.approx(energy, rel=1e-4)
    assert angular_momentum(simulation.world) == pytest.approx(spin, abs=1e-4)


def test_a_spring_goes_when_one_of_its_ends_does() -> None:
    """The other flies on straight; what it held is in no energy."""
    simulation = two_masses(dt=1 / 60)
    simulation.step(5)
    speed = +simulation["light"].motion.linear
    simulation.world.despawn(simulation.world.find("heavy"))
    simulation.step(5)
    assert simulation["light"].motion.linear.tolist() == speed.tolist()
    assert potential_energies(simulation.world)["springs"] == 0.0


def test_who_is_on_a_spring_stays_awake_and_a_new_spring_wakes() -> None:
    """Else one end would move and the other sleep."""
    simulation = Simulation(dt=1 / 60, sleeping=True)
    simulation.add(collider={"plane": {}})
    box = {"collider": {"box": {"size": (1.0, 1.0, 1.0)}}, "body": {}}
    for name, x in (("tied", 0.0), ("loose", 5.0)):
        simulation.add(name=name, transform={"position": (x, 0.5, 0.0)}, **box)
    simulation.add(spring={"a": simulation.world.find("tied"), "stiffness": 1.0})
    simulation.step(120)
    assert not simulation["tied"].motion.asleep
    assert simulation["loose"].motion.asleep
    simulation.add(spring={"a": simulation.world.find("loose"), "anchor_b": (5.0, 9.0, 0.0), "stiffness": 5000.0})
    simulation.step(5)
    assert simulation["loose"].transform.position[1] > 0.51


@pytest.mark.parametrize("speed", [0.0, 30.0])
def test_a_soft_spring_never_grows(speed: float) -> None:
    """A joint along a line, 1 kg on 1e5 N/m at dt 1/60, which as a force would be past verlet's limit of w h = 2."""
    simulation = weightless(dt=1 / 60, substeps=1)
    mass = simulation.add(
        body={"mass": 1.0}, transform={"position": (1.5, 0.0, 0.0)}, motion={"linear": (speed, 0.0, 0.0)}
    )
    free, first = (FREE,) * 6, (True, False, False, False, False, False)
    simulation.world.spawn(
        Joint(b=int(mass), along=LINE, mode=free, driven=first, stiffness=1e5, target=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    )
    row, energies = simulation.world.row(mass), []
    for _ in range(600):
        place, moving = simulation.world[Transform].position[row], simulation.world[Motion].linear[row]
        energies.append(0.5e5 * float(np.sqrt(place @ place) - 1.0) ** 2 + 0.5 * float(moving @ moving))
        simulation.step()
    assert max(energies) == energies[0]
    assert energies[-1] < 1e-3 * energies[0]


FILE = """carom: 1
gravity: [0, 0, 0]
entities:
  - {name: cart, body: {mass: 2}, transform: {position: [3, 0, 0]}}
  - {name: post, transform: {position: [0, 1, 0]}}
  - name: spring
    spring: {a: cart, b: post, anchor_b: [0, -1, 0], rest_length: 2 m, stiffness: 2 N/mm, damping: 3 N s/m}
"""


def test_files_say_the_same_words() -> None:
    """Units are read, ends found by name."""
    simulation = load_text(FILE, integrator="semi_implicit", substeps=1).simulation
    spring, row = simulation.world[Spring], simulation.world.row(simulation.world.find("spring"))
    assert (spring.stiffness[row], spring.damping[row], spring.rest_length[row]) == (2000.0, 3.0, 2.0)
    simulation.step()
    assert (spring.length[row], spring.tension[row]) == (3.0, 2000.0)


REFUSED = {
    "stiffness: -1": "must be at least 0 N/m; received -1",
    "stiffness: 3 m": """must be a value in N/m; received '3 m', which is a length; \
accepted: a number in N/m, or one with a unit: N/m""",
}


@pytest.mark.parametrize("wrong", REFUSED)
def test_what_is_no_spring_is_refused(wrong: str) -> None:
    """Whole messages."""
    with pytest.raises(WorldError) as refused:
        load_text(FILE.replace("stiffness: 2 N/mm", wrong))
    assert str(refused.value) == f"world.yaml:7:72: entities.2.spring.stiffness: {REFUSED[wrong]}"


def test_python_is_told_the_columns() -> None:
    """A word that no spring has is refused."""
    with pytest.raises(DeclarationError) as refused:
        weightless().add(spring={"hardness": 3.0})
    assert str(refused.value) == (
        "Spring has no column 'hardness'; its columns are a, b, anchor_a, anchor_b, rest_length, stiffness, damping, "
        "length, tension"
    )
