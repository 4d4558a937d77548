"""What changed a velocity in a step is told by source, each by its own impulse; together they are the change."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from heaps import bin_of_balls, jointed_heap, stack_of_boxes

from carom.ecs import state_hash
from carom.systems.bodies import dynamic_rows
from carom.systems.causes import Causes, take_step
from carom.systems.simulation import Simulation
from carom.worlds import load_world

ENOUGH = 1e-9  # m/s


def blown() -> Simulation:
    """Return a box on a slope of belts that wind, drags, springs and somebody's hand pull at."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(name="floor", collider={"plane": {}, "surface_velocity": (0.5, 0.0, 0.0)})
    simulation.add(
        collider={"box": {"size": (1, 1, 1)}}, body={"linear_damping": 0.3}, transform={"position": (0, 0.6, 0)}
    )
    simulation.add(collider={"sphere": {"radius": 0.3}}, body={"locked": ["x"]}, transform={"position": (0, 2, 0.1)})
    simulation.force("wind", velocity=(6.0, 0.0, 1.0))
    simulation.force("linear_drag", coefficient=2.0)
    simulation.force("quadratic_drag", area=1.0)
    return simulation


WORLDS: dict[str, tuple[Callable[[], Simulation], int]] = {
    "a bin of balls": (lambda: bin_of_balls(12), 60),
    "a stack of boxes": (stack_of_boxes, 40),
    "joints of all kinds": (jointed_heap, 40),
    "wind, drags and a belt": (blown, 60),
    "the break of billiards": (lambda: load_world("billiards").simulation, 60),
}


@pytest.mark.parametrize("integrator", ["verlet", "semi_implicit", "euler"])
@pytest.mark.parametrize("world", WORLDS)
def test_causes_add_up_to_the_change_of_velocity(world: str, integrator: str) -> None:
    """To 1e-9 m/s in every step, of one body after the other; to ask changes no bit."""
    make, frames = WORLDS[world]
    asked, free = make(), make()
    for simulation in (asked, free):
        simulation.settings = simulation.settings.__class__(**vars(simulation.settings) | {"integrator": integrator})
    rows = dynamic_rows(asked.world)
    worst, sources = 0.0, set()
    for frame in range(frames):
        found = take_step(asked, asked.world.entity(rows[frame % len(rows)]))
        worst = max(worst, float(np.abs(found.rest).max()))
        sources |= {cause.source for cause in found.causes}
    free.step(frames)
    assert state_hash(asked.world) == state_hash(free.world)
    assert worst < ENOUGH
    assert {"gravity"} < sources


def changes(found: Causes, simulation: Simulation) -> dict[tuple[str, str], list[float]]:
    """Return the causes by source and name."""
    world = simulation.world
    return {(one.source, world.name(one.other) if one.other >= 0 else ""): one.change.tolist() for one in found.causes}


def test_each_cause_is_what_its_formula_says() -> None:
    """A crate that slides: gravity g h, the floor as much, friction mu g h, a push F h / m; each against its name."""
    simulation = Simulation(dt=1 / 100, gravity=(0.0, -10.0, 0.0), sleeping=False)
    simulation.add(name="floor", collider={"plane": {}}, material={"friction": 0.2})
    simulation.add(
        name="crate",
        collider={"box": {"size": (1, 1, 1)}},
        body={"mass": 2.0},
        material={"friction": 0.2},
        transform={"position": (0, 0.5, 0)},
        motion={"linear": (5, 0, 0)},
    )
    simulation.step(10)
    simulation["crate"].external_force.force = (0.0, 0.0, 4.0)
    found = take_step(simulation, "crate")
    told = changes(found, simulation)
    assert (found.frame, found.mass, simulation.world.name(found.entity)) == (11, 2.0, "crate")
    assert set(told) == {("gravity", ""), ("contact", "floor"), ("friction", "floor"), ("external", "")}
    assert told["gravity", ""] == pytest.approx([0.0, -0.1, 0.0])
    assert told["external", ""] == pytest.approx([0.0, 0.0, 0.02])
    assert told["contact", "floor"] == pytest.approx([0.0, 0.1, 0.0], rel=1e-3)
    assert told["friction", "floor"] == pytest.approx([-0.02, 0.0, 0.0], abs=1e-4)


def test_who_struck_is_named_on_both_sides() -> None:
    """Two balls of 1 and 3 kg exchange the same momentum, m1 m2 / (m1 + m2) (1 + e) v."""
    simulations = []
    for asked in ("left", "right"):
        simulation = Simulation(dt=1 / 100, gravity=(0.0, 0.0, 0.0))
        for name, x, mass, speed in (("left", -0.505, 1.0, 2.0), ("right", 0.5, 3.0, 0.0)):
            simulation.add(
                name=name,
                collider={"sphere": {"radius": 0.5}},
                body={"mass": mass},
                material={"restitution": 0.5, "friction": 0.0},
                transform={"position": (x, 0, 0)},
                motion={"linear": (speed, 0, 0)},
            )
        simulations.append((asked, simulation, changes(take_step(simulation, asked), simulation)))
    momentum = 0.75 * 1.5 * 2.0
    assert simulations[0][2] == {("impact", "right"): pytest.approx([-momentum, 0.0, 0.0])}
    assert simulations[1][2] == {("impact", "left"): pytest.approx([momentum / 3.0, 0.0, 0.0])}
