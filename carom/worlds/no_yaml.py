"""What is no YAML: where, and what was probably meant."""

from __future__ import annotations

import re
from collections.abc import Iterator

import yaml

from carom.worlds.errors import Fault
from carom.worlds.source import OPENING

DEEPEST = 64
TOO_DEEP = f"is nested deeper than {DEEPEST} levels"
GIVEN_UP = "exceeded maximum nesting depth"  # what libyaml says from 1,000 levels on, before it hands over the first
TAB = re.compile(r"[ ]*\t")
COMMENT = re.compile(r"[:,{\[]\s+#\w")


def no_yaml(name: str, text: str, fault: yaml.YAMLError) -> Fault:
    """Return what a parser of YAML says of the text of a file, with what may mend it."""
    if not isinstance(fault, yaml.MarkedYAMLError):
        return Fault(name, 1, 1, "", f"is not YAML: {str(fault).splitlines()[0]}")
    mark = fault.problem_mark or fault.context_mark
    line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
    if fault.problem == GIVEN_UP:
        return Fault(name, line, column, "", TOO_DEEP)
    begun = fault.context_mark.line + 1 if fault.context_mark else line
    problem = " ".join(part for part in (fault.context, fault.problem) if part)
    hints = _hints(problem, text.split("\n"), begun, line)
    return Fault(name, line, column, "", f"is not YAML: {problem}", hint="; ".join(hints))


def _hints(problem: str, lines: list[str], begun: int, line: int) -> Iterator[str]:
    """Yield what may be wrong in the lines of a text from where something begins to where it cannot go on."""
    within = lines[begun - 1 : line]
    if problem.startswith("mapping values"):
        yield "a text with ': ' stands in quotes, entries beside each other stand in {...}"
    if begun < line:
        yield f"it begins at line {begun}"
    if any(OPENING in each for each in within):
        yield 'inside {...} and [...] an expression stands in quotes: "${...}"'
    if any(TAB.match(each) for each in within):
        yield "a line begins with blanks, never with a tab"
    if any(COMMENT.search(each) for each in lines[max(begun - 2, 0) : line]):
        yield "what follows # is a comment; a colour stands in quotes: '#ff8000'"
