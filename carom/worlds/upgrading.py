"""Upgrading: files of earlier versions of the format become those of today's, in their tree, so that comments stay."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from carom.worlds.errors import Fault, WorldError, shown
from carom.worlds.header import VERSION, with_header
from carom.worlds.layout import Collection, Scalar, grown, printed
from carom.worlds.reader import read

Step = Callable[[Collection], None]

STEPS: dict[int, Step] = {}  # by the version that a step leaves; each changes the tree to the one after


def upgraded(text: str, name: str, *, steps: Mapping[int, Step] = STEPS, version: int = VERSION) -> tuple[str, int]:
    """Return the text of a file in the words of ``version``, and the version that it was in.

    A text of that version comes back as it is. Raises WorldError when it is no world file or of a later version.
    """
    source = read(text, name)
    source.refuse_if_faulty()
    stated = source.data.get("carom") if isinstance(source.data, dict) else None
    if stated == version and not isinstance(stated, bool):
        return text, version
    if not isinstance(stated, int) or isinstance(stated, bool) or not 1 <= stated < version:
        with_header(source)
        place = source.position(("carom",))
        raise WorldError([Fault(name, *place, "carom", "unknown version", shown(stated), f"1 to {version}")])
    root = grown(text)
    for number in range(stated, version):
        steps[number](root)
    root.entry(("carom",)).node = Scalar(str(version), str(version), plain=True)
    return printed(root), stated
