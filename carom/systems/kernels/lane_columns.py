"""Columns in lanes: eight rows of a column of one, three, four or six numbers at once, a lane each number."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,attr-defined"
import numba
import numpy as np

from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lanes import WIDTH, address, choose, larger, spread, which

LANES = tuple(range(WIDTH))
ALL = (1 << WIDTH) - 1
SMALLEST = 5e-324  # the smallest number above 0: nothing lies between

if numba.config.DISABLE_JIT:

    def _loading(width):
        def load_rows(column, first):
            return tuple(np.reshape(column, (-1, width))[first : first + WIDTH].T.copy())

        return load_rows

    def _storing(width):
        def store_rows(column, first, lanes):
            np.reshape(column, (-1, width))[first : first + WIDTH] = np.array(lanes).T

        return store_rows

    def lane_of(numbers):
        """Return eight whole numbers in lanes."""
        return np.array(numbers, np.float64)

    def pick(column, width, k, places):
        """Return the k-th of the ``width`` numbers of a column's rows at eight places."""
        return np.reshape(column, (-1, width))[np.array(places), k]

else:
    from llvmlite import ir
    from numba.core import cgutils, types
    from numba.extending import intrinsic

    from carom.systems.kernels.lanes_compiled import INTEGER, LANE, VECTOR, WHOLE, _place

    def _picked(builder, vectors, wanted):
        """Return a vector of numbers, each ``wanted`` as which of the vectors it is in and where there."""
        found = vectors[0]
        for number, vector in enumerate(vectors):
            mask = [WIDTH + at if of == number else lane for lane, (of, at) in enumerate(wanted)]
            order = ir.Constant(ir.VectorType(INTEGER, WIDTH), mask)
            found = builder.shuffle_vector(found, vector, order)
        return found

    def _places(builder, width, column, first):
        begin = builder.mul(first, WHOLE(width))
        return [_place(builder, column, builder.add(begin, WHOLE(WIDTH * part)), VECTOR) for part in range(width)]

    def _loading(width):
        @intrinsic
        def load_rows(typing, column, first):
            def lower(context, builder, sig, values):
                vectors = [builder.load(place, align=8) for place in _places(builder, width, *values)]
                at = [[divmod(width * lane + k, WIDTH) for lane in range(WIDTH)] for k in range(width)]
                return context.make_tuple(builder, sig.return_type, [_picked(builder, vectors, w) for w in at])

            return types.UniTuple(LANE, width)(types.int64, types.int64), lower

        return load_rows

    def _storing(width):
        @intrinsic
        def store_rows(typing, column, first, lanes):
            def lower(context, builder, sig, values):
                vectors = cgutils.unpack_tuple(builder, values[2], width)
                for part, place in enumerate(_places(builder, width, *values[:2])):
                    at = [divmod(WIDTH * part + lane, width) for lane in range(WIDTH)]
                    builder.store(_picked(builder, vectors, [(k, row) for row, k in at]), place, align=8)
                return context.get_dummy_value()

            return types.void(types.int64, types.int64, types.UniTuple(LANE, width)), lower

        return store_rows

    WHOLES = types.UniTuple(types.int64, WIDTH)

    def _collected(builder, numbers):
        vector = ir.Constant(VECTOR, ir.Undefined)
        for lane, number in enumerate(numbers):
            vector = builder.insert_element(vector, number, INTEGER(lane))
        return vector

    @intrinsic
    def lane_of(typing, numbers):
        """Return eight whole numbers in lanes."""

        def lower(context, builder, sig, values):
            numbers = cgutils.unpack_tuple(builder, values[0], WIDTH)
            return _collected(builder, [builder.sitofp(number, ir.DoubleType()) for number in numbers])

        return LANE(WHOLES), lower

    @intrinsic
    def pick(typing, column, width, k, places):
        """Return the k-th of the ``width`` numbers of a column's rows at eight places."""

        def lower(context, builder, sig, values):
            column, width, k, places = values
            found = []
            for place in cgutils.unpack_tuple(builder, places, WIDTH):
                at = builder.add(builder.mul(place, width), k)
                found.append(builder.load(_place(builder, column, at, ir.DoubleType())))
            return _collected(builder, found)

        return LANE(types.int64, types.int64, types.int64, WHOLES), lower


load_one, load_three, load_four, load_six = _loading(1), _loading(3), _loading(4), _loading(6)
store_one, store_three, store_four = _storing(1), _storing(3), _storing(4)


@woven
def in_a_row(rows, n):
    """Tell whether the eight rows from the n-th on are next to each other."""
    return n + WIDTH <= len(rows) and rows[n + WIDTH - 1] - rows[n] == WIDTH - 1


