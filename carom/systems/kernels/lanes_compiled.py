"""Lanes for the JIT: vectors of LLVM, and what Numba has to know of them."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc,attr-defined"
import operator

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models, register_default
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin

from carom.systems.kernels.lane_widths import BLOCK, PLANES, WIDTH

VECTOR = ir.VectorType(ir.DoubleType(), WIDTH)
FOUR = ir.VectorType(ir.DoubleType(), 4)
INTEGER = ir.IntType(32)


class LaneType(types.Type):
    """The type of a lane."""

    def __init__(self):
        super().__init__(name=f"lane{WIDTH}")


LANE = LaneType()
EIGHT = types.UniTuple(LANE, BLOCK)


@register_default(LaneType)
class LaneModel(models.PrimitiveModel):
    """A lane is one vector."""

    def __init__(self, manager, kind):
        super().__init__(manager, kind, VECTOR)


def _splat(builder, number):
    one = builder.insert_element(ir.Constant(VECTOR, ir.Undefined), number, INTEGER(0))
    return builder.shuffle_vector(one, one, ir.Constant(ir.VectorType(INTEGER, WIDTH), [0] * WIDTH))


def _arithmetic(operation, instruction):
    cases = [(LANE, LANE), (LANE, types.float64), (types.float64, LANE)]
    template = type(f"Lane_{instruction}", (ConcreteTemplate,), {"cases": [signature(LANE, *sides) for sides in cases]})
    infer_global(operation)(template)
    for sides in cases:

        def lower(context, builder, sig, values, sides=sides):
            a, b = (
                value if side is LANE else _splat(builder, value) for value, side in zip(values, sides, strict=True)
            )
            return getattr(builder, instruction)(a, b)

        lower_builtin(operation, *sides)(lower)


for _operation, _instruction in (
    (operator.add, "fadd"), (operator.sub, "fsub"), (operator.mul, "fmul"), (operator.truediv, "fdiv")
):  # fmt: skip
    _arithmetic(_operation, _instruction)


@infer_global(operator.neg)
class Negative(ConcreteTemplate):
    """The type of -lane."""

    cases = [signature(LANE, LANE)]  # noqa: RUF012


@lower_builtin(operator.neg, LANE)
def _negative(context, builder, sig, values):
    return builder.fneg(values[0])


WHOLE = ir.IntType(64)


def _place(builder, rows, number, kind):
    """Return a pointer to a number at an address."""
    base = builder.inttoptr(rows, ir.DoubleType().as_pointer())
    return builder.bitcast(builder.gep(base, [number]), kind.as_pointer())


def _row(builder, row):
    return builder.mul(row, WHOLE(WIDTH))


@intrinsic
def address(typing, rows):
    """Return where an array of rows is, as the functions below take it."""

    def lower(context, builder, sig, values):
        array = context.make_array(sig.args[0])(context, builder, values[0])
        return builder.ptrtoint(array.data, WHOLE)

    return types.int64(rows), lower


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
def load(typing, rows, row):
    """Return a row."""

    def lower(context, builder, sig, values):
        return builder.load(_place(builder, values[0], _row(builder, values[1]), VECTOR), align=8)

    return LANE(types.int64, types.int64), lower


@intrinsic
def store(typing, rows, row, lane):
    """Write a row of eight."""

    def lower(context, builder, sig, values):
        builder.store(values[2], _place(builder, values[0], _row(builder, values[1]), VECTOR), align=8)
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, LANE), lower


@intrinsic
def spread(typing, number):
    """Return one number in all lanes."""
    return LANE(types.float64), lambda context, builder, sig, values: _splat(builder, values[0])


def _compared(builder, how, a, b, yes, no):
    return builder.select(builder.fcmp_ordered(how, a, b), yes, no)


@intrinsic
def larger(typing, a, b):
    """Return the larger of two, lane by lane."""
    return LANE(LANE, LANE), lambda context, builder, sig, v: _compared(builder, ">", v[0], v[1], v[0], v[1])


@intrinsic
def smaller(typing, a, b):
    """Return the smaller of two, lane by lane."""
    return LANE(LANE, LANE), lambda context, builder, sig, v: _compared(builder, "<", v[0], v[1], v[0], v[1])


def _zero():
    return ir.Constant(VECTOR, [0.0] * WIDTH)


@intrinsic
def choose(typing, test, a, b):
    """Return a where the test is positive, b elsewhere."""

    def lower(context, builder, sig, values):
        return _compared(builder, ">", values[0], _zero(), values[1], values[2])

    return LANE(LANE, LANE, LANE), lower


def _by_llvm(name):
    """Return how to lower a function of one lane that LLVM has."""

    def lower(context, builder, sig, values):
        kind = ir.FunctionType(VECTOR, [VECTOR])
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v{WIDTH}f64"), values)

    return lower


@intrinsic
def root(typing, a):
    """Return the square root."""
    return LANE(LANE), _by_llvm("sqrt")


@intrinsic
def whole(typing, a):
    """Return the largest whole number up to a."""
    return LANE(LANE), _by_llvm("floor")


@intrinsic
def some(typing, test):
    """Tell whether the test is positive in some lane."""

    def lower(context, builder, sig, values):
        which = builder.bitcast(builder.fcmp_ordered(">", values[0], _zero()), ir.IntType(WIDTH))
        return builder.icmp_unsigned("!=", which, ir.Constant(ir.IntType(WIDTH), 0))

    return types.boolean(LANE), lower


@intrinsic
def which(typing, test):
    """Return the lanes in which the test is positive, each a bit, the first the lowest."""

    def lower(context, builder, sig, values):
        bits = builder.bitcast(builder.fcmp_ordered(">", values[0], _zero()), ir.IntType(WIDTH))
        return builder.zext(bits, WHOLE)

    return types.int64(LANE), lower


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
