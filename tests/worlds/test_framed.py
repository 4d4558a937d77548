"""Framed joints: stated in the frames of both bodies, they are the same wherever these are."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import DeclarationError
from carom.ecs.components.joint import Joint
from carom.systems.joints import JOINTS
from carom.systems.joints.framed import Framed
from carom.systems.parameters import words_of
from carom.systems.simulation import Simulation

HALF = 2.0**-0.5
STATED: dict[str, dict[str, Any]] = {
    "ball": {"swing": 0.5, "twist": (-0.2, 0.3), "friction": 0.1},
    "hinge": {"limits": (-1.0, 2.0), "motor": {"speed": 3.0, "most": 5.0}, "friction": 0.2},
    "slider": {"motor": {"target": 0.1, "stiffness": 20.0, "damping": 3.0}, "break_force": 90.0},
    "fixed": {"break_torque": 7.0, "collide": True},
    "universal": {"second_axis": (0, 1, 0), "second_limits": (-0.4, 0.4)},
    "generic": {"x": "free", "y": {"limits": (0.0, 0.2)}, "rotation_z": {"motor": {"damping": 0.3}}},
}


def built(turned: bool) -> Simulation:
    """Return two bodies, in one place or another."""
    simulation = Simulation()
    rotation = (0.0, HALF, 0.0, HALF) if turned else (HALF, 0.0, 0.0, HALF)
    simulation.add(name="post", transform={"position": (3.0 * turned, 1, 0), "rotation": rotation})
    simulation.add(
        name="door",
        body={"mass": 2, "inertia": (0.1, 0.1, 0.1)},
        transform={"position": (0.5, 1, turned), "rotation": rotation},
    )
    return simulation


def columns(simulation: Simulation) -> dict[str, bytes]:
    """Return what states the one joint, to the bit."""
    row = int(simulation.world.row_numbers(Joint)[0])
    held = simulation.world[Joint]
    return {name: getattr(held, name)[row].tobytes() for name, one in Joint.columns.items() if one.role == "state"}


@pytest.mark.parametrize("key", sorted(STATED))
def test_every_kind_at_a_point_is_a_framed_joint(key: str) -> None:
    """Column by column and bit by bit, also where the bodies have gone elsewhere."""
    first, second = built(turned=False), built(turned=True)
    axis = {"axis": (0.0, 0.0, 1.0)} if "axis" in JOINTS[key].__dataclass_fields__ else {}
    joint = first.add(joint={key: {"a": "post", "b": "door", "at": (0.2, 1.3, 0.1), **axis, **STATED[key]}})
    row, held = first.world.row(joint), first.world[Joint]
    one = Joint(**{name: getattr(held, name)[row] for name, each in Joint.columns.items() if each.role == "state"})
    stated = Framed.of(one)
    assert stated is not None
    second.add(joint={"framed": {"a": "post", "b": "door", **words_of(stated)}})
    assert columns(second) == columns(first)


def test_frames_that_are_no_rotations_are_refused() -> None:
    """With how long they are, and nothing is added."""
    simulation = built(turned=False)
    with pytest.raises(DeclarationError) as caught:
        simulation.add(joint={"framed": {"b": "door", "frame_a": (0, 0, 0, 2), "frame_b": (1, 1, 0, 0)}})
    assert str(caught.value) == (
        "joint.framed.frame_a: must be a unit quaternion, received one of length 2; "
        "joint.framed.frame_b: must be a unit quaternion, received one of length 1.41421356"
    )
    assert not simulation.world.count(Joint)


def test_a_framed_joint_holds_as_the_hinge_it_came_from() -> None:
    """A door swings alike on both."""
    angles = []
    for kind in ("hinge", "framed"):
        simulation = built(turned=False)
        words: dict[str, Any] = {"at": (0, 1, 0), "axis": (0.0, 0.0, 1.0)}
        joint = simulation.add(name="pivot", joint={"hinge": {"a": "post", "b": "door", **words}})
        if kind == "framed":
            held, row = simulation.world[Joint], simulation.world.row(joint)
            stated = Framed.of(Joint(**{name: getattr(held, name)[row].copy() for name in Joint.columns}))
            simulation.world.despawn(joint)
            simulation.add(name="pivot", joint={"framed": {"a": "post", "b": "door", **words_of(stated)}})
        simulation.step(30)
        angles.append(float(simulation["pivot"].joint.position[3]))
    assert angles[0] == angles[1]
    assert np.abs(angles[0]) > 0.1
