"""Trust: for how long what is known of the contacts of fast pairs says when they meet."""

from __future__ import annotations

from math import inf

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APART_MARGIN, ASTRAY, GLIDING, MEET
from carom.systems.kernels.arriving import sought_to
from carom.systems.kernels.bodies import length_of
from carom.systems.kernels.fast_pairs import NEVER, between, motion_of
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.seen import speeds_seen
from carom.systems.kernels.spatial import cross
from carom.systems.kernels.swinging import (
    LEVER,
    REACH,
    SMALLER,
    SPIN,
    SWING,
    TRUSTED,
    spin_of,
    swing_about,
    swing_now,
    swing_of,
)


@kernel("trusts")
def find_trusts(bodies, numbers, linear, angular, trusts):
    """Write of each body of these pairs how far it is trusted to go, how far it reaches, and how fast others come.

    That is how far its contacts are trusted (m), how far it reaches from its centre (m), how fast those are whom it may
    meet (m/s), as seen from the first of them, whose velocity comes next (3), and its lever (m) about the axis about
    which it turns, its spin as it sees that (3); a ball about its body's centre turns without effect.
    """
    for p in range(len(bodies)):
        for side in range(2):
            i, o = bodies[p, side], bodies[p, 1 - side]
            if i < 0:
                continue
            for k in range(3 if trusts[i, 0] == inf and o >= 0 else 0):
                trusts[i, 3 + k] = linear[o, k]
            trusts[i, 0] = min(trusts[i, 0], numbers[p, TRUSTED])
            trusts[i, 1] = max(trusts[i, 1], numbers[p, REACH + side])
            trusts[i, 6] = max(trusts[i, 6], numbers[p, LEVER + side])
            for k in range(3):
                trusts[i, 7 + k] = numbers[p, SPIN + 3 * side + k]
            comes = between(o, i, linear, trusts[:, 3:]) + length_of(o, angular) * numbers[p, LEVER + 1 - side]
            trusts[i, 2] = max(trusts[i, 2], comes)


@woven
def coming_of(i, turns, linear, angular, trusts):
    """Return how fast (m/s) body i and those whom it may meet come to each other as it moves now."""
    x, y, z = spin_of(i, turns, angular)
    swing = swing_about(x, y, z, trusts[i, 7], trusts[i, 8], trusts[i, 9], trusts[i, 6], trusts[i, 1])
    return between(i, i, linear, trusts[:, 3:]) + trusts[i, 2] + swing


@woven
def closing_of(c, i, o, normal, point, center, linear, angular):
    """Return how fast (m/s) contact c of bodies i and o closes."""
    closing = 0.0
    for body, sense in ((i, 1.0), (o, -1.0)):
        if body >= 0:
            x, y, z = cross(
                angular[body, 0], angular[body, 1], angular[body, 2],
                point[c, 0] - center[body, 0], point[c, 1] - center[body, 1], point[c, 2] - center[body, 2],
            )  # fmt: skip
            for k, turn_k in enumerate((x, y, z)):
                closing += sense * normal[c, k] * (linear[body, k] + turn_k)
    return closing


@kernel("agrees")
def find_agreeing(
    pairs, numbers, times, span, row_a, row_b, normal, depth, point, body_row, reach, center, linear, angular, agrees
):
    """Tell which pairs need nobody to look: their contacts, followed straight on, say when they meet just as well.

    That is so where both times are the same, but for as long as the bodies may move by what a contact is trusted, and
    for what is near already as long as nobody turns by more than that; and no corner may come that was too far to be a
    contact, as bodies ``reach``. Contacts are in order of pair, as pairs are.
    """
    c = 0
    for p in range(len(pairs)):
        a, b = pairs[p, 0], pairs[p, 1]
        i, o = body_row[a], body_row[b]
        while c < len(row_a) and (row_a[c] < a or (row_a[c] == a and row_b[c] < b)):
            c += 1
        straight, near_now = NEVER, False
        while c < len(row_a) and row_a[c] == a and row_b[c] == b:
            closing = closing_of(c, i, o, normal, point, center, linear, angular)
            near_now |= -depth[c] <= numbers[p, TRUSTED]
            if closing > 0.0 and -depth[c] < closing * span:
                straight = min(straight, max(0.0, -depth[c] / closing))
            c += 1
        smaller = int(numbers[p, SMALLER])
        small, other = (i, o) if smaller == 0 else (o, i)
        way, _, _, _ = motion_of(small, other, center, linear, angular, linear, angular)
        most = way + numbers[p, SWING]
        if near_now:
            agrees[p] = numbers[p, SWING] * span <= numbers[p, TRUSTED]
        else:
            agrees[p] = abs(straight - times[p]) * most <= numbers[p, TRUSTED] or straight == times[p]
            agrees[p] &= straight == NEVER or most * span <= sought_to(p, i, o, numbers, reach)


