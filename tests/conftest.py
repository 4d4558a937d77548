"""Every test runs in checked mode: systems that touch what they do not declare fail."""

from __future__ import annotations

import os
import signal

import pytest
from hypothesis import settings

collect_ignore = ["example_game"]  # a project of its own: .ci/run installs it and runs its tests

CHECK = "CAROM_CHECK"
# Long runs of systems that other tests check; guarding every call would double their time.
UNCHECKED = ("test_mirror_room", "test_rolling")

# The same examples in every run, as long as they take: what passed passes everywhere.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")

# Who starts tests in the background may ignore Ctrl-C for them, which those that they start would do too.
signal.signal(signal.SIGINT, signal.default_int_handler)

# Simulations read it when they are made, in this process and in those that tests start.
os.environ.setdefault(CHECK, "1")


@pytest.fixture(autouse=True)
def checked_mode(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Guard what systems touch, but for the heavy laws."""
    if request.path.stem in UNCHECKED:
        monkeypatch.delenv(CHECK)
