"""A body never moves along or turns about an axis that is locked, and the others obey the laws with what is left."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.ecs import Entity, Motion, RigidBody, Transform
from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.energy import angular_momentum, kinetic_energy, momentum, total_energy
from carom.systems.freedom import AXES
from carom.systems.simulation import Simulation

G = 9.81
ROTATIONS = ["rotation_x", "rotation_y", "rotation_z"]
SHAPES: list[dict[str, Any]] = [
    {"box": {"size": (0.3, 0.5, 0.4)}},
    {"sphere": {"radius": 0.2}},
    {"capsule": {"radius": 0.1, "length": 0.3}},
    {"cylinder": {"radius": 0.2, "length": 0.3}},
    {"sphere": {"radius": 0.15}, "position": (0.1, 0.05, -0.02)},
]


def askew(generator: np.random.Generator) -> Floats:
    """Return any rotation."""
    return quaternion.normalise(generator.normal(size=4))


def heap(integrator: str = "verlet", share: float = 0.35) -> Simulation:
    """Return bodies of all shapes, each with locks of its own, that fall onto an uneven ground in a crosswind."""
    generator = np.random.default_rng(5)
    simulation = Simulation(dt=1 / 120, integrator=integrator)
    rough = {"friction": 0.5, "restitution": 0.4, "rolling_friction": 0.01}
    simulation.add(collider={"plane": {"normal": (0.0, 1.0, 0.0)}}, material=rough)
    simulation.add(collider={"plane": {"normal": (0.6, 0.8, 0.0), "offset": -0.5}}, material=rough)
    simulation.force("wind", velocity=(1.0, 0.5, -2.0))
    simulation.force("linear_drag", coefficient=2.0)
    for number in range(20):
        locked = [axis for axis in AXES if generator.uniform() < share]
        free = np.array([axis not in locked for axis in AXES], np.float64)
        simulation.add(
            collider=SHAPES[number % len(SHAPES)],
            body={"locked": locked, "angular_damping": 0.1},
            material=rough,
            transform={
                "position": generator.uniform(-0.5, 0.5, 3) + np.array([0.0, 1.0 + 0.9 * number, 0.0]),
                "rotation": askew(generator),
            },
            motion={"linear": generator.normal(size=3) * free[:3], "angular": generator.normal(size=3) * free[3:]},
        )
    return simulation


@pytest.mark.parametrize("integrator", ["verlet", "semi_implicit", "euler"])
def test_nothing_moves_along_or_about_a_locked_axis(integrator: str) -> None:
    """Through wind, impacts and rest: velocities are 0.0 to the bit, and centres and rotations stay to the bit."""
    simulation = heap(integrator)
    world, rows = simulation.world, simulation.world.row_numbers(RigidBody)
    free = world[RigidBody].freedom[rows]
    fixed, unturned = free[:, :3] == 0.0, ~free[:, 3:].any(axis=1)
    centred = (world[RigidBody].center_of_mass[rows] == 0.0).all(axis=1) | unturned
    position, rotation = world[Transform].position[rows].copy(), world[Transform].rotation[rows].copy()
    for _ in range(240):
        simulation.step()
        assert (world[Motion].linear[rows][fixed] == 0.0).all()
        assert (world[Motion].angular[rows][free[:, 3:] == 0.0] == 0.0).all()
        held = fixed & centred[:, None]
        assert (world[Transform].position[rows][held] == position[held]).all()
        assert (world[Transform].rotation[rows][unturned] == rotation[unturned]).all()
    moved = np.abs(world[Transform].position[rows] - position)
    assert (moved[~fixed] > 0.0).all()
    assert moved.max() > 1.0


def test_a_velocity_set_from_outside_along_a_locked_axis_is_none() -> None:
    """The next step takes it out before anything moves."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    body = {"mass": 1.0, "locked": ["x", "rotation_y"]}
    entity = simulation.add(collider={"box": {"size": (1.0, 2.0, 3.0)}}, body=body)
    with simulation.world.edit(Motion) as motion:
        motion.linear[0], motion.angular[0] = (1.0, 2.0, 0.0), (0.0, 3.0, 0.0)
    simulation.step()
    assert simulation[entity].transform.position.tolist() == pytest.approx([0.0, 2.0 / 60.0, 0.0], abs=1e-15)
    assert simulation[entity].transform.position[0] == 0.0
    assert simulation[entity].transform.rotation.tolist() == [0.0, 0.0, 0.0, 1.0]


