"""A run is looked at just when it was asked for, between two steps too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

from carom.ecs.errors import CaromError
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.filming import Filming, Shot, frames
from carom.tools.moments import Moments, every

SPEED = 2.0


def gliding() -> Simulation:
    """Return a red ball that glides along x at 2 m/s, in steps of 0.1 s."""
    simulation = Simulation(dt=0.1, gravity=(0.0, 0.0, 0.0))
    ball = {"collider": {"sphere": {"radius": 0.5}}, "visual": {"color": (1.0, 0.0, 0.0, 1.0)}}
    simulation.add(name="ball", body={}, motion={"linear": (SPEED, 0.0, 0.0)}, **ball)
    return simulation


CAMERA = Camera((0.0, 0.0, 8.0))
SHOT = Shot(CAMERA, 64, 48, 25.0)


def middle(picture: np.ndarray) -> float:
    """Return where the ball is in a picture, px from the left, by the mean of its pixels."""
    red = (picture[..., 0].astype(int) - picture[..., 1]) > 60
    return float((np.nonzero(red)[1] + 0.5).mean())


def seen(simulation: Simulation, times: list[float], steps: int) -> list[tuple[float, float]]:
    """Return each time that came, with the ball's place (m) then."""
    moments, found = Moments(times), []
    for step in range(steps + 1):
        if step:
            simulation.step()
        found += [(time, float(poses.position[0, 0])) for time, poses in moments.due(simulation)]
    return found


def test_every_moment_is_seen_once_where_the_body_is_just_then() -> None:
    """Before, on and between steps, several within one included: x = v t."""
    times = [0.0, 0.1, 0.13, 0.16, 0.2, 0.45, 0.7]
    found = seen(gliding(), times, 6)
    assert [time for time, _ in found] == times[:-1]
    np.testing.assert_allclose([x for _, x in found], SPEED * np.array(times[:-1]), rtol=0.0, atol=1e-12)


def test_moments_are_apart_by_their_interval_up_to_the_end() -> None:
    """The end is one of them where it is met, but for rounding."""
    assert list(every(0.1, 0.2, 0.5)) == pytest.approx([0.2, 0.3, 0.4, 0.5], abs=1e-15)
    assert list(every(0.25, 1.0, 1.6)) == [1.0, 1.25, 1.5]


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([0.1], "moments: 0.1 s cannot be seen any more at 0.2 s"),
        ([0.4, 0.25], "moments: 0.25 s cannot be seen any more at 0.3 s"),
    ],
)
def test_a_moment_that_is_over_is_refused(times: list[float], message: str) -> None:
    """Neither before the start nor behind the step before."""
    simulation = gliding()
    simulation.step(2)
    with pytest.raises(CaromError) as caught:
        seen(simulation, times, 3)
    assert str(caught.value) == message


def test_frames_follow_a_body_between_steps() -> None:
    """By the pinhole, x is f v t / depth px off the middle, in slow motion at ten pictures a step too."""
    times = np.arange(21) * 0.01
    places = [middle(picture) for picture in frames(gliding(), SHOT, times)]
    focal = SHOT.height / 2.0 / np.tan(CAMERA.fov / 2.0)
    np.testing.assert_allclose(places, SHOT.width / 2.0 + focal * SPEED * times / 8.0, atol=0.25)
    assert np.diff(places).min() >= 0.0


def test_a_film_runs_at_the_speed_of_the_simulation_whatever_its_rate(tmp_path: Path) -> None:
    """With 25 pictures a second of steps of 0.1 s, the ball moves on from each to the next."""
    simulation, filming = gliding(), Filming(SHOT, tmp_path / "film.webp")
    with observed(simulation, filming):
        simulation.step(10)
    with Image.open(tmp_path / "film.webp") as image:
        places = [middle(np.asarray(frame.convert("RGB"))) for frame in ImageSequence.Iterator(image)]
    assert len(places) == 26
    focal = SHOT.height / 2.0 / np.tan(CAMERA.fov / 2.0)
    truth = SHOT.width / 2.0 + focal * SPEED * np.arange(26) / 25.0 / 8.0
    np.testing.assert_allclose(places[:20], truth[:20], atol=0.5)