@inlined
def ask_straying(time, span, bodies, numbers, turns, linear, angular, before, asked, strays):
    """Let who agreed when pairs were found, as velocities were ``before``, be ``asked`` once it goes another way.

    That is by more than at which a contact is found, within the ``time`` (s): as other impacts have it and, without
    any, precession. Where speed is not to count, it is what it was ``before``. Who is asked and turns by more than
    ASTRAY in ``span`` (s) ``strays`` from contacts that are too far to be trusted. Tell whether there are any.
    """
    some = False
    for p in range(len(bodies)):
        off, turned = 0.0, 0.0
        for side in range(2):
            i = bodies[p, side]
            if i < 0:
                continue
            turned = max(turned, span * length_of(i, angular))
            x, y, z = spin_of(i, turns, angular)
            spin = SPIN + 3 * side
            x, y, z = x - numbers[p, spin], y - numbers[p, spin + 1], z - numbers[p, spin + 2]
            off += between(i, i, linear, before) + swing_of(p, side, x, y, z, numbers)
        asked[p] = asked[p] or off * time > MEET * numbers[p, TRUSTED]
        strays[p] = asked[p] and turned > ASTRAY
        some |= strays[p]
    return some


@inlined
def spend_trust(
    elapsed, span, bodies, numbers, center, turns, linear, angular, before, angular_before, struck, left, times
):  # fmt: skip
    """Take from what is ``left`` of the way (m) for which contacts of pairs are trusted what bodies went since a look.

    That was ``elapsed`` seconds ago, in a substep of ``span`` seconds, and how far they glide counts little (GLIDING);
    velocities ``before`` are those when pairs were found. No more counts than what either sees of the other
    (`speeds_seen`), as both moved before or do now. Their ``times`` to be looked at come nearer, and are 0, unknown,
    where a body was ``struck`` or trust is spent.
    """
    for p in range(len(bodies)):
        i, o = bodies[p, 0], bodies[p, 1]
        came = GLIDING * max(
            between(i, o, linear, linear), between(i, o, linear, before),
            between(i, o, before, linear), between(i, o, before, before),
        )  # fmt: skip
        for side in range(2):
            spin = SPIN + 3 * side
            came += max(
                swing_now(p, side, bodies[p, side], turns, angular, numbers),
                swing_of(p, side, numbers[p, spin], numbers[p, spin + 1], numbers[p, spin + 2], numbers),
            )
        if i >= 0 and o >= 0:
            for side, one, other in ((0, i, o), (1, o, i)):
                seen = 0.0
                for one_linear, one_angular in ((linear, angular), (before, angular_before)):
                    for other_linear, other_angular in ((linear, angular), (before, angular_before)):
                        _, of_trust = speeds_seen(
                            p, one, other, side, span, 0.0, numbers, center, one_linear, one_angular,
                            other_linear, other_angular,
                        )  # fmt: skip
                        seen = max(seen, of_trust)
                came = min(came, seen)
        rest, unknown = left[p] - came * elapsed, (i >= 0 and struck[i]) or (o >= 0 and struck[o])
        if rest <= APART_MARGIN * numbers[p, TRUSTED]:  # most often all of it, but for rounding
            unknown |= left[p] > 0.0
            rest = 0.0
        left[p] = rest
        until = times[p] - elapsed
        times[p] = 0.0 if unknown or until <= APART_MARGIN * times[p] else until
