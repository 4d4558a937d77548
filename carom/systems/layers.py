"""Layers: who collides with whom, by name."""

from __future__ import annotations

from collections.abc import Iterable

from carom.ecs.component import Resource
from carom.ecs.errors import DeclarationError, did_you_mean

EVERYTHING = -1
MOST_LAYERS = 62


class Layers(Resource):
    """Named layers; two colliders meet when each one's mask holds the other's bit. ``none`` meets nobody."""

    def __init__(self) -> None:
        self.bits: dict[str, int] = {"none": 0, "default": 1}
        self.masks: dict[str, int] = {"none": 0, "default": EVERYTHING}

    def define(self, accepts: dict[str, Iterable[str] | None]) -> None:
        """Add layers, each with the names it collides with (None: all); names may refer to each other."""
        for name in accepts:
            if name not in self.bits:
                if len(self.bits) > MOST_LAYERS:
                    raise DeclarationError(f"at most {MOST_LAYERS} layers fit, '{name}' is one too many")
                self.bits[name] = 1 << (len(self.bits) - 1)
        for name, others in accepts.items():
            self.masks[name] = EVERYTHING if others is None else self.mask(others)

    def bit(self, name: str) -> int:
        """Return the bit of a layer; raise DeclarationError with near names for an unknown one."""
        if name not in self.bits:
            hint = did_you_mean(name, self.bits) or f"the layers are {', '.join(self.bits)}"
            raise DeclarationError(f"unknown layer {name!r}; {hint}")
        return self.bits[name]

    def mask(self, names: Iterable[str]) -> int:
        """Return the bits of several layers."""
        total = 0
        for name in names:
            total |= self.bit(name)
        return total
