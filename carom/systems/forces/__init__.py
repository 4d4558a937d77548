"""Forces, one file each; importing this package fills the registry of laws."""

from carom.systems.forces import (
    attraction,
    buoyancy,
    constant_push,
    drag,
    gravity_well,
    lift,
    magnus,
    mutual_gravitation,
    thruster,
    vortex,
    wind,
)
from carom.systems.forces.law import LAWS, Forces, Law

__all__ = [
    "LAWS",
    "Forces",
    "Law",
    "attraction",
    "buoyancy",
    "constant_push",
    "drag",
    "gravity_well",
    "lift",
    "magnus",
    "mutual_gravitation",
    "thruster",
    "vortex",
    "wind",
]
