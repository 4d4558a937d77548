"""Fields of models: their types, by what declares them, and what they say of themselves."""

from __future__ import annotations

from typing import Annotated, Any, Literal, get_args, get_origin

from carom.worlds.values import Flag, In, Whole, word_of

Fields = dict[str, Any]


def numbers(width: int, mark: In) -> Any:
    """Return the type of one number or of a list of ``width``."""
    return Annotated[float if width == 1 else tuple.__class_getitem__((float,) * width), mark]


def hinted(hint: Any, unit: str, *, width: int = 1, whole: tuple[int, int | None] = (0, None), **bounds: Any) -> Any:
    """Return the type of a value by its annotation: a word, a flag, a whole number, or ``width`` numbers in a unit."""
    if get_origin(hint) is Literal:
        return word_of(*get_args(hint))
    if hint is bool:
        return Flag
    if hint is int:
        return Annotated[int, Whole(*whole)]
    return numbers(width, In(unit, **bounds))


def description(doc: str, unit: str) -> str:
    """Return what a word means, with its unit."""
    return doc if unit == "1" else f"{doc} ({unit})"


def first_line(kind: type[Any]) -> str:
    """Return the first line of what a class says of itself."""
    return (kind.__doc__ or "").strip().split("\n")[0]
