"""The words of a camera: what they mean, and every fault told where it stands."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import math

import pytest

from carom.worlds import WorldError, load_text

HEADER = "carom: 1\nentities: [{name: ball, body: {mass: 1}}, {name: box, body: {mass: 1}}]\n"


def test_words_of_a_camera_are_read_in_si() -> None:
    """Lengths, angles and rates in any unit; what is left out has its default."""
    cameras = load_text(
        HEADER
        + """cameras:
  chase: {follow: {entity: ball, offset: [0 m, 200 cm, 4], frame: body}, fov: 60 deg}
  around: {orbit: {around: box, distance: 3 m, rate: 90 deg/s}, target: ball}
  plan: {position: [0, 10, 0], height: 400 cm, up: [0, 0, -1]}
"""
    ).cameras
    chase, around, plan = cameras["chase"], cameras["around"], cameras["plan"]
    assert chase.follow is not None and around.orbit is not None
    assert (chase.follow.offset, chase.follow.frame, chase.fov) == ((0.0, 2.0, 4.0), "body", math.radians(60.0))
    assert (around.orbit.around, around.orbit.distance, around.orbit.rate) == ("box", 3.0, math.radians(90.0))
    assert (around.orbit.elevation, around.orbit.azimuth, around.target) == (math.radians(20.0), 0.0, "ball")
    assert (plan.height, plan.up, plan.fov, plan.target) == (4.0, (0.0, 0.0, -1.0), math.radians(50.0), None)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("{}", "w.yaml:3:11: cameras.a: must state one place; received none; accepted: position, follow, orbit or keyframes"),
        (
            "{position: [1, 0, 0], orbit: {distance: 1}}",
            "w.yaml:3:11: cameras.a: must state one place; received position and orbit; accepted: position, follow, orbit or keyframes",
        ),
        (
            "{position: [1, 0, 0], fov: 40 deg, height: 2}",
            "w.yaml:3:11: cameras.a: must state one lens; received fov and height; accepted: fov, or height for parallel light",
        ),
        (
            "{position: [1, 0, 0], height: 0}",
            "w.yaml:3:36: cameras.a.height: must be above 0 m; received 0",
        ),
        (
            "{follow: {entity: bal, offset: [0, 1, 4]}}",
            "w.yaml:3:24: cameras.a.follow.entity: unknown entity; received 'bal'; accepted: ball, box; did you mean 'ball'?",
        ),
        (
            "{position: [1, 0, 0], target: bocx}",
            "w.yaml:3:36: cameras.a.target: unknown entity; received 'bocx'; accepted: ball, box; did you mean 'box'?",
        ),
        (
            "{orbit: {around: blal, distance: 1}}",
            "w.yaml:3:23: cameras.a.orbit.around: unknown entity; received 'blal'; accepted: ball, box; did you mean 'ball'?",
        ),
        (
            "{orbit: {around: ball, elevation: 100 deg, distance: 1}}",
            "w.yaml:3:37: cameras.a.orbit.elevation: must be at most 1.5708 rad; received '100 deg'",
        ),
        (
            "{orbit: {around: ball}}",
            "w.yaml:3:15: cameras.a.orbit.distance: is missing; accepted: from that place to the camera (m)",
        ),
        (
            "{follow: {entity: ball, offset: [0, 1]}}",
            "w.yaml:3:38: cameras.a.follow.offset: must be a list of 3 numbers; received [0, 1]; accepted: numbers in m",
        ),
        (
            "{follow: {entity: ball, offset: [0, 1, 4], frame: ball}}",
            "w.yaml:3:57: cameras.a.follow.frame: unknown word; received 'ball'; accepted: world, body",
        ),
        (
            "{follow: {entity: ball, offset: [0, 1, 4], axes: body}}",
            "w.yaml:3:57: cameras.a.follow.axes: unknown key; received 'axes'; accepted: entity, offset, frame",
        ),
        (
            "{position: [1, 2, 3], target: [1, 2, 3]}",
            "w.yaml:3:11: cameras.a: looks at where it stands; accepted: a target elsewhere",
        ),
        (
            "{position: [0, 0, 0]}",
            "w.yaml:3:11: cameras.a: looks at where it stands; accepted: a target elsewhere",
        ),
        (
            "{follow: {entity: ball, offset: [0, 0, 0]}}",
            "w.yaml:3:11: cameras.a: looks at where it stands; accepted: a target elsewhere",
        ),
        (
            "{position: [0, 4, 0], up: [0, 2, 0]}",
            "w.yaml:3:11: cameras.a: looks along up; received up [0.0, 2.0, 0.0]; accepted: an up across the view",
        ),
        (
            "{position: [0, 4, 0], up: [0, 0, 0]}",
            "w.yaml:3:36: cameras.a.up: must have a direction; received [0.0, 0.0, 0.0]",
        ),
        (
            "{position: [0, 4, 0], target: 3}",
            "w.yaml:3:36: cameras.a.target: must be a list of 3 numbers; received 3; accepted: numbers in m",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}]}",
            "w.yaml:3:15: cameras.a.keyframes: must be two or more; received 1",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 0 s, position: [1, 2, 4]}]}",
            "w.yaml:3:58: cameras.a.keyframes.1.at: must be later than the keyframe before, 0 s; received 0 s",
        ),
        (
            "{keyframes: [{at: 0, target: [1, 2, 3]}, {at: 1, position: [1, 2, 4]}]}",
            "w.yaml:3:27: cameras.a.keyframes.0.position: is missing; the first keyframe says where the path begins",
        ),
        (
            "{keyframes: {repeat: loop, frames: [{at: 0, position: [1, 2, 3]}, {at: 1, position: [1, 2, 4]}]}}",
            "w.yaml:3:80: cameras.a.keyframes.frames.1: must have the position of the first, for the path to begin anew there; close it, or state ping_pong",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3], target: [0, 0, 1]}, {at: 1, position: [1, 2, 4]}], target: ball}",
            "w.yaml:3:107: cameras.a.target: keyframes say what it looks at; remove one of the two",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 1, position: [0, 0, 0]}]}",
            "w.yaml:3:57: cameras.a.keyframes.1: looks at where it stands; accepted: a target elsewhere",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 1, positon: [0, 1, 0]}]}",
            "w.yaml:3:65: cameras.a.keyframes.1.positon: unknown key; received 'positon'; accepted: at, position, target, fov, height; did you mean 'position'?",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3], target: [0, 0, 1]}, {at: 1, target: boll}]}",
            "w.yaml:3:84: cameras.a.keyframes.1.target: unknown entity; received 'boll'; accepted: ball, box; did you mean 'ball'?",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 1, target: ball}]}",
            "w.yaml:3:27: cameras.a.keyframes.0.target: is missing; the first keyframe says where the path begins",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3], target: ball}, {at: 1, target: [1, 2, 3]}]}",
            "w.yaml:3:71: cameras.a.keyframes.1: looks at where it stands; accepted: a target elsewhere",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 1, fov: 0 deg}]}",
            "w.yaml:3:65: cameras.a.keyframes.1.fov: must be above 0 rad; received '0 deg'",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 1, fov: 20 deg}, {at: 2, height: 2 m}]}",
            "w.yaml:3:87: cameras.a.keyframes.2.height: must state one lens; received fov and height; accepted: fov, or height for parallel light",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 1, fov: 20 deg}], height: 2 m}",
            "w.yaml:3:65: cameras.a.keyframes.1.fov: must state one lens; received fov and height; accepted: fov, or height for parallel light",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3], fov: 60 deg}, {at: 1}], fov: 20 deg}",
            "w.yaml:3:80: cameras.a.fov: keyframes say how much it sees; remove one of the two",
        ),
        (
            "{keyframes: {repeat: loop, frames: [{at: 0, position: [1, 2, 3], target: ball, fov: 60 deg}, {at: 1, fov: 20 deg}]}}",
            "w.yaml:3:107: cameras.a.keyframes.frames.1: must have the fov of the first, for the path to begin anew there; close it, or state ping_pong",
        ),
        (
            "{keyframes: [{at: 0, position: [1, 2, 3]}, {at: 1}], target: boll}",
            "w.yaml:3:67: cameras.a.target: unknown entity; received 'boll'; accepted: ball, box; did you mean 'ball'?",
        ),
    ],
)  # fmt: skip
def test_a_faulty_camera_is_told(words: str, message: str) -> None:
    """Where, what, what was received and what is accepted."""
    with pytest.raises(WorldError) as caught:
        load_text(f"{HEADER}cameras: {{a: {words}}}\n", "w.yaml")
    assert str(caught.value) == message
