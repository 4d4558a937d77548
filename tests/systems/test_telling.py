"""Contacts of fast pairs that still tell where these meet are gone by; who comes to meet elsewhere is detected anew."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from typing import Any

import numpy as np
import pytest

from carom.ecs import Collider, Motion, Transform, World
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.constants import ROLLED_ASIDE, TOLD, TRUST
from carom.systems.continuous import Fast
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.contacts import detect
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.meeting import foresee_meetings
from carom.systems.kernels.swinging import TRUSTED
from carom.systems.kernels.telling import ask_told
from carom.systems.kernels.told import renew_told
from carom.systems.looked import Told
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

H, GAP = 1.0 / 240.0, 1e-3  # s, m
UP, EVEN, Z = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 0.0, 1.0]), (0.0, 0.0, 1.0)
PLATE, ROD = {"box": {"size": (0.6, 0.04, 0.6)}}, {"box": {"size": (1.2, 0.06, 0.06)}}
COIN, PEBBLE = {"cylinder": {"radius": 0.3, "length": 0.04}}, {"ellipsoid": {"radii": (0.3, 0.02, 0.3)}}
PLANE: dict[str, Any] = {"plane": {}}
TILE = {"height_field": {"heights": [[0.0, 0.0], [0.0, 0.0]], "spacing": 4.0}}  # as far as 2 m from its middle
RIDGE = {"box": {"size": (2.0**0.5, 2.0**0.5, 4.0)}}  # on its edge: a metre above its middle
ON_EDGE = {"position": (0.0, -1.0, 0.0), "rotation": quaternion.from_axis_angle(Z, np.pi / 4.0)}


def lowest(collider: dict[str, Any], rotation: Floats) -> float:
    """Return how far (m) beneath its centre a box, cylinder or ellipsoid of these words reaches."""
    (kind, words), up = *collider.items(), quaternion.rotate(quaternion.conjugate(rotation), UP)
    if kind == "box":
        return float(0.5 * np.abs(up * words["size"]).sum())
    if kind == "ellipsoid":
        return float(np.linalg.norm(up * words["radii"]))
    return float(words["radius"] * np.hypot(up[0], up[2]) + 0.5 * words["length"] * abs(up[1]))


def found(
    collider: dict[str, Any], rotation: Floats, ground: dict[str, Any] = PLANE, *, at: tuple[float, float] = (0.0, 0.0),
    **words: Any,
) -> Simulation:  # fmt: skip
    """Return a body that falls and is detected a millimetre above the ground."""
    simulation = Simulation(checked=False)
    simulation.add(collider=ground, **words)
    place = (at[0], GAP + lowest(collider, rotation), at[1])
    motion = {"linear": -8.0 * UP, "angular": (1.0, 2.0, 3.0)}
    simulation.add(
        name="it", collider=collider, body={}, transform={"position": place, "rotation": rotation}, motion=motion
    )
    with simulation.world.faces(None):
        reach_within(simulation.world, H)
        detect(simulation.world, H, H)
    assert simulation.world[Contact].count > 0
    return simulation


@kernel(
    "room", "places", "left", "tells", "depth", "offset_a", "offset_b", "resting", "stale", "lanes", makes_arrays=True
)
def ask_and_renew(
    span, center, turns, linear, angular, felt, bodies, numbers, cores, roots, local_position, local_rotation,
    bounds, nodes, triangles, room, asked, times, body_a, body_b, normal, spans, around, places, left, tells,
    count, start, group_of, lane_of, row, stale, row_a, row_b, shape, bound_radius, depth, offset_a, offset_b, resting,
    lanes,
):  # fmt: skip
    """Tell whether contacts tell where pairs meet, and write how they do."""
    told = ask_told(
        span, center, turns, linear, angular, felt, bodies, numbers, cores, roots, local_position, local_rotation,
        bounds, nodes, triangles, room, asked, times, body_a, body_b, normal, spans, around, places, left, tells,
    )  # fmt: skip
    if told:
        renew_told(
            count, start, group_of, lane_of, row, stale, row_a, row_b, shape, bound_radius, body_a, body_b, normal,
            spans, around, places, numbers[:, TRUSTED], tells, center, turns, linear, angular, depth, offset_a,
            offset_b, resting, lanes,
        )  # fmt: skip
    return told


def tells(simulation: Simulation, way: Floats, turn: Floats, *, span: float = 1e-6) -> bool:
    """Tell whether the contacts tell where the body meets once it has come so far and turned so, and ``span`` on."""
    world, row = simulation.world, simulation.world.row(int(simulation.world.find("it")))
    with world.faces(None):
        transform, flight, fast = world[Transform], world[Flight], world[Fast]
        motion, contact, resting, collider = world[Motion], world[Contact], world[Resting], world[Collider]
        transform.rotation[row] = quaternion.multiply(turn, transform.rotation[row])
        flight.center[row] = flight.start_center[row] = flight.detected_center[row] + way
        of = fast.all
        of.asked[:], of.near[:], of.left[:], of.times[:] = True, True, 0.0, 0.0
        moves = flight.center, transform.rotation, motion.linear, motion.angular, flight.felt

        def soon() -> float:
            where = flight.detected_center, flight.detected_rotation, flight.reach
            return float(foresee_meetings(span, False, False, *moves, *where, *fast.columns[:14]))

        assert soon() == 0.0
        answer: bool = ask_and_renew(
            span, *moves, *of.looked, *fast.land, of.asked, of.times, contact.body_a, contact.body_b, contact.normal,
            *fast.told, of.left, np.empty(len(of.pairs), np.bool_), resting.count, resting.start, resting.group_of,
            resting.lane_of, resting.row, resting.stale, contact.row_a, contact.row_b, collider.shape,
            collider.bound_radius, contact.depth, contact.offset_a, contact.offset_b, contact.resting, resting.lanes,
        )  # fmt: skip
        assert (soon() > 0.0) == answer  # it is trusted again
    return answer


def tell_nothing(fast: Fast, world: World) -> None:
    """Note of no contact where it is, so that whoever is to be looked at is detected."""
    fast.told = Told.room(len(fast.all.pairs), world[Contact].count)
    fast.told.spans[:] = 0


def deepest(simulation: Simulation) -> float:
    """Return how deep (m) the deepest contact is."""
    contact = simulation.world[Contact]
    return float(contact.depth[: contact.count].max())


@pytest.mark.parametrize("ground", [PLANE, TILE], ids=["plane", "field"])
@pytest.mark.parametrize("collider", [PLATE, ROD, COIN, PEBBLE], ids=["plate", "rod", "coin", "pebble"])
@pytest.mark.parametrize("seed", range(4))
def test_who_has_come_on_by_as_much_as_it_is_thick_is_as_deep_as_contacts_tell(
    collider: dict[str, Any], ground: dict[str, Any], seed: int
) -> None:
    """Corners are as deep as they are; a rim that has turned by 0.02 rad is put where it is lowest by now."""
    random = np.random.default_rng(seed)
    rotation = quaternion.from_axis_angle((1.0, 0.0, 0.5), random.uniform(0.5, 1.0))
    simulation = found(collider, rotation, ground, at=(0.2, 0.3))
    turn = quaternion.from_axis_angle(tuple(random.normal(size=3)), 0.02)
    goal = GAP * random.uniform(-0.5, 0.5)  # where it is by then
    height = GAP + lowest(collider, rotation)
    rise = goal + lowest(collider, quaternion.multiply(turn, rotation)) - height
    assert tells(simulation, np.array([*random.uniform(-0.02, 0.02, 2), 0.0])[[0, 2, 1]] + rise * UP, turn)
    exact = collider in (PLATE, ROD)  # what is less off than that stays where it is
    assert deepest(simulation) == pytest.approx(-goal, abs=1e-12 if exact else 1.01 * ROLLED_ASIDE * TRUST * 0.02)


def test_a_contact_that_is_off_does_not_tell() -> None:
    """As that of a coin's rim that has rolled on: by more than is believed, but not by less."""
    rotation = quaternion.from_axis_angle(Z, 1.2)
    for angle, answer in ((0.02, True), (0.4, False)):
        simulation = found(COIN, rotation)
        turn = quaternion.from_axis_angle(tuple(quaternion.rotate(rotation, UP)), angle)  # about its own axis
        assert tells(simulation, np.zeros(3), turn) == answer
        assert (0.3 * np.sin(1.2) * (1.0 - np.cos(angle)) < TOLD * TRUST * 0.02) == answer


