"""How geoms of MJCF touch: which of them meet, and with what friction."""

from __future__ import annotations

from collections import Counter

from carom.worlds.importing.elements import Reading
from carom.worlds.importing.model import Piece
from carom.worlds.importing.report import Report

SOFTNESS = ("solref", "solimp", "solmix", "margin", "gap", "priority")


class Touching:
    """Reads how geoms touch; ``met`` counts the pairs of contype and conaffinity, for their layers."""

    def __init__(self, reading: Reading, report: Report) -> None:
        self.reading, self.report = reading, report
        self.met: Counter[tuple[int, int]] = Counter()
        self.smooth: list[tuple[Piece, str]] = []  # of condim 1, and whose they are

    def read(self, piece: Piece, whose: str) -> None:
        """Let a piece touch by contype and conaffinity, with its friction, the greater of which counts."""
        element, read = piece.element, self.reading
        pair = (read.whole(element, "contype", 1), read.whole(element, "conaffinity", 1))
        piece.touches = any(pair)
        if not piece.touches:
            return
        self.met[pair] += 1
        piece.layer = layer_of(pair)
        slides, *_ = read.numbers(element, "friction", 3, (1.0, 0.005, 0.0001), fewer=True)
        if slides < 0.0:
            read.fault(element, "friction must be at least 0", received=f"{slides:g}")
        piece.material = {"friction": {"value": slides, "combine": "max"}}
        dimensions = read.whole(element, "condim", 3)
        if dimensions == 1:
            self.smooth.append((piece, whose))
        if dimensions > 3:
            self.report.drop(element, "friction against spinning and rolling (condim)", whose)
        for key in SOFTNESS:
            if key in element.attributes:
                self.report.drop(element, f"softness of contacts ({key})", whose)

    def settle_friction(self) -> None:
        """Let geoms of condim 1 be without friction where all are, for it takes two of them."""
        alone = len(self.smooth) == self.met.total()
        for piece, whose in self.smooth:
            if alone:
                piece.material = {"friction": 0.0}
            else:
                what = "condim 1: there without friction on each other, here as on the rest"
                self.report.approximate(piece.element, what, whose)

    def layers(self) -> dict[str, list[str]]:
        """Return the layers: two geoms meet when the contype of one shares a bit with the other's conaffinity."""
        pairs = sorted(self.met)
        met = {one: [other for other in pairs if one[0] & other[1] or other[0] & one[1]] for one in pairs}
        return {layer_of(one): [layer_of(other) for other in met[one]] for one in pairs if layer_of(one) != "default"}


def layer_of(pair: tuple[int, int]) -> str:
    """Return the layer of a contype and conaffinity; the default ones meet whoever meets them."""
    return "default" if pair == (1, 1) else f"layer_{pair[0]}_{pair[1]}"
