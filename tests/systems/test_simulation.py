"""The simulation as a whole: its response, its schedule, and what happens when a number is none."""

from __future__ import annotations

import gc
import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from faults import error

from carom.ecs import Force, Motion, NonFiniteError, RigidBody, System, Transform, World, system
from carom.ecs.relations.impact import Impact
from carom.ecs.timings import Timings
from carom.systems.progress import Progress
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.1}}


def thrown(**settings: object) -> Simulation:
    """Return a ball thrown over a plane, with nothing that loses energy."""
    simulation = Simulation(**settings)
    simulation.add(collider={"plane": {}}, material={"restitution": 1.0, "friction": 0.0})
    simulation.add(
        name="ball", collider=BALL, body={}, transform={"position": (0.0, 1.0, 0.0)}, motion={"linear": (2.0, 3.0, 0.0)}
    )
    return simulation


def test_reflect_leaves_no_resting_contact() -> None:
    """With ``response: reflect`` the resting stage never acts, though the ball bounces; with ``full`` it does."""
    ended = {}
    for response in ("reflect", "full"):
        simulation = Simulation(response=response)
        simulation.add(collider={"plane": {}}, material={"restitution": 0.5})
        simulation.add(collider=BALL, body={}, transform={"position": (0.0, 0.3, 0.0)}, material={"restitution": 0.5})
        rested, impacts = False, 0
        for _ in range(180):
            simulation.step()
            rested |= simulation.world[Progress].resting > 0
            impacts += simulation.world.count(Impact)
        ended[response] = (rested, impacts > 3)
    assert ended == {"reflect": (False, True), "full": (True, True)}


def test_a_system_of_ones_own_is_one_line() -> None:
    """Inserted by name it acts in every substep, replaced it acts otherwise, removed it is gone."""

    def wind(strength: float) -> System:
        @system(reads=(RigidBody,), adds=(Force,))
        def blow(world: World, dt: float) -> None:
            world[Force].force[world.rows(RigidBody)] += (strength, 0.0, 0.0)

        return blow

    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    ball = simulation.add(collider=BALL, body={"mass": 2.0})
    simulation.schedule = simulation.schedule.insert(wind(12.0), after="apply_gravity")
    simulation.step(60)
    assert simulation[ball].motion.linear == pytest.approx([6.0, 0.0, 0.0])
    simulation.schedule = simulation.schedule.replace("blow", wind(-12.0))
    simulation.step(60)
    assert simulation[ball].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    simulation.schedule = simulation.schedule.remove("blow")
    simulation.step(60)
    assert simulation[ball].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert simulation[Timings]["apply_gravity"].calls == 120 * 4 + 60  # without a system of one's own once in a step


@pytest.mark.parametrize(
    ("watched", "column", "by"),
    [
        (False, "Motion.linear", "found at the end of the step"),
        (True, "Force.force", "written by system 'broken'"),
    ],
)
def test_a_nan_names_where_it_came_from(watched: bool, column: str, by: str) -> None:
    """A force of NaN in frame 4 is told with frame, column and entity; a watched simulation also names the system."""
    simulation = thrown()
    simulation.watched = watched
    simulation.force_function(
        lambda world, rows: np.full((len(rows), 3), math.nan if world.frame == 4 else 0.0), name="broken"
    )
    simulation.step(3)
    message = f"frame 4: {column} of entity 'ball' is [nan, nan, nan], {by}"
    with error(NonFiniteError, message):
        simulation.step()


@pytest.mark.parametrize("collision", ["auto", "fcl"])
def test_a_stack_of_three_boxes_stays_put(collision: str) -> None:
    """For 5 s no box moves by more than 1 mm or turns by more than 0.1 degrees."""
    simulation = Simulation(collision=collision)
    simulation.add(collider={"plane": {}})
    for k in range(3):
        simulation.add(
            collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform={"position": (0.1 * k, 0.5 + k, 0.0)}
        )
    begun = simulation.world[Transform].position[:4].copy()
    for _ in range(300):
        simulation.step()
        transform = simulation.world[Transform]
        assert np.abs(transform.position[:4] - begun).max() < 1e-3
        assert np.abs(transform.rotation[:4, :3]).max() < math.radians(0.1) / 2.0


def test_whole_numbers_do_not_make_kernels_of_whole_numbers() -> None:
    """The first world of a process falls by (0, -10, 0): the next one by 9.81 m/s2 all the same."""
    code = """
from carom.systems.simulation import Simulation
for gravity in ((0, -10, 0), (0.0, -9.81, 0.0)):
    simulation = Simulation(dt=1, substeps=1, gravity=gravity)
    ball = simulation.add(body={"mass": 1.0})
    simulation.step()
    print(simulation[ball].motion.linear[1])
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["-10.0", "-9.81"]


def test_settings_set_later_are_those_that_the_world_steps_by() -> None:
    """Gravity and dt are those set, not those the simulation was made with."""
    simulation = Simulation(gravity=(0.0, -10.0, 0.0))
    ball = simulation.add(body={"mass": 1.0})
    simulation.settings = replace(simulation.settings, gravity=(0.0, 4.0, 0.0), dt=0.5)
    simulation.step()
    assert simulation.time == 0.5
    assert simulation.world[Motion].linear[simulation.world.row(ball), 1] == 2.0


@pytest.mark.parametrize("checked", [False, True])
def test_a_step_leaves_nothing_to_the_garbage_collector(checked: bool) -> None:
    """Which would halt a game for as long as it takes to look through all objects there are, 40 ms and more."""
    simulation = thrown(checked=checked)
    box = {"collider": {"box": {"size": (1.0, 1.0, 1.0)}}, "body": {}}
    for k in range(3):
        simulation.add(name=f"box{k}", transform={"position": (3.0, 0.5 + k, 0.0)}, **box)
    simulation.add(collider={"sphere": {"radius": 1.0}, "sensor": True})
    simulation.add(joint={"ball": {"b": "box2", "at": (3.0, 4.0, 0.0)}})
    simulation.force("wind", velocity=(1.0, 0.0, 0.0))
    simulation.force("quadratic_drag", area=0.1)
    simulation.step(120)  # by then all kernels are loaded, which does leave something
    gc.collect()
    gc.disable()
    try:
        simulation.step(60)
        assert gc.collect() == 0
    finally:
        gc.enable()
