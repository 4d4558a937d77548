"""Bodies on keyframes are where they should be when they should be there, and push and carry on the way."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from faults import error

from carom.ecs import (
    DeclarationError,
    bytes_from_snapshot,
    restore_snapshot,
    snapshot_from_bytes,
    state_hash,
    take_snapshot,
)
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

ROUGH = {"friction": 0.5}
CUBE = {"box": {"size": (1.0, 1.0, 1.0)}}
KINEMATIC = {"type": "kinematic"}
QUARTER = (0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))
TOUR = (
    {"at": 0.1, "position": (0.0, 0.0, 0.0)},
    {"at": 0.37, "position": (0.0, 2.0, 1.0), "rotation": QUARTER},
    {"at": 0.9, "rotation": (0.6, 0.0, 0.0, 0.8)},
    {"at": 1.3, "position": (0.0, 0.0, 0.0), "rotation": (0.0, 0.0, 0.0, 1.0)},
)
TIMES = [frame["at"] for frame in TOUR]
PLACES = np.array([(0.0, 0.0, 0.0), (0.0, 2.0, 1.0), (0.0, 2.0, 1.0), (0.0, 0.0, 0.0)])
TURNS = np.array([(0.0, 0.0, 0.0, 1.0), QUARTER, (0.6, 0.0, 0.0, 0.8), (0.0, 0.0, 0.0, 1.0)])


def pose_at(time: float, repeat: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the pose of the tour at a time, in so many words."""
    period = TIMES[-1] - TIMES[0]
    since = max(time - TIMES[0], 0.0)
    if repeat == "loop":
        since = since % period
    elif repeat == "ping_pong":
        since = since % (2.0 * period)
        since = min(since, 2.0 * period - since)
    since = TIMES[0] + min(since, period)
    k = max(n for n in range(3) if TIMES[n] <= since)
    share = (since - TIMES[k]) / (TIMES[k + 1] - TIMES[k])
    return (1.0 - share) * PLACES[k] + share * PLACES[k + 1], quaternion.slerp(TURNS[k], TURNS[k + 1], share)


@pytest.mark.parametrize("dt", [1 / 60, 1 / 100])
@pytest.mark.parametrize("repeat", ["once", "loop", "ping_pong"])
def test_every_step_ends_at_the_pose_of_its_time(repeat: str, dt: float) -> None:
    """To 1e-12, through corners of the path within steps, about a centre of mass that is elsewhere."""
    simulation = Simulation(dt=dt)
    body = {**KINEMATIC, "center_of_mass": (0.3, -0.2, 0.1)}
    guide = simulation.add(collider=CUBE, body=body, keyframes={"frames": TOUR, "repeat": repeat})
    assert simulation[guide].transform.position.tolist() == [0.0, 0.0, 0.0]
    for _ in range(round(5.0 / dt)):
        simulation.step()
        position, rotation = pose_at(simulation.time, repeat)
        assert simulation[guide].transform.position == pytest.approx(position, abs=1e-12)
        found = simulation[guide].transform.rotation
        assert np.copysign(1.0, found @ rotation) * found == pytest.approx(rotation, abs=1e-12)


def waves(height: float, rate: float) -> list[dict[str, Any]]:
    """Return keyframes of 6 s that go up and down, twenty to the second."""
    times = [0.05 * k for k in range(121)]
    return [{"at": time, "position": (0.0, height * (1.0 - math.cos(rate * time)) - 0.25, 0.0)} for time in times]


def test_a_lift_on_keyframes_carries_a_stack_up_and_down() -> None:
    """Its greatest acceleration is a fifth of g: no cube leaves it by 0.1 mm or comes to lie askew."""
    simulation = Simulation(checked=False)
    slab = {"box": {"size": (4.0, 0.5, 4.0)}}
    lift = simulation.add(collider=slab, body=KINEMATIC, material=ROUGH, keyframes=waves(0.5, 2.0))
    cubes = [
        simulation.add(collider=CUBE, body={"mass": 1.0}, material=ROUGH, transform={"position": (0.0, 0.5 + i, 0.0)})
        for i in range(2)
    ]
    simulation.step(30)
    for _ in range(330):
        simulation.step()
        top = simulation[lift].transform.position[1] + 0.25
        heights = [simulation[cube].transform.position[1] - top for cube in cubes]
        assert heights[0] == pytest.approx(0.5, abs=1e-4)
        assert heights[1] == pytest.approx(1.5, abs=1e-3)
    assert simulation[cubes[1]].transform.position[[0, 2]] == pytest.approx([0.0, 0.0], abs=1e-4)


def test_a_slab_on_keyframes_pushes_at_its_speed() -> None:
    """Out by 1 m in 1 s, and back: the cube goes along, keeps its place once it has slid to rest, and is left there."""
    simulation = Simulation(checked=False)
    simulation.add(collider={"plane": {}}, material=ROUGH)
    out = [{"at": at, "position": (x, 0.5, 0.0)} for at, x in ((0.0, -0.6), (1.0, 0.4), (2.0, -0.6))]
    slab = {"box": {"size": (0.2, 1.0, 2.0)}}
    simulation.add(collider=slab, body=KINEMATIC, material=ROUGH, keyframes=out)
    cube = simulation.add(collider=CUBE, body={"mass": 1.0}, material=ROUGH, transform={"position": (0.0, 0.5, 0.0)})
    simulation.step(59)
    assert simulation[cube].motion.linear[0] == pytest.approx(1.0, abs=1e-5)
    simulation.step(90)
    assert simulation[cube].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    assert simulation[cube].transform.position[0] == pytest.approx(1.0 + 1.0 / (2.0 * 0.5 * 9.81), abs=0.005)


