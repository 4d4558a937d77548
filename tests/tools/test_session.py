"""The summary of a run tells what was cut short."""

from __future__ import annotations

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
