"""Explosions: what bodies take of them against closed forms of the sky they cover, walls, mirrors and the ledger."""

from __future__ import annotations

from math import atan, pi, sqrt

import numpy as np
import pytest

from carom.ecs import Motion, Transform
from carom.ecs.errors import DeclarationError
from carom.systems.energy import kinetic_energy
from carom.systems.explosion import Explosion, blast
from carom.systems.free_body import loads
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.5}}
CUBE = {"box": {"size": (1.0, 1.0, 1.0)}}
Place = tuple[float, float, float]


def floating(*places: Place, collider: dict[str, object] = BALL) -> tuple[Simulation, list[int]]:
    """Return bodies of 2 kg at rest in a world without gravity."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    add = simulation.add
    return simulation, [add(collider=collider, body={"mass": 2.0}, transform={"position": at}) for at in places]


def view_factor(x: float) -> float:
    """Return 1 / pi times the integral of cos over the solid angle of a square, x its half edge over its distance.

    Four corners of it; Howell, A catalog of radiation heat transfer configuration factors.
    """
    return 4.0 / pi * x / sqrt(1.0 + x * x) * atan(x / sqrt(1.0 + x * x))


@pytest.mark.parametrize("distance", [0.6, 1.0, 3.0, 100.0])
def test_a_ball_takes_what_goes_into_its_part_of_the_sky(distance: float) -> None:
    """P R^2 / (4 r^2) along the line of centres, to rounding, however near; and nothing turns it."""
    away = distance * np.array([2.0, -1.0, 2.0]) / 3.0
    simulation, (ball,) = floating(tuple(1.0 + away))
    pushes = simulation.explode(position=(1, 1, 1), impulse=80)
    wanted = 80.0 * 0.25 / (4.0 * distance**2) * away / distance
    assert pushes.impulse[0] == pytest.approx(wanted, rel=1e-9)
    assert pushes.twist[0] == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    assert simulation[ball].motion.linear == pytest.approx(wanted / 2.0, rel=1e-9)


@pytest.mark.parametrize("distance", [1.0, 1.5, 2.0, 4.0, 20.0])
def test_a_cube_takes_what_its_face_covers(distance: float) -> None:
    """P / 4 times the view factor of the face; within 4 %."""
    simulation, _ = floating((distance, 0.0, 0.0), collider=CUBE)
    pushes = blast(simulation.world, Explosion(1.0))
    wanted = view_factor(0.5 / (distance - 0.5)) / 4.0
    assert pushes.impulse[0] == pytest.approx((wanted, 0.0, 0.0), rel=0.04, abs=1e-15)


def test_all_of_it_is_taken_by_who_is_all_around() -> None:
    """Six plates make a closed box about the point: each takes P / 4 times its view factor, together 0."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    for axis in range(3):
        for side in (-1.0, 1.0):
            size, place = np.full(3, 2.0), np.zeros(3)
            size[axis], place[axis] = 1e-3, side * 1.0005
            simulation.add(collider={"box": {"size": size}}, body={"mass": 1.0}, transform={"position": place})
    pushes = blast(simulation.world, Explosion(12.0))
    assert np.abs(pushes.impulse).max(axis=1) == pytest.approx([12.0 / 4.0 * view_factor(1.0)] * 6, rel=0.04)
    assert pushes.impulse.sum(axis=0) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("mirror", [(-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, -1)])
def test_who_mirror_each_other_fly_mirrored_to_the_bit(mirror: Place) -> None:
    """Cubes about the point, off every axis: positions, velocities and turning half a second later."""
    place = np.array([1.7, 1.1, 0.9])
    simulation, _ = floating(tuple(place), tuple(place * mirror), collider=CUBE)
    simulation.explode(impulse=100)
    simulation.step(30)
    (one, other), motion = simulation.world[Transform].position[:2], simulation.world[Motion]
    turned = np.prod(mirror) * np.array(mirror, np.float64)  # angular velocities are no vectors
    assert np.linalg.norm(one - place) > 0.5
    np.testing.assert_array_equal(one * mirror, other)
    np.testing.assert_array_equal(motion.linear[0] * mirror, motion.linear[1])
    np.testing.assert_array_equal(motion.angular[0] * turned, motion.angular[1])
    assert np.abs(motion.angular[0]).min() > 0.01


