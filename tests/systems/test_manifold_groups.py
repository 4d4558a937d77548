"""Groups of manifolds: who is solved side by side."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from heaps import bin_of_balls, stack_of_boxes

from carom.ecs import restore_snapshot, state_hash, take_snapshot
from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion
from carom.ecs.system import System
from carom.systems.constants import REGROUPED
from carom.systems.kernels import groups as of
from carom.systems.kernels.lanes import WIDTH
from carom.systems.kernels.rubbing import IDLE
from carom.systems.resting import Resting, Stage
from carom.systems.simulation import Simulation
from carom.tools.bench.contact_scenes import pyramid
from carom.tools.bench.engines import Carom


def heap_of_boxes() -> Simulation:
    """Return two hundred boxes of all sizes and turns that fall into a funnel."""
    simulation, random = Simulation(sleeping=False), np.random.default_rng(7)
    for x, z in ((0.6, 0.0), (-0.6, 0.0), (0.0, 0.6), (0.0, -0.6)):
        simulation.add(collider={"plane": {"normal": (x, 0.8, z)}})
    for number in range(200):
        x, z = random.uniform(-1.0, 1.0, 2)
        simulation.add(
            collider={"box": {"size": tuple(random.uniform(0.3, 0.6, 3))}},
            body={},
            material={"restitution": 0.3},
            transform={
                "position": (x, 1.5 + 0.05 * number, z),
                "rotation": quaternion.normalise(random.normal(size=4)),
            },
        )
    return simulation


@pytest.mark.parametrize(
    ("make", "separate"), [(heap_of_boxes, True), (lambda: bin_of_balls(120), True), (stack_of_boxes, False)]
)
def test_those_who_did_not_rest_come_last_in_their_level(make: Callable[[], Simulation], separate: bool) -> None:
    """Where they fill a group; of either kind those with the most points first, in groups of no fewer than they have.

    A group in which nobody rests is not solved.
    """
    simulation, apart, idle = make(), 0, 0
    resting, contact = simulation.world[Resting], simulation.world[Contact]

    def look(system: System) -> None:
        nonlocal apart
        if system.name != "find_contacts":
            return
        begin = 0
        for end in resting.level_ends():
            there = resting.first[begin:end] >= 0
            rests = contact.grouped[resting.first[begin:end][there]]
            size, points = resting.size[begin:end][there], np.repeat(resting.points[begin:end], there.sum(axis=1))
            assert (size <= points).all()
            kinds = (rests, ~rests) if (~rests).sum() >= WIDTH else (np.ones_like(rests),)
            if len(kinds) > 1:
                apart += 1
                assert (np.diff(rests.astype(int)) <= 0).all()
            for kind in kinds:
                assert (np.diff(size[kind]) <= 0).all()
            begin = end
        assert begin == resting.groups

    def look_for_idle(stage: Stage, number: int) -> None:
        nonlocal idle
        nobody_rests = ~(resting.lanes[resting.row[: resting.groups] + of.RESTS] > 0.0).any(axis=1)
        if stage.name == "solve":
            assert ((resting.asks[: resting.groups] == IDLE) == nobody_rests).all()
            idle += int(nobody_rests.sum())

    simulation.hearers.append(look)
    resting.hearers.append(look_for_idle)
    simulation.step(90)
    assert (apart > 20) == separate
    assert idle > 0


def test_groups_stay_while_few_begin_or_end_to_rest() -> None:
    """Of balls that come to rest some do so in most steps: up to one of 64 since groups were made."""
    simulation, counts = bin_of_balls(240, sleeping=False), list[int]()
    resting, contact = simulation.world[Resting], simulation.world[Contact]

    def look(system: System) -> None:
        if system.name == "find_contacts":
            first = resting.start[: resting.count]
            counts.append(np.count_nonzero(contact.resting[first] != contact.grouped[first]))
            assert counts[-1] <= REGROUPED * resting.count

    simulation.hearers.append(look)
    simulation.step(240)
    assert np.count_nonzero(counts) > 10


def test_what_is_restored_is_grouped_as_it_was() -> None:
    """A pyramid of 820 boxes, of which few begin or end to rest in a step, goes on from a snapshot to the same."""
    engine = Carom(pyramid(40), 1)
    simulation, world = engine.simulation, engine.simulation.world
    simulation.step(60)
    snapshot = take_snapshot(world)
    simulation.step(25)
    went_on = state_hash(world)
    restore_snapshot(world, snapshot)
    simulation.step(25)
    assert state_hash(world) == went_on
