"""What keeps a camera from showing anything is told: it is inside of something, or nothing is there."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from carom.ecs.errors import CaromError
from carom.tools import offscreen, picture_size
from carom.tools.cli import main
from carom.tools.filming import shot_of
from carom.tools.renderer import Renderer
from carom.tools.vantage import vantage_warnings
from carom.worlds import load_text

ROOM = """carom: 1
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: wall, collider: {box: {size: [1, 4, 4]}}, transform: {position: [3, 2, 0]}}
  - {name: veil, collider: {box: {size: [1, 1, 1]}}, transform: {position: [0, 2, 0]}, visual: false}
  - {name: lift, collider: {box: {size: [1, 1, 1]}}, body: {type: kinematic}, motion: {linear: [0, 1, 0]}, transform: {position: [-4, 0.6, 0]}}
step: {dt: 0.1}
"""  # noqa: E501


def warnings(camera: str, steps: int = 0) -> list[str]:
    """Return what is told of one camera in the room after some steps."""
    loaded = load_text(f"{ROOM}cameras: {{main: {camera}}}\n")
    loaded.simulation.step(steps)
    return vantage_warnings(shot_of(loaded), loaded.simulation)


@pytest.mark.parametrize(
    ("camera", "bodies"),
    [
        ("{position: [3.2, 1, 0.5]}", "camera main at [3.2, 1, 0.5] m is inside wall"),
        ("{position: [0, -2, 1]}", "camera main at [0, -2, 1] m is inside floor"),
        ("{position: [3, -0.5, 1], target: lift}", "camera main at [3, -0.5, 1] m is inside floor"),
    ],
)
def test_a_camera_inside_a_body_is_told_with_the_body(camera: str, bodies: str) -> None:
    """The line names camera, place and what is around it."""
    assert warnings(camera) == [f"{bodies}, which it sees through; move it out"]


def test_who_is_inside_is_asked_of_the_moment() -> None:
    """A lift comes to where the camera is, and goes on."""
    camera = "{position: [-4, 2.1, 0], target: wall}"
    assert [len(warnings(camera, steps)) for steps in (0, 15, 30)] == [0, 1, 0]


def test_what_is_not_seen_hides_nothing() -> None:
    """A camera in a body without visual, or outside of all, is fine."""
    assert warnings("{position: [0, 2, 0.2]}") == []
    assert warnings("{position: [0, 1, 6]}") == []


def test_where_nothing_is_there_the_picture_is_made_and_told_of(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A world without bodies and cameras."""
    path = tmp_path / "empty.yaml"
    path.write_text("carom: 1\n")
    assert main(["render", str(path), "--out", str(tmp_path / "a.png"), "--size", "64x48"]) == 0
    assert capsys.readouterr().err == (
        "warning: nothing is there to be seen, and no camera is stated: pictures show the sky; "
        "give entities a collider or a visual\n"
    )
    assert (tmp_path / "a.png").exists()


@pytest.mark.parametrize(
    ("size", "message"),
    [
        ((0, 10), "renderer: width and height must be at least 1 px, received 0 x 10"),
        ((10, 99_999), "renderer: width and height must be at most {largest} px for this driver, received 10 x 99999"),
        (
            (2_000, 1_000),
            (
                "renderer: a picture of 2000 x 1000 px needs 0.08 GB of memory, and 0.05 GB are free; "
                "ask for a smaller one"
            ),
        ),
    ],
)
def test_a_picture_too_small_or_too_large_is_refused(
    size: tuple[int, int], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the driver and by memory, before anything is drawn."""
    with Renderer(8, 8):
        largest = offscreen.largest()
    monkeypatch.setattr(picture_size, "free_memory", lambda: 5e7)
    with pytest.raises(CaromError) as caught:
        Renderer(*size)
    assert str(caught.value) == message.format(largest=largest)


def test_a_picture_that_the_driver_has_no_room_for_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each edge is within its limit, and the whole is 16 GB in four samples: too much for software."""
    with Renderer(8, 8) as renderer:
        if "llvmpipe" not in renderer.driver:
            pytest.skip(f"room for it is asked of llvmpipe; here draws {renderer.driver}")
    monkeypatch.setattr(picture_size, "free_memory", lambda: math.inf)
    with pytest.raises(CaromError) as caught:
        Renderer(16_384, 16_384)
    assert str(caught.value) == ("renderer: the driver has no room for 16384 x 16384 px; ask for a smaller picture")


def test_without_a_camera_a_picture_has_in_view_what_has_gone_far() -> None:
    """Asked anew it goes with a lift; in a film it stays where it was at the start."""
    simulation = (loaded := load_text(ROOM)).simulation
    shot = shot_of(loaded)
    film, start = shot.steady(simulation.world), shot.camera(simulation.world)
    simulation.step(100)
    far = shot.camera(simulation.world)
    around, of_lift = math.sqrt(8.25), math.sqrt(0.75)  # radii of wall and lift
    middle = (around - of_lift - 1.0) / 2.0
    assert start.target == pytest.approx((middle, 2.0, 0.0), abs=1e-12)
    assert far.target == pytest.approx((middle, (12.6 + of_lift - around) / 2.0, 0.0), abs=1e-12), "10 m up in 10 s"
    assert film.camera(simulation.world) == start
