"""Joints, one file each; importing this package fills the registry of kinds."""

from carom.systems.joints import ball, distance, fixed, framed, generic, hinge, rope, slider, spring, universal
from carom.systems.joints.kind import JOINTS, JointKind

__all__ = [
    "JOINTS",
    "JointKind",
    "ball",
    "distance",
    "fixed",
    "framed",
    "generic",
    "hinge",
    "rope",
    "slider",
    "spring",
    "universal",
]
