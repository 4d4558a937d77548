"""Parameters: how shapes, force laws and joints declare the words they take, and what is wrong with values for them."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from carom.ecs.errors import DeclarationError, did_you_mean


class WordFault(NamedTuple):
    """What is wrong with the words of an entity, and where among them; ``name`` is one that nothing is called."""

    steps: tuple[str | int, ...]
    what: str
    received: str = ""
    accepted: str = ""
    hint: str = ""
    name: str = ""

    def __str__(self) -> str:
        """Return the fault as one line."""
        parts = [self.what]
        parts += [f"received {self.received}"] if self.received else []
        parts += [f"accepted: {self.accepted}"] if self.accepted else []
        parts += [self.hint] if self.hint else []
        return ": ".join(filter(None, (".".join(map(str, self.steps)), "; ".join(parts))))


def make_plain(of: Any, names: Iterable[str]) -> None:
    """Make these parameters of a frozen dataclass floats or tuples of them, which is what kernels are compiled for."""
    for name in names:
        value = np.asarray(getattr(of, name), np.float64).tolist()
        object.__setattr__(of, name, tuple(value) if isinstance(value, list) else value)


def refusal(faults: Iterable[WordFault]) -> DeclarationError:
    """Return the error that tells all of these faults."""
    return DeclarationError("; ".join(map(str, faults)))


def unknown_keys(steps: tuple[str, ...], stated: Iterable[Any], known: Iterable[str]) -> Iterator[WordFault]:
    """Yield a fault for each word that is none of those known."""
    known = list(known)
    for key in map(str, stated):
        if key not in known:
            yield WordFault((*steps, key), "unknown key", repr(key), ", ".join(known), did_you_mean(key, known))


def parameter(
    *,
    unit: str,
    doc: str,
    default: Any = dataclasses.MISSING,
    above: float | None = None,
    least: float | None = None,
    most: float | None = None,
) -> Any:
    """Declare a parameter: its unit, meaning and, if any, the value it must lie above and its least and greatest."""
    bounds = {"above": above, "least": least, "most": most}
    return dataclasses.field(default=default, metadata={"unit": unit, "doc": doc, **bounds})


def vector(*, unit: str, doc: str, default: Any = dataclasses.MISSING, above: float | None = None) -> Any:
    """Declare a parameter that is a vector of three numbers and, if any, the value each must lie above."""
    return dataclasses.field(default=default, metadata={"unit": unit, "doc": doc, "width": 3, "above": above})


def words_of(stated: Any) -> dict[str, Any]:
    """Return the words that state a dataclass of declared fields, but its defaults; the inverse of reading them."""
    words: dict[str, Any] = {}
    for field in dataclasses.fields(stated):
        value = getattr(stated, field.name)
        if value is None or same(value, field.default):
            continue
        words[field.name] = words_of(value) if dataclasses.is_dataclass(value) else value
    return words


def same(value: Any, other: Any) -> bool:
    """Tell whether two values are the same to the bit, so that -0 is not 0 and NaN is NaN."""
    if isinstance(value, float) and isinstance(other, float):
        return value.hex() == other.hex()
    if isinstance(value, (tuple, list)) and isinstance(other, (tuple, list)):
        return len(value) == len(other) and all(map(same, value, other))
    return type(value) is type(other) and bool(value == other)


def number_fault(metadata: Mapping[str, Any], received: Any) -> str:
    """Return what is wrong with the value received for a declared parameter; nothing where it is in its bounds.

    Where ``rows`` are declared, it may have one for each of many.
    """
    unit, width = "" if metadata["unit"] == "1" else f" {metadata['unit']}", metadata.get("width")
    above, least, most = (metadata.get(key) for key in ("above", "least", "most"))
    try:
        values = np.asarray(received)
    except ValueError:  # lists of different lengths
        values = np.asarray(None)
    shape = () if width is None else (width,)
    each = metadata.get("rows") and values.ndim == len(shape) + 1 and values.shape[1:] == shape
    if values.dtype.kind not in "fiu" or (values.shape != shape and not each):
        return f"must be {'a number' if width is None else f'{width} numbers'}, received {received!r}"
    wrong, wanted = ~np.isfinite(values), ["finite"]
    for bound, word, fits in ((above, "above", np.greater), (least, "at least", np.greater_equal)):
        if bound is not None:
            wrong |= ~fits(values, bound)
            wanted.append(f"{word} {bound:g}{unit}")
    if most is not None:
        wrong |= ~(values <= most)
        wanted.append(f"at most {most:g}{unit}")
    return f"must be {' and '.join(wanted)}, received {values[wrong].flat[0]:g}" if wrong.any() else ""
