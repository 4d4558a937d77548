"""How columns lie in memory."""

from __future__ import annotations

from zlib import crc32

import pytest

from carom.ecs import Collider, RigidBody


@pytest.mark.parametrize("capacity", [0, 1, 64, 4096])
def test_columns_begin_where_lines_of_the_cache_do(capacity: int) -> None:
    """Zeros of the declared shape and type; large ones do not all begin at one place of a page."""
    places = set()
    for name, column in (*RigidBody.columns.items(), *Collider.columns.items()):
        array = column.allocate(capacity, crc32(name.encode()))
        assert array.shape == (capacity, *column.shape)
        assert array.dtype == column.dtype
        assert array.flags.c_contiguous
        assert not array.any()
        assert array.ctypes.data % 64 == 0 or not array.size
        places.add(array.ctypes.data % 4096)
    assert len(places) > 10 or capacity < 4096
