"""Words that several generators have."""

from __future__ import annotations

from typing import Annotated

from carom.worlds.values import Count, In, Vector3

Counts = tuple[Count, Count]
WIDEST = 1e100  # m; squares of more are beyond all numbers
Gap = Annotated[float, In("m", least=0.0, most=WIDEST)]
Gaps = Annotated[Vector3, In("m", least=0.0, most=WIDEST)]
Edge = Annotated[float, In("m", above=0.0, most=WIDEST)]
Edges = Annotated[Vector3, In("m", above=0.0, most=WIDEST)]
