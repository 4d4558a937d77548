"""Tags: components without columns, by which entities are told apart in queries."""

from __future__ import annotations

import re

from carom.ecs.component import Component, Record
from carom.ecs.errors import DeclarationError


class Tag(Component):
    """What an entity is: either it has the tag or it does not."""


def tag(name: str) -> type[Tag]:
    """Return the tag of that name (snake case), made when it is first asked for; files say ``tags: [name]``.

    Raises DeclarationError for a name that is no lower-case word, or that a component with columns has already.
    """
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", name):
        raise DeclarationError(f"tags: {name!r} is no tag; write lower-case words joined by _, like 'red_team'")
    known = Record.registry.get(name)
    if known is None:
        title = "".join(part.capitalize() for part in name.split("_"))
        known = type(title, (Tag,), {"__doc__": f"The tag {name}.", "__module__": __name__}, key=name)
    if not issubclass(known, Tag):
        raise DeclarationError(f"tags: {name!r} is the key of the component {known.__name__}; choose another")
    return known
