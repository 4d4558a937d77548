"""Kernels: functions over arrays compiled by Numba, once each and cached on disk."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import numpy as np

from carom.ecs.access import GUARDED
from carom.ecs.errors import AccessError

ROOM = Path(__file__).parents[1]
PLAIN = ("scalars.py", "trigonometry.py")  # whose functions kernels compile as they stand
FILES = [
    *ROOM.glob("kernels/*.py"),
    *(ROOM.parent / "ecs" / "spatial" / name for name in PLAIN),
    ROOM / "constants.py",
]
SOURCES = hashlib.blake2b(b"".join(path.read_bytes() for path in sorted(FILES))).hexdigest()


def compiled(function: Callable[..., Any], **options: Any) -> Any:
    """Return Numba's dispatcher of a function, cached on disk until any source of kernels changes.

    Numba itself looks at a function's own file only, and would go on using what it calls as it was.
    """
    dispatcher = numba.njit(cache=True, error_model="numpy", no_cfunc_wrapper=True, **options)(function)
    files = getattr(getattr(dispatcher, "_cache", None), "_cache_file", None)
    if files is not None:
        files._source_stamp = SOURCES
    return dispatcher


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function that only kernels call; it gets no entry from Python, which is half of the time it takes."""
    return compiled(function, no_cpython_wrapper=True)


def woven(function: Callable[..., Any]) -> Any:
    """Compile a function into each of its callers, where handing over its arrays would cost more than a tenth of it."""
    return compiled(function, no_cpython_wrapper=True, forceinline=True)


class Kernel:
    """A compiled function of one specialisation, that names the arguments it writes.

    Read-only arrays (outside of systems, and what a system declares to read) would make Numba compile a second time, so
    they are passed as writable views; handing a read-only array to an output is an AccessError.
    """

    def __init__(self, function: Callable[..., Any], outputs: tuple[str, ...]) -> None:
        names = function.__code__.co_varnames[: function.__code__.co_argcount]
        unknown = set(outputs) - set(names)
        assert not unknown, f"{function.__name__} has no arguments {unknown}"
        self.name = function.__name__
        self.__doc__ = function.__doc__
        self._run = compiled(function)
        self._outputs = [names.index(name) for name in outputs]
        self._names = names
        self._settled = False

    def __call__(self, *arguments: Any) -> Any:
        """Run the compiled function, compiling it on the first call."""
        if self._settled and not GUARDED.get():
            try:
                return self._run(*arguments)
            except TypeError:  # an argument of another type, most often a read-only array
                pass
        result = self._run(*self._writable(arguments))
        if not self._settled and hasattr(self._run, "disable_compile"):
            self._run.disable_compile()
            self._settled = True
        return result

    def _writable(self, arguments: tuple[Any, ...]) -> list[Any]:
        passed = list(arguments)
        for position, argument in enumerate(arguments):
            if not isinstance(argument, np.ndarray) or argument.flags.writeable:
                continue
            if position in self._outputs:
                raise AccessError(
                    f"kernel '{self.name}' writes '{self._names[position]}', which is read-only here; "
                    f"declare the component in writes= (or adds=) of the calling @system"
                )
            owner = argument if argument.base is None else argument.base
            passed[position] = owner if owner.shape == argument.shape and owner.flags.writeable else argument.copy()
        return passed


def kernel(*outputs: str) -> Callable[[Callable[..., Any]], Kernel]:
    """Compile a function over arrays; ``outputs`` are the names of the arguments it writes."""
    return lambda function: Kernel(function, outputs)