def test_who_meets_with_another_corner_is_detected_anew() -> None:
    """The plate has turned over, and stands on the corner that was farthest, as high as before."""
    rotation = quaternion.from_axis_angle(Z, 1.0)
    simulation = found(PLATE, rotation)
    assert not tells(simulation, np.zeros(3), quaternion.from_axis_angle(Z, np.pi))


def test_who_has_come_beyond_the_end_of_a_face_is_detected_anew() -> None:
    """Its corner is half a millimetre beyond, and as near to the edge as it was to the face."""
    rotation, end = quaternion.from_axis_angle(Z, 1.0), 2.0
    corner = quaternion.rotate(rotation, np.array([-0.3, -0.02, 0.0]))[0]
    for way, answer in ((0.01, True), (0.0205, False)):
        simulation = found(PLATE, rotation, TILE, at=(end - 0.02 - corner, 0.0))
        assert tells(simulation, np.array([way, 0.0, 0.0]), EVEN) == answer


@pytest.mark.parametrize(("speed", "answer"), [(20.0, False), (-20.0, True), (0.2, True)])
def test_who_comes_beyond_the_end_before_it_is_asked_again_is_detected_anew(speed: float, answer: bool) -> None:
    """It is 2 mm before the end; contacts are trusted for 5 mm, and for a millisecond."""
    rotation, end = quaternion.from_axis_angle(Z, 1.0), 2.0
    corner = quaternion.rotate(rotation, np.array([-0.3, -0.02, 0.0]))[0]
    simulation = found(PLATE, rotation, TILE, at=(end - 0.002 - corner, 0.0))
    with simulation.world.edit(Motion) as motion:
        motion.linear[:], motion.angular[:] = (speed, 0.0, 0.0), 0.0
    assert tells(simulation, np.zeros(3), EVEN, span=1e-3) == answer


