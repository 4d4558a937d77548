"""Names: which entity is called what, and patterns that mean several."""

from __future__ import annotations

import re
from collections.abc import Iterable

from carom.ecs.column import Integers, Texts
from carom.ecs.errors import DeclarationError, EntityError, did_you_mean

NOBODY = -1


def pattern(text: str) -> re.Pattern[str]:
    """Return what ``text`` means: itself, all copies of that name (``rain[3,0,1]``), or with ``*`` all that fit."""
    return re.compile(re.escape(text).replace(r"\*", ".*") + r"(?:\[[\d,]+\])?")


class Names:
    """The entity of each name, kept while entities come and go and made anew when somebody edited the names."""

    def __init__(self) -> None:
        self.entities: dict[str, int] = {}
        self.stale = False

    def note(self, texts: Texts, entities: Integers) -> None:
        """Take in who is called what; an empty text is no name."""
        pairs = zip(texts.tolist(), entities.tolist(), strict=True)
        self.entities.update((text, entity) for text, entity in pairs if text)

    def refuse_taken(self, names: Iterable[str], entity: int = NOBODY) -> None:
        """Raise DeclarationError when one of ``names`` is that of another than ``entity``, or stands there twice."""
        seen: set[str] = set()
        for name in names:
            if name and (self.entities.get(name, entity) != entity or name in seen):
                raise DeclarationError(f"two entities would be named {name!r}; names are unique, choose another")
            seen.add(name)

    def find(self, name: str) -> int:
        """Return the handle of a name; raise EntityError with near names when there is none."""
        found = self.entities.get(name)
        if found is not None:
            return found
        parts = f"no entity is named {name!r}", did_you_mean(name, self.entities, 3)
        raise EntityError("; ".join(filter(None, parts)))
