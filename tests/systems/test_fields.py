"""Fields against closed forms: wells, points that attract, wings, spin, thrust and whirlwinds."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import Force
from carom.ecs.errors import DeclarationError
from carom.systems.energy import angular_momentum, total_energy
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.1}}


def flying(
    position: tuple[float, float, float], velocity: tuple[float, float, float], **settings: object
) -> tuple[Simulation, int]:
    """Return a ball of 1 kg in a world without gravity, one substep a step."""
    simulation = Simulation(**{"dt": 1 / 240, "gravity": (0.0, 0.0, 0.0), "substeps": 1, "checked": False, **settings})
    motion, place = {"linear": velocity}, {"position": position}
    return simulation, simulation.add(collider=BALL, body={"mass": 1.0}, transform=place, motion=motion)


def test_kepler_keeps_energy_and_angular_momentum() -> None:
    """Ten orbits of e = 0.5, 1,000 steps each: from the farthest point, a = 1, at sqrt(GM (1 - e) / (1 + e))."""
    simulation, ball = flying((1.5, 0.0, 0.0), (0.0, math.sqrt(0.5 / 1.5), 0.0), dt=2.0 * math.pi / 1000)
    simulation.force("gravity_well", strength=1.0)
    energy, momentum = total_energy(simulation.world), angular_momentum(simulation.world)
    assert energy == pytest.approx(-0.5, rel=1e-12)
    energies = []
    for _ in range(100):
        simulation.step(100)
        energies.append(total_energy(simulation.world))
        assert angular_momentum(simulation.world) == pytest.approx(momentum, abs=1e-12)
    assert np.abs(np.array(energies) / energy - 1.0).max() < 1e-3
    assert simulation[ball].transform.position == pytest.approx((1.5, 0.0, 0.0), abs=5e-3)  # late by verlet's error


@pytest.mark.slow
def test_a_ship_that_passes_a_mass_leaves_in_time_and_where_hyperbolas_do() -> None:
    """From (-100, 1) at 1 m/s past GM = 1: it is 100.005 m away after 193.884 s, heading -90.5729 degrees."""
    simulation, ship = flying((-100.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    simulation.force("gravity_well", strength=1.0)
    simulation.step(46_000)
    x, y, _ = simulation[ship].transform.position
    while math.hypot(x, y) < 100.005:
        simulation.step()
        x, y, _ = simulation[ship].transform.position
    vx, vy, _ = simulation[ship].motion.linear
    assert simulation.time == pytest.approx(193.884, abs=0.05)
    assert math.degrees(math.atan2(vy, vx)) == pytest.approx(-90.5729, abs=0.2)


def test_within_a_well_is_a_spring() -> None:
    """A shaft through an even ball: x = R cos(sqrt(G M / R^3) t), by verlet with its own frequency of second order."""
    simulation, ball = flying((2.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    simulation.force("gravity_well", strength=40.0, radius=3.0)
    rate, h = math.sqrt(40.0 / 27.0), 1 / 240
    discrete = 2.0 / h * math.asin(0.5 * rate * h)  # of leapfrog: Hairer, Lubich and Wanner, VI.2
    simulation.step(480)
    assert simulation[ball].transform.position[0] == pytest.approx(2.0 * math.cos(2.0 * discrete), abs=1e-9)
    assert total_energy(simulation.world) == pytest.approx(-40.0 * (27.0 - 4.0) / 54.0, rel=1e-5)


@pytest.mark.parametrize("power", [-3, -2, -1, 0, 1, 2])
def test_attraction_is_its_power_and_keeps_energy(power: int) -> None:
    """The pull 2 m away is k 2^n to rounding; energy swings by what verlet's error of second order is."""
    simulation, ball = flying((2.0, 0.0, 0.0), (0.0, 0.5, 0.0))
    simulation.force("attraction", strength=1.5, power=power)
    before = total_energy(simulation.world)
    simulation.step()
    h = 1 / 240
    assert simulation[ball].motion.linear[0] == pytest.approx(-1.5 * 2.0**power * h, rel=1e-5)
    simulation.step(240)
    assert total_energy(simulation.world) == pytest.approx(before, abs=1e-4)


