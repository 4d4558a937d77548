"""Registries: classes by their key, which only one class may have."""

from __future__ import annotations

from typing import TypeVar

from carom.ecs.errors import DeclarationError

K = TypeVar("K", str, int)
T = TypeVar("T")


def enter(registry: dict[K, type[T]], key: K, kind: type[T], *, clash: str, mend: str) -> None:
    """Enter a class; raise DeclarationError when another module's class has the key.

    A module that is loaded anew, as notebooks do, replaces its own classes.
    """
    known = registry.get(key)
    if known is not None and known.__module__ != kind.__module__:
        raise DeclarationError(f"two {clash} {key!r}: {known.__module__} and {kind.__module__}; {mend}")
    registry[key] = kind
