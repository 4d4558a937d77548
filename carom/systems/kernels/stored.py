"""Stored: what functions are compiled to, kept on disk until something that they depend on changes."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"
import hashlib
import pickle
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any
from uuid import uuid4

import numba
from llvmlite import binding
from numba.core.caching import CompileResultCacheImpl, FunctionCache
from numba.core.runtime import rtsys
from numba.core.serialize import dumps

MESSAGE = "carom: compiling kernels, once, which may take a minute or two; `carom warm` compiles all of them beforehand"
ENDING = ".nbc"


class Announcement:
    """The line that tells of compiling, printed once by a process; not at all where ``due`` is made False."""

    due = True

    @classmethod
    def make(cls) -> None:
        """Print the line on stderr."""
        if cls.due:
            cls.due = False
            print(MESSAGE, file=sys.stderr, flush=True)


class NotStoredError(Exception):
    """A function was called that would have to be compiled, where only what is stored is to be loaded."""


#: Set where nothing is to be compiled; of each thread by itself.
STORED_ONLY: ContextVar[bool] = ContextVar("stored_only", default=False)


@contextmanager
def only_stored() -> Iterator[None]:
    """Load what is stored, and compile nothing in this thread: what would have to be raises NotStoredError."""
    token = STORED_ONLY.set(True)
    try:
        yield
    finally:
        STORED_ONLY.reset(token)


class Files:
    """One file for each signature of a function, so that processes that write at the same time lose nothing.

    Numba keeps an index of numbered files instead: of two processes that compile two signatures of one function, one
    may come to load what the other wrote.
    """

    def __init__(self, folder: Path, name: str, stamp: str) -> None:
        self._folder, self._name = folder, f"{name}.py{sys.version_info.major}{sys.version_info.minor}"
        self._stamp = f"numba {numba.__version__}, {stamp}".encode()

    def path(self, key: object) -> Path:
        """Return where the code of a signature, on a processor, is kept."""
        return self._folder / f"{self._name}.{hashlib.blake2b(repr(key).encode(), digest_size=8).hexdigest()}{ENDING}"

    def load(self, key: object) -> Any:
        """Return what was saved; None where there is nothing, or what there is has another stamp."""
        try:
            stamp, _, data = self.path(key).read_bytes().partition(b"\n")
        except FileNotFoundError:
            return None
        return pickle.loads(data) if stamp == self._stamp else None

    def save(self, key: object, data: object) -> None:
        """Save all at once, so that nobody reads a part."""
        path = self.path(key)
        written = path.with_suffix(f".{uuid4().hex}")
        try:
            written.write_bytes(self._stamp + b"\n" + dumps(data))
            written.replace(path)
        finally:
            written.unlink(missing_ok=True)


class EntryCode(CompileResultCacheImpl):
    """The machine code of a function that no other compiled function calls, without what they would be linked with."""

    def reduce(self, compiled):
        """Return what is saved: in the place of the function's intermediate code, one that has the entry's name."""
        (name, kind, (code, _)), described, *others = super().reduce(compiled)
        stub = f'define void @"{described.llvm_cpython_wrapper_name}"() {{ ret void }}'
        return ((name, kind, (code, binding.parse_assembly(stub).as_bitcode())), described, *others)


class Stored(FunctionCache):
    """What Numba asks for a function's code before it compiles it.

    Numba itself takes code for fresh as long as the function's own file is, and readies its whole compiler before it
    loads any, which takes longer than loading all of it; ``stamp`` is a digest of all that counts.
    """

    def __init__(self, function: Callable[..., Any], stamp: str, *, entry: bool) -> None:
        self._function, self._stamp = function, stamp
        self._impl_class = EntryCode if entry else CompileResultCacheImpl
        self._opened = False

    def load_overload(self, sig, target_context):
        """Return the compiled function; None where it has to be compiled."""
        if not self._opened:
            super().__init__(self._function)
            kind = ".entry" if self._impl_class is EntryCode else ""
            name = f"{self._function.__module__.rpartition('.')[2]}.{self._function.__qualname__}{kind}"
            self._cache_file = Files(Path(self._cache_path), name, self._stamp)
            self._opened = True
        rtsys.initialize(target_context)
        try:
            found = self._load_overload(sig, target_context)
        except Exception:  # what another version left: unpickling calls whatever that names
            found = None
        if found is None:
            if STORED_ONLY.get():
                raise NotStoredError(self._function.__qualname__)
            Announcement.make()
        return found
