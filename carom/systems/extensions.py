"""Extensions: installed packages whose components, shapes, forces and systems take part like carom's own.

A distribution names a module under the entry point group ``carom.extensions``. Importing the module is all it takes:
classes enter the registries when they are declared, systems when they are `placed`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.metadata import EntryPoint, entry_points

from carom.ecs.errors import CaromError, DeclarationError

GROUP = "carom.extensions"


@dataclass(frozen=True, order=True)
class Extension:
    """One entry point: the distribution it came with, its name, and the module it names."""

    distribution: str
    version: str
    name: str
    module: str

    @property
    def package(self) -> str:
        """The package all its modules lie in."""
        return self.module.partition(".")[0]


@cache
def load_extensions() -> tuple[Extension, ...]:
    """Import every installed extension, once; raise DeclarationError naming the first that cannot be used.

    Called where registries are first needed, never by an import of carom.
    """
    found = {_described(entry): entry for entry in entry_points(group=GROUP)}
    loaded = tuple(sorted(found))
    for extension in loaded:
        try:
            found[extension].load()
        except Exception as fault:  # whatever a module of a stranger may raise
            what = str(fault) if isinstance(fault, CaromError) else f"{type(fault).__name__}: {fault}"
            raise DeclarationError(
                f"extension '{extension.name}' of {extension.distribution} {extension.version} cannot be used: {what}; "
                f"python -c 'import {extension.module}' shows where; "
                f"without it: python -m pip uninstall {extension.distribution}"
            ) from fault
    return loaded


def origin(module: str) -> str:
    """Return a module with the distribution of the extension it belongs to, if any."""
    for extension in load_extensions():
        if extension.package == module.partition(".")[0]:
            return f"{module} ({extension.distribution} {extension.version})"
    return module


def _described(entry: EntryPoint) -> Extension:
    assert entry.dist is not None, "entry_points() finds entry points by their distributions"
    return Extension(entry.dist.name, entry.dist.version, entry.name, entry.module)
