"""What to simulate: world files, their schema, reader, builder and expectations, and the library."""

from carom.worlds.builder import LoadedWorld, load_text, load_world
from carom.worlds.errors import Fault, WorldError
from carom.worlds.schema import json_schema
from carom.worlds.writing import world_text, write_world

__all__ = ["Fault", "LoadedWorld", "WorldError", "json_schema", "load_text", "load_world", "world_text", "write_world"]
