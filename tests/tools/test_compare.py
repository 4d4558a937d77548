"""Futures of one world side by side: each is the run it says it is, seen from the first and in one recording."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from carom.ecs import Transform
from carom.tools.cli import main
from carom.tools.comparing import load_futures, read_comparison
from carom.tools.filming import shot_of
from carom.tools.futures import Futures
from carom.tools.painter import Painter
from carom.tools.reading import read
from carom.tools.recording import Recording
from carom.tools.session import run
from carom.worlds import load_world

WORLD = """carom: 1
gravity: [0, -10, 0]
step: {dt: 1/60, substeps: 1}
run: {frames: 30}
entities:
  - {name: floor, collider: {plane: {normal: [0, 1, 0]}}}
  - {name: ball, collider: {sphere: {radius: 0.1}}, body: {}, transform: {position: [0, 5, 0]}, motion: {linear: [1, 0, 0]}}
  - {name: other, collider: {sphere: {radius: 0.1}}, body: {}, transform: {position: [0, 5, 3]}}
expect:
  - never: ball.position.y < 4 m
"""


def compared(world: Path, text: str, observers: list | None = None) -> Futures:  # type: ignore[type-arg]
    """Return the futures of a comparison, run to their end."""
    worlds = load_futures(str(world), text)
    futures = Futures([(name, one.simulation) for name, one in worlds])
    run(worlds[0][1], [futures, *(observers or [])], judged=False)
    return futures


def test_every_future_is_the_run_it_says(world: Path) -> None:
    """To the last bit, whatever runs beside it; and the differences are those of the rules: g t dt / 2 of Euler's."""
    futures = compared(world, "integrator=euler,semi_implicit,verlet")
    for future, integrator in zip(futures.futures, ("euler", "semi_implicit", "verlet"), strict=True):
        alone = load_world(world, integrator=integrator).simulation
        alone.step(30)
        assert (future.simulation["ball"].transform.position == alone["ball"].transform.position).all()
        assert len(future.path()) == 31
        assert (future.path()[-1, 0] == alone["ball"].transform.position).all()
    euler, symplectic, verlet = futures.outcomes()
    assert (euler.difference, euler.whose, euler.error) == (0.0, "", None)
    assert symplectic.difference == pytest.approx(10.0 * 0.5 / 60.0, rel=1e-12)
    assert verlet.difference == pytest.approx(10.0 * 0.5 / 120.0, rel=1e-12)
    assert euler.energy_after - verlet.energy_after > 0.1


def test_futures_of_other_steps_are_seen_at_the_same_times(world: Path) -> None:
    """Where one stands within its own step when the first ends one, it is interpolated; by verlet all fall alike."""
    futures = compared(world, "dt=1/60,1/240,1/77")
    first, finer, other = futures.futures
    assert finer.simulation.frame == 120
    assert other.simulation.frame == 39  # 0.5 s are 38.5 of its steps
    assert finer.path() == pytest.approx(first.path(), abs=1e-12)
    assert other.path() == pytest.approx(first.path(), abs=10.0 / 77**2 / 8.0 * 1.001)  # a chord of its parabola
    assert np.abs(other.path() - first.path()).max() > 1e-5


def test_ghosts_of_other_futures_are_drawn_in_their_colours(world: Path) -> None:
    """Not of the first, nor of what stands; their places are those of the other runs."""
    futures = compared(world, "integrator=euler,verlet")
    simulation = futures.futures[0].simulation
    painter = Painter(simulation, shot_of(load_world(world)).look)
    (batch,) = painter.ghosts(simulation.world[Transform], simulation.time, 1e-3)
    names = [simulation.world.name(simulation.world.entity(row)) for row in batch.ids.tolist()]
    assert names == ["ball", "other"]
    there = futures.futures[1].simulation
    assert batch.poses[:, :3, 3] == pytest.approx(np.array([there[name].transform.position for name in names]), abs=0.0)
    assert (batch.colors[:, :3] == futures.futures[1].color).all()


