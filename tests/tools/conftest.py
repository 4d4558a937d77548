"""What tests of the snapshot kit share."""

from __future__ import annotations

import hypothesis.internal.observability
import pytest

from carom.tools.filming import photograph, shot_of
from carom.tools.recorder import Recorder
from carom.tools.session import run
from carom.tools.snapshot_kit import accept, last_frames, report
from carom.worlds import load_text

__all__ = ["accept", "hypothesis", "last_frames", "report"]

WORLD = """
carom: 1
run: {frames: 1}
entities: [{name: ball, collider: {sphere: {radius: 0.3}}, body: {}}]
expect: [{at: 0 s, ball.position.x: {is: 0, within: 1 um}}]
"""


@pytest.fixture(scope="session")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Import all the inner runs need: each forgets what it imported itself, and NumPy and OpenGL load only once."""
    folder = tmp_path_factory.mktemp("loaded")
    loaded = load_text(WORLD)
    run(loaded, [Recorder(folder / "a.rrd")])
    photograph(shot_of(loaded), loaded.simulation, folder / "a.png")
