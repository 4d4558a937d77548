"""Onlookers: where somebody is told of every system, each of them is run by itself."""

from __future__ import annotations

from carom.systems.simulation import Simulation


def looked_on(simulation: Simulation, seen: bool = True) -> Simulation:
    """Return a simulation with an onlooker; where it is not to be ``seen``, as it is."""
    if seen:
        simulation.hearers.append(lambda system: None)
    return simulation
