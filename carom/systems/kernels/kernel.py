"""Kernels: functions over arrays compiled by Numba, once each and cached on disk."""

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import numba
import numpy as np

from carom.ecs.access import GUARDED
from carom.ecs.errors import AccessError
from carom.systems.kernels import indices  # noqa: F401 - by which kernels are compiled
from carom.systems.kernels.stored import Stored

IMPORTS = re.compile(rb"^ *from (carom\.[\w.]+) import", re.MULTILINE)
#: Modules whose functions kernels call; of all other modules kernels use numbers only.
CALLED = re.compile(r"carom\.systems\.kernels\.\w+|carom\.ecs\.spatial\.(scalars|trigonometry)")
NUMBERS = (int, float, tuple)


@cache
def source_of(module: str) -> bytes:
    """Return the text of a module; of none, where it was typed."""
    path = getattr(sys.modules[module], "__file__", None)
    return Path(path).read_bytes() if path else b""


@cache
def called_from(module: str) -> list[str]:
    """Return the other modules whose functions those of a module may call, in order of their names.

    It imports names from them, or them as a whole, for their numbers.
    """
    called: set[str] = set()
    whole = (value.__name__ for value in vars(sys.modules[module]).values() if isinstance(value, ModuleType))
    for name in (*map(bytes.decode, IMPORTS.findall(source_of(module))), *whole):
        if CALLED.fullmatch(name) and name in sys.modules:
            called.update((name, *called_from(name)))
    return sorted(called)


def digest_of(module: str) -> bytes:
    """Return a digest of a module's text and of the numbers that it has from wherever it imports them."""
    numbers = sorted((name, value) for name, value in vars(sys.modules[module]).items() if isinstance(value, NUMBERS))
    return hashlib.blake2b(source_of(module) + repr(numbers).encode()).digest()


digest_of_called = cache(digest_of)  # a module that is called has all of its numbers, unlike one being imported


def stamp_of(module: str) -> str:
    """Return a digest of all that code compiled from a module depends on."""
    parts = (digest_of(module), *map(digest_of_called, called_from(module)))
    return hashlib.blake2b(b"".join(parts)).hexdigest()


def compiled(function: Callable[..., Any], *, entry: bool = False, **options: Any) -> Any:
    """Return Numba's dispatcher of a function, cached on disk until something that it depends on changes.

    Numba itself looks at a function's own file only, and would go on using what it calls as it was. No compiled
    function calls an ``entry``.
    """
    dispatcher = numba.njit(error_model="numpy", no_cfunc_wrapper=True, nogil=True, **options)(function)
    if not numba.config.DISABLE_JIT:
        dispatcher._cache = Stored(function, stamp_of(function.__module__), entry=entry)
    return dispatcher


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function that only kernels call; it gets no entry from Python, which is half of the time it takes.

    It makes no arrays, and counts no references to those it is handed: an atomic count up and down for each array of
    each call costs more than what most such functions do.
    """
    return compiled(function, no_cpython_wrapper=True, _nrt=False)


def woven(function: Callable[..., Any]) -> Any:
    """Compile a function into each of its callers, where handing over its arrays would cost more than a tenth of it."""
    return compiled(function, no_cpython_wrapper=True, forceinline=True, _nrt=False)


def making(function: Callable[..., Any]) -> Any:
    """Compile a function that only kernels call and that makes arrays."""
    return compiled(function, no_cpython_wrapper=True, _nrt=True)


def names_of(function: Callable[..., Any]) -> tuple[str, ...]:
    """Return the names of a function's arguments."""
    return function.__code__.co_varnames[: function.__code__.co_argcount]


def calling(function: Callable[..., Any], **compiled_ones: Any) -> Callable[..., Any]:
    """Return a plain function as one that calls compiled functions in the place of plain ones of these names."""
    return FunctionType(function.__code__, vars(sys.modules[function.__module__]) | compiled_ones)


def hand_on(*arguments: Any) -> Any:
    """Do the work of a kernel that other kernels do too."""
    return work(*arguments)  # type: ignore[name-defined]  # noqa: F821 - `handed` hands it over


class Kernel:
    """A compiled function of one specialisation, that names the arguments it writes.

    Read-only arrays (outside of systems, and what a system declares to read) would make Numba compile a second time, so
    they are passed as writable views; handing a read-only array to an output is an AccessError. ``within`` is what
    other kernels call in its place, where they do; of one that is shared, what each thread does.
    """

    def __init__(
        self, function: Callable[..., Any], outputs: tuple[str, ...], names: tuple[str, ...], *, makes_arrays: bool,
        within: Any = None,
    ) -> None:  # fmt: skip
        unknown = set(outputs) - set(names)
        assert not unknown, f"{function.__name__} has no arguments {unknown}"
        self.name = function.__name__
        self.within = within
        self.__doc__ = function.__doc__
        self._run = compiled(function, entry=True, _nrt=makes_arrays)
        self._outputs = [names.index(name) for name in outputs]
        self._names = names
        self._settled = False
        self._views: list[tuple[Any, Any]] = [(self, self)] * len(names)  # of arrays, as last given

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
            known, view = self._views[position]
            if known is argument:
                passed[position] = view
            elif isinstance(argument, np.ndarray):
                passed[position] = self._open(position, argument)
        return passed

    def _open(self, position: int, array: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        """Return a writable view of an array; a copy, where it is no piece of one that may be written."""
        view = array
        if not array.flags.writeable:
            if position in self._outputs:
                raise AccessError(
                    f"kernel '{self.name}' writes '{self._names[position]}', which is read-only here; "
                    f"declare the component in writes= (or adds=) of the calling @system"
                )
            if not (isinstance(array.base, np.ndarray) and array.base.flags.writeable and array.flags.c_contiguous):
                return array.copy()
            view = array.view()
            view.flags.writeable = True
        self._views[position] = array, view
        return view


def handed(
    function: Callable[..., Any], hand: Callable[..., Any], outputs: tuple[str, ...], *, makes_arrays: bool
) -> Kernel:
    """Return a kernel that hands the work of a function, which other kernels call too, on by another one."""
    work = compiled(function, no_cpython_wrapper=True, _nrt=makes_arrays)
    run = calling(hand, work=work)
    run.__module__, run.__qualname__ = function.__module__, function.__qualname__
    run.__name__, run.__doc__ = function.__name__, function.__doc__
    return Kernel(run, outputs, names_of(function), makes_arrays=makes_arrays, within=work)


def kernel(*outputs: str, makes_arrays: bool = False, within: bool = False) -> Callable[[Callable[..., Any]], Kernel]:
    """Compile a function over arrays; ``outputs`` are the names of the arguments it writes.

    One that makes no arrays of its own takes those it is handed in half the time; where one does, Numba says "NRT
    required but not enabled" until it says so. Other kernels call it ``within`` where that is stated.
    """
    if within:
        return lambda function: handed(function, hand_on, outputs, makes_arrays=makes_arrays)
    return lambda function: Kernel(function, outputs, names_of(function), makes_arrays=makes_arrays)
