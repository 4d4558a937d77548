"""Groups: entities placed together, called like ``cart.wheel[0]``, and inside it by their own names."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.joints import JOINTS
from carom.systems.paths import stated as stated_frames
from carom.worlds.errors import Path

HEAD = re.compile(r"[^.\[]*")
OWN_AXES = {"axis": (1.0, 0.0, 0.0), "second_axis": (0.0, 0.0, 1.0)}  # of a joint that states none
WORLD_POINTS, WORLD_DIRECTIONS = ("at",), ("axis", "second_axis")


@dataclass(frozen=True)
class Group:
    """Where entities are together, and whom their names stand for; that of the world has no prefix and no members."""

    prefix: str = ""
    members: frozenset[str] = frozenset()
    written: Path = ()  # where its entities are
    position: Floats = field(default_factory=lambda: np.zeros(3))
    rotation: Floats = field(default_factory=lambda: np.array(quaternion.IDENTITY))
    outer: Group | None = None

    @property
    def depth(self) -> int:
        """In how many groups it is."""
        return 0 if self.outer is None else self.outer.depth + 1

    def inside(self, written: Path) -> bool:
        """Tell whether it is, or is in, a group of the entities that are written there."""
        return self.outer is not None and (self.written == written or self.outer.inside(written))

    def whole(self, name: str) -> str:
        """Return the whole name of whom a name means here: one of this group, or of the nearest around it."""
        head = HEAD.match(name)
        group: Group | None = self
        while group is not None:
            if head is not None and head[0] in group.members:
                return group.prefix + name
            group = group.outer
        return name

    def point(self, local: Any) -> Any:
        """Return points (..., 3), m, in the world."""
        return self.position + quaternion.rotate(self.rotation, np.asarray(local, np.float64))

    def direction(self, local: Any) -> Any:
        """Return vectors (..., 3) in the world."""
        return quaternion.rotate(self.rotation, np.asarray(local, np.float64))

    def back(self, rotation: Any) -> Any:
        """Return a quaternion xyzw of the world in the group."""
        return quaternion.multiply(quaternion.conjugate(self.rotation), np.asarray(rotation, np.float64))

    def turned(self, local: Any, rotations: Floats, count: int) -> Floats:
        """Return the rotations (count, 4) of copies, each turned in the group; ``rotations`` (1, 4) is that of all."""
        if local is None:
            return np.repeat(rotations, count, axis=0)
        return np.asarray(quaternion.multiply(self.turn(local), self.back(rotations)))

    def turn(self, local: Any) -> Any:
        """Return a quaternion xyzw in the world."""
        return quaternion.multiply(self.rotation, np.asarray(local, np.float64))

    def place(self, words: dict[str, Any]) -> None:
        """Put an entity's words, in SI, where the group is; a joint's are of the world where it holds the world."""
        if self.outer is None:
            return
        if "parent" not in words and "joint" not in words:
            said = _frames(words)[0] if "keyframes" in words else {"rotation"} if "chain" in words else {}
            wanted = [word for word in ("position", "rotation") if word not in said]
            words["transform"] = self._pose(words.get("transform", {}), wanted)
        if "motion" in words:
            words["motion"] = {key: self.direction(value).tolist() for key, value in words["motion"].items()}
        if "chain" in words:
            words["chain"] |= {"end": self.point(words["chain"]["end"]).tolist()}
        if "keyframes" in words:
            self._place_frames(words)
        for key, kind in words.get("joint", {}).items():
            self._place_joint(key, kind)

    def _pose(self, words: dict[str, Any], wanted: Collection[str] = ()) -> dict[str, Any]:
        placed = dict(words)
        if "position" in words or "position" in wanted:
            placed["position"] = self.point(words.get("position", (0.0, 0.0, 0.0))).tolist()
        if "rotation" in words or "rotation" in wanted:
            placed["rotation"] = self.turn(words.get("rotation", quaternion.IDENTITY)).tolist()
        return placed

    def _place_frames(self, words: dict[str, Any]) -> None:
        stated, placed = words["keyframes"], [self._pose(frame) for frame in _frames(words)]
        words["keyframes"] = stated | {"frames": placed} if isinstance(stated, dict) else placed

    def _place_joint(self, key: str, words: dict[str, Any]) -> None:
        if not any(word in words for word in ("axis", "axis_a", "axis_b")):  # its axes are those of the group
            words |= {name: axis for name, axis in OWN_AXES.items() if name in JOINTS[key].__dataclass_fields__}
        held = [side for side in "ab" if side not in words]
        points = (*WORLD_POINTS, *(f"anchor_{side}" for side in held))
        directions = (*WORLD_DIRECTIONS, *(f"axis_{side}" for side in held))
        words |= {key: self.point(words[key]).tolist() for key in points if words.get(key) is not None}
        words |= {key: self.direction(words[key]).tolist() for key in directions if words.get(key) is not None}


def _frames(words: dict[str, Any]) -> list[Any]:
    frames, _, _ = stated_frames(words["keyframes"])
    return list(frames) or [{}]


WORLD = Group()
