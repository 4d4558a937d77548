"""Columns: the declaration of one field of a component or relation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from carom.ecs.errors import DeclarationError

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Booleans = npt.NDArray[np.bool_]
Texts = npt.NDArray[np.str_]
Role = Literal["state", "input", "derived", "cache"]


@dataclass(frozen=True)
class Column:
    """One field of a table: what it holds, in which unit, and how it lives through a step.

    ``role`` is *state* (saved and hashed), *input* (set from outside, cleared after the step), *derived* (rewritten by
    every step before it is read) or *cache* (droppable at any time without a bit of change in what follows).
    """

    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    default: Any
    unit: str
    doc: str
    role: Role
    entity: bool

    def allocate(self, capacity: int) -> npt.NDArray[Any]:
        """Return zeroed storage for ``capacity`` rows; untouched rows cost address space, not memory."""
        return np.zeros((capacity, *self.shape), self.dtype)


def column(
    *shape: int,
    unit: str | None = None,
    doc: str | None = None,
    dtype: npt.DTypeLike = np.float64,
    default: Any = 0,
    role: Role = "state",
    entity: bool = False,
) -> Any:
    """Declare a column with per-row ``shape``; ``unit`` and ``doc`` are mandatory ("1" is the unit of a pure number).

    Docs, labels, the schema of world files and messages are generated from this declaration. ``entity`` marks columns
    that hold entity handles. Raises DeclarationError when unit or doc is missing.
    """
    if not unit or not doc:
        missing = " and ".join(name for name, given in (("unit", unit), ("doc", doc)) if not given)
        raise DeclarationError(
            f'a column is declared without {missing}; write column(3, unit="m/s", doc="linear velocity")'
        )
    if entity:
        dtype, default = np.int64, -1
    return Column(tuple(shape), np.dtype(dtype), default, unit, doc, role, entity)
