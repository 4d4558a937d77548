"""Declared: columns, parameters and fields say what they mean where they are declared; the API pages show it."""

from __future__ import annotations

import ast
from typing import Any

from griffe import Attribute, Docstring, Expr, ExprCall, ExprKeyword, Extension


class Declared(Extension):
    """Make ``doc`` and ``unit`` of a declaration the docstring of what it declares."""

    def on_attribute(self, *, attr: Attribute, **_: Any) -> None:
        """Look at one attribute that has none of its own."""
        value = attr.value
        if attr.docstring is None and isinstance(value, ExprCall):
            said = {one.name: one.value for one in value.arguments if isinstance(one, ExprKeyword)}
            if doc := text(said.get("doc")) or text(said.get("description")):
                unit = text(said.get("unit"))
                attr.docstring = Docstring(doc + (f" ({unit})" if unit and unit != "1" else ""), parent=attr)


def text(value: str | Expr | None) -> str:
    """Return a literal's text, or nothing."""
    try:
        found = ast.literal_eval(str(value))
    except (ValueError, SyntaxError):
        return ""
    return found if isinstance(found, str) else ""
