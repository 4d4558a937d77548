"""What a file cannot hold, or does not hold any more, is told."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from carom.ecs import CaromError, Component, system
from carom.ecs.column import Floats, column
from carom.systems.simulation import Simulation
from carom.worlds import load_text, load_world, world_text, write_world

LEFT_OUT = (
    "is of other words than those above, so it is left out and the world begins with these; "
    "state is for files as carom wrote them: remove it, or undo what was changed"
)


def test_what_words_were_changed_after_writing_is_not_undone(tmp_path: Path) -> None:
    """The state is of other words then: it is left out, with a warning, and the change is seen."""
    simulation = load_world("falling_ball").simulation
    simulation.step(10)
    write_world(simulation, tmp_path / "w.yaml")
    text = (tmp_path / "w.yaml").read_text(encoding="utf-8")
    line = next(number for number, line in enumerate(text.split("\n"), 1) if line == "state:")
    changed = load_text(
        re.sub(r"(name: ball.*?transform: {position: \[[^,]+), [^,]+,", r"\1, 7,", text, count=1, flags=re.DOTALL),
        "w.yaml",
    )
    assert changed.simulation["ball"].transform.position[1] == 7.0
    assert changed.simulation.frame == 0
    assert changed.warnings == [f"w.yaml:{line}:1: state: {LEFT_OUT}"]
    heavier = load_text(text.replace("gravity: [0, -9, 0]", "gravity: [0, -5, 0]"), "w.yaml")
    assert (heavier.warnings, heavier.simulation.frame) == ([], 10)  # gravity is no part of the state


@pytest.mark.parametrize(
    ("before", "after", "told"),
    [
        ("snapshot: |\n    e", "snapshot: |\n    f", "it is damaged: Error -3 while decompressing data: "),
        (
            "snapshot: |\n    e",
            "snapshot: |\n    !",
            "it is damaged: Only base64 data is allowed; write the world anew",
        ),
    ],
)
def test_a_damaged_state_is_told(before: str, after: str, told: str) -> None:
    """At its place, whatever is wrong with it."""
    simulation = load_world("falling_ball").simulation
    simulation.step(3)
    text = world_text(simulation)
    assert before in text
    with pytest.raises(CaromError) as caught:
        load_text(text.replace(before, after), "w.yaml")
    assert "w.yaml" in str(caught.value)
    assert f": state.snapshot: {told}" in str(caught.value)


class Battery(Component):
    """A component of a script."""

    amount: Floats = column(unit="A s", doc="charge")


@system(reads=(), writes=())
def watch_birds(world: object, dt: float) -> None:
    """Do nothing."""


def test_what_no_file_can_hold_is_told_at_once() -> None:
    """Each with its name, and with what would help."""
    simulation = Simulation()
    simulation.world.spawn(Battery(amount=1.0))
    simulation.force_function(lambda world, rows: np.zeros((len(rows), 3)), "hover")
    simulation.schedule = simulation.schedule.insert(watch_birds, after="apply_gravity")
    mend = "a package of your own, as the README tells, would be there for whoever loads the file"
    with pytest.raises(CaromError) as caught:
        world_text(simulation)
    assert str(caught.value).split("\n") == [
        "the world cannot be written to a file:",
        f"  system 'hover' was put into the step by Python; {mend}",
        f"  system 'watch_birds' was put into the step by Python; {mend}",
        f"  component Battery is declared in {__name__}, which no file loads; {mend}",
    ]
