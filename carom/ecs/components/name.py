"""Name: what files, messages and recordings call an entity."""

from carom.ecs.column import Texts, column
from carom.ecs.component import Component

NAME_LENGTH = 48


class Name(Component):
    """The unique name of an entity; generated entities are called like ``rain[3,0,1]``."""

    text: Texts = column(unit="1", doc="name", dtype=f"U{NAME_LENGTH}", default="")
