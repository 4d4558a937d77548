"""Dataframes: queries and tables as flat columns that hold the same bits, with names, gaps and units."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pyarrow
import pytest
from faults import error

from carom.ecs import (
    Component,
    DeclarationError,
    Motion,
    Name,
    Parent,
    Relation,
    RigidBody,
    Transform,
    World,
    column,
    state_hash,
    tag,
)
from carom.ecs.relations.contact import Contact
from carom.systems.simulation import Simulation


class Strain(Component):
    """Columns of every shape and type."""

    tensor = column(2, 2, unit="1", doc="strain")
    layers = column(5, unit="m", doc="thickness of each layer", dtype="float32")
    label = column(unit="1", doc="what the lab calls it", dtype="U8", default="")
    broken = column(unit="1", doc="gave way", dtype="bool")
    grips = column(2, unit="1", doc="who holds it", holds="entities")


class Wire(Relation):
    """Who is wired to whom."""

    a = column(unit="1", doc="first", holds="entities")
    b = column(unit="1", doc="second", holds="entities")
    length = column(unit="m", doc="length at rest")


def mixed() -> tuple[World, dict[str, int]]:
    """Return a world with names, gaps, a tag and a parent, and its handles by name."""
    world = World()
    ball = world.spawn(Transform(position=(1.0, 2.0, 3.0)), Motion(linear=(0.1, np.nan, -0.0)), name="ball")
    gone = world.spawn(Transform())
    cart = world.spawn(Transform(), RigidBody(type=1), tag("fast")(), name="cart")
    hook = world.spawn(Transform(), Parent(entity=cart))
    world.despawn(gone)
    return world, {"ball": ball, "cart": cart, "hook": hook, "gone": gone}


def test_a_query_holds_the_same_bits() -> None:
    """One column per number, called by its path, with handle and name in front."""
    world, _ = mixed()
    world.spawn_many(50, Transform(position=np.random.default_rng(1).normal(size=(50, 3))), Motion())
    query = world.query(Transform, Motion)
    table = query.arrow()
    names = ["entity", "name", *(f"transform.position.{axis}" for axis in "xyz")]
    names += [f"transform.rotation.{axis}" for axis in "xyzw"]
    for name, declared in Motion.columns.items():
        names += [f"motion.{name}.{axis}" for axis in "xyz"] if declared.shape else [f"motion.{name}"]
    assert table.column_names == names
    assert table["entity"].to_numpy().tolist() == query.entities.tolist()
    assert table["name"].to_pylist() == ["ball"] + [None] * 50
    for kind in (Transform, Motion):
        for name, declared in kind.columns.items():
            values = getattr(world[kind], name)[query.rows]
            for i, part in enumerate(values.reshape(len(values), -1).T):
                held = table[f"{kind.key}.{name}.{'xyzw'[i]}" if declared.shape else f"{kind.key}.{name}"]
                assert held.null_count == 0
                assert np.ascontiguousarray(held.to_numpy()).tobytes() == part.tobytes()


def test_fields_carry_unit_and_meaning() -> None:
    """What the column declares goes along."""
    schema = mixed()[0].query(Transform, tag("fast")).arrow().schema
    about = {field.name: (field.metadata[b"unit"].decode(), field.metadata[b"doc"].decode()) for field in schema}
    assert about["transform.position.y"] == ("m", "position of the origin in the world frame")
    assert about["entity"] == ("1", "handle")
    assert about["name"] == ("1", "name, where it has one")
    assert about["fast"] == ("1", "The tag fast.")


def test_optional_components_leave_gaps_and_tags_are_booleans() -> None:
    """Where an entity lacks a component there is null, not the zero of the table."""
    world, handles = mixed()
    table = world.query(Transform, optional=(RigidBody, tag("fast"), Name, Parent)).arrow()
    assert table["name"].to_pylist() == ["ball", "cart", None]
    assert table["rigid_body.mass"].to_pylist() == [None, 1.0, None]
    assert table["rigid_body.type"].to_pylist() == [None, 1, None]
    assert table["fast"].to_pylist() == [False, True, False]
    assert table["parent.entity"].to_pylist() == [None, None, handles["cart"]]
    assert table["parent.entity.name"].to_pylist() == [None, None, "cart"]


def test_columns_of_every_shape_and_type() -> None:
    """Matrices and long rows are numbered; whoever is gone has a handle and no name."""
    world, handles = mixed()
    world.attach(
        handles["ball"],
        Strain(tensor=[[1.0, 2.0], [3.0, 4.0]], layers=range(5), label="ü", broken=True, grips=(handles["cart"], -1)),
    )
    world.despawn(handles["cart"])
    row = world.query(Strain).arrow().to_pylist()[0]
    grips = {f"strain.grips.{axis}": handle for axis, handle in (("x", handles["cart"]), ("y", -1))}
    assert row == {
        "entity": handles["ball"],
        "name": "ball",
        **{f"strain.tensor.{i}.{j}": 1.0 + 2 * i + j for i in range(2) for j in range(2)},
        **{f"strain.layers.{i}": float(i) for i in range(5)},
        "strain.label": "ü",
        "strain.broken": True,
        **grips,
        **{f"{path}.name": None for path in grips},
    }
    assert world.query(Strain).arrow().schema.field("strain.layers.0").type == pyarrow.float32()


def test_no_rows_have_the_same_columns() -> None:
    """The schema follows from what is asked for, not from who is there."""
    world, _ = mixed()
    full, empty = world.query(Transform, optional=Strain).arrow(), World().query(Transform, optional=Strain).arrow()
    assert empty.num_rows == 0
    assert empty.schema == full.schema
    assert World()[Wire].arrow().schema.names == ["a", "a.name", "b", "b.name", "length"]


def test_the_table_of_a_kind() -> None:
    """A component's table is the query for it; a relation's has its rows, and names of whom they hold."""
    world, handles = mixed()
    assert world[Transform].arrow() == world.query(Transform).arrow()
    world.table(Wire).resize(2)
    with world.edit(Wire) as wire:
        wire.a[:2], wire.b[:2], wire.length[:2] = handles["ball"], [handles["cart"], handles["gone"]], [0.5, 0.25]
    assert world[Wire].arrow().to_pydict() == {
        "a": [handles["ball"]] * 2,
        "a.name": ["ball"] * 2,
        "b": [handles["cart"], handles["gone"]],
        "b.name": ["cart", None],
        "length": [0.5, 0.25],
    }


def test_contacts_of_a_simulation() -> None:
    """Who lies on what, straight from the step."""
    simulation = Simulation()
    simulation.add(name="floor", collider={"plane": {"normal": (0, 1, 0), "offset": 0}})
    simulation.add(
        name="ball", collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0}, transform={"position": (0, 0.1, 0)}
    )
    before = state_hash(simulation.world)
    assert simulation.world[Contact].arrow().num_rows == 0
    assert state_hash(simulation.world) == before
    simulation.step(3)
    rows = simulation.world[Contact].arrow().to_pylist()
    assert [(row["a.name"], row["b.name"]) for row in rows] == [("floor", "ball")]
    assert rows[0]["normal.y"] == simulation.world[Contact].normal[0, 1]


def test_later_steps_do_not_reach_a_table() -> None:
    """A table is what was when it was asked for."""
    world, _ = mixed()
    table = world[Transform].arrow()
    with world.edit(Transform) as transform:
        transform.position[:] = 9.0
    assert table["transform.position.x"].to_pylist() == [1.0, 0.0, 0.0]


def test_whoever_takes_arrow_streams_takes_queries_and_tables() -> None:
    """The PyCapsule protocol, as often as it is asked for."""
    world, _ = mixed()
    query = world.query(Transform)
    assert pyarrow.table(query) == pyarrow.table(query) == query.arrow()
    assert pyarrow.RecordBatchReader.from_stream(query).read_all() == query.arrow()
    assert pyarrow.table(world[Wire]) == world[Wire].arrow()


def test_polars() -> None:
    """By method and by constructor."""
    polars = pytest.importorskip("polars")
    world, handles = mixed()
    query = world.query(Transform, optional=RigidBody)
    frame = query.polars()
    assert frame.equals(polars.DataFrame(query))
    assert frame["transform.position.x"].to_list() == [1.0, 0.0, 0.0]
    assert frame["rigid_body.type"].to_list() == [None, 1, None]
    assert frame.filter(polars.col("name") == "cart")["entity"].item() == handles["cart"]
    assert world[Wire].polars().shape == (0, 5)


def test_pandas() -> None:
    """Plain NumPy types, but for whole numbers and booleans with gaps, which would lose bits as floats."""
    pandas = pytest.importorskip("pandas")
    world, handles = mixed()
    frame = world.query(Transform, optional=(RigidBody, Parent)).pandas()
    assert frame["transform.position.x"].to_numpy().tobytes() == np.array([1.0, 0.0, 0.0]).tobytes()
    assert frame["entity"].dtype == np.int64
    assert frame["rigid_body.mass"].dtype == np.float64
    assert frame["parent.entity"].isna().tolist() == [True, True, False]
    assert frame["parent.entity"][2] == handles["cart"]
    assert frame["parent.entity"].dtype == pandas.ArrowDtype(pyarrow.int64())
    assert frame.set_index("name").loc["ball", "transform.position.y"] == 2.0


@pytest.mark.parametrize("package", ["pandas", "polars"])
def test_a_package_that_is_not_there(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message is the command to type."""
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ModuleNotFoundError, match=f"^{package} is not installed; pip install {package}$"):
        getattr(World()[Transform], package)()


def test_a_bundle_is_no_table() -> None:
    """What `Transform(...)` makes goes into spawn."""
    message = "Transform(...) is a bundle for spawn, not a table; write world[Transform]"
    with error(DeclarationError, message):
        Transform(position=(0.0, 1.0, 0.0)).arrow()


def test_arrow_is_loaded_when_it_is_asked_for() -> None:
    """`import carom` stays quick."""
    code = "import sys, carom.ecs; sys.exit(any(name in sys.modules for name in ('pyarrow', 'pandas', 'polars')))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
