"""What to simulate: world files, their schema, reader, builder and expectations, and the library.

What is named here is imported when it is first asked for: who lists the library waits for no solver.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from carom.worlds.builder import LoadedWorld, load_text, load_world
    from carom.worlds.errors import Fault, WorldError
    from carom.worlds.schema import json_schema
    from carom.worlds.writing import world_text, write_world

__all__ = ["Fault", "LoadedWorld", "WorldError", "json_schema", "load_text", "load_world", "world_text", "write_world"]

_NAMES = {
    "builder": ("LoadedWorld", "load_text", "load_world"),
    "errors": ("Fault", "WorldError"),
    "schema": ("json_schema",),
    "writing": ("world_text", "write_world"),
}


def __getattr__(name: str) -> Any:
    for module, names in _NAMES.items():
        if name in names:
            return getattr(import_module(f"carom.worlds.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