@woven
def load_flat(column, at):
    """Return the eight numbers of a column from the at-th on, whatever rows they are of."""
    return load_one(address(column), at)[0]


@woven
def store_flat(column, at, lane):
    """Write what `load_flat` returns."""
    store_one(address(column), at, (lane,))


@woven
def is_all(value, lane):
    """Tell whether eight numbers are one value; NaN is none."""
    off = lane - value
    return which(SMALLEST - larger(off, -off)) == ALL


@woven
def are_all(value, column, width, i):
    """Tell whether the ``width`` numbers of row i and of the seven behind it all are one value."""
    same = True
    for at in range(width * i, width * (i + WIDTH), WIDTH):
        same &= is_all(value, load_flat(column, at))
    return same


@woven
def set_all(value, column, width, i):
    """Let the ``width`` numbers of row i and the seven behind it be one value; where they are, memory is only read."""
    for at in range(width * i, width * (i + WIDTH), WIDTH):
        if not is_all(value, load_flat(column, at)):
            store_flat(column, at, spread(value))


@woven
def numbers_at(column, at):
    """Return eight whole numbers of a column."""
    return (
        column[at[0]], column[at[1]], column[at[2]], column[at[3]],
        column[at[4]], column[at[5]], column[at[6]], column[at[7]],
    )  # fmt: skip


@woven
def pick_one(column, at, there):
    """Return the numbers of a column at eight places, 0 where there is none."""
    return choose(there, pick(address(column), 1, 0, at), spread(0.0))


@woven
def pick_three(column, at, there):
    """Return the vectors of a column as `pick_one` does numbers."""
    rows, zero = address(column), spread(0.0)
    return (
        choose(there, pick(rows, 3, 0, at), zero),
        choose(there, pick(rows, 3, 1, at), zero),
        choose(there, pick(rows, 3, 2, at), zero),
    )


@woven
def take_one(column, rows, n, side_by_side, room):
    """Return the numbers of the eight rows from the n-th on, the last again where there are fewer.

    Those that are not ``side_by_side`` are copied into the ``room`` of eight rows before.
    """
    if side_by_side:
        return load_one(address(column), rows[n])[0]
    for lane in range(WIDTH):
        room[lane] = column[rows[min(n + lane, len(rows) - 1)]]
    return load_one(address(room), 0)[0]


@woven
def take_three(column, rows, n, side_by_side, room):
    """Return the three numbers of each row as `take_one` does."""
    if side_by_side:
        return load_three(address(column), rows[n])
    for lane in range(WIDTH):
        for k in range(3):
            room[lane, k] = column[rows[min(n + lane, len(rows) - 1)], k]
    return load_three(address(room), 0)


@woven
def take_four(column, rows, n, side_by_side, room):
    """Return the four numbers of each row as `take_one` does."""
    if side_by_side:
        return load_four(address(column), rows[n])
    for lane in range(WIDTH):
        for k in range(4):
            room[lane, k] = column[rows[min(n + lane, len(rows) - 1)], k]
    return load_four(address(room), 0)


@woven
def take_freedom(column, rows, n, side_by_side, room):
    """Return the six numbers of each row as `take_one` does; most often all are 1, which is seen sooner."""
    if side_by_side:
        if are_all(1.0, column, 6, rows[n]):
            one = spread(1.0)
            return one, one, one, one, one, one
        return load_six(address(column), rows[n])
    for lane in range(WIDTH):
        for k in range(6):
            room[lane, k] = column[rows[min(n + lane, len(rows) - 1)], k]
    return load_six(address(room), 0)


@woven
def give_one(column, rows, n, side_by_side, room, lane):
    """Write what `take_one` returns."""
    if side_by_side:
        store_one(address(column), rows[n], (lane,))
        return
    store_one(address(room), 0, (lane,))
    for row in range(n, min(n + WIDTH, len(rows))):
        column[rows[row]] = room[row - n]


@woven
def give_three(column, rows, n, side_by_side, room, lanes):
    """Write what `take_three` returns."""
    if side_by_side:
        store_three(address(column), rows[n], lanes)
        return
    store_three(address(room), 0, lanes)
    for row in range(n, min(n + WIDTH, len(rows))):
        for k in range(3):
            column[rows[row], k] = room[row - n, k]


@woven
def give_four(column, rows, n, side_by_side, room, lanes):
    """Write what `take_four` returns."""
    if side_by_side:
        store_four(address(column), rows[n], lanes)
        return
    store_four(address(room), 0, lanes)
    for row in range(n, min(n + WIDTH, len(rows))):
        for k in range(4):
            column[rows[row], k] = room[row - n, k]
