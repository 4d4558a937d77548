"""For how long contacts of fast pairs are trusted, and what is left of that after bodies have flown."""

from __future__ import annotations

import numpy as np
import pytest
import spending

from carom.ecs import Motion, Transform, World
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.systems.constants import GLIDING, MEET, TOLD
from carom.systems.constants import TRUST as TRUST_PART
from carom.systems.continuous import Fast
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.contacts import detect
from carom.systems.kernels import swinging
from carom.systems.kernels.fast_pairs import NEVER
from carom.systems.kernels.meeting import foresee_meetings
from carom.systems.simulation import Simulation

TRUST, REACH = 0.04, 0.5
STILL, ALONG, ACROSS = np.zeros((1, 3)), np.array([[4.0, 0.0, 0.0]]), np.array([[0.0, 0.0, 4.0]])


def spend(
    *, asked: bool, linear: Floats = ALONG, angular: Floats = STILL, before: Floats = ALONG, spin: Floats = STILL,
    left: float = TRUST,
) -> tuple[bool, float]:  # fmt: skip
    """Return whether a pair is looked after, and what is left, 2 ms after a look and 10 ms before the next."""
    asks, lefts = np.array([asked]), np.array([left])
    spending.spend(0.002, of_pair(spin=spin), lefts, linear, angular, before, asked=asks)
    return bool(asks[0]), float(lefts[0])


def of_pair(*, other: float = 0.0, spin: Floats = STILL) -> Floats:
    """Return the numbers of a pair whose first turns about an axis through all of it, as a pencil does about its own.

    The second reaches so far (m) from its centre.
    """
    numbers = np.zeros((1, swinging.NUMBERS))
    numbers[0, swinging.REACH : swinging.REACH + 2] = REACH, other
    numbers[0, swinging.TRUSTED], numbers[0, swinging.SPIN : swinging.SPIN + 3] = TRUST, spin[0]
    return numbers


@pytest.mark.parametrize(("linear", "before"), [(ALONG, ALONG), (STILL, ALONG), (ALONG, STILL)])
def test_who_is_looked_after_spends_the_way_it_may_have_come(linear: Floats, before: Floats) -> None:
    """At the greater of its speeds before and now, since when it was struck is not asked; gliding counts little."""
    left = pytest.approx(TRUST - GLIDING * 0.002 * 4.0, rel=1e-12)
    assert spend(asked=True, linear=linear, before=before) == (True, left)


def test_turning_counts_at_the_reach() -> None:
    """4 rad/s half a metre from the centre are 2 m/s, all of which count; 4 m/s beside it do in part.

    But about the axis about which it turned at first it comes nowhere, however fast it is by now.
    """
    left = TRUST - 0.002 * (GLIDING * 4.0 + 2.0)
    assert spend(asked=True, angular=ACROSS)[1] == pytest.approx(left, rel=1e-12)
    for faster in (1.0, 100.0):
        found = spend(asked=False, angular=faster * ACROSS, spin=ACROSS)
        assert found == (False, pytest.approx(TRUST - 0.002 * GLIDING * 4.0, rel=1e-12))


def test_only_what_moves_against_each_other_counts() -> None:
    """Two that fly side by side spend nothing; where one was stopped on the way, all of its speed."""
    numbers, both, lefts = of_pair(other=REACH), np.tile(ALONG, (2, 1)), np.array([TRUST])
    still, stopped = np.zeros((2, 3)), np.vstack([ALONG, STILL])
    spending.spend(0.002, numbers, lefts, both, still, both, bodies=(0, 1))
    assert lefts == TRUST
    for now, before in ((both, stopped), (stopped, both)):
        lefts[:] = TRUST
        spending.spend(0.002, numbers, lefts, now, still, before, bodies=(0, 1))
        assert lefts == pytest.approx(TRUST - GLIDING * 0.002 * 4.0, rel=1e-12)


def test_who_goes_round_with_what_turns_spends_as_it_sees_that() -> None:
    """Three metres from its centre, with it: contacts are off by no more than what their points turn aside by."""
    spin, reach, span = 4.0, 3.5, 0.01
    round_about = np.array([[0.0, 0.0, spin], [0.0, 0.0, spin]])
    along = np.array([[3.0 * spin, 0.0, 0.0], [0.0, 0.0, 0.0]])
    aside = 0.5 * spin * spin * (REACH + reach) * span
    for extra in (np.zeros(3), np.array([0.0, 2.0, 0.0])):
        lefts, linear = np.array([TRUST]), along + np.outer((1.0, 0.0), extra)
        spending.spend(0.001, of_pair(other=reach), lefts, linear, round_about, linear, bodies=(0, 1), span=span)
        way, speed = np.linalg.norm(extra), np.linalg.norm(linear[0])
        seen = GLIDING * (way + spin * speed * span) + (aside + spin * way * span) / TOLD
        assert lefts == pytest.approx(TRUST - 0.001 * seen, rel=1e-12)
        assert seen < 0.5 * (GLIDING * speed + spin * (REACH + reach))


