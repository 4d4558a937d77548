"""Files that nobody meant end in a world or in whole sentences; .ci/run hands in many more than these."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from mutants import mutant
from trial import FindingError, hold_messages, trial

CASES = range(150)


def test_mutants_end_in_a_world_or_in_whole_sentences(tmp_path: Path) -> None:
    """A sample of the cases of fuzz.py: some load, most are refused, none does anything else."""
    ends = Counter(trial(case, tmp_path) for case in CASES)
    assert ends["refused"] > len(CASES) // 2
    assert ends["stepped"] > len(CASES) // 20
    assert set(ends) <= {"refused", "loaded", "stopped", "stepped"}


def test_a_case_is_the_same_every_time() -> None:
    """The number of a case says all of its files."""
    assert mutant(1234) == mutant(1234)
    assert mutant(1234) != mutant(1235)


@pytest.mark.parametrize(
    "line",
    [
        "KeyError: 'x'",
        "world.yaml:1:1: ",
        "world.yaml:1:1: received <class 'int'>",
        "world.yaml:1:1: received \x1b[31m",
        "world.yaml:4:1: is beyond the end",
        "world.yaml:1:12: is beyond the line",
    ],
)
def test_what_is_no_message_is_found(line: str, tmp_path: Path) -> None:
    """What a user should not see is told as a finding."""
    (tmp_path / "world.yaml").write_text("carom: 1\n", encoding="utf-8")
    hold_messages("world.yaml:2:1: is told where it stands", tmp_path)
    with pytest.raises(FindingError):
        hold_messages(line, tmp_path)
