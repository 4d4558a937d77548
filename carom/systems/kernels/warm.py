"""Warm: compile every kernel of the step into the cache, in two processes at once."""

from __future__ import annotations

import hashlib
import multiprocessing
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor


def warm(*further: Callable[[], None]) -> None:
    """Compile what is not yet in the cache; ``further`` functions compile what others have."""
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"), initializer=be_silent) as pool:
        for task in [pool.submit(part) for part in (*PARTS, *further)]:
            task.result()


def key_of_cache() -> str:
    """Return a name for all that is compiled, here and now: another one where any of it would be compiled anew."""
    import numba
    from numba.core.registry import cpu_target

    import carom.systems.simulation  # noqa: F401
    from carom.systems.kernels.kernel import CALLED, stamp_of

    target = cpu_target.target_context.codegen().magic_tuple()  # what it is compiled for: system, processor, features
    stamps = [stamp_of(name) for name in sorted(sys.modules) if CALLED.fullmatch(name) and name != __name__]
    depends = (sys.version_info[:2], numba.__version__, target, stamps)
    digest = hashlib.blake2b(repr(depends).encode(), digest_size=8).hexdigest()
    return f"carom-kernels-numba-{numba.__version__}-{target[1]}-{digest}"


def be_silent() -> None:
    """Let this process compile without telling so: whoever started it has."""
    from carom.systems.kernels.stored import Announcement

    Announcement.due = False


def look_for_vectors(there: bool) -> None:
    """Tell Numba whether to look for vectors, which takes a tenth of the time where there are none.

    Those that part boxes are the only ones.
    """
    import numba

    numba.config.LOOP_VECTORIZE = 1 if there else 0


def compile_measuring() -> None:
    """Measure pairs of every shape that has kernels, and of one that FCL measures; merge and renew them; ask space."""
    look_for_vectors(there=True)

    import numpy as np

    from carom.ecs import Collider, ColliderPose, Motion, Transform
    from carom.ecs.components.flight import Flight
    from carom.systems.detection.apart import Apart
    from carom.systems.detection.bounds import reach_within
    from carom.systems.detection.contacts import find
    from carom.systems.detection.leaving import detection_holds
    from carom.systems.detection.manifolds import reduce_points
    from carom.systems.detection.narrow import measure_pairs
    from carom.systems.detection.recycling import find_balls
    from carom.systems.detection.seams import without_seams
    from carom.systems.kernels.broad_pairs import renew_pairs
    from carom.systems.kernels.crew import ALONE
    from carom.systems.kernels.fast_pairs import let_go
    from carom.systems.kernels.grid import lead_astray
    from carom.systems.kernels.lanes import WIDTH, aligned
    from carom.systems.kernels.left_out import write_left_out
    from carom.systems.kernels.manifolds import part_masses
    from carom.systems.kernels.merging import merge_contacts
    from carom.systems.kernels.swinging import NUMBERS
    from carom.systems.looked import LeftOut
    from carom.systems.passing import seeming, without_passing, without_seeming
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
    for standing in ({"shape": Mesh(solid)}, *shapes[:1] * 2):
        simulation.add(collider=standing)
    round_one = {"cylinder": {"radius": 0.5, "length": 1.0}}
    for collider in ({"sphere": {"radius": 0.5}}, *shapes, *shapes, round_one):
        simulation.add(collider=collider, body={"mass": 1.0})
    world = simulation.world
    rows = world.row_numbers(Collider)
    pairs = np.array([(a, b) for a in rows for b in rows if a < b and b > 3])
    with world.faces(None):
        reach_within(world, 1.0)
        found = without_seams(world, measure_pairs(world, pairs, np.ones(len(pairs))))
        find_balls(world, pairs, np.ones(len(pairs)))
        world[Motion].linear[:] = 1.0
        world[Motion].angular[:] = 1.0
        find(world, pairs, 1.0)  # with everybody turning
        detection_holds(world, 1.0)  # and leaving
        without_passing(world, found, 1.0, world[Flight].center, np.ones(world.capacity, np.bool_))
        seeming(world, found, 1.0, world[Flight].center)
        without_seeming(world, found, 1.0, world[Flight].center, pairs[-1:], np.ones((1, NUMBERS)))
        apart = world[Apart]
        apart.many = True
        apart.without(world, pairs, np.ones(len(pairs)))
        apart.note(world, pairs, np.ones(len(pairs)), len(pairs))
    count = len(found.row_a)
    merge_contacts(ALONE, np.arange(count), *found[:-1], *found, *found.room(2 * count))
    far = np.zeros(count, np.bool_)  # of somebody fast
    let_go(pairs, count, found.row_a, found.row_b, far)
    far[0] = True
    found.without(far, 1)
    left_out, center, rotation = LeftOut.room(1), world[Flight].center, world[Transform].rotation
    write_left_out(
        pairs, np.ones((len(pairs), NUMBERS)), far, found.row_a, found.row_b, found.normal, found.depth, found.point,
        world[ColliderPose].body_row, center, rotation, *left_out,
    )  # fmt: skip
    none, place = np.zeros(1, np.int64), np.zeros((1, 3))  # manifolds that bodies have side by side
    part_masses(0, none, none, none, none, none, place, place[0, :1], none, none, none, aligned(1, WIDTH))
    reduce_points([(np.zeros(3), np.ones(3), 0.0)])  # of shapes that only FCL measures
    room = np.empty((2 * len(pairs), 2), np.int64)
    simulation.space.cast_ray((0.0, 2.0, 0.0), (0.0, -1.0, 0.0))
    simulation.space.cast_shape(shapes[0], (0.0, 2.0, 0.0), (0.0, -1.0, 0.0))
    renew_pairs(pairs, pairs, rows, world.capacity, room)  # of bodies that leave their fat bounds
    lead_astray(rows, np.zeros(world.capacity, np.int64), rows.copy(), 0)


