"""A snapshot's bytes are those of its state, and a file that is no such snapshot is refused with the reason."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from heaps import bin_of_balls, hashes
from xxhash import xxh3_128_hexdigest

from carom.ecs import (
    Component,
    Material,
    Motion,
    Resource,
    SnapshotError,
    Transform,
    World,
    bytes_from_snapshot,
    column,
    first_difference,
    load_snapshot,
    restore_snapshot,
    save_snapshot,
    snapshot_from_bytes,
    state_hash,
    take_snapshot,
)
from carom.ecs.component import Record
from carom.systems.settings import Random


class Tide(Resource):
    """A resource with a state."""

    height = b"low"

    def state(self) -> bytes:
        """Return the height."""
        return self.height

    def restore(self, state: bytes) -> None:
        """Take back a height."""
        self.height = state


def altered(data: bytes, change: Any) -> bytes:
    """Return a snapshot whose header was changed and whose first line fits again."""
    _, _, body = data.partition(b"\n")
    line, _, blocks = body.partition(b"\n")
    header = json.loads(line)
    change(header)
    body = json.dumps(header).encode() + b"\n" + blocks
    return b"carom snapshot 2 %d %s\n%s" % (len(body), xxh3_128_hexdigest(body).encode(), body)


def refused(data: bytes, world: World, path: Path) -> str:
    """Return why a file of these bytes is refused, without the folder."""
    path.write_bytes(data)
    before = state_hash(world)
    with pytest.raises(SnapshotError) as fault:
        load_snapshot(path, world)
    assert state_hash(world) == before
    return str(fault.value).replace(str(path), path.name)


def test_equal_states_have_equal_bytes_in_whatever_order_things_were_made() -> None:
    """Tables and resources made in another order, read without being filled, or restored."""
    worlds = World(), World(capacity=1000)
    for world, kinds, resources in (
        (worlds[0], (Transform, Motion), (Random(1), Tide())),
        (worlds[1], (Material, Motion, Transform), (Tide(), Random(1))),
    ):
        for kind in kinds:
            world[kind]
        for resource in resources:
            world.add(resource)
        world.spawn_many(3, Transform(position=np.arange(9.0).reshape(3, 3)), Motion())
    one, other = (bytes_from_snapshot(take_snapshot(world)) for world in worlds)
    assert one == other
    assert bytes_from_snapshot(snapshot_from_bytes(one, worlds[1])) == one


def test_the_layout_is_a_line_a_list_and_little_endian_parts() -> None:
    """As the docstring says, so that other programs can read it."""
    world = World()
    world.spawn(Transform(position=(1.0, 2.0, 3.0)))
    data = bytes_from_snapshot(take_snapshot(world))
    first, header, blocks = data.split(b"\n", 2)
    magic, name, version, length, digest = first.split()
    body = data[len(first) + 1 :]
    assert (magic, name, version, int(length)) == (b"carom", b"snapshot", b"2", len(body))
    assert digest.decode() == xxh3_128_hexdigest(body)
    assert json.loads(header) == {
        "frame": 0,
        "modules": {"transform": "carom.ecs.components.transform"},
        "parts": [
            ["slots/alive", "|b1", [1]],
            ["slots/died_at", "<i8", [1]],
            ["slots/generations", "<i4", [1]],
            ["slots/id_shift", "<i4", [1]],
            ["transform#", "<i8", [1]],
            ["transform.position", "<f8", [1, 3]],
            ["transform.rotation", "<f8", [1, 4]],
        ],
    }
    assert np.frombuffer(blocks[25:49], "<f8").tolist() == [1.0, 2.0, 3.0]


def test_a_saved_file_leads_to_the_same_future_in_another_world(tmp_path: Path) -> None:
    """Among hundreds of impacts a step; saving again replaces the file as a whole."""
    simulation = bin_of_balls(40)
    simulation.step(30)
    path = tmp_path / "heap.snapshot"
    path.write_bytes(b"an earlier one")
    save_snapshot(path, take_snapshot(simulation.world))
    assert [file.name for file in tmp_path.iterdir()] == ["heap.snapshot"]
    expected = hashes(simulation, 20)
    other = bin_of_balls(40)
    loaded = load_snapshot(path, other.world)
    assert other.frame == 0
    restore_snapshot(other.world, loaded)
    assert first_difference(other.world, loaded) is None
    assert hashes(other, 20) == expected


def test_what_is_no_whole_snapshot_is_refused(tmp_path: Path) -> None:
    """By name: missing, foreign, of another version, cut off anywhere, or with one bit changed."""
    world = World()
    world.spawn(Transform())
    data = bytes_from_snapshot(take_snapshot(world))
    path = tmp_path / "game.snapshot"
    with pytest.raises(SnapshotError) as fault:
        load_snapshot(path, world)
    assert str(fault.value) == f"{path} cannot be read: No such file or directory"
    assert refused(b"", world, path) == "game.snapshot is no snapshot of carom: it begins with b''"
    assert refused(b"\x89PNG\r\n\x1a\n" + bytes(90), world, path) == (
        r"game.snapshot is no snapshot of carom: it begins with b'\x89PNG\r\n\x1a\n\x00\x00\x00\x00\x00\x00\x00\x00'"
    )
    assert refused(b"carom snapshot 1\n{}\n", world, path) == (
        "game.snapshot is of version 1, this carom reads version 2; save it anew"
    )
    assert refused(data.replace(b"shot 2", b"shot 11", 1), world, path) == (
        "game.snapshot is of version 11, this carom reads version 2; update carom"
    )
    start = data.index(b"\n") + 1
    length = len(data) - start
    for end in (start - 3, start + 40, len(data) - 1):
        missing = f"{start + length - end} of {length} bytes are" if end >= start else "the rest of its first line is"
        assert refused(data[:end], world, path) == f"game.snapshot is cut off: {missing} missing; save it anew"
    for place in (start - 3, start + 40, len(data) - 1):
        damaged = bytearray(data)
        damaged[place] ^= 1
        assert refused(bytes(damaged), world, path) == (
            "game.snapshot is damaged: its bytes are not those that were saved; save it anew"
        )
    assert refused(data + b"x", world, path) == (
        "game.snapshot is damaged: its bytes are not those that were saved; save it anew"
    )


def test_what_does_not_fit_is_told_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Unknown components with where they were declared, columns, resources: every fault, and nothing is changed."""

    class Fuel(Component):
        litres: Any = column(unit="1", doc="fuel")

    class Wing(Component):
        area: Any = column(2, unit="m2", doc="area of both")

    world = World()
    world.add(Tide())
    world.spawn(Transform(), Fuel(litres=3.0), Wing())
    data = bytes_from_snapshot(take_snapshot(world))

    def elsewhere(header: dict[str, Any]) -> None:
        header["modules"] |= {"fuel": "flying_game.parts", "wing": "__main__"}

    monkeypatch.setattr(Record, "registry", {k: v for k, v in Record.registry.items() if k not in ("fuel", "wing")})

    other = World()
    other.add(Random(1))
    assert refused(altered(data, elsewhere), other, tmp_path / "plane.snapshot") == (
        "plane.snapshot does not fit this world:\n"
        "  it holds Tide, which this world does not have; add it with world.add(Tide(...))\n"
        "  it holds component 'fuel', which nothing here declares; "
        "flying_game.parts did: import it, or install the package flying_game\n"
        "  it holds component 'wing', which nothing here declares; __main__ did: run it from there\n"
        "  it does not hold Random, whose state this world needs"
    )
    with pytest.raises(SnapshotError, match=r"^the snapshot does not fit this world:\n"):
        snapshot_from_bytes(data, other)


def test_columns_declared_otherwise_are_told(tmp_path: Path) -> None:
    """The component of today counts, not that of the file."""

    class Engine(Component):
        power: Any = column(unit="W", doc="power")
        gears: Any = column(unit="1", doc="gears", dtype="int64")

    world = World()
    world.spawn(Engine(power=3.0))
    data = bytes_from_snapshot(take_snapshot(world))

    class Engine(Component):  # type: ignore[no-redef]
        power: Any = column(3, unit="W", doc="power", dtype="float32")
        torque: Any = column(unit="N m", doc="torque")

    assert refused(data, World(), tmp_path / "car.snapshot") == (
        "car.snapshot does not fit this world:\n"
        "  it holds Engine.gears, which is no state here\n"
        "  Engine.power is float64 of shape (1,), declared here is float32 of shape (1, 3)\n"
        "  it does not hold Engine.torque"
    )
