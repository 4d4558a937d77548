"""Stream: the velocity that all bodies share, as seen from which they come less far."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.component import Resource


class Stream(Resource):
    """How far bodies reach is around where the stream takes them, so that a crowd costs as much wherever it goes.

    ``motion`` (2, 3) is its velocity (m/s) and its way (m) since detection. What stands and who sleeps ``passes`` by as
    far (m) within what is foreseen. There is none, as zeros say, where few are awake, where not nearly all of them go
    one way, or where they come no farther than they are large. Made anew in each detection; ``gone`` (3,) is how far
    (m) streams went before.
    """

    def __init__(self) -> None:
        self.motion: Floats = np.zeros((2, 3))
        self.gone: Floats = np.zeros(3)
        self.passes = 0.0
