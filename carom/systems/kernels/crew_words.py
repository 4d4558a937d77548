"""Crew words: what threads tell each other by, whole numbers in memory, and calls by address."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc,attr-defined"
import os

import numba

if numba.config.DISABLE_JIT:  # kernels are not shared then

    def look(words, at):
        """Return a word, as others have left it."""
        return words[at]

    def tell(words, at, value):
        """Write a word, and all before it, for others to see."""
        words[at] = value

    def count_up(words, at):
        """Add one to a word that others count up too."""
        words[at] += 1

    def give_way():
        """Let other threads have the processor."""

    def describe(function, crew, arguments):
        """Return the crew, a task and its data, which `call` calls."""
        return crew, function, (crew, arguments)

    def call(task, data, part, parts):
        """Call a task that `describe` has found; return 1 where it fails, else 0."""
        crew, arguments = data
        task((crew, part, parts), *arguments)
        return 0

else:
    from llvmlite import ir
    from numba.core import cgutils, types
    from numba.core.imputils import impl_ret_borrowed
    from numba.extending import intrinsic

    WHOLE, BYTES = ir.IntType(64), ir.IntType(8).as_pointer()
    TASK = ir.FunctionType(WHOLE, [BYTES, WHOLE, WHOLE])

    def _word(context, builder, sig, values):
        return builder.gep(context.make_array(sig.args[0])(context, builder, values[0]).data, [values[1]])

    @intrinsic
    def look(typing, words, at):
        """Return a word, as others have left it."""

        def lower(context, builder, sig, values):
            return builder.load_atomic(_word(context, builder, sig, values), "seq_cst", 8)

        return types.int64(words, types.int64), lower

    @intrinsic
    def tell(typing, words, at, value):
        """Write a word, and all before it, for others to see."""

        def lower(context, builder, sig, values):
            builder.store_atomic(values[2], _word(context, builder, sig, values), "seq_cst", 8)
            return context.get_dummy_value()

        return types.void(words, types.int64, types.int64), lower

    @intrinsic
    def count_up(typing, words, at):
        """Add one to a word that others count up too."""

        def lower(context, builder, sig, values):
            builder.atomic_rmw("add", _word(context, builder, sig, values), WHOLE(1), "seq_cst")
            return context.get_dummy_value()

        return types.void(words, types.int64), lower

    @intrinsic
    def give_way(typing):
        """Let other threads have the processor."""

        def lower(context, builder, sig, values):
            if os.name == "posix":
                kind = ir.FunctionType(ir.IntType(32), [])
                builder.call(cgutils.get_or_insert_function(builder.module, kind, "sched_yield"), [])
            return context.get_dummy_value()

        return types.void(), lower

    def _task(context, builder, called, compiled, given):
        """Return the task that calls a compiled function with what is given: the one of this module, once there is."""
        name = f"{compiled.fndesc.mangled_name}.task"
        if name in builder.module.globals:
            return builder.module.globals[name]
        task = ir.Function(builder.module, TASK, name=name)
        task.linkage = "internal"
        inner = ir.IRBuilder(task.append_basic_block())
        place, part, parts = task.args
        there = inner.load(inner.bitcast(place, context.get_value_type(given).as_pointer()))
        words, others = cgutils.unpack_tuple(inner, there, 2)
        passed = (context.make_tuple(inner, called.args[0], [words, part, parts]), *cgutils.unpack_tuple(inner, others))
        target = context.declare_function(builder.module, compiled.fndesc)
        status, _ = context.call_conv.call_function(inner, target, called.return_type, called.args, passed)
        inner.ret(inner.zext(status.is_error, WHOLE))
        return task

    @intrinsic
    def describe(typing, function, crew, arguments):
        """Return the crew and the addresses of a task and its data, which `call` calls until its caller returns.

        The task calls a compiled function with (crew, part, parts) and the arguments, whatever those are.
        """
        called = function.get_call_type(typing, (types.Tuple((crew, types.int64, types.int64)), *arguments), {})

        def lower(context, builder, sig, values):
            given = types.Tuple(sig.args[1:])
            data = cgutils.alloca_once_value(builder, context.make_tuple(builder, given, values[1:]))
            compiled = function.dispatcher.overloads[tuple(called.args)]
            context.add_linking_libs([compiled.library])
            task = _task(context, builder, called, compiled, given)
            found = [values[1], *(builder.ptrtoint(it, WHOLE) for it in (task, data))]
            described = context.make_tuple(builder, sig.return_type, found)
            return impl_ret_borrowed(context, builder, sig.return_type, described)

        return types.Tuple((crew, types.int64, types.int64))(function, crew, arguments), lower

    @intrinsic
    def call(typing, task, data, part, parts):
        """Call a task that `describe` has found; return 1 where it fails, else 0."""

        def lower(context, builder, sig, values):
            task, data, part, parts = values
            place = builder.inttoptr(data, BYTES)
            return builder.call(builder.inttoptr(task, TASK.as_pointer()), [place, part, parts])

        return types.int64(types.int64, types.int64, types.int64, types.int64), lower
