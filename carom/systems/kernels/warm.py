"""Warm: compile every kernel of the step into the cache, in two processes at once."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor

#: Systems whose kernels take about half of the time to compile; the other process compiles all others.
HEAVY = ("hold", "drift", "settle")


def warm() -> None:
    """Compile what is not yet in the cache."""
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        list(pool.map(compile_systems, (True, False)))


def compile_systems(heavy: bool) -> None:
    """Run the heavy systems of the step, or all others, once on a world that makes each call its kernels."""
    import numba

    # The kernels are scalar code: looking for vectors in it finds none and takes a tenth of the time.
    numba.config.LOOP_VECTORIZE = numba.config.SLP_VECTORIZE = 0

    from carom.ecs.relations.contact import Contact
    from carom.systems.progress import Progress
    from carom.systems.simulation import Simulation

    simulation = Simulation(checked=False)
    world = simulation.world
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform={"position": (0.0, 0.5, 0.0)})
    simulation.force("linear_drag", coefficient=1.0)
    simulation.force("quadratic_drag", area=1.0)
    simulation.force("mutual_gravitation")
    simulation.force("constant_push", force=(1.0, 0.0, 0.0))
    with world.faces(None):
        if heavy:  # a contact to hold, which detection would have found
            world.resize(Contact, 1)
            world[Contact].resting[0], world[Contact].body_b[0] = True, 1
            world[Progress].resting = 1
        for _, system in simulation.schedule:
            if (system.name in HEAVY) is heavy:
                system(world, simulation.settings.dt)
