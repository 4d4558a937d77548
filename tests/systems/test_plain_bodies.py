"""What is seen at once of eight bodies in a row is seen of each of them."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import NonFiniteError, RigidBody
from carom.systems.simulation import Simulation


@pytest.mark.parametrize("column", ["center_of_mass", "freedom"])
def test_a_number_that_is_none_is_told_of_one_among_eight(column: str) -> None:
    """It equals nothing, and so is not taken for what most bodies have."""
    simulation = Simulation()
    for n in range(8):
        simulation.add(collider={"sphere": {"radius": 0.1}}, body={}, transform={"position": (n, 0.0, 0.0)})
    with simulation.world.edit(RigidBody) as body:
        getattr(body, column)[3] = np.nan
    with pytest.raises(NonFiniteError):
        simulation.step()
