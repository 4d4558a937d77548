"""Mesh: a closed surface of triangles that does not move."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.systems.shapes.triangles import Triangles


@dataclass(frozen=True)
class Mesh(Triangles):
    """A watertight triangle mesh; static, since FCL cannot measure how deep two meshes overlap."""

    key: ClassVar[str] = "mesh"
    number: ClassVar[int] = 7
    static: ClassVar[bool] = True

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL bounding-volume hierarchy; it cannot grow, so the margin is left out."""
        import fcl

        model = fcl.BVHModel()
        model.beginModel(len(self.geometry.vertices), len(self.geometry.faces))
        model.addSubModel(np.asarray(self.geometry.vertices), np.asarray(self.geometry.faces))
        model.endModel()
        return model
