"""Where in its keyframes a path is at a time."""

from __future__ import annotations

from math import floor

# mypy: disable-error-code="no-untyped-def"
from carom.ecs.components.path import Repeat
from carom.systems.kernels.kernel import kernel

LOOP, PING_PONG = Repeat.LOOP.value, Repeat.PING_PONG.value


@kernel("before", "share")
def find_moments(rows, time, first, count, repeat, at, before, share):
    """Write for each row of a path the keyframe it is at or past, and which share of the way to the next it has gone.

    Before the first keyframe and after the last of one that does not repeat it stays there.
    """
    for n in range(len(rows)):
        i = rows[n]
        k, last = first[i], first[i] + count[i] - 1
        since, period = time - at[k], at[last] - at[k]
        if since > 0.0 and repeat[i] == LOOP:
            since -= period * floor(since / period)
        elif since > 0.0 and repeat[i] == PING_PONG:
            since -= 2.0 * period * floor(since / (2.0 * period))
            since = min(since, 2.0 * period - since)
        since = min(max(since, 0.0), period)
        while k < last - 1 and at[k + 1] - at[first[i]] <= since:
            k += 1
        before[n] = k
        share[n] = (since - (at[k] - at[first[i]])) / (at[k + 1] - at[k])
