"""Generators by their words; each is a file of its own, named here."""

from carom.worlds.generators import grid, heap, line, pyramid, random, ring, stack, wall
from carom.worlds.generators.generator import GENERATORS, Copies, Generator, Setting

__all__ = [
    "GENERATORS",
    "Copies",
    "Generator",
    "Setting",
    "grid",
    "heap",
    "line",
    "pyramid",
    "random",
    "ring",
    "stack",
    "wall",
]
