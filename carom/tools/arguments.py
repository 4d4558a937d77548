"""Arguments: argparse that says which word was probably meant."""

from __future__ import annotations

import argparse
import re
from typing import Any, NoReturn

CHOICE = re.compile(r"invalid choice: '([^']*)' \(choose from (.*)\)")


class Parser(argparse.ArgumentParser):
    """A parser whose commands tell what is wrong with their words by their own usage, and the nearest word."""

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Return what words say; end the process with status 2 for words that mean nothing."""
        found, unknown = self.parse_known_args(args, namespace)
        if unknown:
            getattr(found, "parser", self).error(f"unrecognized arguments: {' '.join(unknown)}", unknown[0])
        return found

    def error(self, message: str, unknown: str = "") -> NoReturn:
        """Tell what is wrong, of a word that is ``unknown`` what may have been meant, and end the process."""
        from carom.ecs.errors import did_you_mean

        known: list[str] = [option for action in self._actions for option in action.option_strings]
        known = [option for option in known if option[:3] == unknown[:3]]  # two dashes alone make nothing alike
        if choice := CHOICE.search(message):
            unknown, known = choice[1], re.findall(r"[\w-]+", choice[2])
        hint = did_you_mean(unknown.partition("=")[0], known) if unknown else ""
        super().error(f"{message}; {hint}" if hint else message)
