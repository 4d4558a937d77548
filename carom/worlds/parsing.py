"""Parsing: the tokens of a small language inside a text of a file. No code is run."""

from __future__ import annotations

import re
from typing import ClassVar

from carom.worlds.errors import WordError

DEEPEST = 32


class Parser:
    """Takes tokens from the left; each language has its own pattern, whose named groups are the kinds of tokens."""

    TOKEN: re.Pattern[str]
    KIND: str  # what a text is meant to be
    FORM: str  # what is accepted
    MEANT: ClassVar[dict[str, str]] = {}  # what may have been meant by what is no token

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens: list[tuple[str, str]] = []
        at = 0
        while text[at:].strip():
            found = self.TOKEN.match(text, at)
            if found is None:
                rest = text[at:].strip()
                meant = next((right for wrong, right in self.MEANT.items() if rest.startswith(wrong)), "")
                raise self.fault(f"is no {self.KIND} at {rest!r}", f"did you mean {meant!r}?" if meant else "")
            self.tokens.append((str(found.lastgroup), found[str(found.lastgroup)]))
            at = found.end()

    def fault(self, what: str, hint: str = "") -> WordError:
        """Return what is wrong with the text."""
        return WordError(what, received=repr(self.text), accepted=self.FORM, hint=hint)

    def take(self, *wanted: str) -> str | None:
        """Take the next token if it is one of these."""
        return self.tokens.pop(0)[1] if self.tokens and self.tokens[0][1] in wanted else None

    def enter(self, depth: int) -> int:
        """Return the depth inside a bracket; raise WordError when it is too deep."""
        if depth == DEEPEST:
            raise self.fault(f"is nested deeper than {DEEPEST} levels")
        return depth + 1

    def close(self) -> None:
        """Take a closing bracket; raise WordError when there is none."""
        if not self.take(")"):
            raise self.fault("lacks a closing bracket")

    def end(self) -> None:
        """Raise WordError when tokens are left."""
        if self.tokens:
            raise self.fault(f"is no {self.KIND} at {self.tokens[0][1]!r}")
