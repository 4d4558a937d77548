"""Expectations of what cameras show are held by pictures, and fail loudly where none can be drawn."""

from __future__ import annotations

from pathlib import Path

import pytest

from carom.ecs.errors import CaromError
from carom.systems.simulation import Simulation
from carom.tools import offscreen
from carom.tools.cli import main
from carom.tools.quantities import quantity
from carom.tools.session import Watch, run
from carom.worlds import WorldError, load_text

# A ball of 0.5 m glides from x = -3 m to 3 m, 8 m before the camera; a wall hides the middle third of its way.
WORLD = """carom: 1
gravity: [0, 0, 0]
step: {dt: 0.05}
run: {duration: 3 s}
prefabs:
  stone: {collider: {box: {size: [0.2, 0.2, 0.2]}}, transform: {position: [0, 2.5, 0]}}
entities:
  - name: ball
    collider: {sphere: {radius: 0.5}}
    body: {}
    motion: {linear: [2, 0, 0]}
    transform: {position: [-3, 0, 0]}
  - {name: wall, collider: {box: {size: [2, 3, 0.1]}}, transform: {position: [0, 0, 2]}}
  - {name: gate, collider: {box: {size: [0.2, 3, 3]}, sensor: true}, transform: {position: [2, 0, 0]}}
  - {name: stone, prefab: stone, grid: {count: [2, 1, 1], spacing: 1}}
  - {name: mark}
cameras:
  main: {position: [0, 0, 8], fov: 50 deg}
  back: {position: [0, 0, -8], fov: 50 deg}
render: {width: 160, height: 120}
expect:
  - """
LINE = WORLD.count("\n") + 1  # of the first expectation


def failures(expectation: str) -> list[str]:
    """Run the world with one thing expected and return what failed."""
    return list(map(str, run(load_text(WORLD + expectation)).failures))


@pytest.mark.parametrize(
    "expectation",
    [
        "visible: ball >= 150 px from main",
        "visible: ball == 100 %",
        "visible: stone > 5 px from back",
        "{at: 0 s, visible: ball >= 150 px from main}",
        "{at: 1.5 s, visible: ball == 0 px from main}",
        "{at: 1.5 s, visible: ball > 99 % from back, ball.position.x: {is: 0, within: 1 um}}",
        "{when: {enter: [gate, ball]}, visible: ball > 100 from main}",
        "always: visible(ball, back) > 150 px and visible_share(ball, back) == 1",
        "never: visible(ball, main) > 400 px",
        "{at: 0.5 s, 'left_of(ball, wall, main)': {is: 1, within: 0}, 'left_of(ball, wall, back)': {is: 0, within: 0}}",
        "{at: 1.5 s, 'overlap(ball, wall, main)': {is: 200, within: 10 %}}",
        "always: above(stone[0,0,0], wall) == 1",
    ],
)
def test_it_holds(expectation: str) -> None:
    """At the end, at a time, at an event and throughout; by a camera, or by the one that pictures are taken by."""
    assert failures(expectation) == []


@pytest.mark.parametrize(
    ("expectation", "moment", "expected", "received"),
    [
        ("visible: ball < 50 % from main", "frame 60 at 3 s", "visible_share(ball, main) < 50 %",
         "visible_share(ball, main) = 1 1"),
        ("{at: 1.5 s, visible: ball > 5 px from main}", "frame 30 at 1.5 s", "visible(ball, main) > 5 px",
         "visible(ball, main) = 0 px"),
        ("{at: 9 s, visible: ball > 5 px from main}", "frame 60 at 3 s", "visible(ball, main) > 5 px",
         "the run ended at frame 60, before frame 180"),
        ("{when: {impact: [ball, wall]}, visible: ball > 5}", "frame 60 at 3 s", "visible(ball) > 5",
         "0 of 1 such events by the end of the run"),
        ("{at: 1.5 s, 'visible(ball, main)': {is: 9, within: 3}}", "frame 30 at 1.5 s",
         "visible(ball, main) 9 px within 3", "visible(ball, main) = 0 px, off by 9"),
        ("always: left_of(ball, wall, main) == 1", "frame 30 at 1.5 s", "always left_of(ball, wall, main) == 1",
         "left_of(ball, wall, main) = 0 1"),
    ],
)  # fmt: skip
def test_it_fails(expectation: str, moment: str, expected: str, received: str) -> None:
    """The line says when, what was expected, and what was seen."""
    (line,) = failures(expectation)
    parts = line.split("; ")
    assert parts[0].startswith(f"failed in {moment}: ")
    assert parts[1:3] == [f"expected {expected}", f"received {received}"]


