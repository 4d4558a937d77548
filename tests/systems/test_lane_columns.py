"""Columns in lanes: what is taken from eight rows and given back is theirs, wherever they are."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numba
import numpy as np
import pytest

from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lane_columns import (
    give_four,
    give_one,
    give_three,
    in_a_row,
    take_four,
    take_freedom,
    take_one,
    take_three,
)
from carom.systems.kernels.lanes import WIDTH, address, load, store


@kernel("one", "three", "four", makes_arrays=True)
def turn_round(rows, one, three, four, six):
    """Write the numbers of each row of a column in another order, and to the first what the last of six is."""
    room_1, room_3, room_4, room_6 = np.empty(8), np.empty((8, 3)), np.empty((8, 4)), np.empty((8, 6))
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        a = take_one(one, rows, n, near, room_1)
        x, y, z = take_three(three, rows, n, near, room_3)
        p, q, r, s = take_four(four, rows, n, near, room_4)
        others = take_freedom(six, rows, n, near, room_6)
        give_one(one, rows, n, near, room_1, a + others[0] - others[1] + others[2] - others[3] + others[4] - others[5])
        give_three(three, rows, n, near, room_3, (z, x, y))
        give_four(four, rows, n, near, room_4, (s, r, p, q))


@pytest.mark.parametrize(
    "rows", [range(16), range(5, 29), range(3), range(2, 40, 3), [0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 30], []]
)
def test_rows_are_taken_and_given_back_wherever_they_are(rows: list[int]) -> None:
    """Next to each other, with gaps, fewer than eight: these rows are as NumPy makes them, all others as they were."""
    chosen, random = np.array(rows, np.int64), np.random.default_rng(7)
    one, three, four, six = (random.normal(size=(40, width)) for width in (1, 3, 4, 6))
    expected = [one[:, 0].copy(), three.copy(), four.copy()]
    sum_of_six = six @ np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    expected[0][chosen] += sum_of_six[chosen]
    expected[1][chosen] = three[chosen][:, [2, 0, 1]]
    expected[2][chosen] = four[chosen][:, [3, 2, 0, 1]]
    found = [one[:, 0].copy(), three, four]
    turn_round(chosen, *found, six)
    np.testing.assert_allclose(found[0], expected[0], rtol=0.0, atol=1e-14)
    np.testing.assert_array_equal(found[1], expected[1])
    np.testing.assert_array_equal(found[2], expected[2])


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="only the JIT has a stack of its own")
def test_lanes_put_aside_lie_in_one_line_each() -> None:
    """The stack of what uses lanes begins with a line of the cache, by which LLVM places what it puts aside."""

    @numba.njit
    def copy(rows):
        store(address(rows), 1, load(address(rows), 0))

    rows = np.arange(16.0).reshape(2, 8)
    copy(rows)
    np.testing.assert_array_equal(rows[1], rows[0])
    assert "alignstack=64" in copy.inspect_llvm(copy.signatures[0])