@pytest.mark.parametrize(("angle", "answer"), [(0.01, True), (0.1, False)])
def test_who_has_turned_about_an_edge_is_detected_anew(angle: float, answer: bool) -> None:
    """It still touches there, but its face leads another way."""
    simulation = found(PLATE, EVEN, RIDGE, transform=ON_EDGE)
    rise = (GAP + 0.02) * (1.0 / np.cos(angle) - 1.0)
    assert tells(simulation, rise * UP, quaternion.from_axis_angle(Z, angle)) == answer


@pytest.mark.parametrize("ground", [PLANE, TILE], ids=["plane", "field"])
@pytest.mark.parametrize("collider", [PLATE, ROD], ids=["plate", "rod"])
def test_what_tumbles_onto_the_ground_is_seldom_detected_anew_and_strikes_as_ever(
    collider: dict[str, Any], ground: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first blow is that of a world that detects whenever contacts have been trusted as far as they are."""

    def fall(seed: int) -> tuple[Simulation, Floats]:
        simulation, random = Simulation(checked=False), np.random.default_rng(seed)
        simulation.add(collider=ground)
        simulation.add(
            collider=collider, body={"mass": 1.0},
            transform={"position": (0.1, 0.8, 0.1), "rotation": quaternion.normalise(random.normal(size=4))},
            motion={"linear": (1.0, -8.0, 0.5), "angular": random.uniform(-20.0, 20.0, 3)},
        )  # fmt: skip
        impact = simulation.world[Impact]
        while not impact.count:
            simulation.step()
        first = np.array([impact.time[0], impact.speed[0], *impact.impulse[:1], *impact.point[0], *impact.normal[0]])
        simulation.step(20 - simulation.frame)
        return simulation, first

    told = [fall(seed) for seed in range(6)]
    monkeypatch.setattr(Fast, "note", tell_nothing)
    anew = [fall(seed) for seed in range(6)]
    for (_, first), (_, as_ever) in zip(told, anew, strict=True):
        np.testing.assert_allclose(first, as_ever, rtol=1e-6, atol=1e-9)
    numbers = [[one.world[Answered].detections - one.frame for one, _ in both] for both in (told, anew)]
    assert sum(numbers[0]) < 0.25 * sum(numbers[1])


def test_a_crowd_that_falls_on_land_is_detected_a_few_times_in_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each is asked at its own time, and nobody is given up or lost."""

    def fallen() -> int:
        simulation, random = Simulation(checked=False), np.random.default_rng(1)
        heights = random.uniform(-0.3, 0.3, (17, 17)).tolist()
        simulation.add(collider={"height_field": {"heights": heights, "spacing": 0.5}})
        for x, z in np.ndindex(5, 5):
            place = {"position": (x - 2.0, 1.0, z - 2.0), "rotation": quaternion.normalise(random.normal(size=4))}
            motion = {"linear": -6.0 * UP, "angular": random.uniform(-5.0, 5.0, 3)}
            simulation.add(collider=COIN, body={"mass": 1.0}, transform=place, motion=motion)
        simulation.step(40)
        world = simulation.world
        assert world[Transform].position[world.row_numbers(Collider)[1:], 1].min() > -0.4
        assert world[Answered].looks_cut == 0
        return int(world[Answered].detections)

    told = fallen()
    monkeypatch.setattr(Fast, "note", tell_nothing)
    assert told < 0.25 * fallen()
