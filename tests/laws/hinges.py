"""Bodies on joints, for tests of joints."""

from __future__ import annotations

from carom.systems.simulation import Simulation

G = 9.81
BALL = {"sphere": {"radius": 0.05}}
UNIT = {"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}


def weightless(dt: float = 1 / 240) -> Simulation:
    """Return a world without gravity in which nobody sleeps."""
    return Simulation(dt=dt, gravity=(0.0, 0.0, 0.0), sleeping=False)


def hinged(simulation: Simulation, *, spin: float, **words: object) -> int:
    """Add a body of unit inertia that turns about x at ``spin`` (rad/s) on a hinge; return the joint."""
    simulation.add(name="flap", collider=BALL, body=UNIT, motion={"angular": (spin, 0.0, 0.0)})
    axis = {"b": "flap", "at": (0.0, 0.0, 0.0), "axis": (1.0, 0.0, 0.0)}
    return int(simulation.add(joint={"hinge": axis | words}))
