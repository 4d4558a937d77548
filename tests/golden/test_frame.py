"""The frame: what runs in which order and touches what changes only on purpose."""

from __future__ import annotations

from pathlib import Path

import pytest

from carom.ecs.explain import explain
from carom.systems.step import STEP

GOLDEN = Path(__file__).parent / "frame.txt"


def test_the_frame_is_the_golden_one(pytestconfig: pytest.Config) -> None:
    """`carom explain` prints tests/golden/frame.txt; ``--carom-update`` rewrites it."""
    frame = explain(STEP)
    if pytestconfig.getoption("--carom-update"):
        GOLDEN.write_text(frame, encoding="utf-8")
    assert frame == GOLDEN.read_text(encoding="utf-8"), "the frame changed; if on purpose: pytest --carom-update"