@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("striker", [{"sphere": {"radius": 0.1}}, {"capsule": {"radius": 0.1, "length": 0.4}}])
def test_a_box_on_a_rail_is_struck_obliquely(striker: dict[str, Any], friction: float) -> None:
    """J = (1 + e) v_n / (1/m + n_x^2 / M): the rail takes the rest; momentum along it is kept to rounding."""
    angle, mass, heavy, e = math.radians(30.0), 0.5, 3.0, 0.7
    normal = np.array([math.cos(angle), math.sin(angle), 0.0])
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    surface = {"friction": friction, "restitution": e}
    rail = simulation.add(
        collider={"box": {"size": (0.5, 2.0, 2.0)}},
        body={"mass": heavy, "locked": ["y", "z", *ROTATIONS]},
        material=surface,
        transform={"rotation": (0.0, 0.0, math.sin(0.5 * angle), math.cos(0.5 * angle))},
    )
    turned = quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * math.pi)
    start = np.array([-3.0, -0.4, 0.0])
    ball = simulation.add(
        collider=striker,
        body={"mass": mass, "locked": ROTATIONS},
        material=surface,
        transform={"position": 0.55 * normal, "rotation": turned},
        motion={"linear": start},
    )
    before = momentum(simulation.world)
    simulation.step(30)
    slip = start - (start @ normal) * normal
    along = slip / np.linalg.norm(slip)
    # The rubbing impulse is at the edge of the cone: J = j (n - mu t).
    way = normal - friction * along
    yields = normal @ way / mass + normal[0] * way[0] / heavy
    impulse = -(1.0 + e) * (start @ normal) / yields
    assert simulation[ball].motion.linear == pytest.approx(start + impulse * way / mass, abs=1e-11)
    assert simulation[rail].motion.linear.tolist() == pytest.approx([-impulse * way[0] / heavy, 0.0, 0.0], abs=1e-11)
    assert momentum(simulation.world)[0] == pytest.approx(before[0], abs=1e-12)


@pytest.mark.parametrize("friction", [0.05, 10.0])
@pytest.mark.parametrize("locks", [ROTATIONS, ["z", *ROTATIONS], ["z", "rotation_x", "rotation_y"]])
@pytest.mark.parametrize("shape", ["sphere", "capsule"])
def test_an_impact_on_a_rough_wall(shape: str, locks: list[str], friction: float) -> None:
    """Friction takes min(mu J, m_t v_t), m_t the mass that slides: m, or 2/7 m of a ball that may turn (z only)."""
    speed, e = np.array([0.6, -2.0, 0.0]), 0.5
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    surface = {"friction": friction, "restitution": e}
    simulation.add(collider={"plane": {}}, material=surface)
    form: dict[str, Any] = {"sphere": {"radius": 0.1}}
    if shape == "capsule":
        form = {"capsule": {"radius": 0.1, "length": 0.3}}
    ball = simulation.add(
        collider=form,
        body={"mass": 1.0, "inertia": (0.004, 0.004, 0.004), "locked": locks},
        material=surface,
        transform={
            "position": (0.0, 0.12, 0.0),
            "rotation": quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * math.pi),
        },
        motion={"linear": speed},
    )
    simulation.step(10)
    turns = "rotation_z" not in locks
    slides = 1.0 / (1.0 + 0.01 / 0.004) if turns else 1.0
    impulse = min(friction * (1.0 + e) * 2.0, slides * 0.6)
    body = simulation[ball]
    assert body.motion.linear == pytest.approx([0.6 - impulse, e * 2.0, 0.0], abs=1e-11)
    assert body.motion.angular == pytest.approx([0.0, 0.0, -impulse * 0.1 / 0.004 if turns else 0.0], abs=1e-11)


def test_a_ball_that_cannot_turn_slides_and_never_rolls() -> None:
    """It slows by mu g to its stop, v^2 / (2 mu g) away; the way is right to the substep in which it stops."""
    simulation = Simulation(dt=1 / 240)
    simulation.add(collider={"plane": {"offset": -0.1}}, material={"friction": 0.2})
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={"locked": ROTATIONS},
        material={"friction": 0.2},
        motion={"linear": (2.0, 0.0, 0.0)},
    )
    simulation.step(120)
    assert simulation[ball].motion.linear == pytest.approx([2.0 - 0.2 * G * 0.5, 0.0, 0.0], abs=1e-9)
    simulation.step(240)
    assert simulation[ball].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert simulation[ball].transform.position[0] == pytest.approx(2.0**2 / (2.0 * 0.2 * G), rel=1e-4)


