"""Contacts go on within a step with the faces they are on: who slides goes as theory says, nobody creeps."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Transform, World
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.detection.answered import Answered
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
from carom.systems.simulation import Simulation

DT, G = 1.0 / 60.0, 9.81
BOX: dict[str, Any] = {"box": {"size": (0.25, 0.25, 0.25)}}
DRUM: dict[str, Any] = {"cylinder": {"radius": 0.125, "length": 0.25}}
BALL: dict[str, Any] = {"sphere": {"radius": 0.125}}
HALF, REACH = 0.125, 1.5 - 0.125  # m, of bodies, and of their centres from the axis of the wall
ICE, ROUGH = {"friction": 0.0, "restitution": 0.0}, {"friction": 0.6, "restitution": 0.0}
CORNERS = np.array([(x, y, z) for x in (-0.1, 0.1) for y in (-6.0, 6.0) for z in (-1.5, 1.5)])
ALONG_X = {"rotation": (0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))}
WALLS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "box": ({"box": {"size": (0.2, 12.0, 3.0)}}, {}),
    "hull": ({"shape": Convex(hull_of(CORNERS))}, {}),
    "end": ({"cylinder": {"radius": 6.0, "length": 0.2}}, ALONG_X),  # of a cylinder
}


def beside_a_wall(spin: float, material: dict[str, float], of: str = "box") -> Simulation:
    """Return a world without weight, in which a wall (a face ``of`` one) at x = 1.5 m turns about z (rad/s)."""
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, 0.0), sleeping=False, checked=False)
    body = {"type": "kinematic", "center_of_mass": (0.0, 0.0, 0.0)}
    drum = simulation.add(body=body, motion={"angular": (0.0, 0.0, spin)})
    collider, turned = WALLS[of]
    wall = {"entity": drum, "position": (1.6, 0.0, 0.0), **turned}
    simulation.add(collider=collider, parent=wall, material=material)
    return simulation


def add_body(
    simulation: Simulation,
    collider: dict[str, Any],
    spin: float,
    place: tuple[float, float],
    material: dict[str, float],
) -> int:
    """Add a body of 1 kg that goes along with what turns about z."""
    x, y = place
    return simulation.add(
        collider=collider, body={"mass": 1.0}, material=material, transform={"position": (x, y, 0.0)},
        motion={"linear": (-spin * y, spin * x, 0.0), "angular": (0.0, 0.0, spin)},
    )  # fmt: skip


def add_busy_capsule(simulation: Simulation) -> None:
    """Add a capsule that flies to and fro between walls far away."""
    bouncy = {"friction": 0.0, "restitution": 1.0}
    for x in (99.0, 101.0):
        simulation.add(collider={"box": {"size": (0.2, 9.0, 9.0)}}, material=bouncy, transform={"position": (x, 0, 0)})
    simulation.add(
        collider={"capsule": {"radius": 0.1, "length": 0.3}}, body={"mass": 1.0}, material=bouncy,
        transform={"position": (100.0, 0.0, 0.0)}, motion={"linear": (300.0, 0.0, 0.0), "angular": (0.0, 0.0, 30.0)},
    )  # fmt: skip


def seen_from_the_wall(simulation: Simulation, body: int, spin: float) -> tuple[float, float]:
    """Return where a body is as seen from what turns about z."""
    x, y, _ = simulation[body].transform.position
    angle = spin * simulation.frame * DT
    return x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)


def borne(world: World) -> float:
    """Return by what all contacts bear (N)."""
    contact = world[Contact]
    return float(contact.impulse[: contact.count].sum()) / DT


@pytest.mark.parametrize("collider", [BOX, DRUM, BALL], ids=["box", "drum", "ball"])
@pytest.mark.parametrize("start", [0.2, -0.2])
@pytest.mark.parametrize("wall", WALLS)
def test_what_slides_over_a_wall_that_turns_flies_off_by_cosh(
    wall: str, collider: dict[str, Any], start: float
) -> None:
    """Without friction s = s0 cosh(w t), and it is borne by w^2 d + 2 w s' (Goldstein, section 4.10), in 0.35 s.

    The wall is kept to 20 um (a hull's, with whose corners the points of a box go, to 22) and the way to 2e-3 of it.
    Impulses are of whole steps.
    """
    spin = 4.0
    simulation = beside_a_wall(spin, ICE, wall)
    body = add_body(simulation, collider, spin, (REACH, start), ICE)
    for _ in range(21):
        simulation.step()
        off, along = seen_from_the_wall(simulation, body, spin)
        angle, middle = spin * simulation.frame * DT, spin * (simulation.frame - 0.5) * DT
        assert off == pytest.approx(REACH, abs=2.2e-5 if wall == "hull" else 2e-5)
        assert along == pytest.approx(start * np.cosh(angle), rel=2e-3)
        if simulation.frame > 2:
            by_theory = spin * spin * (REACH + 2.0 * start * np.sinh(middle))
            assert borne(simulation.world) == pytest.approx(by_theory, abs=0.01 * spin * spin * REACH)
    ledger = simulation.keep_ledger()
    simulation.step()
    assert ledger.entries["friction"] == 0.0


@pytest.mark.parametrize(
    ("spin", "busy", "bound"), [(2.0, False, 3e-6), (4.0, False, 1.5e-5), (2.0, True, 3e-6), (4.0, True, 6e-5)]
)
@pytest.mark.parametrize("wall", WALLS)
def test_nobody_in_a_stack_on_a_wall_that_turns_creeps(wall: str, spin: float, busy: bool, bound: float) -> None:
    """Four boxes, borne by each other, stay where they have come to lie after a second, for another.

    So they do, but for how deep they lie (0.1 mm; as FCL tells it of an end, 0.2), where all are detected anew within
    steps as somebody is busy.
    """
    simulation = beside_a_wall(spin, ROUGH, wall)
    if busy:
        add_busy_capsule(simulation)
    places = [(REACH - 0.25 * k, 0.0) for k in range(4)]
    bodies = [add_body(simulation, BOX, spin, place, ROUGH) for place in places]
    simulation.step(60)
    before = [seen_from_the_wall(simulation, body, spin) for body in bodies]
    simulation.step(60)
    after = [seen_from_the_wall(simulation, body, spin) for body in bodies]
    deep = 2e-4 if wall == "end" else 1e-4
    np.testing.assert_allclose(np.subtract(after, before)[:, 0], 0.0, atol=deep if busy else bound)
    np.testing.assert_allclose(np.subtract(after, before)[:, 1], 0.0, atol=bound)
    np.testing.assert_allclose(after, places, atol=1.5e-4 * spin * spin)  # what they yield by
    assert (simulation.world[Answered].detections > 2 * simulation.frame) == busy


@pytest.mark.parametrize("collider", [BOX, BALL], ids=["box", "ball"])
@pytest.mark.parametrize("integrator", ["verlet", "semi_implicit"])
@pytest.mark.parametrize("start", [0.5, -0.5])
@pytest.mark.parametrize("spin", [0.5, -0.5])
def test_what_slides_down_a_plank_that_tilts_goes_as_theory_says(
    collider: dict[str, Any], integrator: str, start: float, spin: float
) -> None:
    """Without friction s'' = w^2 s - g sin(w t), to 0.1 mm in 0.6 s; the plank is kept to 2 um."""
    simulation = Simulation(dt=DT, gravity=(0.0, -G, 0.0), sleeping=False, checked=False, integrator=integrator)
    plank = {"box": {"size": (8.0, 0.2, 2.0)}}
    simulation.add(collider=plank, body={"type": "kinematic"}, motion={"angular": (0.0, 0.0, spin)}, material=ICE)
    body = add_body(simulation, collider, spin, (start, 0.1 + HALF), ICE)
    simulation.step(36)
    along, off = seen_from_the_wall(simulation, body, spin)
    angle = spin * simulation.frame * DT
    falls = 0.5 * G / spin**2  # s = A cosh(w t) + B sinh(w t) + g sin(w t) / (2 w^2), at rest on it at first
    assert along == pytest.approx(start * np.cosh(angle) - falls * np.sinh(angle) + falls * np.sin(angle), abs=1e-4)
    assert off == pytest.approx(0.1 + HALF, abs=2e-6)


@pytest.mark.parametrize("collider", [DRUM, BALL], ids=["drum", "ball"])
def test_a_wall_that_turns_away_is_not_struck(collider: dict[str, Any]) -> None:
    """It is 1.5 m / cos(w t) away, which outruns 8 cm/s where 0.2 mm are between, but not 20 cm/s."""
    for speed, strikes in ((0.08, 0), (0.2, 1)):
        simulation = beside_a_wall(4.0, ICE)
        turn = quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * np.pi)
        simulation.add(
            collider=collider, body={"mass": 1.0}, material=ICE, motion={"linear": (speed, 0.0, 0.0)},
            transform={"position": (REACH - 2e-4, 0.0, 0.0), "rotation": turn},
        )  # fmt: skip
        struck = 0
        for _ in range(10):
            simulation.step()
            struck += simulation.world.count(Impact)
        assert struck == strikes


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_belt_on_a_turntable_runs_along_with_it(restitution: float) -> None:
    """As seen from the turntable a box on it goes straight on at 0.5 m/s, to 0.2 mm in a second, and turns with it."""
    spin, speed = 1.0, 0.5
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, -G), sleeping=False, checked=False)
    rough = {"friction": 0.5, "restitution": restitution}
    simulation.add(
        collider={"box": {"size": (8.0, 8.0, 0.5)}, "surface_velocity": (speed, 0.0, 0.0)}, material=rough,
        body={"type": "kinematic"}, transform={"position": (0.0, 0.0, -0.25)}, motion={"angular": (0.0, 0.0, spin)},
    )  # fmt: skip
    body = simulation.add(
        collider=BOX, body={"mass": 1.0}, material=rough, transform={"position": (-0.25, 0.1, HALF)},
        motion={"linear": (speed - spin * 0.1, -spin * 0.25, 0.0), "angular": (0.0, 0.0, spin)},
    )  # fmt: skip
    simulation.step(60)
    along, across = seen_from_the_wall(simulation, body, spin)
    assert along == pytest.approx(-0.25 + speed, abs=2e-4)
    assert across == pytest.approx(0.1, abs=2e-4)
    _, _, z, w = simulation[body].transform.rotation
    assert 2.0 * np.arctan2(z, w) == pytest.approx(spin, abs=1e-3)


def test_a_belt_on_a_turntable_drags_along_with_it() -> None:
    """A box that a stop on it holds is pressed on that by mu m g and w^2 x, whichever way both have come to face."""
    spin, x = 1.0, 0.5
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, -G), sleeping=False, checked=False)
    table = simulation.add(
        collider={"box": {"size": (8.0, 8.0, 0.5)}, "surface_velocity": (1.0, 0.0, 0.0)}, material=ROUGH,
        body={"type": "kinematic", "center_of_mass": (0.0, 0.0, 0.0)}, motion={"angular": (0.0, 0.0, spin)},
        transform={"position": (0.0, 0.0, -0.25)},
    )  # fmt: skip
    stop = {"entity": table, "position": (x + HALF + 0.05, 0.0, 0.25 + HALF)}
    simulation.add(collider={"box": {"size": (0.1, 1.0, 0.25)}}, parent=stop, material=ICE)
    box = add_body(simulation, BOX, spin, (x, 0.0), ROUGH)
    with simulation.world.edit(Transform) as transform:
        transform.position[simulation.world.row(box), 2] = HALF
    contact = simulation.world[Contact]
    for _ in range(150):
        simulation.step()
        if simulation.frame > 30:
            level = np.abs(contact.normal[: contact.count, 2]) < 0.5
            pressed = contact.impulse[: contact.count][level].sum() / DT
            assert pressed == pytest.approx(0.6 * G + spin * spin * x, rel=1e-3)
