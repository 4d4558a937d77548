"""Cameras that move with what they show, by where geometry has them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from carom.ecs.errors import CaromError
from carom.tools.cameras import Camera
from carom.tools.filming import frames, shot_of
from carom.tools.moments import Moments
from carom.tools.rigs import Rig
from carom.worlds import LoadedWorld, load_text

WORLD = """carom: 1
gravity: [0, 0, 0]
step: {dt: 0.1, substeps: 1}
entities:
  - {name: ball, body: {mass: 1}, collider: {sphere: {radius: 0.5}}, transform: {position: [1, 2, 3]}, motion: {linear: [2, 0, 0], angular: [0, 3, 0]}}
  - {name: stone, collider: {sphere: {radius: 0.5}}, transform: {position: [0, 5, 0]}}
"""  # noqa: E501


def world(camera: str, up: str = "y") -> LoadedWorld:
    """Return a world in which a ball glides and spins, with one camera."""
    return load_text(f"{WORLD}up: {up}\ncameras: {{main: {camera}}}\n")


def camera_after(camera: str, steps: int = 0, up: str = "y") -> Camera:
    """Return where that camera is after some steps of 0.1 s."""
    loaded = world(camera, up)
    loaded.simulation.step(steps)
    return shot_of(loaded).camera(loaded.simulation.world)


def test_a_fixed_camera_stays_and_may_look_at_a_body() -> None:
    """Its target is the origin of the body, wherever that is."""
    camera = camera_after("{position: [0, 0, 9], target: ball}", 5)
    assert camera.position == (0.0, 0.0, 9.0)
    assert camera.target == pytest.approx((2.0, 2.0, 3.0), abs=1e-12)


def test_a_follower_keeps_its_offset_in_the_axes_of_the_world() -> None:
    """Position = place + offset, whatever the body's spin; it looks at the body."""
    camera = camera_after("{follow: {entity: ball, offset: [0, 1, 4]}}", 5)
    assert camera.position == pytest.approx((2.0, 3.0, 7.0), abs=1e-12)
    assert camera.target == pytest.approx((2.0, 2.0, 3.0), abs=1e-12)
    assert camera_after("{follow: {entity: ball, offset: [0, 1, 4]}, target: stone}", 5).target == (0.0, 5.0, 0.0)


def test_a_follower_in_the_axes_of_the_body_turns_with_it() -> None:
    """After 0.5 s at 3 rad/s about y the offset has turned by 1.5 rad."""
    camera = camera_after("{follow: {entity: ball, offset: [0, 1, 4], frame: body}}", 5)
    turned = np.array((4.0 * math.sin(1.5), 1.0, 4.0 * math.cos(1.5)))
    assert np.array(camera.position) - camera.target == pytest.approx(turned, abs=1e-9)


@pytest.mark.parametrize(("up", "front", "right"), [("y", (0, 0, 1), (1, 0, 0)), ("z", (0, -1, 0), (1, 0, 0))])
def test_an_orbit_is_a_circle_about_up_at_its_rate(up: str, front: tuple[int, ...], right: tuple[int, ...]) -> None:
    """Anticlockwise from above, from in front, at constant distance and height over what it circles."""
    words = "{orbit: {around: ball, distance: 2 m, elevation: 30 deg, azimuth: 10 deg, rate: 40 deg/s}}"
    risen = np.array((0.0, 1.0, 0.0) if up == "y" else (0.0, 0.0, 1.0))
    for steps in (0, 5, 20):
        camera = camera_after(words, steps, up)
        angle = math.radians(10.0 + 40.0 * 0.1 * steps)
        level = math.cos(angle) * np.array(front) + math.sin(angle) * np.array(right)
        away = 2.0 * (math.cos(math.pi / 6.0) * level + 0.5 * risen)
        assert np.array(camera.position) - camera.target == pytest.approx(away, abs=1e-12)
        assert camera.target == pytest.approx((1.0 + 0.2 * steps, 2.0, 3.0), abs=1e-9)
        assert camera.up == tuple(risen)


