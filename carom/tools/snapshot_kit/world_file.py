"""World files as tests: a world runs to its end, holds what it expects, and is compared with its golden."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from carom.tools.snapshot_kit.fixture import CaromSnapshot
from carom.tools.snapshot_kit.kit import KIT

END = "end"  # the name of the golden


class WorldFile(pytest.File):
    """A world file that matches ``carom_worlds``: one test, which the command line calls ``FILE::world``."""

    def collect(self) -> Iterator[WorldItem]:
        """Yield the test."""
        yield WorldItem.from_parent(self, name="world")


class WorldItem(pytest.Item):
    """A run of a world file to its end."""

    def runtest(self) -> None:
        """Fail where the file is wrong, an expectation does not hold, or the end is not that of the golden."""
        from carom.ecs.errors import CaromError
        from carom.tools.filming import shot_of
        from carom.tools.opening import Opening
        from carom.tools.session import run
        from carom.tools.snapshot_kit.last_frames import LastFrames
        from carom.worlds.builder import load_world

        with LastFrames().kept() as frames:
            try:
                loaded = load_world(self.path)
                failures = run(loaded).failures
            except CaromError as fault:
                pytest.fail(str(fault), pytrace=False)
            if failures:
                opening = Opening(loaded, self.config.stash[KIT].shown(self.path))
                pytest.fail("\n".join(line for failed in failures for line in opening.lines(failed)), pytrace=False)
            shot = shot_of(loaded)
            snapshot = CaromSnapshot(self, self.config.stash[KIT], frames)
            snapshot.check(loaded, END, size=(shot.width, shot.height))

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Return the heading of a failure."""
        return self.path, None, self.path.name
