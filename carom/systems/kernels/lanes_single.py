"""Lanes of single precision: eight numbers in a row of a float32 column, as lanes of doubles."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numba
import numpy as np

from carom.systems.kernels.lane_widths import WIDTH

if numba.config.DISABLE_JIT:

    def load_single(column, first):
        """Return the numbers from ``first`` on of a column, as `address` returned it."""
        return column[first : first + WIDTH].astype(np.float64)

    def store_single(column, first, lane):
        """Write what `load_single` returns, rounded."""
        column[first : first + WIDTH] = lane

else:
    from llvmlite import ir
    from numba.core import types
    from numba.extending import intrinsic

    from carom.systems.kernels.lanes_compiled import LANE, VECTOR

    SINGLE, SINGLES = ir.FloatType(), ir.VectorType(ir.FloatType(), WIDTH)

    def _pointer(builder, column, first):
        base = builder.inttoptr(column, SINGLE.as_pointer())
        return builder.bitcast(builder.gep(base, [first]), SINGLES.as_pointer())

    @intrinsic
    def load_single(typing, column, first):
        """Return the numbers from ``first`` on of a column, as `address` returned it."""

        def lower(context, builder, sig, values):
            return builder.fpext(builder.load(_pointer(builder, *values), align=4), VECTOR)

        return LANE(types.int64, types.int64), lower

    @intrinsic
    def store_single(typing, column, first, lane):
        """Write what `load_single` returns, rounded."""

        def lower(context, builder, sig, values):
            rounded = builder.fptrunc(values[2], SINGLES)
            builder.store(rounded, _pointer(builder, *values[:2]), align=4)
            return context.get_dummy_value()

        return types.void(types.int64, types.int64, LANE), lower