def test_a_camera_on_a_path_is_where_its_keyframes_say() -> None:
    """At their times and, by the same curve, between two steps; what a keyframe leaves out is as before."""
    frames = "{at: 0, position: [0, 0, 9], target: [0, 0, 0]}, {at: 1, position: [4, 0, 9]}, {at: 2, target: [0, 4, 0]}"
    loaded = world(f"{{keyframes: [{frames}], fov: 30 deg}}")
    now, shot = loaded.simulation.world, shot_of(loaded)
    for time, position, target in (
        (0.0, (0, 0, 9), (0, 0, 0)), (0.5, (2, 0, 9), (0, 0, 0)), (1.0, (4, 0, 9), (0, 0, 0)),
        (1.5, (4, 0, 9), (0, 2, 0)), (2.0, (4, 0, 9), (0, 4, 0)), (9.0, (4, 0, 9), (0, 4, 0)),
    ):  # fmt: skip
        camera = shot.camera(now, time)
        assert (camera.position, camera.fov) == (pytest.approx(position), math.radians(30.0))
        assert camera.target == pytest.approx(target)
    loaded.simulation.step(5)
    assert shot.camera(now) == shot.camera(now, 0.5)


def test_a_camera_on_a_path_may_look_at_a_body_and_go_round_for_ever() -> None:
    """Its keyframes say where it is, its target whom it looks at; a loop of 1 s is at the same places every second."""
    corners = "".join(f"{{at: {n / 4}, position: {place}}}, " for n, place in enumerate(
        ([9, 0, 0], [0, 0, 9], [-9, 0, 0], [0, 0, -9], [9, 0, 0])
    ))  # fmt: skip
    words = f"{{keyframes: {{repeat: loop, frames: [{corners[:-2]}]}}, target: ball}}"
    after = [camera_after(words, steps) for steps in (2, 12, 32)]
    assert [camera.position for camera in after[1:]] == [pytest.approx(after[0].position)] * 2
    assert [camera.target for camera in after] == [pytest.approx((1.0 + 0.2 * n, 2.0, 3.0)) for n in (2, 12, 32)]


def test_a_camera_on_a_path_may_look_from_one_to_another() -> None:
    """At each keyframe it looks at whom that names, where he is then, and between two on a smooth way to the next."""
    start = "{at: 0, position: [0, 0, 9], target: ball}, {at: 1}"
    loaded = world(f"{{keyframes: [{start}, {{at: 2, target: stone}}, {{at: 3, target: [0, 0, 1]}}]}}")
    now, shot = loaded.simulation.world, shot_of(loaded)
    loaded.simulation.step(5)
    ball = np.array((2.0, 2.0, 3.0))
    assert shot.camera(now).target == pytest.approx(ball, abs=1e-12)
    assert shot.camera(now, 1.0).target == pytest.approx(ball, abs=1e-12)
    assert shot.camera(now, 2.0).target == pytest.approx((0.0, 5.0, 0.0), abs=1e-12)
    assert shot.camera(now, 3.0).target == pytest.approx((0.0, 0.0, 1.0), abs=1e-12)
    leaves = 0.5 * (np.array((0.0, 0.0, 1.0)) - ball)  # Catmull and Rom: at 2 s, by where it is 1 s before and after
    middle = 0.5 * (ball + np.array((0.0, 5.0, 0.0))) - leaves / 8.0
    assert shot.camera(now, 1.5).target == pytest.approx(middle, abs=1e-12)


def test_a_camera_on_a_path_may_zoom() -> None:
    """In equal times what is seen grows by equal shares: half way from 10 m to 40 m it is 20 m, without a stop."""
    shown = world("{keyframes: [{at: 0, position: [0, 0, 9], height: 10}, {at: 2, height: 40}, {at: 3}]}")
    shot, now = shot_of(shown), shown.simulation.world
    heights = [shot.camera(now, time).height for time in (0.0, 1.0, 2.0, 2.5)]
    assert heights == pytest.approx([10.0, 20.0, 40.0, 40.0], rel=1e-12)
    shown = world("{keyframes: [{at: 0, position: [0, 0, 9]}, {at: 1, fov: 2 deg}, {at: 2, fov: 1 deg}], fov: 60 deg}")
    shot, now = shot_of(shown), shown.simulation.world
    cameras = [shot.camera(now, time) for time in np.linspace(0.0, 2.0, 41)]
    assert [cameras[n].fov for n in (0, 20, 40)] == pytest.approx([math.radians(n) for n in (60, 2, 1)], rel=1e-12)
    reach = np.log([camera.reach for camera in cameras])
    assert np.abs(np.diff(reach, 2)).max() < 0.06  # without a jump in its rate, 60 to 2 in 1 s
    assert cameras[10].fov == pytest.approx(2.0 * math.atan(math.exp(np.mean(np.log(np.tan(np.radians((30, 1))))) + (
        np.log(np.tan(math.radians(30))) - np.log(np.tan(math.radians(0.5)))) / 16)), rel=1e-12)  # fmt: skip


