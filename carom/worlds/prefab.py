"""Prefabs: words an entity extends, its own words winning, with parameters that each entity may state."""

from __future__ import annotations

from typing import Any

from carom.systems.joints import JOINTS
from carom.systems.shapes import SHAPES
from carom.worlds.errors import Path, WordError
from carom.worlds.names import known
from carom.worlds.source import Source
from carom.worlds.variables import Variables

MEMBERS = "entities"  # of a group: each is filled in for itself, since it may have parameters of its own
KEPT = (MEMBERS, "parameters")


class Prefabs:
    """The prefabs of a world; what extends them is filled in with its parameters."""

    def __init__(self, source: Source, prefabs: Any, variables: Variables) -> None:
        self.source, self.variables = source, variables
        self.stated = {} if prefabs is None else prefabs
        self.prefabs: dict[str, Any] = prefabs if isinstance(prefabs, dict) else {}

    def extended(self, path: Path, words: Any, outer: Variables | None = None) -> tuple[Any, Variables]:
        """Return an entity's words laid over those of its prefab and of the prefab's own, and its parameters.

        ``outer`` are the parameters of the group around it. An unknown prefab or parameter is reported.
        """
        outer = outer or self.variables
        if not isinstance(words, dict):
            return words, outer
        if isinstance(words.get("parameters"), dict) and not is_prefab(path):  # stated in the words of who is around
            words = words | {"parameters": outer.fill(words["parameters"], (*path, "parameters"))}
        words = self._chained(path, words)
        if "parameters" in words:
            outer = Variables(self.source, (*path, "parameters"), words["parameters"], outer)
            outer.settle_all()
        if not self.source.computes:
            return words, outer
        kept = {key: value for key, value in words.items() if key in KEPT}
        return outer.fill({key: words[key] for key in words if key not in KEPT}, path) | kept, outer

    def _chained(self, path: Path, words: dict[str, Any]) -> dict[str, Any]:
        chain = [path]
        stated = words.get("parameters")
        while isinstance(words.get("prefab"), str):
            name, here = words["prefab"], chain[-1]
            base: Path = ("prefabs", name)
            words = {key: value for key, value in words.items() if key != "prefab"}
            if name not in self.prefabs:
                try:
                    known("prefab", name, self.prefabs)
                except WordError as fault:
                    self.source.report_value((*here, "prefab"), fault)
                break
            if base in chain:
                self.source.report((*here, "prefab"), "extends itself", received=repr(name))
                break
            if not isinstance(self.prefabs[name], dict):
                break  # told of the prefab itself
            self.source.inherits[here] = base
            words = merged(self.prefabs[name], words)
            chain.append(base)
        if not is_prefab(path):  # which may declare more than those it extends
            self._refuse_unknown(path, stated, chain[1:])
        return dict(words)

    def _refuse_unknown(self, path: Path, stated: Any, chain: list[Path]) -> None:
        """Report parameters that an entity states and no prefab of it declares."""
        said = [self.prefabs[str(base)].get("parameters") or {} for _, base in chain]
        if not all(isinstance(parameters, dict) for parameters in said):
            return  # told of the prefab itself
        declared = [name for parameters in said for name in parameters]
        for name in stated if isinstance(stated, dict) else ():
            try:
                known("parameter", name, declared)
            except WordError as fault:
                self.source.report_value((*path, "parameters", name), fault)


def is_prefab(path: Path) -> bool:
    """Tell whether a path is that of a prefab, rather than of an entity."""
    return path[0] == "prefabs" and len(path) == 2


def merged(under: Any, over: Any) -> Any:
    """Return mappings merged to the depth; a rotation is taken whole, a shape or joint takes the place of another."""
    if not (isinstance(under, dict) and isinstance(over, dict)):
        return over
    result = dict(under)
    for kinds in (SHAPES, JOINTS):
        if any(key in kinds for key in over):
            result = {key: value for key, value in result.items() if key not in kinds or key in over}
    for key, value in over.items():
        result[key] = merged(result[key], value) if key in result and key != "rotation" else value
    return result
