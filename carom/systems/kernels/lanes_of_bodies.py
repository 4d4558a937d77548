"""Bodies in lanes, for the JIT: what is read of those of a group in a plane, and written back."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc,attr-defined"
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from carom.systems.kernels.lane_widths import BLOCK, PLANES, WIDTH
from carom.systems.kernels.lanes_compiled import INTEGER, LANE, VECTOR, WHOLE, _place, _row

FOUR = ir.VectorType(ir.DoubleType(), 4)
EIGHT = types.UniTuple(LANE, BLOCK)


def _shuffled(builder, a, b, order):
    return builder.shuffle_vector(a, b, ir.Constant(ir.VectorType(INTEGER, len(order)), order))


# Of two vectors the numbers in even places by turns, and those in odd ones; the pairs in even places of one, then of
# the other, and those in odd ones.
EVEN, ODD = [0, 8, 2, 10, 4, 12, 6, 14], [1, 9, 3, 11, 5, 13, 7, 15]
EVEN_PAIRS, ODD_PAIRS = [0, 1, 4, 5, 8, 9, 12, 13], [2, 3, 6, 7, 10, 11, 14, 15]


def _transposed(builder, vectors):
    """Return eight vectors with rows and columns swapped, by what takes no order of its own from memory."""
    rows = [None] * WIDTH
    for first, order in enumerate((EVEN, ODD)):
        pairs = [_shuffled(builder, vectors[k], vectors[k + 1], order) for k in range(0, WIDTH, 2)]
        for second, order_of_pairs in enumerate((EVEN_PAIRS, ODD_PAIRS)):
            one, other = (_shuffled(builder, pairs[k], pairs[k + 1], order_of_pairs) for k in (0, 2))
            for third, last in enumerate((EVEN_PAIRS, ODD_PAIRS)):
                rows[first + 2 * second + 4 * third] = _shuffled(builder, one, other, last)
    return rows


def _bodies(builder, kind, plane, index, group, at=None):
    """Return pointers to the numbers of each body of a group in a plane, from the at-th on."""
    places = []
    for lane in range(WIDTH):
        which = builder.load(_place(builder, index, builder.add(_row(builder, group), WHOLE(lane)), WHOLE))
        first = builder.mul(which, WHOLE(BLOCK))
        places.append(_place(builder, plane, builder.add(first, at) if at else first, kind))
    return places


@intrinsic
def planes(typing, bodies):
    """Return where each plane (n, 8) of an array (4, n, 8) is, as `gather` takes it."""

    def lower(context, builder, sig, values):
        array = context.make_array(sig.args[0])(context, builder, values[0])
        first = builder.ptrtoint(array.data, WHOLE)
        step = cgutils.unpack_tuple(builder, array.strides)[0]
        places = [builder.add(first, builder.mul(step, WHOLE(plane))) for plane in range(PLANES)]
        return context.make_tuple(builder, sig.return_type, places)

    return types.UniTuple(types.int64, PLANES)(bodies), lower


@intrinsic
def gather(typing, plane, index, group):
    """Return the eight numbers of each body of a group in a plane, each number a lane."""

    def lower(context, builder, sig, values):
        bodies = [builder.load(place, align=8) for place in _bodies(builder, VECTOR, *values)]
        return context.make_tuple(builder, sig.return_type, _transposed(builder, bodies))

    return EIGHT(types.int64, types.int64, types.int64), lower


@intrinsic
def scatter(typing, plane, index, group, lanes):
    """Write what `gather` returns."""

    def lower(context, builder, sig, values):
        bodies = _transposed(builder, cgutils.unpack_tuple(builder, values[3], BLOCK))
        for body, place in zip(bodies, _bodies(builder, VECTOR, *values[:3]), strict=True):
            builder.store(body, place, align=8)
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, types.int64, EIGHT), lower


@intrinsic
def gather_four(typing, plane, index, group, at):
    """Return four of the numbers that `gather` returns, from the at-th on, for half of what those take."""

    def lower(context, builder, sig, values):
        bodies = [builder.load(place, align=8) for place in _bodies(builder, FOUR, *values)]
        rows = [_shuffled(builder, bodies[k], bodies[k + 2], list(range(WIDTH))) for k in (0, 1, 4, 5)]
        pairs = [[_shuffled(builder, rows[k], rows[k + 1], order) for k in (0, 2)] for order in (EVEN, ODD)]
        lanes = [_shuffled(builder, a, b, order) for order in (EVEN_PAIRS, ODD_PAIRS) for a, b in pairs]
        return context.make_tuple(builder, sig.return_type, lanes)

    return types.UniTuple(LANE, 4)(types.int64, types.int64, types.int64, types.int64), lower


@intrinsic
def scatter_four(typing, plane, index, group, at, lanes):
    """Write what `gather_four` returns."""

    def lower(context, builder, sig, values):
        x, y, z, w = cgutils.unpack_tuple(builder, values[4], 4)
        pairs = [[_shuffled(builder, a, b, order) for a, b in ((x, y), (z, w))] for order in (EVEN, ODD)]
        for lane, place in enumerate(_bodies(builder, FOUR, *values[:4])):
            k, (a, b) = lane - lane % 2, pairs[lane % 2]
            body = _shuffled(builder, a, b, [k, k + 1, WIDTH + k, WIDTH + k + 1])
            builder.store(body, place, align=8)
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, types.int64, types.int64, types.UniTuple(LANE, 4)), lower


@intrinsic
def fetch(typing, plane, index, group):
    """Have the processor bring what `gather` returns into its cache, while it goes on."""

    def lower(context, builder, sig, values):
        byte, integer = ir.IntType(8).as_pointer(), ir.IntType(32)
        kind = ir.FunctionType(ir.VoidType(), [byte, integer, integer, integer])
        prefetch = cgutils.get_or_insert_function(builder.module, kind, "llvm.prefetch.p0i8")
        for place in _bodies(builder, VECTOR, *values):
            builder.call(prefetch, [builder.bitcast(place, byte), integer(0), integer(3), integer(1)])
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, types.int64), lower