def test_a_bead_on_a_level_rail_lies_on_a_slope_without_sinking_or_sliding() -> None:
    """The rail carries its weight: nothing moves it along x, and the slope presses it by nothing."""
    simulation = Simulation()
    slope = simulation.add(collider={"plane": {"normal": (0.6, 0.8, 0.0), "offset": -0.1}})
    bead = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"locked": ["y", "z"]})
    simulation.step(60)
    assert simulation[bead].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert slope != bead


@pytest.mark.parametrize("axis", range(3))
def test_a_body_with_one_free_axis_turns_by_its_moment_about_it(axis: int) -> None:
    """Its speed is torque t / (e . I e), however askew its principal axes are, and its energy the work, to rounding."""
    generator = np.random.default_rng(axis)
    rotation, torque, size = askew(generator), 0.3, np.array([0.2, 0.5, 1.1])
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    locked = [name for k, name in enumerate(ROTATIONS) if k != axis]
    wheel = simulation.add(
        collider={"box": {"size": tuple(size)}},
        body={"mass": 2.0, "locked": locked},
        transform={"rotation": rotation},
    )
    spun = np.zeros(3)
    for _ in range(120):
        simulation[wheel].external_force.torque = (torque, torque, torque)
        simulation.step()
    turn = quaternion.matrix(rotation)
    moments = 2.0 / 12.0 * (size @ size - size * size)
    spun[axis] = torque * 0.5 / (turn @ np.diag(moments) @ turn.T)[axis, axis]
    assert simulation[wheel].motion.angular == pytest.approx(spun, rel=1e-11)
    angle = 0.5 * spun[axis] * 0.5
    energy = kinetic_energy(simulation.world)
    assert energy == pytest.approx(torque * angle, rel=1e-11)
    turned = quaternion.multiply(simulation[wheel].transform.rotation, quaternion.conjugate(rotation))
    assert 2.0 * math.atan2(turned[axis], turned[3]) == pytest.approx(angle, rel=1e-3)


