"""Mass: what a body of one or of many shapes weighs, and how that is spread."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import RigidBody
from carom.ecs.column import Booleans, Floats
from carom.ecs.components.rigid_body import BodyType
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.freedom import freedom_of
from carom.systems.shapes.shape import NO_AXES, MassProperties
from carom.systems.shapes.solid import principal

PASSED_ON = (
    "gravity_scale",
    "linear_damping",
    "angular_damping",
    "continuous",
    "sleeps",
)  # words that are columns as they stand
NOTHING = MassProperties(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), NO_AXES)


class Part(NamedTuple):
    """A solid of a density (kg/m3) at a pose in the frame of its body; all may have a row for each of many bodies."""

    solid: MassProperties
    density: float | Floats
    position: Floats
    rotation: Floats


@np.errstate(divide="ignore", over="ignore", invalid="ignore")
def rigid_body(words: Mapping[str, Any], parts: Sequence[Part], dimensions: int = 3) -> RigidBody:
    """Return the body of some parts; what ``words`` state of mass (kg), inertia or centre of mass goes before.

    A stated mass is shared out by volume, evenly where none has any. Numbers of the words, and of a single part, may
    have a row for each of many bodies. Raises DeclarationError for a dynamic body that has no mass, and for damping
    that drives.
    """
    kind = BodyType[words.get("type", "dynamic").upper()]
    masses, volume = [part.density * part.solid.volume for part in parts], sum(part.solid.volume for part in parts)
    mass = np.asarray(words.get("mass", sum(masses)), np.float64)
    moves = kind is BodyType.DYNAMIC
    if moves:
        _refuse("mass", mass, (mass > 0.0) & (mass < np.inf), "above 0 kg", "; state mass, or a shape with volume")
    for key in ("linear_damping", "angular_damping"):
        rate = np.asarray(words.get(key, 0.0), np.float64)
        _refuse(key, rate, (rate >= 0.0) & (rate < np.inf), "at least 0 1/s")
    if len(parts) == 1:
        solid = placed(parts[0])
    else:
        if "mass" in words:
            masses = [mass * (part.solid.volume / volume if volume else 1.0 / len(parts)) for part in parts]
        solid = joined(parts, list(map(float, masses))) if parts and mass else NOTHING
    inertia = np.asarray(words.get("inertia", mass[..., None] * np.asarray(solid.inertia)), np.float64)
    inverse = np.where(inertia > 0.0, 1.0 / inertia, 0.0) if moves else np.zeros(3)
    return RigidBody(
        **{key: words[key] for key in PASSED_ON if key in words},
        type=kind.value,
        mass=mass,
        inverse_mass=1.0 / mass if moves else 0.0,
        inertia=inertia,
        inverse_inertia=inverse,
        center_of_mass=words.get("center_of_mass", solid.center),
        freedom=freedom_of(words.get("locked", ()), dimensions),
        principal_axes=words.get("principal_axes", NO_AXES if "inertia" in words else solid.axes),
    )


def _refuse(word: str, values: Floats, fits: Booleans, wanted: str, mend: str = "") -> None:
    """Raise DeclarationError unless all values of a word fit, naming the first that does not."""
    if not fits.all():
        raise DeclarationError(f"body.{word}: must be finite and {wanted}, received {values[~fits].flat[0]:g}{mend}")


def placed(part: Part) -> MassProperties:
    """Return a solid in the frame of its body."""
    center = part.position + quaternion.rotate(part.rotation, part.solid.center)
    return part.solid._replace(center=center, axes=quaternion.multiply(part.rotation, part.solid.axes))  # type: ignore[arg-type]


def joined(parts: Sequence[Part], masses: Sequence[float]) -> MassProperties:
    """Return several solids of these masses (kg) as one: moments are moved to the common centre by Steiner's theorem.

    With + - * / and sqrt alone, as `solid_properties`: mass is state.
    """
    solids, total = [placed(part) for part in parts], math.fsum(masses)
    center = [math.fsum(m * s.center[k] for m, s in zip(masses, solids, strict=True)) / total for k in range(3)]
    inertia = np.zeros((3, 3))
    for mass, solid in zip(masses, solids, strict=True):
        x, y, z = (a - b for a, b in zip(solid.center, center, strict=True))
        steiner = np.array(
            [[y * y + z * z, -x * y, -x * z], [-x * y, x * x + z * z, -y * z], [-x * z, -y * z, x * x + y * y]]
        )
        axes = quaternion.matrix(solid.axes)
        own = sum(moment * np.multiply.outer(axis, axis) for moment, axis in zip(solid.inertia, axes.T, strict=True))
        inertia += mass / total * (own + steiner)
    moments, turned = principal(inertia.tolist())
    axes = quaternion.from_matrix(turned)
    volume = sum(solid.volume for solid in solids)
    return MassProperties(volume, tuple(center), moments, tuple(axes.tolist()))  # type: ignore[arg-type]