def test_a_camera_is_of_its_moment() -> None:
    """Between two steps it stands by the time and the poses of then, not by those of the world."""
    loaded = world("{orbit: {around: ball, distance: 2, elevation: 0 deg, rate: 1 rad/s}}")
    simulation, moments = loaded.simulation, Moments([0.25])
    for _ in range(3):
        assert moments.due(simulation) == []
        simulation.step()
    ((time, poses),) = moments.due(simulation)
    camera = shot_of(loaded).camera(simulation.world, time, poses)
    assert camera.target == pytest.approx((1.5, 2.0, 3.0), abs=1e-12)
    assert camera.position == pytest.approx((1.5 + 2.0 * math.sin(0.25), 2.0, 3.0 + 2.0 * math.cos(0.25)), abs=1e-12)


@pytest.mark.parametrize(
    ("words", "top"),
    [
        ("{position: [0, 9, 0]}", (0.0, 0.0, -1.0)),  # from above, what is far is at the top of the picture
        ("{position: [0, -9, 0]}", (0.0, 0.0, 1.0)),
        ("{orbit: {distance: 9, elevation: 90 deg, azimuth: 90 deg}}", (-1.0, 0.0, 0.0)),
        ("{orbit: {distance: 9, elevation: -90 deg, azimuth: 90 deg}}", (1.0, 0.0, 0.0)),
    ],
)
def test_a_view_along_up_is_turned_as_one_a_little_less_steep(words: str, top: tuple[float, ...]) -> None:
    """Where the world's up says nothing, the picture's top is what it tends to."""
    assert camera_after(words).pose()[:3, 1] == pytest.approx(top, abs=1e-12)


def test_what_is_stated_of_the_lens_comes_through() -> None:
    """Angle and height of the file are those of the camera, and up z is the world's."""
    assert camera_after("{position: [0, 0, 9], fov: 30 deg}").fov == math.radians(30.0)
    camera = camera_after("{position: [0, -9, 0], height: 4 m}", up="z")
    assert (camera.height, camera.up) == (4.0, (0.0, 0.0, 1.0))
    assert camera_after("{position: [0, -9, 0], up: [1, 0, 0]}").up == (1.0, 0.0, 0.0)


COMES_AND_GOES = """events:
  - {at: 0.2 s, spawn: {name: late, body: {mass: 1, inertia: [1, 1, 1]}, motion: {linear: [1, 0, 0]}, line: {count: 2, step: [0, 0, 7]}, transform: {position: [9, 0, 0], rotation: {axis: [0, 1, 0], angle: 90 deg}}}}
  - {at: 0.4 s, despawn: [late]}
"""  # noqa: E501


def test_a_camera_awaits_who_comes() -> None:
    """It is where it will be when that comes, and goes with it from then on."""
    loaded = load_text(
        f"{WORLD}{COMES_AND_GOES}cameras: {{main: {{follow: {{entity: 'late[1]', offset: [0, 1, 4], frame: body}}}}}}\n"
    )
    simulation, shot = loaded.simulation, shot_of(loaded)
    for steps, x in ((0, 9.0), (2, 9.0), (1, 9.1), (1, 9.2)):
        simulation.step(steps)
        camera = shot.camera(simulation.world)
        assert camera.target == pytest.approx((x, 0.0, 7.0), abs=1e-12)
        assert camera.position == pytest.approx((x + 4.0, 1.0, 7.0), abs=1e-12)  # +z of the body, turned to +x
    simulation.step()
    with pytest.raises(CaromError) as caught:
        shot.camera(simulation.world)
    assert str(caught.value) == "camera main: no entity is named 'late[1]'"


