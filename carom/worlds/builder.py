"""World files to simulations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from carom.ecs.column import Floats
from carom.ecs.hierarchy import compose
from carom.systems.settings import Random
from carom.systems.shapes import Shape
from carom.systems.simulation import Simulation
from carom.worlds import library
from carom.worlds.amounts import few_enough
from carom.worlds.camera import Camera, check_cameras
from carom.worlds.comers import all_names
from carom.worlds.embedding import content_of
from carom.worlds.errors import WordError, WorldError
from carom.worlds.events import add_events, with_prefabs
from carom.worlds.expect import Expectation, read_expectations
from carom.worlds.files import WorldFiles
from carom.worlds.filling import checked_sections, filled, unfolded
from carom.worlds.forces import add_forces
from carom.worlds.founding import founded
from carom.worlds.generators import Setting
from carom.worlds.geometry import GeometryReader
from carom.worlds.header import with_header
from carom.worlds.include import Includes
from carom.worlds.measuring import measured
from carom.worlds.names import known, whole_of_copy
from carom.worlds.oracle import read_oracle
from carom.worlds.pictures import Pictures
from carom.worlds.populate import Populator
from carom.worlds.reader import read
from carom.worlds.run import RunPlan, plan
from carom.worlds.sections import RecordingWords, Render
from carom.worlds.source import Source
from carom.worlds.state import take_state
from carom.worlds.uncollected import uncollected
from carom.worlds.unfold import Item

UP = {"y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@dataclass
class LoadedWorld:
    """A world file ready to run; ``document`` is its plain data and ``up`` the direction pictures keep upright.

    ``warnings`` are lines for the user on what the file can be used without, such as triangles without area; ``files``
    are those that it names or includes, by its words for them; ``source`` knows where each of its words stands,
    ``places`` which of them an entity is of, and ``models`` what was made of its model files.
    """

    simulation: Simulation
    document: dict[str, Any]
    path: str
    source_text: str
    run: RunPlan
    expectations: list[Expectation]
    name: str = ""
    description: str = ""
    up: tuple[float, float, float] = UP["y"]
    cameras: dict[str, Camera] = field(default_factory=dict)
    render: Render = field(default_factory=lambda: Render.model_validate({}))
    recording: RecordingWords = field(default_factory=lambda: RecordingWords.model_validate({}))
    warnings: list[str] = field(default_factory=list)
    files: dict[str, Path] = field(default_factory=dict)
    source: Source = field(default_factory=lambda: Source("", ""))
    places: dict[int, tuple[str | int, ...]] = field(default_factory=dict)
    models: dict[tuple[Any, ...], Shape] = field(default_factory=dict)

    def contents(self) -> dict[str, bytes]:
        """Return what is in its files, by the words of the world for them; none needs another file beside it."""
        return {word: content_of(path) for word, path in self.files.items()}


def load_world(world: str | Path, *, checked: bool | None = None, **options: Any) -> LoadedWorld:
    """Load a world from a file or, by its name, from the library; ``options`` override settings of the file.

    ``load_world("billiards", collision="fcl", seed=3)``: every field of `Settings` is an option. Raises WorldError with
    all faults of the file at once.
    """
    path = library.find(world)
    name = path.name if str(world) in library.names() and not Path(world).is_file() else str(world)
    return load_text(library.read_text(path, name), name, path.parent, checked=checked, **options)


@uncollected()
def load_text(
    text: str,
    name: str = "world.yaml",
    folder: Path | None = None,
    *,
    files: Mapping[str, Path] | None = None,
    checked: bool | None = None,
    **options: Any,
) -> LoadedWorld:
    """Load a world from the text of a file that lies, or would lie, in ``folder``; mesh files are found from there.

    ``files`` says of some where they are, by the words of the text for them.
    """
    files_of_world = WorldFiles(folder or Path(), files or {})
    try:
        return _loaded(text, name, files_of_world, checked, options)
    except WorldError as fault:
        fault.files = [*files_of_world.used.values()]
        raise


def _loaded(
    text: str, name: str, files_of_world: WorldFiles, checked: bool | None, options: dict[str, Any]
) -> LoadedWorld:
    source = read(text, name)
    with_header(source)
    Includes(source, files_of_world).take(source, (Path(name).name,))
    data, prefabs = filled(source, source.data)
    values = checked_sections(source, with_prefabs(prefabs, data))
    simulation = founded(source, values, checked, options)
    up, geometries = UP[values["up"]].index(1.0), GeometryReader(files_of_world)
    setting = Setting(up, simulation.world[Random].generator)

    def measure(some: list[Item]) -> tuple[Floats, Floats] | None:
        apart = founded(source, values, checked, options)
        return measured(Populator(source, apart, geometries, Setting(up, apart.world[Random].generator)), some)

    items = unfolded(source, prefabs, data.get("entities", []), setting, measure)
    populator = Populator(source, simulation, geometries, setting)
    if few_enough(source, items):
        populator.add_all(items)
    there = {whole_of_copy(name) for name in simulation.world.names()}
    source.excused = {item.name for item in items if item.name is not None} - there
    populator.intake.connections.point_all()
    with source.telling(("entities",)):
        if not source.faults:
            compose(simulation.world)
            populator.weigh_all()
    with source.telling(("entities",)):
        populator.join_all()
    add_forces(source, simulation, values["forces"])
    take_state(source, simulation.world, values["state"])
    with source.telling(("events",)):
        add_events(source, populator.intake, values["events"])
    simulation.world.add(Pictures(values["cameras"]))
    if values["oracle"]:
        look_up = prefabs.variables.look_up
        with source.telling(("oracle",)):
            simulation.world.add(read_oracle(source, simulation.world, values["oracle"], look_up))
    expectations: list[Expectation] = []
    with source.telling(("expect",)):
        expectations = read_expectations(source, simulation, values["expect"])
    with source.telling(("run",)):
        run = plan(values["run"], simulation.settings.dt)
    check_cameras(source, values["cameras"], all_names(simulation.world))
    if values["render"] is not None and values["render"].camera is not None:
        try:
            known("camera", values["render"].camera, values["cameras"])
        except WordError as fault:
            source.report_value(("render", "camera"), fault)
    source.refuse_if_faulty()
    render = values["render"] or Render.model_validate({})
    recording = values["recording"] or RecordingWords.model_validate({})
    return LoadedWorld(
        simulation, data, name, text, run, expectations,
        values["name"], values["description"], UP[values["up"]], values["cameras"], render, recording, source.warnings,
        files_of_world.used, source, populator.intake.places_in_file, populator.intake.geometries.known,
    )  # fmt: skip
