"""Layout: the text of a world file as a tree that keeps its comments, and its one stable form."""

from carom.worlds.layout.form import formatted, printed
from carom.worlds.layout.growing import grown
from carom.worlds.layout.tree import Collection, Entry, Scalar

__all__ = ["Collection", "Entry", "Scalar", "formatted", "grown", "printed"]
