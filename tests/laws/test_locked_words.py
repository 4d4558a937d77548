"""What cannot be locked is refused, in whole sentences."""

from __future__ import annotations

from typing import Any

import pytest

from carom.ecs.errors import DeclarationError
from carom.systems.simulation import Simulation


@pytest.mark.parametrize(
    ("settings", "words", "message"),
    [
        (
            {},
            {"body": {"mass": 1.0, "locked": ["rotaton_x"]}},
            (
                "body.locked: unknown axis 'rotaton_x'; the axes are x, y, z, rotation_x, rotation_y, rotation_z; "
                "did you mean 'rotation_x'?"
            ),
        ),
        (
            {},
            {"body": {"mass": 1.0, "locked": ["x"]}, "motion": {"linear": (0.5, 0.0, 1.0)}},
            (
                "motion.linear: must be 0 along x, which is locked, received 0.5 m/s; "
                "take x out of body.locked, or the velocity out of motion"
            ),
        ),
        (
            {},
            {"body": {"type": "kinematic", "locked": ["rotation_z"]}, "motion": {"angular": (1.0, 0.0, -2.0)}},
            (
                "motion.angular: must be 0 about z, which is locked, received -2 rad/s; "
                "take rotation_z out of body.locked, or the velocity out of motion"
            ),
        ),
        (
            {},
            {"body": {"type": "kinematic", "locked": ["z"]}, "keyframes": [{"at": 0.0}, {"at": 1.0}]},
            "body.locked: keyframes say how it moves; remove locked or keyframes",
        ),
        (
            {"dimensions": 2},
            {"body": {"type": "kinematic"}, "keyframes": [{"at": 0.0}, {"at": 1.0, "position": (0.0, 0.0, 1.0)}]},
            "keyframes: must keep to one z and turn about z only with dimensions: 2",
        ),
        (
            {"dimensions": 2},
            {"body": {"type": "kinematic"}, "keyframes": [{"at": 0.0}, {"at": 1.0, "rotation": (0.6, 0.0, 0.0, 0.8)}]},
            "keyframes: must keep to one z and turn about z only with dimensions: 2",
        ),
        (
            {"dimensions": 2},
            {"body": {"mass": 1.0}, "motion": {"linear": (0.5, 0.0, 1.0)}},
            "motion.linear: must be 0 along z with dimensions: 2, received 1 m/s; bodies keep to the plane z = const",
        ),
        (
            {"dimensions": 2},
            {"body": {"mass": 1.0}, "motion": {"angular": (0.5, 0.0, 1.0)}},
            (
                "motion.angular: must be 0 about x with dimensions: 2, received 0.5 rad/s; "
                "bodies keep to the plane z = const"
            ),
        ),
    ],
)
def test_velocities_along_locked_axes_are_refused(settings: Any, words: Any, message: str) -> None:
    """What, where, what was received and how to mend it."""
    with pytest.raises(DeclarationError) as caught:
        Simulation(**settings).add(**words)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"dimensions": 4}, "dimensions must be 2 or 3, received 4"),
        (
            {"dimensions": 2, "gravity": (0.0, 0.0, -9.81)},
            "gravity must lie in the plane z = const with dimensions 2, received [0.0, 0.0, -9.81]",
        ),
    ],
)
def test_dimensions_that_cannot_be_are_refused(settings: Any, message: str) -> None:
    """Before anything is in the world."""
    with pytest.raises(DeclarationError) as caught:
        Simulation(**settings)
    assert str(caught.value) == message
