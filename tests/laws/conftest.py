"""Laws hold while nobody sleeps: else what is at rest would hold them by doing nothing."""

from __future__ import annotations

from typing import Any

import pytest

from carom.systems.simulation import Simulation


@pytest.fixture(autouse=True)
def nobody_sleeps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Turn sleeping off where a test does not choose it."""
    make = Simulation.__init__

    def made(self: Simulation, *, checked: bool | None = None, **settings: Any) -> None:
        make(self, checked=checked, **{"sleeping": False, **settings})

    monkeypatch.setattr(Simulation, "__init__", made)
