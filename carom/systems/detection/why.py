"""Why two colliders are not in contact: the detection's own steps for one pair, told in words with numbers."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.spatial import quaternion
from carom.systems.detection.answered import uncounted
from carom.systems.detection.bounds import reach_within, reaches_of
from carom.systems.detection.narrow import measure_pairs
from carom.systems.kernels.islands import moves
from carom.systems.layers import Layers
from carom.systems.settings import Settings
from carom.systems.shapes.plane import Plane
from carom.systems.stream import Stream
from carom.systems.ties import Ties

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation

DOUBLINGS = 60  # of the reach, in search of the nearest points of a pair that does not come near


def why_no_contact(of: World | Simulation, a: int | str, b: int | str) -> str:
    """Say why the next step finds no contact of two entities (handles or names), or that it finds one.

    Layers, joints, bounds and shapes are asked in this order at the present poses; the first that keeps them apart is
    told, and whether they sleep.
    """
    world = of if isinstance(of, World) else of.world
    handles = [world.find(one) if isinstance(one, str) else int(one) for one in (a, b)]
    handles.sort(key=world.row)
    rows = [world.row(handle) for handle in handles]
    names = [f"'{world.name(handle)}'" for handle in handles]
    if rows[0] == rows[1]:
        return f"{names[0]} is one entity; contacts are of two"
    bare = [name for name, row in zip(names, rows, strict=True) if not world.table(Collider).present[row]]
    if bare:
        return f"{' and '.join(bare)} {'has' if len(bare) == 1 else 'have'} no collider"
    with _placed(world):
        pair = _Pair(world, rows, names)
        return pair.refused() or pair.nowhere() or pair.asleep(pair.of_sensor(pair.far_bounds() or pair.near()))


@contextmanager
def _placed(world: World) -> Iterator[None]:
    """Place all colliders as the next step will, and put everything back."""
    written = (Transform, "position rotation"), (ColliderPose, " ".join(ColliderPose.columns))
    kept = [
        (kind, name, getattr(world[kind], name).copy())
        for kind, names in (*written, (Flight, "reach detected_center"))
        for name in names.split()
    ]
    stream = world[Stream]
    flowing = stream.motion.copy(), stream.gone.copy(), stream.passes
    with world.faces(None), uncounted(world):
        reach_within(world, world[Settings].dt)
        try:
            yield
        finally:
            for kind, name, values in kept:
                getattr(world[kind], name)[:] = values
            stream.motion[:], stream.gone[:], stream.passes = flowing


class _Pair:
    """Two colliders, lower row first, with their names in quotes."""

    def __init__(self, world: World, rows: list[int], names: list[str]) -> None:
        self.world, self.rows, self.names = world, rows, names
        self.collider, self.pose = world[Collider], world[ColliderPose]
        self.bodies = [int(self.pose.body_row[row]) for row in rows]
        self.reach = float(reaches_of(world, np.array([rows]), world[Flight].reach)[0])
        self.flat = [int(self.collider.shape[row]) == Plane.number for row in rows]

    def refused(self) -> str:
        """Say what keeps them from being a pair wherever they are."""
        a, b = self.names
        if self.bodies == [-1, -1]:
            return f"neither {a} nor {b} moves; give one of them a body"
        if self.bodies[0] == self.bodies[1]:
            return f"{a} and {b} belong to one body, '{self.world.name(self.world.entity(self.bodies[0]))}'"
        inverse_mass = self.world[RigidBody].inverse_mass
        stand = all(body < 0 or inverse_mass[body] == 0.0 for body in self.bodies)
        if stand and not self.collider.sensor[self.rows].any():
            return f"neither {a} nor {b} can be pushed; give one of them a dynamic body"
        layers = self.collider.layer[self.rows].tolist()
        if 0 in layers:
            return f"{self.names[layers.index(0)]} is on layer 'none', which meets nobody"
        for one, other in ((0, 1), (1, 0)):
            layer, mask = layers[one], int(self.collider.mask[self.rows[other]])
            if not layer & mask:
                bits = self.world[Layers].bits
                on = next((name for name, bit in bits.items() if bit == layer), str(layer))
                accepted = ", ".join(f"'{name}'" for name, bit in bits.items() if bit & mask) or "nobody"
                refusal = f"which {self.names[other]} does not accept; it accepts {accepted}"
                return f"{self.names[one]} is on layer '{on}', {refusal}"
        owners = [body if body >= 0 else row for body, row in zip(self.bodies, self.rows, strict=True)]
        for joint in self.world[Ties].now(self.world).keeping_apart(*owners):
            held_by = self.world.name(self.world.entity(joint))
            return f"{a} and {b} are held by '{held_by}', which keeps them from touching; its word collide lets them"
        if self.collider.sensor[self.rows].all():
            return f"{a} and {b} are both sensors, which do not notice each other"
        return ""

    def nowhere(self) -> str:
        """Name who has no finite place."""
        for name, row, flat in zip(self.names, self.rows, self.flat, strict=True):
            if not np.isfinite(self.pose.position[row]).all():
                return f"{name} is nowhere: its position is {self.pose.position[row].tolist()} m"
            if not flat and not np.isfinite((self.pose.lower[row], self.pose.upper[row])).all():
                return f"{name} has no end of its bounds: its velocity is not finite, or too large"
        return ""

    def asleep(self, told: str) -> str:
        """Add that nobody looks for their contacts, where one sleeps and nobody moves."""
        motion, names = self.world[Motion], []
        for name, body in zip(self.names, self.bodies, strict=True):
            if body >= 0 and motion.asleep[body]:
                names.append(name)
            elif body >= 0 and (self.world[RigidBody].inverse_mass[body] or moves(body, motion.linear, motion.angular)):
                return told
        if not names or self.world[Collider].sensor[self.rows].any():
            return told
        sleep = f"{' and '.join(names)} {'sleeps' if len(names) == 1 else 'sleep'}"
        return f"{sleep}, so that nobody looks for contacts of the two; {told}"

    def of_sensor(self, told: str) -> str:
        """Add that one of them is a sensor."""
        for name, row in zip(self.names, self.rows, strict=True):
            if self.collider.sensor[row]:
                return f"{name} is a sensor, which notes who enters and touches nobody; {told}"
        return told

    def far_bounds(self) -> str:
        """Say how far apart their bounds are, where that is more than they reach."""
        if any(self.flat):
            plane, box = (0, 1) if self.flat[0] else (1, 0)
            where = f"above the plane of {self.names[plane]}"
            gap = self._above(self.rows[plane], self.rows[box])
        else:
            a, b = self.rows
            gaps = np.maximum(self.pose.lower[b] - self.pose.upper[a], self.pose.lower[a] - self.pose.upper[b])
            axis = int(np.argmax(gaps))
            gap, where = float(gaps[axis]), f"apart along {'xyz'[axis]}"
        if gap <= 0.0:
            return ""
        return f"their bounds are {_length(gap + self.reach)} {where}; they reach {_length(self.reach)} within a step"

    def _above(self, plane: int, box: int) -> float:
        size: Floats = self.collider.size[plane]
        normal = quaternion.rotate(self.pose.rotation[plane], size[:3])
        corner = np.where(normal > 0.0, self.pose.lower[box], self.pose.upper[box]) - self.pose.position[plane]
        return float((normal * corner).sum() - size[3])

    def near(self) -> str:
        """Say how near their shapes are."""
        reach = self.reach
        for _ in range(DOUBLINGS):
            found = measure_pairs(self.world, np.array([self.rows]), np.array([reach]))
            if len(found.depth):
                break
            reach *= 2.0
        else:
            return "the narrow phase finds no point of the two"
        deepest, count = float(found.depth.max()), len(found.depth)
        apart = f"{_length(-deepest)} apart, they reach {_length(self.reach)} within a step"
        sensing = self.collider.sensor[self.rows].any()
        if reach > self.reach or (sensing and deepest < 0.0):
            return f"their nearest points are {apart}"
        points = f"{count} point{'s' if count > 1 else ''}"
        if deepest < 0.0:
            return f"they may touch within the step: {points}, the nearest {apart}"
        return f"they {'overlap' if sensing else 'are in contact'}: {points}, deepest {_length(deepest)}"


def _length(meters: float) -> str:
    return f"{1e3 * meters:.3g} mm" if meters < 0.1 else f"{meters:.3g} m" if meters < 1000.0 else f"{meters:.0f} m"
