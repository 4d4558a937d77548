"""Unlike: a report of one check whose picture is not the golden's."""

from __future__ import annotations

from pathlib import Path

from carom.ecs import World
from carom.tools.snapshot_kit.case import leave
from carom.tools.snapshot_kit.golden import Actual, Golden
from carom.tools.snapshot_kit.picture import Picture, write_picture
from carom.tools.snapshot_kit.state import state_golden

PLACE = "tests/__carom__/test_game/start"


def leave_unlike(root: Path, report: str, test: str, expected: Picture, actual: Picture) -> Path:
    """Write a golden into a project, and a report of a check that saw another picture; return that."""
    golden, state = Golden(root / PLACE), state_golden(World())
    golden.path.parent.mkdir(parents=True)
    golden.file(".json").write_text(state.text())
    write_picture(golden.file(".png"), expected)
    made = Actual(state, actual)
    verdict = golden.verdict(made, 0.0)
    assert verdict is not None
    leave(root / report, root, test, golden, made, verdict)
    return root / report
