"""Registries: classes by their key, which only one class may have."""

from __future__ import annotations

from typing import Any, ClassVar, TypeVar

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


class Keyed:
    """A class whose subclasses are known by the ``key`` they state; its base says where: ``registry=LAWS``.

    ``kinds`` is what they are called when two have one key.
    """

    key: ClassVar[str] = ""
    _registry: ClassVar[dict[str, Any]]
    _kinds: ClassVar[str]

    def __init_subclass__(cls, *, registry: dict[str, Any] | None = None, kinds: str = "", **options: Any) -> None:
        super().__init_subclass__(**options)
        if registry is not None:
            cls._registry, cls._kinds = registry, kinds
        elif "key" in vars(cls):
            enter(cls._registry, cls.key, cls, clash=f"{cls._kinds} have the key", mend="give one of them another key")