def compile_frame() -> None:
    """Step a world in which balls rest, roll in a sensor and bear a box, one body is on keyframes, and all laws act."""
    look_for_vectors(there=False)

    import numpy as np

    from carom.ecs.components.joint import FREE, LIMITED, LOCKED, Joint
    from carom.systems.gravitation import attract_by_tree
    from carom.systems.grouping import group_contacts
    from carom.systems.simulation import Simulation
    from carom.systems.solving import Solving

    simulation = Simulation(checked=False)
    simulation.add(collider={"plane": {}})
    for x, speed in ((0.0, 0.0), (5.0, 1.0)):
        place, motion = {"position": (x, 0.5, 0.0)}, {"linear": (speed, 0.0, 0.0)}
        ball = simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform=place, motion=motion)
    simulation[ball].external_force.torque = (0.0, 1.0, 0.0)
    simulation.add(collider={"sphere": {"radius": 1.0}, "sensor": True})
    way = ({"at": 0.0}, {"at": 1.0, "position": (1.0, 0.0, 0.0)})
    simulation.add(body={"type": "kinematic"}, keyframes=way)
    frame, everything = (LOCKED, LOCKED, LOCKED, LIMITED, FREE, LOCKED), (True, False, False, True, False, False)
    simulation.world.spawn(Joint(b=int(ball), mode=frame, driven=everything, stiffness=1.0))
    simulation.add(spring={"a": int(ball)})
    simulation.force("linear_drag", coefficient=1.0)
    simulation.force("quadratic_drag", area=1.0)
    simulation.force("gravity_well", strength=1.0, radius=1.0)
    simulation.force("attraction", strength=1.0)
    box, place = {"box": {"size": (1.0, 1.0, 1.0)}}, {"position": (0.0, 1.5, 0.0)}
    simulation.add(collider=box, body={}, transform=place, motion={"angular": (0.0, 9.0, 0.0)})
    simulation.force("buoyancy")
    simulation.force("lift", area=1.0)
    simulation.force("magnus", radius=0.5)
    simulation.force("thruster", force=(0.0, 1.0, 0.0))
    simulation.force("vortex", circulation=1.0)
    simulation.force("wind", velocity=(1.0, 0.0, 0.0), gust=1.0)
    simulation.force("mutual_gravitation")
    attract_by_tree(np.ones(9), np.arange(27.0).reshape(9, 3), 1.0, 0.0, 0.5)
    simulation.force("constant_push", force=(1.0, 0.0, 0.0))
    simulation.add(emitter={"burst": 9, "collide": "all"}, transform={"position": (0.0, 3.0, 0.0)})
    simulation.keep_ledger()
    Solving(simulation)
    simulation.step(3)
    with simulation.world.faces(None):
        for same in (False, True):  # those who stay in groups
            group_contacts(simulation.world, places=same, same=same)
    compile_rest()


def compile_rest() -> None:
    """Let a ball fall asleep and wake, and another, which is not balanced, fly at one that stands; reach out."""
    from carom.ecs.components.joint import FREE, LOCKED, Joint
    from carom.systems.kernels.crew import make_crew, serve
    from carom.systems.kernels.observing import compile_observing
    from carom.systems.kinematics import Kinematics
    from carom.systems.simulation import Simulation
    from carom.systems.why_awake import why_awake

    compile_observing()
    serve(make_crew(2), 1, 0)  # what another thread does: nothing, since this shift is over
    simulation, ball = Simulation(checked=False), {"sphere": {"radius": 0.5}}
    simulation.add(collider={"plane": {}})
    sleeper = simulation.add(collider=ball, body={}, transform={"position": (0.0, 0.5, 0.0)})
    simulation.step()
    simulation[sleeper].motion.still = 1.0
    simulation.step()
    simulation.add(collider=ball, transform={"position": (9.0, 5.0, 0.0)})
    place, flies = {"position": (7.0, 5.0, 0.0)}, {"linear": (100.0, 0.0, 0.0), "angular": (0.0, 0.0, 300.0)}
    unbalanced = {"mass": 1.0, "center_of_mass": (0.1, 0.0, 0.0)}
    simulation.add(collider=ball, body=unbalanced, transform=place, motion=flies)
    simulation.step()
    simulation.wake(sleeper)
    simulation.step()
    why_awake(simulation, sleeper)
    simulation.world.spawn(Joint(b=int(sleeper), mode=(LOCKED, LOCKED, LOCKED, FREE, FREE, FREE)))
    simulation.add(emitter={"burst": 9}, transform={"position": (0.0, 3.0, 0.0)})  # only gravity: even arcs
    simulation.step()
    arm = Kinematics(simulation)
    arm.jacobian(sleeper)
    arm.reach(sleeper, (0.0, 0.0, 0.0))


#: Each takes about half of the time and has a process of its own.
PARTS = (compile_measuring, compile_frame)