def test_a_recording_has_all_futures_below_their_names(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Copies, paths and differences of each, and the world file's words in the first's settings; exit 0 though it differs."""
    path, picture = tmp_path / "run.rrd", tmp_path / "run.png"
    command = [
        "run",
        str(world),
        "--compare",
        "integrator=verlet,euler",
        "--record",
        str(path),
        "--picture",
        str(picture),
    ]
    assert main([*command, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [future["name"] for future in told["futures"]] == ["integrator=verlet", "integrator=euler"]
    assert told["futures"][1]["difference"] == pytest.approx(10.0 * 0.5 / 120.0, rel=1e-12)
    assert told["judged"] is False and picture.exists()
    recording, series = Recording(path), read(path).series
    away = recording.plot("plots/difference/integrator\\=euler")
    assert away == pytest.approx({frame: 10.0 * frame / 60.0 / 120.0 for frame in range(31)}, rel=1e-9, abs=1e-14)
    alone = load_world(world, integrator="euler").simulation
    alone.step(30)
    (group,) = {name for name, part in series if "ghosts" in name and part == "ghost_of"}
    places = series[group, "InstancePoses3D:translations"].at(30)[1]
    assert places[0] == pytest.approx(alone["ball"].transform.position, abs=1e-6)
    for name in ("integrator=verlet", "integrator=euler"):
        assert any(path.endswith("/paths/" + name.replace("=", "\\=")) for path, _ in series), sorted(
            {p for p, _ in series}
        )


def test_a_table_tells_what_became_of_each(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Energies, what they gained, and who is farthest from the first."""
    assert main(["run", str(world), "--compare", "integrator=euler,verlet"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[5] == "  expectations  not asked of this run"
    assert lines[6:] == [
        "future             energy     since the start  farthest from integrator=euler",
        "integrator=euler   424.464 J  +3.49 J          -",
        "integrator=verlet  420.973 J  +0 J             0.04167 m, ball",
    ]


def test_a_future_that_explodes_is_told_and_left_behind(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The others go on; from then on it has no ghost, and the table says what became of it."""
    futures = compared(world, "gravity=[0, -10, 0], [0, -1e308, 0]")
    first, lost = futures.futures
    assert first.simulation.frame == 30
    assert lost.ended is not None and lost.simulation.frame < 30
    assert np.isfinite(lost.path()[0]).all() and np.isnan(lost.path()[-1]).all()
    assert futures.outcomes()[1].whose == ""
    row = futures.text().splitlines()[2]
    assert row.startswith("gravity=[0, -1e+308, 0]  frame ")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("verlet", "--compare: is no comparison; received 'verlet'; accepted: a setting and two or more values, such as integrator=euler,semi_implicit,verlet or dt=1/60,1/240"),
        ("dt=1/60", "--compare: compares fewer than two different values; received 'dt=1/60'; accepted: a setting and two or more values, such as integrator=euler,semi_implicit,verlet or dt=1/60,1/240"),
        ("integratr=euler,verlet", "--compare: unknown setting; received 'integratr'; accepted: collision, dimensions, dt, gravity, hit_speed, integrator, response, seed, sleeping, substeps, threads; did you mean 'integrator'?"),
        ("integrator=eulr,verlet,5", "--compare: integrator=5: unknown word; received 5; accepted: euler, semi_implicit, verlet\n--compare: integrator=eulr: unknown word; received 'eulr'; accepted: euler, semi_implicit, verlet"),
        ("dt=0,1 kg", "--compare: dt=0: must be above 0 s; received 0\n--compare: dt=1 kg: must be a time; received '1 kg', which is a mass; accepted: a number in s, or one with a unit: s, ms, us, min, h, d"),
    ],
)  # fmt: skip
def test_wrong_words_are_told_as_ever(text: str, message: str, world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """All at once, with what is accepted; nothing is run, and the exit status is that of wrong usage."""
    assert main(["run", str(world), "--compare", text]) == 2
    assert capsys.readouterr().err == message + "\n"


def test_a_setting_is_stated_once(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is compared cannot be set aside as well; vectors are compared in brackets."""
    assert main(["run", str(world), "--compare", "dt=1/60,1/240", "--dt", "1/60"]) == 2
    assert capsys.readouterr().err == "--compare: compares dt, which --dt states; leave one of them\n"
    name, values = read_comparison("gravity=[0, -9.81, 0], [0, 0, 0]")
    assert (name, [value for _, value in values]) == ("gravity", [(0.0, -9.81, 0.0), (0.0, 0.0, 0.0)])
