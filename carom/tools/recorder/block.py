"""Block: rows of several frames, joined to be written at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import prod
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.tools.recorder.stream import Stamp

Columns = dict[str, npt.NDArray[Any]]


class Block(NamedTuple):
    """When there were rows, how many each time, and the columns of all, numbers (n,) or vectors (n, width)."""

    stamps: list[Stamp]
    counts: list[int]
    columns: Columns

    def values(self, names: Iterable[str]) -> list[Any]:
        """Return columns as Rerun takes them, in their own precision."""
        import rerun

        columns = {name: _arrow(self.columns[name]) for name in names}
        return self.drawn(rerun.AnyValues(**columns)) if columns else []

    def drawn(self, archetype: Any) -> list[Any]:
        """Return what an archetype has of all rows as Rerun takes it; its own `columns` counts them one by one."""
        return [batch.partition(self.counts) for batch in archetype.as_component_batches()]


def joined(pending: Sequence[tuple[Stamp, Columns]]) -> Block:
    """Return the block of what was kept at one time or several."""
    stamps, parts = zip(*pending, strict=True)
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    return Block(list(stamps), [len(next(iter(part.values()))) for part in parts], columns)


def _arrow(values: npt.NDArray[Any]) -> Any:
    import pyarrow

    numbers = pyarrow.array(values.ravel())
    return numbers if values.ndim == 1 else pyarrow.FixedSizeListArray.from_arrays(numbers, prod(values.shape[1:]))