def test_a_wall_on_keyframes_strikes() -> None:
    """A ball at -1 m/s that meets a wall at 2 m/s, e = 1, leaves at 5 m/s."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    frames = [{"at": 0.0, "position": (-1.0, 0.0, 0.0)}, {"at": 2.0, "position": (3.0, 0.0, 0.0)}]
    simulation.add(collider={"box": {"size": (0.2, 4.0, 4.0)}}, body=KINEMATIC, keyframes=frames)
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={"mass": 1.0},
        material={"restitution": 1.0},
        transform={"position": (0.3, 0.0, 0.0)},
        motion={"linear": (-1.0, 0.0, 0.0)},
    )
    simulation.step(60)
    assert simulation[ball].motion.linear == pytest.approx([5.0, 0.0, 0.0], abs=1e-9)


def on_tour() -> Simulation:
    """Return boxes that a body on keyframes goes through."""
    simulation = Simulation(checked=False)
    simulation.add(collider={"plane": {"offset": -1.0}})
    simulation.add(collider=CUBE, body=KINEMATIC, keyframes={"frames": TOUR, "repeat": "ping_pong"})
    for k in range(6):
        place = {"position": (0.4 * (k % 2) - 0.2, 1.0 + 0.5 * k, 0.5)}
        simulation.add(collider={"box": {"size": (0.4, 0.4, 0.4)}}, body={}, transform=place)
    return simulation


def test_a_path_goes_on_bit_for_bit_from_a_snapshot_in_its_middle() -> None:
    """In another simulation, by way of bytes: every hash of the next 60 frames is the same."""
    simulation, other = on_tour(), on_tour()
    simulation.step(40)
    kept = bytes_from_snapshot(take_snapshot(simulation.world))
    restore_snapshot(other.world, snapshot_from_bytes(kept, other.world))
    for _ in range(60):
        simulation.step()
        other.step()
        assert state_hash(simulation.world) == state_hash(other.world)


def test_a_body_that_is_added_later_begins_where_its_path_is() -> None:
    """Keyframes are in the world's time."""
    simulation = Simulation(dt=1 / 100)
    simulation.step(50)
    frames = [{"at": 0.0, "position": (0.0, 0.0, 0.0)}, {"at": 1.0, "position": (2.0, 0.0, 0.0)}]
    guide = simulation.add(body=KINEMATIC, keyframes=frames)
    assert simulation[guide].transform.position == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)
    simulation.step()
    assert simulation[guide].motion.linear == pytest.approx([2.0, 0.0, 0.0], abs=1e-12)


def test_transform_says_what_the_first_keyframe_leaves_out() -> None:
    """And each other one what those after it leave out."""
    simulation = Simulation()
    place = {"position": (1.0, 2.0, 3.0), "rotation": QUARTER}
    frames = ({"at": 0.0}, {"at": 1.0, "position": (1.0, 3.0, 3.0)}, {"at": 2.0})
    guide = simulation.add(body=KINEMATIC, transform=place, keyframes=frames)
    assert simulation[guide].transform.position.tolist() == [1.0, 2.0, 3.0]
    simulation.step(90)
    assert simulation[guide].transform.position == pytest.approx([1.0, 3.0, 3.0], abs=1e-12)
    assert simulation[guide].transform.rotation == pytest.approx(QUARTER, abs=1e-12)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (
            {"keyframes": [{"at": 0.0}]},
            ("keyframes: only a kinematic body follows keyframes; give it body: {type: kinematic}; "
            "keyframes: must be two or more; received 1"),
        ),
        (
            {"keyframes": [{"at": 1.0}, {"at": 1.0}, {"at": math.nan}], "body": {}, "motion": {}},
            ("body.type: only a kinematic body follows keyframes; received dynamic; "
            "motion: keyframes say how it moves; remove motion or keyframes; "
            "keyframes.2.at: must be a time in s; "
            "keyframes.1.at: must be later than the keyframe before, 1 s; received 1 s"),
        ),
        (
            {"keyframes": {"frames": [{"at": 0.0}, {"after": 1.0}], "repeat": "twice"}, "body": KINEMATIC},
            ("keyframes.frames.1.after: unknown key; a keyframe has at, position, rotation; "
            "keyframes.repeat: must be one of once, loop, ping_pong; received 'twice'; "
            "keyframes.frames.1.at: must be a time in s"),
        ),
        (
            {"keyframes": {"frames": TOUR[:3], "repeat": "loop"}, "body": KINEMATIC,
             "transform": {"position": (0, 0, 1)}},
            ("transform.position: the first keyframe says where it is; remove one of the two; "
            "keyframes.frames.2: must have the pose of the first, for the path to begin anew there; "
            "close it, or state ping_pong"),
        ),
    ],
)  # fmt: skip
def test_everything_wrong_with_keyframes_is_told_at_once(words: dict[str, Any], message: str) -> None:
    """In Python as in files, and nothing is left of them."""
    simulation = Simulation()
    with error(DeclarationError, message):
        simulation.add(**words)
    assert simulation.world.used() == 0


def test_copies_are_added_one_by_one() -> None:
    """Many bodies on one path would be in one place."""
    with error(DeclarationError, "keyframes: all copies would go the same way; add them one by one"):
        Simulation().add_many(np.zeros((2, 3)), body=KINEMATIC, keyframes=TOUR)
