"""What a compiled kernel depends on: it is compiled anew when that changes, and only then."""

from __future__ import annotations

import sys

import numba
import numpy as np
import pytest

from carom.systems.kernels import (
    balls,
    balls_narrow,
    broad_cache,
    groups,
    indices,
    kernel,
    levers,
    mesh_axes,
    spatial,
)


def test_a_kernel_depends_on_the_modules_it_calls_directly_or_not() -> None:
    """Through modules in between, and not on its neighbours."""
    called = kernel.called_from(balls_narrow.__name__)
    assert {balls.__name__, spatial.__name__, kernel.__name__} <= set(called)
    assert mesh_axes.__name__ not in called


def test_a_module_outside_the_kernels_counts_by_its_numbers_alone() -> None:
    """Constants and shapes are no part of the text."""
    assert "carom.systems.constants" not in kernel.called_from(mesh_axes.__name__)
    assert "carom.systems.shapes.plane" not in kernel.called_from(broad_cache.__name__)


def test_a_module_imported_as_a_whole_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its numbers are compiled into who reads them by its name."""
    assert groups.__name__ in kernel.called_from(levers.__name__)
    before = kernel.stamp_of(levers.__name__)
    monkeypatch.setattr(groups, "TANGENT", 7)
    monkeypatch.setattr(kernel, "digest_of_called", kernel.digest_of)
    assert kernel.stamp_of(levers.__name__) != before


def test_another_number_gives_another_stamp(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the kernels that import it alone."""
    before, other = kernel.stamp_of(mesh_axes.__name__), kernel.stamp_of(balls.__name__)
    monkeypatch.setattr(mesh_axes, "PARALLEL_EDGES", 0.5)
    assert kernel.stamp_of(mesh_axes.__name__) != before
    assert kernel.stamp_of(balls.__name__) == other


def test_another_text_gives_another_stamp_to_all_that_call_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """And to no other."""
    kept = {name: kernel.stamp_of(name) for name in (balls.__name__, balls_narrow.__name__, spatial.__name__)}
    texts = {name: kernel.source_of(name) for name in sys.modules if kernel.CALLED.fullmatch(name)}
    monkeypatch.setattr(kernel, "source_of", lambda name: texts[name] + b"#" * (name == balls.__name__))
    monkeypatch.setattr(kernel, "digest_of_called", kernel.digest_of)
    changed = [name for name, stamp in kept.items() if kernel.stamp_of(name) != stamp]
    assert changed == [balls.__name__, balls_narrow.__name__]


def test_a_kernel_is_handed_read_only_arrays_themselves_and_as_they_are_now(monkeypatch: pytest.MonkeyPatch) -> None:
    """A piece of an array that may be written is not copied, however often it comes; others are, each time anew."""
    given = []
    first = kernel.Kernel(lambda values: None, (), ("values",), makes_arrays=False)
    monkeypatch.setattr(first, "_run", lambda values: given.append(values))
    room, alone = np.arange(6.0), np.arange(3.0)
    piece = room[2:5].view()
    piece.flags.writeable = alone.flags.writeable = False
    for number in (7.0, 8.0):
        room[2] = number
        for array in (piece, alone, np.broadcast_to(room[2], 3)):
            first(array)
    pieces, copies, spread = given[::3], given[1::3], given[2::3]
    assert all(array.flags.writeable and np.shares_memory(array, room) for array in pieces)
    assert not any(np.shares_memory(array, alone) for array in copies)
    assert [array.tolist() for array in spread] == [[7.0] * 3, [8.0] * 3]


def test_indices_of_kernels_are_not_looked_at_and_those_of_others_count_from_the_end() -> None:
    """Kernels are known by their names; what others compile goes on as Numba has it."""
    rows, found = np.arange(3), np.empty(3, np.int64)
    assert broad_cache.find_met(rows, np.ones(3, np.int64), np.ones(3, np.int64), found) == 3
    (code,) = broad_cache.find_met._run.overloads.values()
    assert code.fndesc.mangled_name.startswith(indices.OWN)
    assert numba.njit(lambda column, at: column[at])(np.array([1.0, 2.0]), -1) == 2.0
