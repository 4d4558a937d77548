"""Overlays, one file each; importing this package fills their registry."""

from carom.tools.overlays import axes, bounds, contacts, forces, joints, labels, stamp, trails, velocities, wireframe
from carom.tools.overlays.overlay import OVERLAYS, Overlay

__all__ = [
    "OVERLAYS",
    "Overlay",
    "axes",
    "bounds",
    "contacts",
    "forces",
    "joints",
    "labels",
    "stamp",
    "trails",
    "velocities",
    "wireframe",
]
