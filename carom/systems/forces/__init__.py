"""Forces, one file each; importing this package fills the registry of laws."""

from carom.systems.forces import constant_push, drag, mutual_gravitation, wind
from carom.systems.forces.law import LAWS, Forces, Law

__all__ = ["LAWS", "Forces", "Law", "constant_push", "drag", "mutual_gravitation", "wind"]