def test_no_picture_is_a_failure_of_each_that_asks_for_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without OpenGL worlds are checked and run, and only what asks for pictures fails, ``never`` included."""
    world = tmp_path / "world.yaml"
    asked = "never: visible(ball, main) > 999 px", "visible: ball > 1 px"
    world.write_text(WORLD + "\n  - ".join([*asked, "always: ball.position.x < 9\n"]))

    def none() -> str:
        raise offscreen.GraphicsError("no OpenGL here")

    monkeypatch.setattr(offscreen, "backend", none)
    assert main(["check", str(world)]) == 0
    assert capsys.readouterr().out == f"ok     {world}: 6 entities, 3 expectations\n"
    assert main(["test", str(world)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"FAILED {world}: 1 of 3 expectations held"
    for k, text in enumerate(asked):
        line, command = lines[1 + 2 * k : 3 + 2 * k]
        assert line.startswith(f"       {world}:{LINE + k}:5: failed in frame 0 at 0 s: {text}; expected ")
        assert "; received no picture: no OpenGL here; worst" in line
        assert command == f"         open it with: carom run {world} --break 'frame 1' --pdb"


def test_asking_where_nobody_draws_tells_who_does() -> None:
    """A loop of one's own needs a witness."""
    loaded = load_text(WORLD + "always: visible(ball, main) > 1 px")
    with pytest.raises(CaromError) as caught:
        loaded.expectations[0].begin(loaded.simulation)
    assert str(caught.value) == (
        "visible(...) is asked of a picture, and nobody draws here; run the world by carom test or carom run, or let a "
        "carom.tools.witness.Witness observe it before its expectations do"
    )


@pytest.mark.parametrize(
    ("expectation", "message"),
    [
        ("visible: ball > 4 px from mian",
         "unknown camera; received 'mian'; accepted: main, back; did you mean 'main'?"),
        ("visible: mark > 4 px", "nothing is drawn of mark; accepted: an entity with a collider or a visual"),
        ("always: left_of(ball, main) > 0",
         "unknown entity; received 'main'; accepted: ball, wall, gate, stone[0,0,0], stone[1,0,0], mark"),
    ],
)  # fmt: skip
def test_names_are_checked_without_a_picture(expectation: str, message: str) -> None:
    """Cameras and entities that are not there, or not to be seen, are faults of the file."""
    with pytest.raises(WorldError) as caught:
        load_text(WORLD + expectation)
    (fault,) = caught.value.faults
    key = expectation.partition(":")[0]
    assert str(fault).partition(" ")[2] == f"expect.0.{key}: {message}"


def test_runs_that_are_not_judged_answer_too() -> None:
    """Plots ask the same questions, here of a ball that passes behind a wall."""
    loaded = load_text(WORLD + "energy: non-increasing")
    seen = quantity("visible(ball, main)", loaded.simulation.world)
    pixels: list[float] = []

    class Plot(Watch):
        def observe(self, simulation: Simulation) -> None:
            pixels.append(seen.read(simulation.world)["visible(ball, main)"])

    run(loaded, [Plot()], frames=60)
    assert len(pixels) == 60
    assert pixels[29] == 0.0
    assert min(pixels[0], pixels[-1]) > 150.0
