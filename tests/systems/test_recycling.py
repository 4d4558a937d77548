"""Contacts of what hardly moves are recycled: they go with their shapes."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Collider, Transform, state_hash
from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion
from carom.ecs.table import Table
from carom.systems.constants import REACH_FACTOR, RECYCLED_SLIP
from carom.systems.detection import contacts
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.recycling import measure_what_moved
from carom.systems.kernels.crew import ALONE
from carom.systems.kernels.recycling import recycle_contacts
from carom.systems.shapes.box import Box
from carom.systems.simulation import Simulation

BOX = {"box": {"size": (1.0, 1.0, 1.0)}}
FOLLOWS = (
    "offset_a", "offset_b", "share", "friction", "restitution", "rolling", "spinning", "surface", "body_a", "body_b",
    "kind",
)  # fmt: skip


@pytest.fixture
def pair() -> tuple[Simulation, int]:
    """Return a box that has stood on a floor of boxes for a second, and that box."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"box": {"size": (4.0, 1.0, 4.0)}})
    box = simulation.add(collider=BOX, body={}, transform={"position": (0.0, 1.0, 0.0)})
    simulation.step(60)
    return simulation, box


def measured(simulation: Simulation, steps: int = 1) -> int:
    """Return how many pairs the next steps measure."""
    answered = simulation.world[Answered]
    before = answered.kernels + answered.fcl
    simulation.step(steps)
    return answered.kernels + answered.fcl - before


def test_what_stands_is_not_measured_again(pair: tuple[Simulation, int]) -> None:
    """Its four points keep their features."""
    simulation, _ = pair
    contact = simulation.world[Contact]
    features = contact.feature[: contact.count].copy()
    assert measured(simulation, 60) == 0
    contact = simulation.world[Contact]
    assert contact.feature[: contact.count].tolist() == features.tolist()
    assert contact.count == 4


