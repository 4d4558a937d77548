"""The summary of a run tells what was cut short."""

from __future__ import annotations

import signal

import pytest

from carom.tools.interrupt import deferred_interrupt
from carom.tools.session import Summary


def test_what_was_cut_is_told() -> None:
    """Each kind in a line of its own, and only where it happened."""
    plain = Summary("pool").text().splitlines()
    summary = Summary("pool", points_refused=1, impacts_cut=2, looks_cut=3)
    passed = "3 times somebody fast was no longer looked after and may have passed through a wall; a smaller dt helps"
    assert [line for line in summary.text().splitlines() if line not in plain] == [
        "  warning       1 contact points were impossible and left out; --check names their pair",
        "  warning       2 impacts beyond the limit of a step were put off to the next",
        f"  warning       {passed}",
    ]


def test_ctrl_c_after_the_last_step_is_not_forgotten() -> None:
    """Nobody asks after it any more, so the end of the run raises it."""
    with pytest.raises(KeyboardInterrupt), deferred_interrupt():
        signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
