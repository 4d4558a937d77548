"""Rotations in world files: a quaternion, an axis and an angle, Euler angles, or where forward looks."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, Field, TypeAdapter, WrapValidator

from carom.ecs.spatial import quaternion
from carom.worlds.errors import WordError, shown
from carom.worlds.values import In, Vector3, Words

FORMS = "[x, y, z, w] of length 1 within 1 %, {axis, angle}, {euler, order} or {look_at}"
HAND_TYPED = 0.01  # how far from 1 the length of a quaternion may be that was meant to be unit
Rotation = tuple[float, float, float, float]


def _direction(value: Vector3) -> Vector3:
    if not any(value):
        raise WordError("must have a direction", received=shown(list(value)))
    return value


Direction = Annotated[Vector3, In("1"), AfterValidator(_direction)]


class AxisAngle(Words):
    """A turn by ``angle`` about ``axis``, by the right-hand rule."""

    axis: Direction = Field(description="axis of any length but 0")
    angle: Annotated[float, In("rad")] = Field(description="angle")

    def rotation(self) -> Any:
        """Return the quaternion xyzw."""
        return quaternion.from_axis_angle(self.axis, self.angle)


def _order(value: str) -> str:
    axes = len(value) == 3 and set(value.lower()) <= set("xyz") and (value.isupper() or value.islower())
    if not axes:
        accepted = "three of X, Y, Z for the turning axes, or of x, y, z for fixed ones"
        raise WordError("is not an order of axes", received=shown(value), accepted=accepted)
    return value


class Euler(Words):
    """Three turns one after another."""

    euler: Annotated[Vector3, In("rad")] = Field(description="angles")
    order: Annotated[str, AfterValidator(_order)] = Field("XYZ", description="axes: XYZ turning, xyz fixed")

    def rotation(self) -> Any:
        """Return the quaternion xyzw."""
        return quaternion.from_euler(self.euler, self.order)


class LookAt(Words):
    """The turn that takes forward (-z) to a direction and keeps y near ``up``."""

    look_at: Direction = Field(description="direction in the world")
    up: Direction = Field((0.0, 1.0, 0.0), description="direction y is kept near")

    def rotation(self) -> Any:
        """Return the quaternion xyzw."""
        return quaternion.look_at(self.look_at, self.up)


Quaternion = Annotated[Rotation, In("1")]
ADAPTERS: dict[str, TypeAdapter[Any]] = {
    key: TypeAdapter(form) for key, form in (("axis", AxisAngle), ("euler", Euler), ("look_at", LookAt))
}
NUMBERS: TypeAdapter[Rotation] = TypeAdapter(Quaternion)


def _read(value: Any, handler: Any) -> Rotation:
    if isinstance(value, list):
        return _unit(NUMBERS.validate_python(value))
    for key, adapter in ADAPTERS.items():
        if isinstance(value, dict) and key in value:
            x, y, z, w = adapter.validate_python(value).rotation()
            return (float(x), float(y), float(z), float(w))
    raise WordError("is not a rotation", received=shown(value), accepted=FORMS)


def _unit(value: Rotation) -> Rotation:
    length = sum(part * part for part in value) ** 0.5
    if abs(length - 1.0) > HAND_TYPED:
        what = "is not a unit quaternion" if length else "is a zero quaternion"
        raise WordError(what, received=f"{shown(list(value))} of length {length:.6g}", accepted=FORMS)
    x, y, z, w = quaternion.unit(value)
    return (float(x), float(y), float(z), float(w))


RotationWord = Annotated[Quaternion | AxisAngle | Euler | LookAt, WrapValidator(_read)]