def test_what_stays_is_completed_where_it_is_placed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A wall that is built up settles to the same bits as where it is found of all contacts at once what follows."""

    def wall() -> list[bytes]:
        simulation = Simulation(sleeping=False)
        simulation.add(collider={"plane": {}}, material={"friction": 0.3})
        told: list[bytes] = []
        for k in range(9):
            place = {"position": (1.01 * (k % 2), 0.5 + 1.01 * (k // 2), 0.02 * k)}
            simulation.add(collider=BOX, body={}, transform=place, material={"friction": 0.05 * k, "restitution": 0.1})
            for _ in range(40):
                simulation.step()
                contact = simulation.world[Contact]
                told += [getattr(contact, name)[: contact.count].tobytes() for name in FOLLOWS]
            told.append(state_hash(simulation.world).encode())
        return told

    passes: list[int] = []
    found = contacts.complete
    monkeypatch.setattr(contacts, "complete", lambda *given, **known: passes.append(1) or found(*given, **known))
    told = wall()
    assert 9 < len(passes) < 180  # of 360 steps
    passes.clear()
    monkeypatch.setattr(contacts, "Complete", type(None))  # then none is
    monkeypatch.setattr(contacts, "complete", lambda *given, known: passes.append(1) or found(*given, known=False))
    assert wall() == told
    assert len(passes) >= 360


def test_recycled_contacts_go_with_their_shapes(pair: tuple[Simulation, int]) -> None:
    """Moved by less than a thousandth of its half extent, its depths follow to the last digits."""
    simulation, box = pair
    simulation[box].transform.position = (2e-4, 1.0003, -3e-4)
    assert measured(simulation) == 0
    contact = simulation.world[Contact]
    assert contact.point[: contact.count, 1] == pytest.approx(0.5 + 0.5 * 0.0003, abs=2e-5)
    assert np.sort(contact.point[: contact.count, 0]) == pytest.approx([-0.4999, -0.4999, 0.5001, 0.5001], abs=2e-4)


@pytest.mark.parametrize(
    "change",
    [
        lambda simulation, box: setattr(simulation[box].transform, "position", (0.002, 1.0, 0.0)),
        lambda simulation, box: setattr(simulation[box].transform, "position", (0.0, 1.002, 0.0)),
        lambda simulation, box: setattr(simulation[box].transform, "rotation", (0.0, 0.002, 0.0, 1.0)),
    ],
    ids=["slipped", "lifted", "turned"],
)
def test_what_moves_is_measured_again(pair: tuple[Simulation, int], change: object) -> None:
    """By two thousandths of its half extent, or by four thousandths of a radian."""
    simulation, box = pair
    assert callable(change)
    change(simulation, box)
    assert measured(simulation) == 1


def test_who_reaches_farther_is_measured_again(pair: tuple[Simulation, int]) -> None:
    """Though it is where it was: what it could not reach before may be near; by a thousandth of its half extent.

    Who moves has what stirs others, too, in its reach: as much again.
    """
    simulation, box = pair
    contact, motion = simulation.world[Contact], simulation[box].motion
    reach = contact.seat_reach[0]
    assert (contact.seat_reach[:4] == reach).all()
    for part, again in ((0.4, 0), (1.1, 1)):
        motion.linear = (0.0, part * RECYCLED_SLIP * 0.5 * 60.0 / REACH_FACTOR, 0.0)
        assert measured(simulation) == again
        motion.linear, motion.angular = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        simulation[box].transform.position = (0.0, 1.0, 0.0)


@pytest.mark.parametrize("size", [(0.6, 1.0, 1.0), (1.23, 1.0, 0.83), (0.99, 1.0, 1.01)])
def test_another_size_is_measured_again(pair: tuple[Simulation, int], size: tuple[float, float, float]) -> None:
    """Though nothing has moved, and whatever the sizes have in common."""
    simulation, box = pair
    world = simulation.world
    with world.edit(Collider) as collider:
        row = world.row(box)
        collider.size[row, :3], collider.bound_half[row] = size, np.multiply(0.5, size)
    assert measured(simulation) == 1
    contact = world[Contact]
    assert np.abs(contact.point[: contact.count, 0]).max() == pytest.approx(0.5 * size[0], abs=1e-6)


def test_a_rolling_ball_is_measured_in_every_step() -> None:
    """The points of balls do not go with them."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}})
    ball = simulation.add(
        collider={"sphere": {"radius": 0.5}},
        body={},
        transform={"position": (0.0, 0.5, 0.0)},
        motion={"linear": (1e-4, 0.0, 0.0)},
    )
    assert measured(simulation, 10) == 10
    contact = simulation.world[Contact]
    assert contact.point[0, 0] == pytest.approx(
        simulation.world[Transform].position[simulation.world.row(ball), 0], abs=1e-6
    )


def test_what_is_to_be_measured_again_leaves_its_contacts_as_they_are(pair: tuple[Simulation, int]) -> None:
    """Turned about the first of its points, which hardly moves, while the others slip: that is not placed alone."""
    simulation, box = pair
    world = simulation.world
    contact, count = world[Contact], world[Contact].count
    before = [column[:count].copy() for column in (contact.normal, contact.depth, contact.point)]
    turn = quaternion.from_axis_angle((0.0, 1.0, 0.0), 0.002)
    transform = simulation[box].transform
    pivot = np.array([contact.point[0, 0], transform.position[1], contact.point[0, 2]])
    transform.position = pivot + quaternion.rotate(turn, transform.position - pivot) + (2e-4, 0.0, 0.0)
    transform.rotation = quaternion.multiply(turn, transform.rotation)
    with world.faces(None):
        reach_within(world, 1 / 60)
        found = measure_what_moved(world, world.row_numbers(Collider)[None], np.array([0.01]))
    assert found.old.tolist() == [-1] * 4
    slips = np.abs(found.point - before[2]).max(axis=1)
    assert 1e-4 < slips[0] < 4e-4 < slips[1:].min()
    for column, was in zip((contact.normal, contact.depth, contact.point), before, strict=True):
        assert np.array_equal(column[:count], was)


