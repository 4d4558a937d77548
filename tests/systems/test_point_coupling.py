"""Coupling of points: what an impulse at one of them does at all."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np
import pytest

from carom.ecs.spatial import quaternion
from carom.systems.kernels.bodies import push_at, surface_velocity
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.point_coupling import couple_points, part_points

POINTS = 4


@kernel("coupling", "slips")
def couple_and_part(
    m, impulse, contacts, offset, inverse_mass, inverse_inertia, principal, freedom, rotation, coupling, slips
):
    """Couple points of body 0 and of none, and part them by an impulse at point m."""
    for body in (0, -1):
        couple_points(
            body, contacts, offset, inverse_mass, inverse_inertia, principal, freedom, rotation, coupling
        )  # fmt: skip
    part_points(m, impulse[0], impulse[1], impulse[2], coupling, slips)


@kernel("linear", "angular", "moved")
def push_and_look(
    m, impulse, offset, inverse_mass, inverse_inertia, principal, freedom, rotation, linear, angular, moved
):  # fmt: skip
    """Push body 0 at point m, and write how fast its points move then."""
    push_at(
        0, 1.0, impulse[0], impulse[1], impulse[2], offset[m, 0], offset[m, 1], offset[m, 2],
        linear, angular, inverse_mass, inverse_inertia, principal, freedom, rotation,
    )  # fmt: skip
    for o in range(len(offset)):
        x, y, z = surface_velocity(0, offset[o, 0], offset[o, 1], offset[o, 2], linear, angular)
        moved[o, 0], moved[o, 1], moved[o, 2] = x, y, z


@pytest.mark.parametrize("locked", [(), (0,), (4,), (1, 3, 5)], ids=str)
@pytest.mark.parametrize("inverse_inertia", [(2.0, 2.0, 2.0), (0.5, 1.0, 3.0)], ids=["ball", "box"])
def test_points_part_as_a_body_that_is_pushed_moves(
    inverse_inertia: tuple[float, float, float], locked: tuple[int, ...]
) -> None:
    """To rounding, whatever the moments, the turn, and the axes that are locked; what stands takes no part."""
    random = np.random.default_rng(3)
    offset, impulse = random.normal(size=(POINTS, 3)), random.normal(size=3)
    freedom = np.ones((1, 6))
    freedom[0, list(locked)] = 0.0
    turns = quaternion.normalise(random.normal(size=(2, 1, 4)))
    body = np.array([0.7]), np.array([inverse_inertia]), turns[0], freedom, turns[1]
    for m in range(POINTS):
        slips, moved = np.zeros((POINTS, 3)), np.zeros((POINTS, 3))
        couple_and_part(m, impulse, np.arange(POINTS), offset, *body, np.zeros((POINTS, POINTS, 9)), slips)
        push_and_look(m, impulse, offset, *body, np.zeros((1, 3)), np.zeros((1, 3)), moved)
        assert np.abs(moved).max() > 0.1
        np.testing.assert_allclose(slips, moved, rtol=0.0, atol=1e-14)
