"""The constants of the step: one name, one meaning, whichever part of the step reads it."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

from carom.systems import constants


def test_no_two_parts_of_the_step_give_the_same_name() -> None:
    """All are read from one place, where the last of a name would silently stand for the others."""
    given = Counter(
        name.id
        for module in Path(constants.__path__[0]).glob("*.py")
        for line in ast.parse(module.read_text(encoding="utf-8")).body
        if isinstance(line, ast.Assign | ast.AnnAssign)
        for target in (line.targets if isinstance(line, ast.Assign) else [line.target])
        for name in ast.walk(target)
        if isinstance(name, ast.Name)
    )
    assert len(given) > 50
    assert [name for name, times in given.items() if times > 1] == []
