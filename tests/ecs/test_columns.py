"""How columns lie in memory."""

from __future__ import annotations

import pytest

from carom.ecs import Collider, RigidBody


@pytest.mark.parametrize("capacity", [0, 1, 64, 4096])
def test_columns_begin_where_lines_of_the_cache_do(capacity: int) -> None:
    """Zeros of the declared shape and type."""
    for column in (*RigidBody.columns.values(), *Collider.columns.values()):
        array = column.allocate(capacity)
        assert array.shape == (capacity, *column.shape)
        assert array.dtype == column.dtype
        assert array.flags.c_contiguous
        assert not array.any()
        assert array.ctypes.data % 64 == 0 or not array.size
