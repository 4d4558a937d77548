"""Writing: a world in memory as the text of a file that loads to the same state."""

from carom.worlds.writing.world import world_text, write_world

__all__ = ["world_text", "write_world"]
