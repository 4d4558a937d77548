"""Indices: those of kernels count from the beginning, and nobody looks at each whether it is negative.

Numba lets negative indices count from the end, as NumPy does, by a comparison and an addition for every access: up to a
third of the time of kernels that go through tables. Kernels have none; NUMBA_BOUNDSCHECK=1 refuses those that have.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numba

OWN = "_ZN5carom7systems7kernels"  # how names of functions begin that are compiled from modules of this folder

if not numba.config.DISABLE_JIT:
    from numba.core import types
    from numba.np import arrayobj

    numbas_own = arrayobj.fix_integer_index

    def fix_integer_index(context, builder, kind, index, size):
        """Return an index as it is within kernels; elsewhere as Numba does, counted from the end where negative."""
        if kind.signed and builder.function.name.startswith(OWN):
            return context.cast(builder, index, kind, types.intp)
        return numbas_own(context, builder, kind, index, size)

    arrayobj.fix_integer_index = fix_integer_index
