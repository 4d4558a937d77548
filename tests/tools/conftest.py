"""What tests of tools share: a small world in a file, a renderer, and what runs within tests of the kit need."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import hypothesis.internal.observability
import pytest

from carom.tools.filming import photograph, shot_of
from carom.tools.recorder import Recorder
from carom.tools.renderer import Renderer
from carom.tools.session import run
from carom.tools.snapshot_kit import accept, last_frames, report
from carom.worlds import load_text

__all__ = ["accept", "hypothesis", "last_frames", "report"]

FALLING = """carom: 1
name: Falling
step: {dt: 1/60}
run: {duration: 0.5 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: ball, transform: {position: [0, 1, 0]}, collider: {sphere: {radius: 0.1}}, body: {}}
cameras: {main: {position: [0, 1, 3]}, top: {position: [0, 3, 0.1]}}
render: {width: 64, height: 48}
expect:
  - at: 0.2 s
    ball.position.y: {is: 0.8038, within: 1 mm}
"""


@pytest.fixture(scope="session")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Import all the inner runs need: each forgets what it imported itself, and NumPy and OpenGL load only once."""
    folder = tmp_path_factory.mktemp("loaded")
    loaded = load_text(FALLING)
    run(loaded, [Recorder(folder / "a.rrd")])
    photograph(shot_of(loaded), loaded.simulation, folder / "a.png")


@pytest.fixture
def world(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Return the file, in an empty folder, of the WORLD of a module, or of one in which a ball falls."""
    path = tmp_path / "world.yaml"
    path.write_text(getattr(request.module, "WORLD", FALLING))
    return path


@pytest.fixture(scope="module")
def renderer(request: pytest.FixtureRequest) -> Iterator[Renderer]:
    """Yield one renderer, of the module's WIDTH and HEIGHT, that all of its tests share."""
    with Renderer(request.module.WIDTH, request.module.HEIGHT) as made:
        yield made


@pytest.fixture(scope="module")
def strict_rerun() -> Iterator[None]:
    """Let Rerun raise on bad data instead of warning."""
    import rerun

    rerun.set_strict_mode(True)
    yield
    rerun.set_strict_mode(False)
