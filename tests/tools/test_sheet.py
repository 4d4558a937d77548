"""Contact sheets show each moment once, with its time, on a sheet of about 4:3."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.filming import Shot, frames
from carom.tools.sheet import CAPTION, GAP, INK, PAPER, Sheet, captions, columns_for, contact_sheet, spread


def test_pictures_lie_in_rows_with_a_text_under_each() -> None:
    """Every pixel of a picture is on the sheet; under it is ink in its middle; an empty cell is paper."""
    pictures = [np.full((60, 80, 3), 20 * number, np.uint8) for number in range(1, 6)]
    sheet = contact_sheet(pictures, [f"{number} s" for number in range(5)])
    columns = columns_for(5, 80 + GAP, 60 + CAPTION + GAP)
    assert columns == 3
    assert sheet.shape == (2 * (60 + CAPTION + GAP) + GAP, 3 * (80 + GAP) + GAP, 3)
    for number in range(6):
        left, top = GAP + number % 3 * (80 + GAP), GAP + number // 3 * (60 + CAPTION + GAP)
        cell, under = sheet[top : top + 60, left : left + 80], sheet[top + 60 : top + 60 + CAPTION, left : left + 80]
        assert (cell == (20 * (number + 1) if number < 5 else PAPER)).all()
        dark = np.nonzero((under < 128).all(axis=2))
        assert len(dark[0]) > 5 if number < 5 else not len(dark[0])
        if number < 5:
            assert abs(dark[1].mean() - 39.5) < 6
            assert abs(under.min() - min(INK)) < 30


def test_sheets_are_of_about_four_to_three_and_mostly_full() -> None:
    """With cells of nearly that shape, sheets are as square as counts allow, and no row is empty."""
    assert [columns_for(count, 328, 274) for count in (1, 4, 6, 9, 12, 16, 20, 25)] == [1, 2, 3, 3, 4, 4, 5, 5]
    assert [columns_for(count, 200, 400) for count in (2, 24)] == [2, 8]
    for count in range(1, 60):
        columns = columns_for(count, 328, 274)
        rows = -(-count // columns)
        assert columns * rows - count < columns
        assert abs(np.log(columns * 328 / (rows * 274) * 3 / 4)) < np.log(2.0)


def test_times_are_told_apart() -> None:
    """Hundredths where they are exact, else thousandths, and more where times are nearer."""
    assert captions([0.0, 0.75, 1.5]) == ["0.00 s", "0.75 s", "1.50 s"]
    assert captions([0.0, 0.125]) == ["0.000 s", "0.125 s"]
    assert captions([1.0, 1.0002]) == ["1.00000 s", "1.00020 s"]
    assert captions([3.0]) == ["3.00 s"]
    assert spread(1.0, 3.0, 5) == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert spread(1.0, 3.0, 1) == [1.0]


def test_a_sheet_holds_what_a_film_shows_at_those_times(tmp_path: Path) -> None:
    """A falling ball; a run cut short leaves a sheet of the pictures up to there."""
    shot = Shot(Camera((0.0, 0.0, 5.0)), 64, 48)
    times = spread(0.0, 0.5, 6)

    def falling() -> Simulation:
        simulation = Simulation(dt=0.02)
        simulation.add(name="ball", collider={"sphere": {"radius": 0.5}}, body={})
        return simulation

    truth = list(frames(falling(), shot, times))
    for steps, shown in ((25, 6), (17, 4)):
        simulation, sheet = falling(), Sheet(shot, tmp_path / f"{steps}.png", times)
        with observed(simulation, sheet):
            simulation.step(steps)
        with Image.open(tmp_path / f"{steps}.png") as image:
            assert np.array_equal(np.asarray(image), contact_sheet(truth[:shown], captions(times)[:shown]))
