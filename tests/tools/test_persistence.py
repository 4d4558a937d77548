"""Points of contact go on as the step has them go on: what the solver set out from is what is recorded of it."""

from __future__ import annotations

import numpy as np

from carom.ecs import World, system
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.simulation import Simulation
from carom.tools.recorder.persistence import Persistence, both

Key = tuple[int, int, int]


def keys(world: World) -> list[Key]:
    """Return pair and feature of each point, of those too that sleep."""
    return list(zip(*(both(world, name).tolist() for name in ("a", "b", "feature")), strict=True))


def test_the_solver_sets_out_from_what_is_told() -> None:
    """Boxes tumble, so that corners and edges change places; a system right after the detection sees the truth."""
    simulation, truth = Simulation(dt=1 / 120), dict[Key, float]()
    simulation.add(name="floor", collider={"plane": {}})
    for number in range(12):
        across, up = divmod(number, 4)
        simulation.add(
            name=f"box[{number}]", body={}, collider={"box": {"size": (0.2, 0.3, 0.25)}},
            transform={"position": (0.28 * across, 0.3 + 0.4 * up, 0.02 * number)},
            motion={"angular": (number % 3, 2.0, number % 5)},
        )  # fmt: skip

    @system(reads=(Contact, SleepingContact))
    def see(world: World, dt: float) -> None:
        """Note with which impulse each point begins."""
        truth.clear()
        truth.update(zip(keys(world), both(world, "warm_normal").tolist(), strict=True))

    simulation.schedule = simulation.schedule.insert(see, after="find_contacts")
    persistence, warm, moved = Persistence(), 0, 0
    persistence.watch(simulation.world)
    before: set[Key] = set()
    for _ in range(240):
        simulation.step()
        persistence.watch(simulation.world)
        told = dict(zip(keys(simulation.world), persistence.began_with.tolist(), strict=True))
        assert told == {key: truth[key] for key in told}
        warm += sum(impulse > 0.0 for impulse in told.values())
        moved += sum(impulse > 0.0 and key not in before for key, impulse in told.items())
        before = set(told)
    assert warm > 1000
    assert moved > 10  # which took over the impulse of a point with another feature


def test_points_of_those_who_go_are_forgotten() -> None:
    """And a pair that meets anew begins cold, at that time."""
    simulation, persistence = Simulation(dt=1 / 60), Persistence()
    simulation.add(name="floor", collider={"plane": {}})
    collider, place = {"box": {"size": (0.2, 0.2, 0.2)}}, {"position": (0.0, 0.1, 0.0)}
    simulation.add(name="box", collider=collider, body={}, transform=place)
    for frame in range(1, 21):
        if frame == 11:
            simulation.world.despawn(simulation.world.find("box"))
            simulation.add(name="box", collider=collider, body={}, transform=place)
        simulation.step()
        persistence.watch(simulation.world)
        first = 1 if frame < 11 else 11
        assert np.array_equal(persistence.since, np.full(4, first / 60))
        assert (persistence.began_with == 0.0).all() == (frame == first)