def test_a_point_that_is_met_pulls_nobody() -> None:
    """Right at it there is no direction: nothing, not a NaN."""
    for law, words in (("attraction", {"strength": 1.0}), ("gravity_well", {"strength": 1.0})):
        simulation, ball = flying((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        simulation.force(law, **words)
        simulation.step()
        assert simulation[ball].motion.linear == pytest.approx((0.0, 0.0, 0.0), abs=0.0)


def test_a_glider_in_trim_glides() -> None:
    """CL 1 and CD 0.1 on 0.1 m^2: 5.7106 degrees down, at sqrt(2 m g cos / (rho CL A)) = 12.6241 m/s, for 20 s."""
    slope = math.atan(0.1)
    speed = math.sqrt(2.0 * 9.81 * math.cos(slope) / (1.225 * 0.1))
    assert speed == pytest.approx(12.6241, abs=1e-4)
    velocity = (0.0, -speed * math.sin(slope), -speed * math.cos(slope))
    simulation, glider = flying((0.0, 100.0, 0.0), velocity, gravity=(0.0, -9.81, 0.0))
    simulation.force("lift", area=0.1, lift_coefficient=1.0)
    simulation.force("quadratic_drag", area=0.1, drag_coefficient=0.1)
    simulation.step(4800)
    assert simulation[glider].motion.linear == pytest.approx(velocity, rel=1e-4, abs=1e-4)


def test_a_ball_with_side_spin_flies_in_a_circle() -> None:
    """The force is across the flight, and turns it by C pi r^3 rho w / m a second; half the step, a quarter off."""
    rate = 0.5 * math.pi * 0.001 * 1000.0 * 2.0
    turned = (10.0 * math.cos(rate), 0.0, -10.0 * math.sin(rate))  # y x x is -z
    errors = []
    for per_second in (240, 480):
        simulation, ball = flying((0.0, 0.0, 0.0), (10.0, 0.0, 0.0), dt=1 / per_second)
        simulation.force("magnus", radius=0.1, density=1000.0, coefficient=0.5)
        simulation[ball].motion.angular = (0.0, 2.0, 0.0)
        simulation.step(per_second)
        errors.append(float(np.linalg.norm(simulation[ball].motion.linear - turned)))
    assert errors[0] < 3e-3
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def test_a_thruster_off_the_middle_turns_what_it_pushes() -> None:
    """A force along z at x = 0.5 turns about -y: w = F x t / I; at the middle it pushes where the body points."""
    simulation, ball = flying((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    simulation.force("thruster", force=(0.0, 0.0, 2.0), at=(0.5, 0.0, 0.0))
    inertia = 0.4 * 0.1**2
    simulation.step(24)
    assert simulation[ball].motion.angular == pytest.approx((0.0, -2.0 * 0.5 * 0.1 / inertia, 0.0), rel=1e-12)
    simulation, ball = flying((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    simulation[ball].transform.rotation = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))
    simulation.force("thruster", force=(3.0, 0.0, 0.0))
    simulation.step(240)
    assert simulation[ball].motion.linear == pytest.approx((0.0, 3.0, 0.0), abs=1e-12)


def test_a_vortex_moves_the_medium_round_its_axis() -> None:
    """Outside the core at C / (2 pi r), within it like a solid; what drifts in it goes that fast."""
    for at, speed in ((3.0, 5.0 / (2.0 * math.pi * 3.0)), (0.5, 5.0 * 0.5 / (2.0 * math.pi))):
        simulation, ball = flying((1.0 + at, 0.0, 0.0), (0.0, 0.0, 0.0))
        simulation.force("vortex", circulation=5.0, position=(1.0, 0.0, 0.0), rise=0.7)
        simulation.force("linear_drag", coefficient=1000.0)
        simulation.step()
        rise = 0.7 if at < 1.0 else 0.0
        assert simulation.world[Force].medium[simulation.world.row(ball)] == pytest.approx((0.0, rise, -speed))
        assert simulation[ball].motion.linear == pytest.approx((0.0, rise, -speed), rel=0.02)


@pytest.mark.parametrize(
    ("law", "words", "fault"),
    [
        ("attraction", {"strength": 1.0, "power": -1.5}, "attraction.power: must be whole, received -1.5"),
        ("lift", {"area": 1.0, "span": (0.0, 0.0, 0.0)}, "lift.span: must have a direction, received all 0"),
        (
            "quadratic_drag",
            {"area": -1, "density": "air"},
            ("quadratic_drag.area: must be finite and above 0 m2, received -1; "
            "quadratic_drag.density: must be a number, received 'air'"),
        ),
        ("vortex", {"circulation": 1.0, "axis": (0.0, 0.0, 0.0)}, "vortex.axis: must have a direction, received all 0"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_refused(law: str, words: dict[str, object], fault: str) -> None:
    """By Python as by files, in the same words."""
    with pytest.raises(DeclarationError) as caught:
        Simulation().force(law, **words)
    assert str(caught.value) == fault
