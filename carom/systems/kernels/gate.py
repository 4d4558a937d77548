"""Gate: where the threads that share a kernel wait for each other."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import os

import numba

from carom.systems.kernels.kernel import woven

SPINS = 200  # looks at the gate before a thread lets others have its processor

if numba.config.DISABLE_JIT:  # kernels are not shared then

    def arrive(gate):
        """Count a thread that has come to the gate."""
        gate[0] += 1

    def arrived(gate):
        """Return how many have come."""
        return gate[0]

    def give_way():
        """Let other threads have the processor."""

else:
    from llvmlite import ir
    from numba.core import cgutils, types
    from numba.extending import intrinsic

    WHOLE = ir.IntType(64)

    def _number(context, builder, sig, values):
        return context.make_array(sig.args[0])(context, builder, values[0]).data

    @intrinsic
    def arrive(typing, gate):
        """Count a thread that has come to the gate."""

        def lower(context, builder, sig, values):
            builder.atomic_rmw("add", _number(context, builder, sig, values), WHOLE(1), "seq_cst")
            return context.get_dummy_value()

        return types.void(gate), lower

    @intrinsic
    def arrived(typing, gate):
        """Return how many have come."""

        def lower(context, builder, sig, values):
            return builder.load_atomic(_number(context, builder, sig, values), "seq_cst", 8)

        return types.int64(gate), lower

    @intrinsic
    def give_way(typing):
        """Let other threads have the processor."""

        def lower(context, builder, sig, values):
            if os.name == "posix":
                kind = ir.FunctionType(ir.IntType(32), [])
                builder.call(cgutils.get_or_insert_function(builder.module, kind, "sched_yield"), [])
            return context.get_dummy_value()

        return types.void(), lower


@woven
def wait_for_all(gate, parts, passed):
    """Wait until all of ``parts`` threads have come to the gate for the ``passed``-th time."""
    arrive(gate)
    looks = 0
    while arrived(gate) < parts * passed:
        looks += 1
        if looks == SPINS:
            give_way()
            looks = 0
