"""Lanes for the JIT: vectors of LLVM, and what Numba has to know of them."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc,attr-defined"
import operator

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models, register_default
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin

from carom.systems.kernels.lane_widths import WIDTH

VECTOR = ir.VectorType(ir.DoubleType(), WIDTH)
INTEGER = ir.IntType(32)


class LaneType(types.Type):
    """The type of a lane."""

    def __init__(self):
        super().__init__(name=f"lane{WIDTH}")


LANE = LaneType()


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


def _align_stack(builder):
    """Let each lane that a function puts aside on its stack lie in one line of the cache, not across two.

    It is asked of functions that use lanes themselves; of those into which only others are woven nothing was gained.
    """
    builder.function.attributes.add("nounwind")  # true of all of them, and llvmlite writes no alignment alone
    builder.function.attributes.alignstack = 8 * WIDTH


def _place(builder, rows, number, kind):
    """Return a pointer to a number at an address."""
    _align_stack(builder)
    base = builder.inttoptr(rows, ir.DoubleType().as_pointer())
    return builder.bitcast(builder.gep(base, [number]), kind.as_pointer())


def _row(builder, row):
    return builder.mul(row, WHOLE(WIDTH))


@intrinsic
def address(typing, rows):
    """Return where an array of rows is, as the functions below take it."""

    def lower(context, builder, sig, values):
        _align_stack(builder)
        array = context.make_array(sig.args[0])(context, builder, values[0])
        return builder.ptrtoint(array.data, WHOLE)

    return types.int64(rows), lower


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
