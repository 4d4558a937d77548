"""What a compiled kernel depends on: it is compiled anew when that changes, and only then."""

from __future__ import annotations

import sys

import pytest

from carom.systems.kernels import balls, balls_narrow, broad_cache, groups, kernel, levers, mesh_axes, spatial


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
