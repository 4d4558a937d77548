"""Fixture: what a test asks to compare a world with its golden."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from carom.tools.snapshot_kit.ledger import ENDINGS, folder_of

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation
    from carom.tools.cameras import Camera
    from carom.tools.snapshot_kit.golden import Actual, Golden, Verdict
    from carom.tools.snapshot_kit.kit import Kit
    from carom.tools.snapshot_kit.last_frames import LastFrames
    from carom.worlds.builder import LoadedWorld

TOLERANCE = 1e-6  # m, m/s, rad/s: where CPU, numpy or numba are not those that wrote the golden
SIZE = (320, 240)  # px


class CaromSnapshot:
    """The goldens of one test."""

    def __init__(self, test: pytest.Item, kit: Kit, frames: LastFrames) -> None:
        self._test, self._kit, self._frames = test, kit, frames

    def check(
        self,
        world: Simulation | LoadedWorld,
        name: str,
        *,
        camera: Camera | None = None,
        tolerance: float = TOLERANCE,
        size: tuple[int, int] = SIZE,
    ) -> None:
        """Fail when the state, or the picture by ``camera``, is not that of golden ``name``.

        A world from a file is photographed by its own camera unless one is stated, a simulation not at all.
        ``tolerance`` (m, m/s, rad/s) holds on other machines than the one that wrote the golden; with 0 every bit of
        the state counts there too. ``size`` is in px.
        """
        __tracebackhide__ = True
        from carom.tools.filming import shot_of
        from carom.tools.snapshot_kit.golden import Golden
        from carom.worlds.builder import LoadedWorld

        if isinstance(world, LoadedWorld):
            simulation = world.simulation
            camera = camera or shot_of(world).camera(simulation.world)
        else:
            simulation = world
        if not name or name != Path(name).name or name.startswith("."):
            pytest.fail(f"a golden is named by letters and digits, received {name!r}", pytrace=False)
        golden = Golden(folder_of(self._test.path) / name)
        self._kit.ledger.use(*map(golden.file, ENDINGS[: 1 if camera is None else 2]))
        actual = self._actual(simulation, camera, size)
        verdict = golden.verdict(actual, tolerance)
        if verdict is not None:
            self._report(simulation, camera, golden, actual, verdict)

    def _actual(self, simulation: Simulation, camera: Camera | None, size: tuple[int, int]) -> Actual:
        __tracebackhide__ = True
        from carom.tools.offscreen import GraphicsError
        from carom.tools.particles import particle_marks
        from carom.tools.scene import Scene
        from carom.tools.snapshot_kit.golden import Actual
        from carom.tools.snapshot_kit.state import state_golden
        from carom.tools.view import View

        if camera is None:
            return Actual(state_golden(simulation.world))
        try:
            renderer = self._kit.renderer(size)
        except GraphicsError as fault:
            pytest.fail(f"the picture cannot be drawn: {fault}", pytrace=False)
        marks = particle_marks(simulation.world, View(camera, *size))
        picture = renderer.picture(Scene(simulation.world).batches(), camera, marks)
        return Actual(state_golden(simulation.world, renderer.driver), picture)

    def _report(
        self, simulation: Simulation, camera: Camera | None, golden: Golden, actual: Actual, verdict: Verdict
    ) -> None:
        """Leave a case in the report; fail unless goldens are updated at the end."""
        __tracebackhide__ = True
        from carom.tools.opening import viewing
        from carom.tools.recording import Recording
        from carom.tools.snapshot_kit.case import RECORDING, leave

        case, folder = leave(self._kit.report, self._kit.root, self._test.nodeid, golden, actual, verdict)
        if self._kit.update:
            return
        recorded = folder / RECORDING
        self._frames.record(simulation, recorded, case.test, camera)
        view = viewing(Recording(recorded), self._kit.shown(recorded), case.frame, [case.entity])
        lines = (
            str(case),
            f"  frame {case.frame}, golden {self._kit.shown(golden.path)}, left in {self._kit.shown(folder)}",
            f"  open it with: {view}",
            f"  again: {case.again}",
            f"  to accept what is now: {case.accept}",
        )
        pytest.fail("\n".join(lines), pytrace=False)