@pytest.mark.parametrize("astray", [None, (0, 0), (1, 3), (2, 7), (3, 3), (3, 16), (4, 8), (5, 0), (5, 2)])
def test_contacts_of_any_number_are_placed(astray: tuple[int, int] | None) -> None:
    """As many of a pair as there may be, of one normal or several, to the end of the table; one astray leaves all.

    With where they are from both bodies, or from what stands; a face bears the points on it.
    """
    generator = np.random.default_rng(5)
    numbers = np.array([1, 4, 8, 17, 9, 3])
    pairs, of = np.arange(12).reshape(6, 2), np.repeat(np.arange(6), numbers)
    count = len(of)
    collider, contact = Table(Collider, 12).live, Table(Contact, count).live
    assert isinstance(collider, Collider) and isinstance(contact, Contact)
    collider.shape[:], collider.bound_half[:] = Box.number, 1.0
    position, rotation = generator.normal(size=(12, 3)), quaternion.normalise(generator.normal(size=(12, 4)))
    normal = quaternion.normalise(generator.normal(size=(count, 3)))
    normal[of % 2 == 1] = normal[np.searchsorted(of, of)][of % 2 == 1]
    normal[of == 5] = quaternion.rotate(rotation[pairs[5, 1]], (0.0, 1.0, 0.0))
    point, depth = generator.normal(size=(count, 3)), 0.01 * generator.normal(size=count)
    body, center = np.arange(12) - 6, generator.normal(size=(6, 3))
    contact.seat_reach[:], contact.seat_depth[:], (contact.a[:], contact.b[:]) = 1.0, depth, pairs[of].T
    for side, sense, seat, lean in (
        (0, 0.5, contact.seat_a, contact.lean_a),
        (1, -0.5, contact.seat_b, contact.lean_b),
    ):
        back = quaternion.conjugate(rotation[pairs[of, side]])
        seat[:] = quaternion.rotate(back, point + sense * depth[:, None] * normal - position[pairs[of, side]])
        lean[:] = quaternion.rotate(back, normal)
    same = np.ones(count, np.bool_)
    if astray is not None:
        pair, number = astray
        same = of != pair
        contact.seat_b[np.argmin(same) + number] += 0.01
    table = contact.normal, contact.depth, contact.point
    offsets = contact.offset_a, contact.offset_b, contact.share
    for column in (*table, *offsets):
        column[:] = np.nan
    moved, reaches, kept, ends = (
        np.empty_like(pairs),
        np.empty(6),
        np.empty(count, np.int64),
        np.zeros((1, 2), np.int64),
    )
    recycle_contacts(
        ALONE, pairs, np.ones(6), True, count, np.arange(12), np.zeros(12, np.int32),
        collider.shape, collider.size, collider.geometry, collider.bound_half, collider.bound_radius,
        position, rotation, body, center, contact.a, contact.b,
        contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b, contact.seat_depth,
        contact.seat_reach, contact.form,
        moved, reaches, contact.row_a, contact.row_b, *table, *offsets, kept, ends,
    )  # fmt: skip
    assert ends.tolist() == [[same.sum(), 0 if astray is None else 1]]
    assert kept[: ends[0, 0]].tolist() == np.flatnonzero(same).tolist()
    for found, wanted in zip(table, (normal, depth, point), strict=True):
        assert found[same] == pytest.approx(wanted[same], abs=1e-14)
        assert np.isnan(found[~same]).all()
    half = 0.5 * depth[:, None] * normal
    seats = np.concatenate([position[:6], center])[pairs[of]]
    wanted_offsets = point + half - seats[:, 0], point - half - seats[:, 1], np.where(of == 5, 0.0, 0.5)
    for found, wanted in zip(offsets, wanted_offsets, strict=True):
        assert found[same] == pytest.approx(wanted[same], abs=1e-14)
        assert np.isnan(found[~same]).all()
