"""Terms: what expectations can ask of a world, such as ``left.position.y`` or ``speed(rain[0,0,1])``."""

from __future__ import annotations

import re

from carom.ecs import World
from carom.ecs.errors import did_you_mean
from carom.worlds.call_terms import call_term, term_of_all
from carom.worlds.column_terms import column_term
from carom.worlds.comers import all_names
from carom.worlds.errors import WordError
from carom.worlds.functions import CALLS, OF_ALL, PAIRS
from carom.worlds.names import fitting, known, matching
from carom.worlds.pictures import QUESTIONS
from carom.worlds.term import Term

NAME_PATTERN = r"[^\W\d][\w*-]*(?:\[[\d,*]*\]|\.[\w*][\w*-]*)*"  # rain[3,0,1], rope.joint[2], cart.wheel[0]
COLUMN_TERM = re.compile(NAME_PATTERN)
DOT = re.compile(r"\.(?=[\w.]+$)")  # before a column, as far as can be told without the names of entities
CALL_TERM = re.compile(r"(\w+)\s*\(([^()]*)\)(?:\.([xyz]))?")
TERM_PATTERN = rf"\w+\s*\([^()]*\)(?:\.[xyz])?|{NAME_PATTERN}"


def read_term(text: str, world: World) -> Term:
    """Return the term a text states; raise WordError for what the world neither has nor will have."""
    text = text.strip()
    call, dots = CALL_TERM.fullmatch(text), [dot.start() for dot in DOT.finditer(text)]
    if call is not None:
        patterns = re.findall(NAME_PATTERN, call[2])
        if call[1] in OF_ALL:
            return term_of_all(text, call[1], patterns, call[3], world)
        if call[3] is None or call[1] not in (*CALLS, *PAIRS, *QUESTIONS):
            return call_term(text, call[1], patterns, world)
    if COLUMN_TERM.fullmatch(text) is None or not dots:
        calls = [f"{name}(entity)" for name in CALLS] + [f"{name}(entity, ...)" for name in OF_ALL]
        calls += [f"{name}(entity, entity)" for name in PAIRS]
        accepted = f"<entity>.<column>, {', '.join(calls[:-1])} or {calls[-1]}"
        raise WordError("is no value of the world", received=repr(text), accepted=accepted)
    there = all_names(world)
    end = next((dot for dot in reversed(dots) if fitting(text[:dot], there)), dots[0])
    names = matching(text[:end], there)
    try:
        return column_term(text, end, names, world)
    except WordError:
        _refuse_member(text, end, names)
        raise


def _refuse_member(text: str, end: int, names: list[str]) -> None:
    """Raise WordError where the word after the name of a group is nearly that of one of those it holds."""
    word, dot, _ = text[end + 1 :].partition(".")
    members = {name[end + 1 :].split(".")[0] for name in names if name[: end + 1] == text[: end + 1]}
    if dot and did_you_mean(word, members):
        known("entity", text[: end + 1] + word, names)