def test_a_film_goes_on_where_its_camera_was_when_whom_it_follows_is_gone() -> None:
    """The picture stays as nobody moves any more, in view of the place where that was."""
    text = WORLD.replace("motion: {linear: [2, 0, 0], angular: [0, 3, 0]}", "motion: {linear: [0, 0, 0]}")
    loaded = load_text(
        f"{text}{COMES_AND_GOES}cameras: {{main: {{follow: {{entity: 'late[0]', offset: [-14, 4, 0]}}}}}}\n"
    )
    shot = replace(shot_of(loaded), width=64, height=48)
    pictures = list(frames(loaded.simulation, shot, (0.25, 0.4, 0.5, 0.7)))
    assert not np.array_equal(pictures[0], pictures[1])
    assert np.array_equal(pictures[2], pictures[3])


def test_a_film_ends_with_a_fault_where_its_target_reaches_the_camera() -> None:
    """Only who is gone leaves the camera where it was."""
    quarters = WORLD.replace("linear: [2, 0, 0]", "linear: [2.5, 0, 0]")  # a quarter of a metre a step, exactly
    loaded = load_text(f"{quarters}cameras: {{main: {{position: [2, 2, 3], target: ball}}}}\n")
    shot = replace(shot_of(loaded), width=64, height=48)
    with pytest.raises(CaromError) as caught:
        list(frames(loaded.simulation, shot, (0.0, 0.4)))
    assert str(caught.value) == "camera main: it stands where it looks at, (2.0, 2.0, 3.0)"


def test_python_states_cameras_in_the_same_words() -> None:
    """Tuples and arrays as well; the camera is that of a file that says so, and faults are told in whole sentences."""
    loaded = world("{keyframes: [{at: 0, position: [0, 0, 9], target: ball}, {at: 1, target: stone, fov: 20 deg}]}")
    now = loaded.simulation.world
    keyframes = [
        {"at": 0, "position": np.array((0, 0, 9)), "target": "ball"},
        {"at": 1, "target": "stone", "fov": "20 deg"},
    ]
    assert Rig.stated(now, {"keyframes": keyframes}).camera(now, 0.7) == shot_of(loaded).camera(now, 0.7)
    with pytest.raises(CaromError) as caught:
        Rig.stated(now, {"keyframes": [*keyframes, {"at": 2, "target": "boll"}]}, name="zoom")
    assert str(caught.value) == (
        "cameras.zoom.keyframes.2.target: unknown entity; received 'boll'; accepted: ball, stone; did you mean 'ball'?"
    )
    with pytest.raises(CaromError) as caught:
        Rig.stated(now, {"position": (0, 0), "fov": "3 m"})
    assert str(caught.value) == (
        "cameras.main.position: must be a list of 3 numbers; received [0, 0]; accepted: numbers in m\n"
        "cameras.main.fov: must be an angle; received '3 m', which is a length; "
        "accepted: a number in rad, or one with a unit: rad, deg, mrad, turn"
    )


def test_a_camera_whose_body_is_gone_says_so() -> None:
    """A body that was removed leaves no place to look at; the error names camera and body."""
    loaded = world("{follow: {entity: ball, offset: [0, 1, 4]}}")
    now = loaded.simulation.world
    now.despawn(now.find("ball"))
    with pytest.raises(CaromError) as caught:
        shot_of(loaded).camera(now)
    assert str(caught.value) == "camera main: no entity is named 'ball'"


def test_a_camera_that_its_target_reaches_says_so() -> None:
    """A body that moves to where the camera stands leaves no direction; the error names camera and place."""
    loaded = world("{position: [2, 2, 3], target: ball}")
    loaded.simulation["ball"].transform.position = (2.0, 2.0, 3.0)
    with pytest.raises(CaromError) as caught:
        shot_of(loaded).camera(loaded.simulation.world)
    assert str(caught.value) == "camera main: it stands where it looks at, (2.0, 2.0, 3.0)"
