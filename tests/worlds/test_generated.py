"""Columns that a user declares are words of files, of their type, shape and unit."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError, create_model

from carom.ecs import Component, World, column
from carom.worlds.generated.columns import column_fields
from carom.worlds.values import Words


class Sundries(Component):
    """Columns of every kind that carom's own components in files have none of."""

    title = column(unit="1", doc="text", dtype="U4", default="none")
    pips = column(unit="1", doc="small whole number", dtype="uint8", default=6)
    doors = column(2, unit="1", doc="flags", dtype="bool")
    strain = column(2, 3, unit="m", doc="matrix")
    rotation = column(unit="rad", doc="an angle, no quaternion")


@pytest.mark.parametrize(
    ("stated", "held", "refused"),
    [
        ({"title": "abcd"}, "abcd", {"title": "abcde"}),
        ({"pips": 255}, 255, {"pips": 256}),
        ({"doors": [True, False]}, (True, False), {"doors": [True]}),
        ({"strain": [[1, 2, "3 mm"], [4, 5, 6]]}, ((1.0, 2.0, 0.003), (4.0, 5.0, 6.0)), {"strain": [1, 2, 3, 4, 5, 6]}),
        ({"rotation": "180 deg"}, math.pi, {"rotation": [0, 0, 0, 1]}),
    ],
)
def test_columns_of_every_kind_are_read_into_what_they_hold(
    stated: dict[str, Any], held: Any, refused: dict[str, Any]
) -> None:
    """By type, shape and unit; the bundle takes it, and what would be cut off or wrapped round is refused."""
    model = create_model("Sundries", __base__=Words, **column_fields(Sundries, *Sundries.columns))
    ((name, value),) = model.model_validate(stated).model_dump(exclude_unset=True).items()
    assert value == held
    world = World()
    entity = world.spawn(Sundries(**{name: value}))
    assert np.array_equal(getattr(world[entity].sundries, name), np.array(held))
    with pytest.raises(ValidationError):
        model.model_validate(refused)
    assert model.model_json_schema()["properties"].keys() == Sundries.columns.keys()
