"""Balls that rest on each other have a way of their own through the solver: it leads where that of all others does."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Collider, Material, Motion, RigidBody, Transform
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.kernels.rubbing import BALLS, ROLLING
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

#: What no ball of its kind does for itself, and changes nothing here: a belt too slow to be seen, and a third axis that
#: nobody moves along.
ELSEWHERE: dict[str, tuple[dict[str, Any], float]] = {"belt": ({}, 1e-290), "plane": ({"dimensions": 2}, 0.0)}


def heap(settings: dict[str, Any], belt: float, rolling: float = 0.0) -> Simulation:
    """Return forty balls of all sizes and weights over a trough in the plane z = 0; every third resists ``rolling``."""
    simulation = Simulation(sleeping=False, checked=False, **settings)
    for x in (-1.0, 1.0):
        simulation.add(collider={"plane": {"normal": (x, 1.0, 0.0)}}, material={"friction": 0.6})
    random = np.random.default_rng(3)
    for i in range(40):
        simulation.add(
            collider={"sphere": {"radius": random.uniform(0.2, 0.4)}, "surface_velocity": (0.0, 0.0, belt * i)},
            body={"mass": random.uniform(0.5, 3.0)},
            material={"friction": random.uniform(0.2, 0.8), "rolling_friction": 0.0 if i % 3 else rolling},
            transform={"position": (0.8 * (i % 8 - 3.5) + random.uniform(-0.1, 0.1), 4.0 + 0.8 * (i // 8), 0.0)},
        )
    return simulation


def asked(simulation: Simulation) -> set[int]:
    """Return what groups ask for."""
    resting = simulation.world[Resting]
    return set(resting.asks[: resting.groups].tolist())


@pytest.mark.parametrize("rolling", [0.0, 0.05])
@pytest.mark.parametrize("way", ELSEWHERE)
def test_balls_go_where_the_way_of_all_others_leads_them(way: str, rolling: float) -> None:
    """Forty in a heap, which rub, roll and slide: the same to rounding, grown by a second and a half of collisions.

    Where some resist rolling they go the way of others beside those that do not.
    """
    own, other = heap({}, 0.0, rolling), heap(*ELSEWHERE[way], rolling)
    ways: list[set[int]] = [set(), set()]
    for _ in range(90):
        for simulation, seen in zip((own, other), ways, strict=True):
            simulation.step()
            seen |= asked(simulation)
    assert BALLS in ways[0]
    assert BALLS not in ways[1]
    assert (ROLLING in ways[0]) == (rolling > 0.0)
    for kind, column in ((Transform, "position"), (Motion, "linear"), (Motion, "angular")):
        one, two = (getattr(world[kind], column)[world.rows(RigidBody)] for world in (own.world, other.world))
        np.testing.assert_allclose(one, two, rtol=0.0, atol=1e-7)


def test_the_table_tells_where_balls_touched_when_the_last_substep_began() -> None:
    """Normals, depths and offsets are those of the centres then, not those that detection found."""
    simulation = heap({}, 0.0)
    simulation.step(70)
    contact, flight, collider = (simulation.world[kind] for kind in (Contact, Flight, Collider))
    rows = np.nonzero((contact.body_a[: contact.count] >= 0) & (contact.body_b[: contact.count] >= 0))[0]
    center, radius = flight.start_center, collider.size[:, 0]
    of_a, of_b = radius[contact.row_a[rows]], radius[contact.row_b[rows]]
    way = center[contact.body_b[rows]] - center[contact.body_a[rows]]
    distance = np.linalg.norm(way, axis=1)
    normal = way / distance[:, None]
    assert len(rows) > 20
    np.testing.assert_allclose(contact.depth[rows], of_a + of_b - distance, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(contact.normal[rows], normal, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(contact.offset_a[rows], of_a[:, None] * normal, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(contact.offset_b[rows], -of_b[:, None] * normal, rtol=0.0, atol=1e-14)


def test_what_resisted_rolling_is_forgotten_where_nothing_does_any_more() -> None:
    """Else it would act at once where something comes to resist rolling again, on whoever lies there by then."""
    simulation = heap({}, 0.0, rolling=0.05)
    simulation.step(70)
    contact = simulation.world[Contact]
    assert np.abs(contact.warm_rolling[: contact.count]).max() > 1e-4
    with simulation.world.edit(Material) as material:
        material.rolling_friction[:] = 0.0
    simulation.step()
    assert np.abs(contact.warm_rolling[: contact.count]).max() == 0.0
