"""Snapshot kit: a pytest plugin that holds a world's state and picture to goldens kept beside the test.

    def test_break(carom_snapshot):
        simulation = load_world("billiards").simulation
        simulation.step(240)
        carom_snapshot.check(simulation, "one_second", camera=Camera((0, 2, 3)))

Missing goldens fail; ``pytest --carom-update`` writes them. The plugin is loaded in every pytest run of the
environment, so it imports nothing of weight before it is used.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation
    from carom.tools.cameras import Camera

FOLDER = "__carom__"
TOLERANCE = 1e-6  # m, m/s, rad/s: where CPU, numpy or numba are not those that wrote the golden


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add ``--carom-update``."""
    parser.getgroup("carom").addoption(
        "--carom-update", action="store_true", help="write the goldens of carom_snapshot anew instead of comparing"
    )


@pytest.fixture(scope="session")
def carom_renderers() -> Iterator[dict[tuple[int, int], Any]]:
    """Keep the renderers of a session by size, since making one takes longer than a picture."""
    renderers: dict[tuple[int, int], Any] = {}
    yield renderers
    for renderer in renderers.values():
        renderer.close()


@pytest.fixture
def carom_snapshot(request: pytest.FixtureRequest, carom_renderers: dict[tuple[int, int], Any]) -> CaromSnapshot:
    """Compare worlds with goldens in ``__carom__/<test file>/`` beside the test file."""
    return CaromSnapshot(request.node, bool(request.config.getoption("--carom-update")), carom_renderers)


class CaromSnapshot:
    """The goldens of one test."""

    def __init__(self, test: pytest.Item, update: bool, renderers: dict[tuple[int, int], Any]) -> None:
        self._folder = test.path.parent / FOLDER / test.path.stem
        self._accept = f'pytest "{test.nodeid}" --carom-update'
        self._update, self._renderers = update, renderers

    def check(
        self,
        simulation: Simulation,
        name: str,
        *,
        camera: Camera | None = None,
        tolerance: float = TOLERANCE,
        size: tuple[int, int] = (320, 240),
    ) -> None:
        """Fail when the state, or the picture by ``camera``, is not that of golden ``name``; None takes no picture."""
        __tracebackhide__ = True
        from carom.tools import goldens

        picture, driver = self._picture(simulation, camera, size) if camera is not None else (None, None)
        state = goldens.state_golden(simulation.world, driver)
        state_path, picture_path = self._path(name, ".json"), self._path(name, ".png")
        if self._update:
            self._write(state_path, state, picture_path, picture)
            return
        missing = [path for path in (state_path, *([picture_path] if picture is not None else [])) if not path.exists()]
        if missing:
            self._fail(f"no golden {', '.join(path.name for path in missing)} in {self._folder}")
        golden = goldens.StateGolden.read(state_path.read_text(encoding="utf-8"))
        physics = goldens.state_fault(state, golden, tolerance)
        rendering, left = None, ""
        if picture is not None:
            drawn = goldens.read_picture(picture_path)
            rendering = goldens.picture_fault(picture, drawn, same_driver=golden.driver == driver)
            left = self._leave(name, picture, drawn) if physics or rendering else ""
        if physics:
            self._fail(f"physics: {physics}{left}")
        if rendering:
            self._fail(f"rendering: {rendering}; the state agrees{left}")
        self._forget(name)

    def _picture(self, simulation: Simulation, camera: Camera, size: tuple[int, int]) -> tuple[Any, str]:
        from carom.tools.renderer import Renderer
        from carom.tools.scene import Scene

        if size not in self._renderers:
            self._renderers[size] = Renderer(*size)
        renderer = self._renderers[size]
        return renderer.picture(Scene(simulation.world).batches(), camera), renderer.driver

    def _path(self, name: str, ending: str) -> Path:
        return self._folder / f"{name}{ending}"

    def _write(self, state_path: Path, state: Any, picture_path: Path, picture: Any) -> None:
        from carom.tools import goldens

        self._folder.mkdir(parents=True, exist_ok=True)
        state_path.write_text(state.text(), encoding="utf-8")
        if picture is not None:
            goldens.write_picture(picture_path, picture)
        self._forget(state_path.stem)

    def _leave(self, name: str, picture: Any, golden: Any) -> str:
        """Leave the picture and how it differs; return where, for the message."""
        from carom.tools import goldens

        goldens.write_picture(self._path(name, ".actual.png"), picture)
        if picture.shape != golden.shape:
            return f"\n  picture: {self._path(name, '.actual.png')}"
        goldens.write_picture(self._path(name, ".difference.png"), goldens.difference(picture, golden))
        return f"\n  picture: {self._path(name, '.actual.png')}\n  difference: {self._path(name, '.difference.png')}"

    def _forget(self, name: str) -> None:
        for ending in (".actual.png", ".difference.png"):
            self._path(name, ending).unlink(missing_ok=True)

    def _fail(self, message: str) -> None:
        __tracebackhide__ = True
        pytest.fail(f"{message}\n  to accept what is now: {self._accept}", pytrace=False)
