"""Columns: the declaration of one field of a component or relation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from carom.ecs.errors import DeclarationError

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Booleans = npt.NDArray[np.bool_]
Texts = npt.NDArray[np.str_]
Role = Literal["state", "input", "derived", "cache"]
LINE = 64  # bytes of the processor's cache
ACCEPTED = {"f": "numbers", "i": "whole numbers", "u": "whole numbers from 0", "b": "true or false", "U": "texts"}


@dataclass(frozen=True)
class Column:
    """One field of a table: what it holds, in which unit, and how it lives through a step.

    ``role`` is *state* (saved and hashed), *input* (set from outside, cleared after the step), *derived* (rewritten by
    every step before it is read) or *cache* (droppable at any time without a bit of change in what follows). Words that
    state it lie ``above`` a number, are at ``least`` one, at ``most`` one.
    """

    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    default: Any
    unit: str
    doc: str
    role: Role
    holds: Literal["values", "entities", "rows"]
    above: float | None = None
    least: float | None = None
    most: float | None = None

    @property
    def bounds(self) -> dict[str, float]:
        """Return the bounds there are by their names."""
        bounds = {"above": self.above, "least": self.least, "most": self.most}
        return {name: bound for name, bound in bounds.items() if bound is not None}

    @cached_property
    def zero(self) -> bool:
        """Whether the default is what storage holds anyway."""
        return not np.any(self.default)

    def allocate(self, capacity: int) -> npt.NDArray[Any]:
        """Return zeroed storage for ``capacity`` rows; untouched rows cost address space, not memory.

        It begins where a line of the processor's cache does, so that eight rows are whole lines.
        """
        size = math.prod(self.shape) * capacity * self.dtype.itemsize
        room = np.zeros(size + LINE, np.uint8)
        begin = -room.ctypes.data % LINE
        return room[begin : begin + size].view(self.dtype).reshape(capacity, *self.shape)

    def accept(self, value: Any, where: str) -> npt.NDArray[Any]:
        """Return ``value`` as an array of this column's type; raise DeclarationError when that would change it."""
        try:
            given = np.asarray(value)
        except ValueError:
            raise DeclarationError(
                f"{where} takes {self.per_row()} per row, received rows of different length"
            ) from None
        kind = self.dtype.kind
        if given.dtype == self.dtype:
            return given
        if kind == given.dtype.kind == "U":
            longest, most = max(given.ravel().tolist(), key=len), self.dtype.itemsize // 4
            if len(longest) > most:
                raise DeclarationError(f"{where} holds at most {most} characters, received {len(longest)}: {longest!r}")
            return given.astype(self.dtype)
        if kind not in "fiub" or given.dtype.kind not in "fiub":
            raise DeclarationError(f"{where} takes {ACCEPTED[kind]}, received {_shown(given)}")
        with np.errstate(invalid="ignore"):
            taken = given.astype(self.dtype)
        changed = taken != given
        if kind != "f" and changed.any():
            raise DeclarationError(f"{where} takes {ACCEPTED[kind]}, received {_shown(given[changed])}")
        return taken

    def fit(self, value: npt.NDArray[Any], count: int, where: str) -> None:
        """Raise DeclarationError unless ``value`` is one row's value, or one for each of ``count`` rows."""
        if value.shape not in ((), (1,), self.shape, (1, *self.shape), (count, *self.shape)):
            each = f" for all, or {(count, *self.shape)} for each" if count != 1 else ""
            raise DeclarationError(
                f"{where} takes {self.per_row()} per row, received an array of shape {value.shape}; "
                f"give shape {self.shape}{each}"
            )

    def per_row(self) -> str:
        """Return in words how many numbers one row holds."""
        return " x ".join(map(str, self.shape)) or "a single value"


def _shown(values: npt.NDArray[Any]) -> str:
    first = values.ravel()[0] if values.size else "nothing"
    return repr(first.item() if isinstance(first, np.generic) else first)


def column(
    *shape: int,
    unit: str | None = None,
    doc: str | None = None,
    dtype: npt.DTypeLike = np.float64,
    default: Any = 0,
    role: Role = "state",
    holds: Literal["values", "entities", "rows"] = "values",
    above: float | None = None,
    least: float | None = None,
    most: float | None = None,
) -> Any:
    """Declare a column with per-row ``shape``; ``unit`` and ``doc`` are mandatory ("1" is the unit of a pure number).

    Docs, labels, the schema of world files and messages are generated from this declaration. A column may hold
    ``entities`` (handles, -1 for none) or, if derived, ``rows``, which `World.compact` renumbers. Raises
    DeclarationError when unit or doc is missing.
    """
    if not unit or not doc:
        missing = " and ".join(name for name, given in (("unit", unit), ("doc", doc)) if not given)
        raise DeclarationError(
            f'a column is declared without {missing}; write column(3, unit="m/s", doc="linear velocity")'
        )
    if holds != "values":
        dtype, default = np.int64, -1
    return Column(tuple(shape), np.dtype(dtype), default, unit, doc, role, holds, above, least, most)
