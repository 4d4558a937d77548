"""Ticks: how late it is, for kernels that do what several systems would."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"
import numba

if numba.config.DISABLE_JIT:
    from time import perf_counter_ns as nanoseconds
else:
    from llvmlite import ir
    from numba.core import cgutils, types
    from numba.extending import intrinsic

    MONOTONIC, WHOLE = 1, ir.IntType(64)  # the clock of POSIX that nobody sets

    @intrinsic
    def nanoseconds(typing):
        """Return the time since some moment, ns."""

        def lower(context, builder, sig, values):
            place = cgutils.alloca_once(builder, ir.ArrayType(WHOLE, 2))
            kind = ir.FunctionType(ir.IntType(32), [ir.IntType(32), place.type])
            read = cgutils.get_or_insert_function(builder.module, kind, "clock_gettime")
            builder.call(read, [ir.IntType(32)(MONOTONIC), place])
            seconds, rest = (builder.load(cgutils.gep_inbounds(builder, place, 0, k)) for k in range(2))
            return builder.add(builder.mul(seconds, WHOLE(1_000_000_000)), rest)

        return types.int64(), lower


__all__ = ["nanoseconds"]
