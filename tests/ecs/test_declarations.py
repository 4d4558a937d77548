"""What a component declares is checked where it is declared and where it is filled."""

from __future__ import annotations

import numpy as np
import pytest
from faults import error

from carom.ecs import Component, DeclarationError, Motion, Relation, Transform, World, column
from carom.ecs.component import Record


@pytest.mark.parametrize(
    ("given", "missing"),
    [({"doc": "speed"}, "unit"), ({"unit": "m/s"}, "doc"), ({}, "unit and doc")],
    ids=["no unit", "no doc", "neither"],
)
def test_unit_and_doc_are_mandatory(given: dict[str, str], missing: str) -> None:
    """Messages, labels and the schema are made from them, so no column exists without."""
    message = f'a column is declared without {missing}; write column(3, unit="m/s", doc="linear velocity")'
    with error(DeclarationError, message):
        column(3, **given)  # type: ignore[arg-type]


def test_every_column_of_carom_has_unit_and_doc() -> None:
    """The registry holds every component and relation, each with documented columns and a docstring."""
    assert {"transform", "motion", "rigid_body", "collider"} <= set(Record.registry)
    for kind in Record.registry.values():
        assert kind.__doc__, kind
        for name, declared in kind.columns.items():
            assert declared.unit and declared.doc, f"{kind.__name__}.{name}"


def test_two_components_of_one_name_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """World files and messages name components by class name, so a second of that name elsewhere is a fault."""
    monkeypatch.setattr(Record, "registry", dict(Record.registry))
    message = "two components are named Transform: carom.ecs.components.transform and elsewhere; rename one of them"
    with error(DeclarationError, message):
        type("Transform", (Component,), {"__module__": "elsewhere"})
    assert Record.registry["transform"] is Transform


def test_keys_are_snake_case(monkeypatch: pytest.MonkeyPatch) -> None:
    """The words of files and of entity views follow from the class name."""
    monkeypatch.setattr(Record, "registry", dict(Record.registry))
    made = type("HeatOfBody2", (Component,), {"__module__": __name__, "heat": column(unit="K", doc="temperature")})
    assert made.key == "heat_of_body2"
    assert list(made.columns) == ["heat"]


def test_an_unknown_column_is_refused() -> None:
    """A typing error in a bundle names the component and what it has."""
    message = (
        "Motion has no column 'velocity'; "
        "its columns are linear, angular, linear_acceleration, angular_acceleration, still, asleep"
    )
    with error(DeclarationError, message):
        Motion(velocity=(1.0, 0.0, 0.0))


def test_a_wrong_dtype_is_refused() -> None:
    """What cannot be a number is refused with component and column."""
    with error(DeclarationError, "Motion.linear takes numbers, received 'fast'"):
        Motion(linear="fast")


@pytest.mark.parametrize(
    ("bundle", "count", "message"),
    [
        (
            Transform(position=(1.0, 2.0)),
            1,
            "Transform.position takes 3 per row, received an array of shape (2,); give shape (3,)",
        ),
        (
            Transform(rotation=np.zeros((3, 4))),
            2,
            (
                "Transform.rotation takes 4 per row, received an array of shape (3, 4); "
                "give shape (4,) for all, or (2, 4) for each"
            ),
        ),
    ],
    ids=["too few numbers", "wrong number of rows"],
)
def test_a_wrong_shape_is_refused_and_leaves_nothing(bundle: Component, count: int, message: str) -> None:
    """The message says what a row takes; the failed spawn leaves neither entity nor component behind."""
    world = World()
    with error(DeclarationError, message):
        world.spawn_many(count, bundle)
    assert world.count(Transform) == 0
    assert len(world.row_numbers()) == 0
    assert world.row(world.spawn(Transform())) == 0


def test_a_wrong_shape_of_a_single_value() -> None:
    """A column of one number per row says so."""
    world = World()

    class Charge(Component):
        """Charge."""

        charge = column(unit="C", doc="electric charge")

    message = "Charge.charge takes a single value per row, received an array of shape (2,); give shape ()"
    with error(DeclarationError, message):
        world.spawn(Charge(charge=[1.0, 2.0]))
    Record.registry.pop("charge")


def test_relations_have_rows_of_their_own() -> None:
    """A relation grows by its own count and takes no rows of the entity space."""
    world = World()

    class Rod(Relation):
        """Rods."""

        a = column(unit="1", doc="first end", holds="entities")
        length = column(unit="m", doc="length")

    Record.registry.pop("rod")
    world.spawn(Transform())
    with world.faces(None):
        world.resize(Rod, 100)
        world[Rod].length[:100] = np.arange(100.0)
        world.resize(Rod, 1000)
        assert world[Rod].length[:100].tolist() == list(range(100))
    assert world.count(Rod) == 1000
    assert len(world.row_numbers()) == 1
    assert Rod.columns["a"].dtype == np.int64
    assert Rod.columns["a"].default == -1
