"""What slides or rolls off what is round is borne by less and less, and leaves it where theory has it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import RigidBody
from carom.ecs.column import Floats
from carom.ecs.relations.contact import Contact
from carom.systems.simulation import Simulation

G, BELOW, ABOVE, START = 9.81, 1.0, 0.1, 0.2
APART = BELOW + ABOVE  # m, of both axes
ALONG_Z = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))
ICE, ROUGH = {"friction": 0.0, "restitution": 0.0}, {"friction": 5.0, "restitution": 0.0}


def lying(shape: str, radius: float, length: float) -> dict[str, Any]:
    """Return the words of what is round about z."""
    size = {"radius": radius} if shape == "sphere" else {"radius": radius, "length": length}
    return {"collider": {shape: size}, "transform": {"rotation": ALONG_Z}}


def borne_on_the_way(below: str, above: str, material: dict[str, float], dt: float) -> tuple[Floats, float]:
    """Return, of each step until one leaves another, the cosine of where it is in its middle, and what bears it (m g).

    It begins `START` (rad) off the top. And return its squared radius of gyration by that of its shape.
    """
    simulation = Simulation(dt=dt, sleeping=False)
    simulation.add(material=material, **lying(below, BELOW, 4.0))
    words = lying(above, ABOVE, 0.5)
    words["transform"]["position"] = (APART * np.sin(START), APART * np.cos(START), 0.0)
    body = simulation.add(body={"mass": 1.0}, material=material, **words)
    gyration = float(simulation.world[RigidBody].inertia[simulation.world.row(body), 1]) / ABOVE**2
    rows: list[tuple[float, float]] = []
    while True:
        before = simulation[body].transform.position / APART
        simulation.step()
        middle = 0.5 * (before + simulation[body].transform.position / APART)
        contact = simulation.world[Contact]
        rows.append((middle[1], contact.impulse[: contact.count].sum() / (dt * G)))
        if rows[-1][1] == 0.0:
            return np.array(rows), gyration if material["friction"] else 0.0


@pytest.mark.parametrize(("per_second", "bound"), [(60, 0.035), (240, 0.01)])
@pytest.mark.parametrize("material", [ICE, ROUGH], ids=["ice", "rough"])
@pytest.mark.parametrize("above", ["sphere", "cylinder", "capsule"])
@pytest.mark.parametrize("below", ["sphere", "cylinder", "capsule"])
def test_who_goes_off_what_is_round_leaves_it_as_theory_has_it(
    below: str, above: str, material: dict[str, float], per_second: int, bound: float
) -> None:
    """It is borne by g cos t - v^2 / a (Goldstein, section 2.4), with v^2 = 2 g a (cos t0 - cos t) / (1 + k).

    Its radius of gyration squared is k r^2 where it rolls; so it leaves at cos t = 2 / (3 + k) cos t0, within a step of
    that, and is borne to 3.5 % of its weight, in steps of a quarter to 1 %.
    """
    rows, k = borne_on_the_way(below, above, material, 1.0 / per_second)
    theory = ((3.0 + k) * rows[:, 0] - 2.0 * np.cos(START)) / (1.0 + k)
    assert rows[5:-1, 1] == pytest.approx(theory[5:-1], abs=bound)
    assert theory[-3] > 0.0 > theory[-1]
