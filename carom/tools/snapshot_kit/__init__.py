"""Snapshot kit: a pytest plugin that holds worlds to goldens of their state and their picture.

    def test_break(carom_snapshot):
        world = load_world("billiards")
        world.simulation.step(240)
        carom_snapshot.check(world, "one_second")

It is loaded in every pytest run of the environment, so it imports nothing of weight before it is used.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from carom.tools.snapshot_kit.fixture import CaromSnapshot
from carom.tools.snapshot_kit.kit import KIT, Kit
from carom.tools.snapshot_kit.world_file import WorldFile

__all__ = ["CaromSnapshot"]


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add ``--carom-update``, ``--carom-report`` and the ini option ``carom_worlds``."""
    group = parser.getgroup("carom")
    group.addoption(
        "--carom-update", action="store_true", help="tell what is not as its golden says, then make it the golden"
    )
    group.addoption(
        "--carom-report", type=Path, metavar="DIR", help="where failures leave their report; carom-report by default"
    )
    parser.addini("carom_worlds", "world files to run as tests: patterns such as worlds/*.yaml", type="args")


def pytest_configure(config: pytest.Config) -> None:
    """Begin, without the cases of an earlier run."""
    kit = config.stash[KIT] = Kit(config)
    config.pluginmanager.register(kit.ledger, "carom-ledger")
    if not hasattr(config, "workerinput"):  # which xdist gives its workers
        kit.begin()


def pytest_unconfigure(config: pytest.Config) -> None:
    """Free what was used to draw."""
    config.stash[KIT].close()


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> WorldFile | None:
    """Collect world files that match ``carom_worlds``."""
    root, patterns = parent.config.rootpath, parent.config.getini("carom_worlds")
    if not file_path.is_relative_to(root) or not any(file_path.relative_to(root).match(one) for one in patterns):
        return None
    made: WorldFile = WorldFile.from_parent(parent, path=file_path)
    return made


@pytest.fixture
def carom_snapshot(request: pytest.FixtureRequest) -> Iterator[CaromSnapshot]:
    """Compare worlds with goldens in ``__carom__/<test file>/`` beside the test file."""
    from carom.tools.snapshot_kit.last_frames import LastFrames

    with LastFrames().kept() as frames:
        yield CaromSnapshot(request.node, request.config.stash[KIT], frames)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Write the report; with ``--carom-update`` tell what changes and change it."""
    if not hasattr(session.config, "workerinput") and not session.config.stash[KIT].finish():
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Say where the report is, and which goldens nobody used."""
    for line in config.stash[KIT].summary():
        terminalreporter.write_line(line)
