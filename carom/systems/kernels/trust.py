"""Trust: for how long what is known of the contacts of fast pairs says when they meet."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import MEET
from carom.systems.kernels.fast_pairs import NEVER, motion_of, speed_of
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.spatial import cross


@kernel("agrees", "left")
def find_agreeing(
    pairs, numbers, times, span, row_a, row_b, normal, depth, point, body_row, center, linear, angular, agrees, left
):
    """Tell which pairs need nobody to look: their contacts, followed straight on, say when they meet just as well.

    That is so where both times are the same, but for as long as the bodies may move by what a contact is trusted, and
    for what is near already as long as nobody turns by more than that. Contacts are in order of pair, as pairs are.
    Where there are some of such a pair, all of the way for which they are trusted is ``left`` (m), else nothing.
    """
    c = 0
    for p in range(len(pairs)):
        a, b = pairs[p, 0], pairs[p, 1]
        i, o = body_row[a], body_row[b]
        while c < len(row_a) and (row_a[c] < a or (row_a[c] == a and row_b[c] < b)):
            c += 1
        straight, near_now, first = NEVER, False, c
        while c < len(row_a) and row_a[c] == a and row_b[c] == b:
            closing = 0.0
            for body, sense in ((i, 1.0), (o, -1.0)):
                if body >= 0:
                    x, y, z = cross(
                        angular[body, 0], angular[body, 1], angular[body, 2],
                        point[c, 0] - center[body, 0], point[c, 1] - center[body, 1], point[c, 2] - center[body, 2],
                    )  # fmt: skip
                    for k, turn_k in enumerate((x, y, z)):
                        closing += sense * normal[c, k] * (linear[body, k] + turn_k)
            near_now |= -depth[c] <= numbers[p, 3]
            if closing > 0.0 and -depth[c] < closing * span:
                straight = min(straight, max(0.0, -depth[c] / closing))
            c += 1
        smaller = int(numbers[p, 2])
        way, turning = motion_of(i if smaller == 0 else o, o if smaller == 0 else i, center, linear, angular)
        turning *= numbers[p, smaller]
        most = way + turning
        if near_now:
            agrees[p] = turning * span <= numbers[p, 3]
        else:
            agrees[p] = abs(straight - times[p]) * most <= numbers[p, 3] or straight == times[p]
        if agrees[p]:
            left[p] = numbers[p, 3] if c > first else 0.0


@woven
def change_of(i, linear, angular, before_linear, before_angular, reach):
    """Return how much the velocity of a point within ``reach`` of the centre of body i may have changed; of none, 0."""
    if i < 0:
        return 0.0
    quick, spin = 0.0, 0.0
    for k in range(3):
        quick += (linear[i, k] - before_linear[i, k]) ** 2
        spin += (angular[i, k] - before_angular[i, k]) ** 2
    return sqrt(quick) + sqrt(spin) * reach


@kernel("asked", "left")
def spend_trust(
    elapsed, since, rest, bodies, numbers, roots, linear, angular, before_linear, before_angular, asked, left
):  # fmt: skip
    """Take from what is ``left`` of the way (m) for which contacts of pairs are trusted what bodies went since a look.

    That was ``elapsed`` seconds ago, and ``since`` detection, when velocities were those ``before``. Pairs that agreed
    then are ``asked`` once bodies go another way than was foreseen by more than at which a contact is found, in the
    ``rest`` of the substep; until then they went straight, and only turning counts.
    """
    for p in range(len(bodies)):
        i, o, trust = bodies[p, 0], bodies[p, 1], numbers[p, 3]
        before = 0.0
        if asked[p]:
            for body, reach in ((i, numbers[p, 0]), (o, numbers[p, 1])):
                quick = speed_of(body, elapsed, linear, angular, reach)
                before += max(quick, speed_of(body, elapsed, before_linear, before_angular, reach))
        else:
            change = change_of(i, linear, angular, before_linear, before_angular, numbers[p, 0])
            change += change_of(o, linear, angular, before_linear, before_angular, numbers[p, 1])
            if change * rest <= MEET * trust:
                continue
            asked[p], before = True, MEET * trust
            for body, reach in ((i, numbers[p, 0]), (o, numbers[p, 1])):
                if body >= 0:
                    x, y, z = before_angular[body, 0], before_angular[body, 1], before_angular[body, 2]
                    before += sqrt(x * x + y * y + z * z) * reach * since
        left[p] = max(0.0, left[p] - before) if roots[p] < 0 else 0.0
