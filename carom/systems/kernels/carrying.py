"""Carrying: rows of columns go to other places in them, whole runs at once."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,attr-defined"
import numba
import numpy as np

from carom.systems.kernels.kernel import making, woven
from carom.systems.kernels.lanes import address

if numba.config.DISABLE_JIT:

    def move_bytes(of, to, source, first, count):
        """Write ``count`` bytes from the ``first`` of one array on into another, from the ``to``-th on."""
        written, read = (np.reshape(array, -1).view(np.uint8) for array in (of, source))
        written[to : to + count] = read[first : first + count].copy()

else:
    from llvmlite import ir
    from numba.core import cgutils, types
    from numba.extending import intrinsic

    @intrinsic
    def move_bytes(typing, of, to, source, first, count):
        """Write ``count`` bytes from the ``first`` at one address on to another, from the ``to``-th on."""

        def lower(context, builder, sig, values):
            of, to, source, first, count = values
            byte = ir.IntType(8).as_pointer()
            written, read = (builder.inttoptr(builder.add(base, by), byte) for base, by in ((of, to), (source, first)))
            cgutils.raw_memmove(builder, written, read, count, 1)
            return context.get_dummy_value()

        return types.void(*[types.int64] * 5), lower


@making
def moves_of(begin, end, match):
    """Return how rows ``begin`` to ``end`` come from where they were (``match``, -1 nowhere) to where they are to be.

    That is the runs (n, 3) of those that go as far, in order: to which row, from which, and how many; and the rows that
    are put aside, since they change their order or were not among these.
    """
    runs, aside = np.empty((end - begin, 3), np.int64), np.empty(end - begin, np.int64)
    number, asides, first, by, goes, last = 0, 0, begin, 0, False, begin - 1
    for row in range(begin, end + 1):
        place = match[row] if row < end else -1
        if goes and place == row + by and place < end:  # most often
            continue
        if goes:
            last = row - 1 + by
            runs[number, 0], runs[number, 1], runs[number, 2] = first, first + by, row - first
            number += by != 0
        goes = last < place < end
        first, by = row, place - row
        if place >= 0 and not goes:
            aside[asides] = row
            asides += 1
    return runs[:number], aside[:asides]


@woven
def rows_of(column):
    """Return where the rows of a column are, and of how many bytes each is."""
    return address(column), column.strides[0]


@making
def lift(columns, match, aside):
    """Return the bytes of rows of columns that are put aside."""
    size = 0
    for _, width in columns:
        size += width * len(aside)
    room, at = np.empty(size, np.uint8), 0
    for column, width in columns:
        for row in aside:
            move_bytes(address(room), at, column, width * match[row], width)
            at += width
    return room


@woven
def carry(columns, runs, aside, room):
    """Move the rows of columns to where they are to be; `lift` has put some aside into the room.

    Those from behind go in their order, and those from before the last first: none is written over before it has gone.
    """
    at = 0
    for column, width in columns:
        for k in range(len(runs)):
            to, first, count = runs[k, 0], runs[k, 1], runs[k, 2]
            if first > to:
                move_bytes(column, width * to, column, width * first, width * count)
        for k in range(len(runs) - 1, -1, -1):
            to, first, count = runs[k, 0], runs[k, 1], runs[k, 2]
            if first < to:
                move_bytes(column, width * to, column, width * first, width * count)
        for row in aside:
            move_bytes(column, width * row, address(room), at, width)
            at += width