@pytest.mark.parametrize("locked", range(3))
def test_a_gyroscope_with_one_locked_axis(locked: int) -> None:
    """Its momentum about the free axes is kept to rounding, its energy error is bounded and of second order.

    The lock makes its velocity w = I_free^-1 L_free, which turns it: that equation, solved by the fourth order of Runge
    and Kutta in steps 16 times as fine, tells where it goes, to 1e-9.
    """
    rotation, free = askew(np.random.default_rng(11)), np.arange(3) != locked
    spin = np.where(free, [3.0, -2.0, 4.0], 0.0)
    turn = quaternion.matrix(rotation)
    wanted = turned_under_a_lock(turn, (turn * MOMENTS) @ turn.T @ spin, free, 2.0)
    errors, places = [], []
    for dt in (1 / 30, 1 / 60):
        simulation, top = gyroscope(dt, rotation, spin, [ROTATIONS[locked]])
        momenta, energy = angular_momentum(simulation.world), kinetic_energy(simulation.world)
        worst = []
        for _ in range(round(2.0 / dt)):
            simulation.step()
            assert simulation[top].motion.angular[locked] == 0.0
            assert angular_momentum(simulation.world)[free] == pytest.approx(momenta[free], rel=1e-12)
            worst.append(abs(kinetic_energy(simulation.world) / energy - 1.0))
        assert max(worst[-10:]) < 2.0 * max(worst[: len(worst) // 2])
        errors.append(max(worst))
        places.append(np.abs(quaternion.matrix(simulation[top].transform.rotation) - wanted).max())
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.2)
    assert math.log2(places[0] / places[1]) == pytest.approx(2.0, abs=0.3)
    assert errors[0] < 1e-2
    assert places[1] < 1e-2


MOMENTS = np.array([0.05, 0.11, 0.14])


def gyroscope(dt: float, rotation: Floats, spin: Floats, locked: list[str]) -> tuple[Simulation, Entity]:
    """Return a free body with three moments of its own."""
    simulation = Simulation(dt=dt, gravity=(0.0, 0.0, 0.0))
    body = {"mass": 1.0, "inertia": tuple(MOMENTS), "locked": locked}
    return simulation, simulation.add(body=body, transform={"rotation": rotation}, motion={"angular": spin})


def turned_under_a_lock(turn: Floats, momenta: Floats, free: Any, duration: float) -> Floats:
    """Return the orientation (3, 3) after some seconds at these momenta (kg m2/s) about the free axes."""

    def rate(turn: Floats) -> Floats:
        inertia = (turn * MOMENTS) @ turn.T
        velocity = np.zeros(3)
        velocity[free] = np.linalg.solve(inertia[np.ix_(free, free)], momenta[free])
        return np.asarray(np.cross(velocity, turn.T).T)

    steps = 2_000
    h = duration / steps
    for _ in range(steps):
        one = rate(turn)
        two = rate(turn + 0.5 * h * one)
        three = rate(turn + 0.5 * h * two)
        four = rate(turn + h * three)
        turn = turn + h / 6.0 * (one + 2.0 * two + 2.0 * three + four)
    return np.asarray(turn)


@pytest.mark.parametrize("restitution", [1.0, 0.6])
def test_impacts_of_bodies_with_locks_give_no_energy(restitution: float) -> None:
    """Whatever is locked, rough bodies in a closed room lose energy, but for the error of turning."""
    simulation = room(restitution)
    energy = first = total_energy(simulation.world)
    for _ in range(720):
        simulation.step()
        now = total_energy(simulation.world)
        assert now <= energy + 1e-6 * first
        energy = now
    assert energy < (0.95 if restitution == 1.0 else 0.4) * first


def room(restitution: float, share: float = 0.3) -> Simulation:
    """Return bodies with locks of their own that fly about in a closed room."""
    generator = np.random.default_rng(6)
    simulation = Simulation(dt=1 / 120, gravity=(0.0, 0.0, 0.0))
    rough = {"friction": 0.4, "restitution": restitution}
    for axis in range(3):
        for side in (-1.0, 1.0):
            normal = tuple(side * np.eye(3)[axis])
            simulation.add(collider={"plane": {"normal": normal, "offset": -1.5}}, material=rough)
    for number, place in enumerate(np.indices((3, 3, 3)).reshape(3, -1).T):
        locked = [axis for axis in AXES if generator.uniform() < share]
        free = np.array([axis not in locked for axis in AXES], np.float64)
        simulation.add(
            collider=SHAPES[number % len(SHAPES)],
            body={"locked": locked},
            material=rough,
            transform={"position": place - 1.0, "rotation": askew(generator)},
            motion={
                "linear": 2.0 * generator.normal(size=3) * free[:3],
                "angular": generator.normal(size=3) * free[3:],
            },
        )
    return simulation


def test_a_kinematic_wall_passes_through_what_is_locked_in_its_way() -> None:
    """No impulse could part them; none is given, and nothing is hurled along the free axis."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    bead = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"locked": ["x", "z"]})
    box = {"box": {"size": (0.2, 0.2, 0.2)}}
    block = simulation.add(collider=box, body={"locked": ["x", *ROTATIONS]}, transform={"position": (0.0, 0.0, 1.0)})
    tilt = {"rotation": (0.0, 0.0, 1e-5, 1.0), "position": (-0.5, 0.0, 0.5)}
    wall = {"box": {"size": (0.2, 4.0, 4.0)}}
    simulation.add(collider=wall, body={"type": "kinematic"}, motion={"linear": (2.0, 0.0, 0.0)}, transform=tilt)
    simulation.step(120)
    for entity in (bead, block):
        assert simulation[entity].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-2)
        assert simulation[entity].transform.position[0] == 0.0


def test_sliding_across_a_rail_stops_what_slides_along_it_and_no_more() -> None:
    """A ball on a rail strikes a belt that runs across it: friction never turns its way along the rail round."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    surface = {"friction": 1.0, "restitution": 1.0}
    belt = {"box": {"size": (4.0, 0.2, 40.0)}}
    simulation.add(
        collider=belt,
        body={"type": "kinematic"},
        motion={"linear": (0.0, 0.0, 0.5)},
        material=surface,
        transform={"position": (0.0, -0.1, 0.0)},
    )
    start = np.array([1.0, -5.0, 0.0])
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={"mass": 1.0, "locked": ["z", *ROTATIONS]},
        material=surface,
        transform={"position": (0.0, 0.11, 0.0)},
        motion={"linear": start},
    )
    simulation.step(10)
    assert simulation[ball].motion.linear == pytest.approx([0.0, 5.0, 0.0], abs=1e-12)


