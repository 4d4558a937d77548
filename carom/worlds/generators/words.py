"""Words that several generators have."""

from __future__ import annotations

from typing import Annotated

from carom.worlds.values import In, Vector3, Whole

Count = Annotated[int, Whole(1)]
Counts = tuple[Count, Count]
Length = Annotated[float, In("m")]
Lengths = Annotated[Vector3, In("m")]
WIDEST = 1e100  # m; squares of more are beyond all numbers
Gap = Annotated[float, In("m", least=0.0, most=WIDEST)]
Gaps = Annotated[Vector3, In("m", least=0.0, most=WIDEST)]
Edge = Annotated[float, In("m", above=0.0, most=WIDEST)]
Edges = Annotated[Vector3, In("m", above=0.0, most=WIDEST)]
