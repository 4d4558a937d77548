"""Who comes farther than detection foresaw is asked for alone, and flies as if all had been detected anew."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion, Transform
from carom.ecs.column import Floats
from carom.ecs.relations.enter import Enter
from carom.systems.constants import MOST_WIDENED
from carom.systems.detection.answered import Answered
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.1}}
QUICK = 6.0  # m/s: a tenth of a metre a step, thirty times what detection adds to the way of who is at rest


def lane(*places: float, collider: object = BALL) -> Simulation:
    """Return balls of 1 kg in a row along x without gravity, of which the first comes quickly."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), sleeping=False)
    for number, x in enumerate(places):
        simulation.add(
            name=f"ball{number}", transform={"position": (x, 0.0, 0.0)}, body={"mass": 1.0}, collider=collider,
            material={"restitution": 1.0, "friction": 0.0},
            motion={"linear": (0.0 if number else QUICK, 0.0, 0.0)},
        )  # fmt: skip
    return simulation


def detections(simulation: Simulation, steps: int) -> int:
    """Take so many steps and return how many detections there were."""
    before = simulation.world[Answered].detections
    simulation.step(steps)
    return simulation.world[Answered].detections - before


def speeds(simulation: Simulation) -> list[float]:
    """Return the speeds along x, in order."""
    found: list[float] = simulation.world[Motion].linear[: simulation.world.used(), 0].tolist()
    return found


def test_who_is_struck_into_the_open_costs_no_detection() -> None:
    """In the step in which the second ball is struck it leaves its reach, where there is nobody."""
    simulation = lane(0.0, 0.25)
    assert detections(simulation, 2) == 2
    assert speeds(simulation) == [0.0, QUICK]
    assert simulation["ball1"].transform.position[0] == pytest.approx(0.25 + QUICK / 30.0 - 0.05, abs=1e-12)


def test_who_is_struck_meets_somebody_whom_it_could_not_foresee() -> None:
    """In one step the first ball comes 0.05 m to the second, and that 0.02 m to the last."""
    simulation = lane(0.0, 0.25, 0.47)
    assert detections(simulation, 1) == 2
    assert speeds(simulation) == [0.0, 0.0, QUICK]
    assert simulation["ball2"].transform.position[0] == pytest.approx(0.47 + QUICK / 60.0 - 0.07, abs=1e-12)


def test_boxes_that_are_struck_do_as_balls_do() -> None:
    """Their contacts are not measured anew on the way, as those of balls are."""
    simulation = lane(0.0, 0.25, 0.47, collider={"box": {"size": (0.2, 0.2, 0.2)}})
    assert detections(simulation, 1) == 2
    assert speeds(simulation) == pytest.approx([0.0, 0.0, QUICK], abs=1e-9)


def test_a_sensor_on_the_new_way_is_entered() -> None:
    """Struck after 0.05 m of the first ball, the second comes to the gate after 0.04 m of its own."""
    simulation = lane(0.0, 0.25)
    simulation.add(
        transform={"position": (0.4, 0.0, 0.0)}, collider={"box": {"size": (0.02, 1.0, 1.0)}, "sensor": True}
    )
    assert detections(simulation, 1) == 2
    enter = simulation.world[Enter]
    assert enter.time[: enter.count].tolist() == pytest.approx([0.09 / QUICK], abs=1e-6)


def gas(monkeypatch: pytest.MonkeyPatch, *, alone: bool) -> tuple[Floats, int]:
    """Return where 60 balls in a room, every third quick, are after 20 steps, and how many detections that took."""
    if not alone:
        monkeypatch.setattr("carom.systems.detection.leaving.MOST_WIDENED", 0)
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0), sleeping=False), np.random.default_rng(3)
    for k in range(3):
        for sense in (-1.0, 1.0):
            side = np.eye(3)[k] * sense
            simulation.add(collider={"plane": {"normal": side, "offset": -1.5}}, material={"restitution": 1.0})
    for k in range(60):
        place = np.array([k % 4, k // 4 % 4, k // 16]) * 0.7 - 1.05 + random.uniform(-0.1, 0.1, 3)
        simulation.add(
            transform={"position": place}, motion={"linear": random.uniform(-8.0, 8.0, 3) * (k % 3 == 0)},
            body={"mass": 1.0}, collider={"sphere": {"radius": 0.12}}, material={"restitution": 1.0, "friction": 0.0},
        )  # fmt: skip
    count = detections(simulation, 20)
    return simulation.world[Transform].position[6:66].copy(), count


def test_a_gas_flies_as_if_everybody_were_detected_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    """Impacts of balls are exact whenever they were detected; each one makes rounding about ten times as large."""
    found, few = gas(monkeypatch, alone=True)
    expected, many = gas(monkeypatch, alone=False)
    assert few < many
    assert np.abs(found - expected).max() < 1e-6


def test_many_are_detected_anew_at_once() -> None:
    """More than MOST_WIDENED that are struck in one substep are not asked one by one."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), sleeping=False)
    for k in range(MOST_WIDENED + 1):
        for x, speed in ((0.0, QUICK), (0.25, 0.0)):
            simulation.add(
                transform={"position": (x, 3.0 * k, 0.0)}, motion={"linear": (speed, 0.0, 0.0)}, body={"mass": 1.0},
                collider=BALL, material={"restitution": 1.0},
            )  # fmt: skip
    assert detections(simulation, 1) == 2


def test_what_rests_is_detected_once_a_step_whatever_pulls_at_it() -> None:
    """Balls lie on a planet whose well pulls four times as hard as gravity: nobody foresees it, and nobody goes."""
    simulation, random = Simulation(checked=False, gravity=(0.0, 0.0, 0.0), sleeping=False), np.random.default_rng(5)
    simulation.force("gravity_well", strength=400.0, radius=0.5)
    simulation.add(collider={"sphere": {"radius": 2.7}})
    for direction in random.normal(size=(60, 3)):
        simulation.add(
            transform={"position": tuple(3.3 * direction / np.linalg.norm(direction))}, body={"mass": 1.0},
            collider={"sphere": {"radius": 0.5}}, material={"rolling_friction": 0.05, "spinning_friction": 0.05},
        )  # fmt: skip
    simulation.step(240)
    assert detections(simulation, 60) == 60