def test_a_push_along_a_stroke_does_its_work_along_the_free_axes() -> None:
    """A bead on a rail leaves a stroke askew to it with the work of what pushes along the rail, to rounding."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    bead = simulation.add(body={"mass": 2.0, "locked": ["y", "z"]})
    simulation.force("constant_push", force=(30.0, 40.0, 0.0), stroke=0.6)
    simulation.step(240)
    assert 0.5 * 2.0 * simulation[bead].motion.linear[0] ** 2 == pytest.approx(30.0 * 0.6 / 0.6, rel=1e-12)


def flat(**settings: Any) -> Simulation:
    """Return a world of two dimensions with bodies askew in it that fall onto each other."""
    generator = np.random.default_rng(3)
    simulation = Simulation(dt=1 / 120, dimensions=2, **settings)
    rough = {"friction": 0.5, "restitution": 0.2}
    for normal in ((0.0, 1.0, 0.0), (0.8, 0.6, 0.0), (-0.8, 0.6, 0.0)):
        simulation.add(collider={"plane": {"normal": normal, "offset": -1.0}}, material=rough)
    for number in range(15):
        turn = quaternion.from_axis_angle((0.0, 0.0, 1.0), generator.uniform(0.0, 3.0))
        simulation.add(
            collider=[{"box": {"size": (0.3, 0.5, 1.0)}}, {"sphere": {"radius": 0.2}}][number % 2],
            body={},
            material=rough,
            transform={"position": (generator.uniform(-0.5, 0.5), 0.7 * number, 0.1 * (number % 3)), "rotation": turn},
            motion={"linear": (*generator.normal(size=2), 0.0), "angular": (0.0, 0.0, generator.normal())},
        )
    return simulation


def test_in_two_dimensions_every_body_keeps_to_its_plane() -> None:
    """Through a pile until it rests: z, and the axes about which nothing turns, are as they were to the bit."""
    simulation = flat()
    world, rows = simulation.world, simulation.world.row_numbers(RigidBody)
    depths = world[Transform].position[rows, 2].copy()
    assert (world[RigidBody].freedom[rows] == [1.0, 1.0, 0.0, 0.0, 0.0, 1.0]).all()
    for _ in range(900):
        simulation.step()
        assert (world[Motion].linear[rows, 2] == 0.0).all()
        assert (world[Motion].angular[rows, :2] == 0.0).all()
        assert (world[Transform].position[rows, 2] == depths).all()
        assert (world[Transform].rotation[rows, :2] == 0.0).all()
    assert np.abs(world[Motion].linear[rows]).max() < 1e-3
    assert np.abs(world[Motion].angular[rows]).max() < 1e-2


def test_in_two_dimensions_a_kinematic_body_goes_along_keyframes() -> None:
    """It turns about z and pushes along x and y, whatever its depth and tilt are."""
    simulation = Simulation(dimensions=2)
    tilted = quaternion.from_axis_angle((0.6, 0.8, 0.0), 0.5)
    turned = quaternion.multiply(quaternion.from_axis_angle((0.0, 0.0, 1.0), 1.0), tilted)
    frames = [
        {"at": 0.0, "position": (0.0, 0.0, 0.5), "rotation": tilted},
        {"at": 1.0, "position": (2.0, 1.0, 0.5), "rotation": turned},
    ]
    guide = simulation.add(body={"type": "kinematic"}, keyframes=frames)
    simulation.step(60)
    assert simulation[guide].transform.position == pytest.approx([2.0, 1.0, 0.5], abs=1e-12)
    assert simulation[guide].transform.rotation == pytest.approx(turned, abs=1e-12)


def test_in_two_dimensions_impacts_keep_momentum_and_angular_momentum() -> None:
    """Along x and y, and about z, to rounding; the others are the plane's to give."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0), dimensions=2)
    surface = {"friction": 0.4, "restitution": 0.7}
    for number, side in enumerate((-1.0, 1.0, 0.1)):
        simulation.add(
            collider={"sphere": {"radius": 0.2}},
            body={},
            material=surface,
            transform={"position": (side, 0.1 * side, 0.1 * number)},
            motion={"linear": (-2.0 * side, 0.3, 0.0), "angular": (0.0, 0.0, 1.0 + side)},
        )
    linear, angular = momentum(simulation.world), angular_momentum(simulation.world)
    simulation.step(240)
    assert simulation.world[Motion].linear[0, 0] < 0.0
    np.testing.assert_allclose(momentum(simulation.world), linear, rtol=1e-12, atol=1e-12)
    assert angular_momentum(simulation.world)[2] == pytest.approx(angular[2], rel=1e-11)


