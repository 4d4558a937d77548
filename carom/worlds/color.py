"""Colours in world files: three or four numbers, ``#rrggbb`` or a name."""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import BeforeValidator, WithJsonSchema

from carom.ecs.errors import did_you_mean
from carom.worlds.errors import WordError, shown
from carom.worlds.values import EXPRESSION

Color = tuple[float, float, float, float]
NAMED = {
    "black": "#000000", "white": "#ffffff", "gray": "#808080", "silver": "#c0c0c0", "red": "#ff0000",
    "maroon": "#800000", "orange": "#ffa500", "yellow": "#ffff00", "gold": "#ffd700", "green": "#008000",
    "lime": "#00ff00", "teal": "#008080", "cyan": "#00ffff", "blue": "#0000ff", "navy": "#000080",
    "purple": "#800080", "magenta": "#ff00ff", "brown": "#a52a2a", "pink": "#ffc0cb", "ivory": "#fffff0",
}  # fmt: skip
HEX = re.compile(r"#(?:[0-9a-fA-F]{6}|[0-9a-fA-F]{8})")
FORMS = "[red, green, blue] or [red, green, blue, alpha] in 0..1, '#rrggbb', '#rrggbbaa' or one of " + ", ".join(NAMED)


def _read(value: Any) -> Color:
    text = NAMED.get(value, value) if isinstance(value, str) else ""
    if HEX.fullmatch(text):
        parts = [int(text[at : at + 2], 16) / 255.0 for at in range(1, len(text), 2)]
    elif isinstance(value, list) and len(value) in (3, 4) and all(_share(part) for part in value):
        parts = [float(part) for part in value]
    else:
        hint = did_you_mean(value, NAMED) if isinstance(value, str) else ""
        raise WordError("is not a colour", received=shown(value), accepted=FORMS, hint=hint)
    red, green, blue, alpha = (*parts, 1.0)[:4]
    return (red, green, blue, alpha)


def _share(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and 0.0 <= value <= 1.0


SHARE = {"type": "number", "minimum": 0, "maximum": 1}
SCHEMA = {
    "anyOf": [
        {"type": "array", "items": SHARE, "minItems": 3, "maxItems": 4},
        {"type": "string", "pattern": f"^{HEX.pattern}$"},
        {"enum": list(NAMED)},
        EXPRESSION,
    ]
}
ColorWord = Annotated[Color, BeforeValidator(_read), WithJsonSchema(SCHEMA)]
