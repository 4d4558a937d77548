"""Warm: compile every kernel of the step into the cache, in two processes at once."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor

#: Systems whose kernels take about half of the time to compile; the other process compiles all others.
HEAVY = ("hold", "drift", "settle", "relax")


def warm() -> None:
    """Compile what is not yet in the cache."""
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        tasks = [
            pool.submit(compile_systems, True),
            pool.submit(compile_systems, False),
            pool.submit(compile_stand_ins),
            pool.submit(compile_for_fcl),
        ]
        for task in tasks:
            task.result()


def look_for_vectors(there: bool) -> None:
    """Tell Numba whether to look for vectors, which takes a tenth of the time where there are none.

    Those that part boxes are the only ones.
    """
    import numba

    numba.config.LOOP_VECTORIZE = 1 if there else 0


def compile_stand_ins() -> None:
    """Measure pairs of every shape that has kernels, and renew some."""
    look_for_vectors(there=True)

    import numpy as np

    from carom.ecs import Collider
    from carom.systems.detection.narrow import measure_pairs
    from carom.systems.kernels.broad_pairs import renew_pairs
    from carom.systems.shapes.geometry import hull_of
    from carom.systems.shapes.mesh import Mesh
    from carom.systems.simulation import Simulation

    solid = hull_of(np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]))
    shapes = (
        {"box": {"size": (1.0, 1.0, 1.0)}},
        {"capsule": {"radius": 0.5, "length": 1.0}},
        {"convex": {"points": solid.vertices}},
    )
    simulation = Simulation(checked=False)
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"shape": Mesh(solid)})
    for collider in ({"sphere": {"radius": 0.5}}, *shapes, *shapes):
        simulation.add(collider=collider, body={"mass": 1.0})
    world = simulation.world
    rows = world.row_numbers(Collider)
    pairs = np.array([(a, b) for a in rows for b in rows if a < b and b > 1])
    with world.faces(None):
        measure_pairs(world, pairs, np.ones(len(pairs)))
    room = np.empty((2 * len(pairs), 2), np.int64)
    renew_pairs(pairs, pairs, np.zeros(world.capacity, np.bool_), room)  # of bodies that leave their fat bounds


def compile_for_fcl() -> None:
    """Measure two boxes as FCL sees them."""
    look_for_vectors(there=False)

    import numpy as np

    from carom.systems.detection.narrow import measure_pairs
    from carom.systems.simulation import Simulation

    simulation = Simulation(checked=False)
    for _ in range(2):
        simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": 1.0})
    with simulation.world.faces(None):
        measure_pairs(simulation.world, np.array([[0, 1]]), np.zeros(1), "fcl")


def compile_systems(heavy: bool) -> None:
    """Run the heavy systems of the step, or all others, once on a world that makes each call its kernels."""
    look_for_vectors(there=False)

    from carom.ecs.relations.contact import Contact
    from carom.systems.progress import Progress
    from carom.systems.simulation import Simulation

    simulation = Simulation(checked=False)
    world = simulation.world
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform={"position": (0.0, 0.5, 0.0)})
    way = ({"at": 0.0}, {"at": 1.0, "position": (1.0, 0.0, 0.0)})
    simulation.add(body={"type": "kinematic"}, keyframes=way)
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