def test_where_one_was_struck_both_ways_count() -> None:
    """Who went round with it until then may have left it at once, or just now."""
    spin, still = np.array([[0.0, 0.0, 4.0], [0.0, 0.0, 4.0]]), np.zeros((2, 3))
    along = np.array([[12.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    most = 4.0 * (REACH + 3.5) + GLIDING * 12.0  # as the world sees it
    for now, before, struck in ((along, along, False), (along, still, True), (still, along, True)):
        lefts = np.array([TRUST])
        spending.spend(0.001, of_pair(other=3.5), lefts, now, spin, before, bodies=(0, 1))
        assert (lefts == pytest.approx(TRUST - 0.001 * most)) == struck
        assert lefts >= TRUST - 0.001 * most - 1e-15


def test_the_time_to_the_next_look_is_known_until_one_is_struck() -> None:
    """Or trust is spent, from which it was found."""
    for struck, left, elapsed, known in (
        (False, 0.0, 0.002, 0.003), (False, 1.0, 0.002, 0.003), (True, 0.0, 0.002, 0.0), (False, 0.001, 0.002, 0.0),
        (False, 0.0, 0.005, 0.0),
    ):  # fmt: skip
        times, lefts, hit = np.array([0.005]), np.array([left]), np.array([struck, False])
        spending.spend(elapsed, of_pair(), lefts, ALONG, STILL, ALONG, struck=hit, times=times)
        assert times == pytest.approx(known)


def test_no_more_is_spent_than_there_is() -> None:
    """What is 0 is far."""
    assert spend(asked=True, left=0.001) == (True, 0.0)


def test_who_goes_straight_on_needs_nobody_to_look() -> None:
    """However far that is."""
    assert spend(asked=False, left=0.0) == (False, 0.0)


@pytest.mark.parametrize("angular", [False, True])
def test_who_goes_another_way_is_looked_after(angular: bool) -> None:
    """Where within the time it may be MEET of the trust from where it was foreseen; nothing is known."""
    off = MEET * TRUST / 0.01
    for part, asked in ((0.999, False), (1.001, True)):
        change = np.array([[0.0, part * off, 0.0]])
        if angular:
            found = spend(asked=False, angular=ACROSS + change / REACH, spin=ACROSS, left=0.0)
        else:
            found = spend(asked=False, linear=ALONG + change, spin=ACROSS, angular=ACROSS, left=0.0)
        assert found == (asked, 0.0)


@pytest.mark.parametrize("near", [True, False])
def test_who_was_not_near_when_contacts_were_found_is_not_trusted_once_he_is(near: bool) -> None:
    """A box that has come within the trust: its contact was left out as too far, unless it was near all the time.

    Then it may go on for as far as it is trusted, else until it is well within what is near.
    """
    half, speed = 0.1, 0.7 * 0.1 * TRUST_PART * 240.0  # 0.7 of the trust in a substep
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider={"box": {"size": (4.0, 1.0, 4.0)}}, transform={"position": (0.0, -0.5, 0.0)})
    place = {"position": (0.0, half + 0.6 * half * TRUST_PART, 0.0)}
    box = {"box": {"size": (0.2, 0.2, 0.2)}}
    simulation.add(collider=box, body={}, transform=place, motion={"linear": (0.0, -speed, 0.0)})
    world = simulation.world
    with world.faces(None):
        np.copyto(world[Flight].center, world[Transform].position)
        reach_within(world, simulation.settings.dt)
        detect(world, simulation.settings.dt, 1.0 / 240.0)
        fast = world[Fast]
        assert fast.all.looked.numbers[:, swinging.TRUSTED] == half * TRUST_PART
        fast.all.asked[:], fast.all.near[:], fast.all.left[:], fast.all.times[:] = True, near, 0.0, 0.0
        time = foresee(world, found=True)
    wanted = (0.6 - 0.5 * MEET) * half * TRUST_PART / speed
    assert time == (NEVER if near else pytest.approx(wanted, rel=1e-9))
    assert fast.all.near == near
    assert fast.all.left == (half * TRUST_PART if near else 0.0)
    fast.all.left[:], fast.all.times[:] = 0.0, 0.0012  # who has a time keeps it
    assert foresee(world, found=False) == 0.0012


def foresee(world: World, *, found: bool) -> float:
    """Return when (s) the first of the fast pairs of a world is to be looked at, within a substep."""
    flight, motion, fast = world[Flight], world[Motion], world[Fast]
    with world.faces(None):
        time: float = foresee_meetings(
            1.0 / 240.0, False, found, flight.center, world[Transform].rotation, motion.linear, motion.angular,
            flight.felt, flight.detected_center, flight.detected_rotation, flight.reach, *fast.columns[:14],
        )  # fmt: skip
    return time