def test_a_compound_keeps_the_locks_of_its_body() -> None:
    """What it carries makes it heavier and no freer; its centre of mass goes only where it may, to the bit."""
    simulation = Simulation(dt=1 / 120)
    body = simulation.add(
        name="sled", collider={"box": {"size": (1.0, 0.2, 0.2)}}, body={"locked": ["y", "z", *ROTATIONS]}
    )
    ball = {"sphere": {"radius": 0.3}}
    simulation.add(collider=ball, parent={"entity": body, "position": (0.3, 0.4, 0.1)})
    assert simulation[body].rigid_body.freedom.tolist() == [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    for _ in range(60):
        simulation[body].external_force.force = (100.0, 50.0, 20.0)
        simulation.step()
    mass = simulation[body].rigid_body.mass
    assert simulation[body].motion.linear.tolist() == pytest.approx([50.0 / mass, 0.0, 0.0], rel=1e-12)
    assert simulation[body].transform.position.tolist()[1:] == [0.0, 0.0]
    assert simulation[body].transform.rotation.tolist() == [0.0, 0.0, 0.0, 1.0]


@pytest.mark.parametrize(
    ("settings", "words", "message"),
    [
        (
            {},
            {"body": {"mass": 1.0, "locked": ["rotaton_x"]}},
            (
                "body.locked: unknown axis 'rotaton_x'; the axes are x, y, z, rotation_x, rotation_y, rotation_z; "
                "did you mean 'rotation_x'?"
            ),
        ),
        (
            {},
            {"body": {"mass": 1.0, "locked": ["x"]}, "motion": {"linear": (0.5, 0.0, 1.0)}},
            (
                "motion.linear: must be 0 along x, which is locked, received 0.5 m/s; "
                "take x out of body.locked, or the velocity out of motion"
            ),
        ),
        (
            {},
            {"body": {"type": "kinematic", "locked": ["rotation_z"]}, "motion": {"angular": (1.0, 0.0, -2.0)}},
            (
                "motion.angular: must be 0 about z, which is locked, received -2 rad/s; "
                "take rotation_z out of body.locked, or the velocity out of motion"
            ),
        ),
        (
            {},
            {"body": {"type": "kinematic", "locked": ["z"]}, "keyframes": [{"at": 0.0}, {"at": 1.0}]},
            "body.locked: keyframes say how it moves; remove locked or keyframes",
        ),
        (
            {"dimensions": 2},
            {"body": {"type": "kinematic"}, "keyframes": [{"at": 0.0}, {"at": 1.0, "position": (0.0, 0.0, 1.0)}]},
            "keyframes: must keep to one z and turn about z only with dimensions: 2",
        ),
        (
            {"dimensions": 2},
            {"body": {"type": "kinematic"}, "keyframes": [{"at": 0.0}, {"at": 1.0, "rotation": (0.6, 0.0, 0.0, 0.8)}]},
            "keyframes: must keep to one z and turn about z only with dimensions: 2",
        ),
        (
            {"dimensions": 2},
            {"body": {"mass": 1.0}, "motion": {"linear": (0.5, 0.0, 1.0)}},
            "motion.linear: must be 0 along z with dimensions: 2, received 1 m/s; bodies keep to the plane z = const",
        ),
        (
            {"dimensions": 2},
            {"body": {"mass": 1.0}, "motion": {"angular": (0.5, 0.0, 1.0)}},
            (
                "motion.angular: must be 0 about x with dimensions: 2, received 0.5 rad/s; "
                "bodies keep to the plane z = const"
            ),
        ),
    ],
)
def test_velocities_along_locked_axes_are_refused(settings: Any, words: Any, message: str) -> None:
    """What, where, what was received and how to mend it."""
    with pytest.raises(DeclarationError) as caught:
        Simulation(**settings).add(**words)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"dimensions": 4}, "dimensions must be 2 or 3, received 4"),
        (
            {"dimensions": 2, "gravity": (0.0, 0.0, -9.81)},
            "gravity must lie in the plane z = const with dimensions 2, received [0.0, 0.0, -9.81]",
        ),
    ],
)
def test_dimensions_that_cannot_be_are_refused(settings: Any, message: str) -> None:
    """Before anything is in the world."""
    with pytest.raises(DeclarationError) as caught:
        Simulation(**settings)
    assert str(caught.value) == message