def test_walls_keep_it_off_on_request() -> None:
    """Who is behind a wall takes nothing, half behind it half; bodies that could fly away themselves are no wall."""
    behind, beside, half = (3.0, 0.0, 0.0), (-3.0, 0.0, 0.0), (0.0, 0.0, 3.0)
    simulation, _ = floating(behind, beside, half)
    simulation.add(collider={"box": {"size": (0.1, 4.0, 4.0)}}, transform={"position": (1.5, 0.0, 0.0)})
    simulation.add(collider={"box": {"size": (4.0, 4.0, 0.1)}}, transform={"position": (2.0, 0.0, 2.0)})
    simulation.add(collider={"box": {"size": (0.1, 1.0, 1.0)}}, body={}, transform={"position": (-1.5, 0.0, 0.0)})
    free, kept = (blast(simulation.world, Explosion(100.0, blocked=blocked)) for blocked in (False, True))
    whole = 100.0 * 0.25 / (4.0 * 9.0)
    assert np.linalg.norm(free.impulse[:3], axis=1) == pytest.approx([whole] * 3, rel=1e-9)
    assert kept.rows.tolist() == [1, 2, 5]
    assert kept.impulse[0] == pytest.approx((-whole, 0.0, 0.0), rel=1e-9)
    assert kept.impulse[1][2] == pytest.approx(0.5 * whole, rel=0.05)
    assert kept.impulse[1][0] < 0.0  # its free half is to the left


def test_it_gives_energy_as_the_ledger_says_and_is_in_the_list_of_forces() -> None:
    """Called between steps it is an edit; bodies that slept wake; its source stands with force times dt as impulse."""
    simulation, (near, far) = floating((0.0, 1.0, 0.0), (0.0, -2.0, 0.0))
    ledger = simulation.keep_ledger()
    simulation.step(2)
    pushes = simulation.explode(impulse=40)
    simulation.step()
    assert ledger.entries["edits"] == pytest.approx(kinetic_energy(simulation.world), rel=1e-12)
    told = loads(simulation)
    assert told.name == ["explosion", "explosion"]
    assert told.body.tolist() == [simulation.world.row(near), simulation.world.row(far)]
    np.testing.assert_allclose(told.force / 60.0, pushes.impulse, rtol=1e-12)
    simulation.step()
    assert loads(simulation).name == []


def test_locked_axes_stay_locked_and_who_sleeps_wakes() -> None:
    """A door that turns about y only; a crate asleep on the ground."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    locked = ["x", "y", "z", "rotation_x", "rotation_z"]
    door = simulation.add(
        collider={"box": {"size": (1.0, 2.0, 0.1)}}, body={"mass": 5.0, "locked": locked},
        transform={"position": (0.0, 2.0, 0.0)},
    )  # fmt: skip
    crate = simulation.add(collider=CUBE, body={"mass": 5.0}, transform={"position": (5.0, 0.5, 0.0)})
    simulation.step(90)
    row = simulation.world.row(crate)
    assert simulation.world[Motion].asleep[row]
    simulation.explode(position=(0.4, 2.0, 0.5), impulse=30)
    simulation.explode(position=(4.0, 0.5, 0.0), impulse=200)
    simulation.step()
    assert not simulation.world[Motion].asleep[row]
    assert simulation[crate].motion.linear[0] > 1.0
    assert simulation[door].motion.linear.tolist() == [0.0, 0.0, 0.0]
    assert np.nonzero(simulation[door].motion.angular)[0].tolist() == [1]
    assert simulation[door].motion.angular[1] > 0.1  # pushed at +x along -z


def test_what_makes_no_sense_is_refused() -> None:
    """All at once."""
    with pytest.raises(DeclarationError) as caught:
        Simulation().explode(impulse=-1, blocked="yes", radius=3)
    assert str(caught.value) == (
        "radius: unknown key; received 'radius'; accepted: impulse, position, blocked; "
        "impulse: must be finite and above 0 N s, received -1; blocked: must be true or false; received 'yes'"
    )
