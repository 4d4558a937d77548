"""carom: a 3D game engine whose world is a table.

Entities are rows, component fields are columns, systems are functions over columns, and a recording is that table with
a time axis.
"""

__version__ = "0.1.0"
