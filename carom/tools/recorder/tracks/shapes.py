"""Shapes: what everybody touches others by, beside how it looks, in colours that tell something of it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from carom.ecs import Collider, Material, Transform, Visual, World
from carom.systems.shapes import SHAPES
from carom.systems.simulation import Simulation
from carom.tools.coloring import Coloring
from carom.tools.recorder.block import Columns, joined
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.legend import legend_text
from carom.tools.recorder.solids import SOLIDS, Fields, by_solid, solid_of
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "world/shapes"
LEGEND = "colours"
SCENES = {
    "material": "Shapes", "sleep": "Sleep", "island": "Islands", "layer": "Layers", "speed": "Speed",
    "energy": "Energy",
}  # fmt: skip


class Shapes(Track):
    """Colliders as solids at their poses, which all colours share: each mode of colour is a component of its name.

    A view shows the one it maps to the colours of its solids. What stands and is no solid, and the look of what only
    has a bounding box, is shown as in the view of the world.
    """

    key: ClassVar[str] = "shapes"
    detail: ClassVar[str] = "full"

    def __init__(self) -> None:
        self._colorings = {mode: Coloring(mode) for mode in SCENES}
        self._legend = ""
        self._last: dict[tuple[str, str], Columns] = {}
        self._pending: defaultdict[tuple[str, str], list[tuple[Stamp, Columns]]] = defaultdict(list)

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write how solids are filled."""
        import rerun

        for name, solid in SOLIDS.items():
            stream.static(f"{PATH}/{name}", getattr(rerun, solid.archetype).from_fields(fill_mode=solid.fill))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Add a view for each mode, and what their colours mean."""
        import rerun.blueprint as rrb

        layout.hide(PATH)
        visual, rows = world[Visual], world.row_numbers(Visual)
        scenery = [SHAPES[key].number for key in LOOKED_AT]
        layout.texts.append(rrb.TextDocumentView(origin=LEGEND, name="Colours"))
        bare = not (visual.visible[rows] & np.isin(visual.shape[rows], scenery)).any()
        for mode, name in SCENES.items():
            layout.scene(name, [f"{PATH}/**", *SCENERY], colored(mode, show_labels=False), grid=bare)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep where colliders are, and their colours, where these are not as before."""
        import rerun

        world = simulation.world
        rows = world.row_numbers(Collider, Transform)
        rows = rows[~world[Collider].sensor[rows]]
        if self.only is not None:
            rows = rows[self.only.rows(world)[rows]]
        colors = {mode: coloring.colors(world, rows) for mode, coloring in self._colorings.items()}
        unseen = ~world.table(Visual).present[rows]
        colors["material"][unseen] = world[Material].color[rows[unseen]]
        if (legend := legend_text(self._colorings, SCENES)) != self._legend:
            self._legend = legend
            stream.row(LEGEND, stamp, rerun.TextDocument(legend, media_type="text/markdown"))
        for name, drawn in by_solid(world, rows).items():
            solid, entities = SOLIDS[name], world.entities(drawn)
            if self._changed(name, "who", solid.sizes(world, drawn) | {"collider": entities}):
                self._introduce(name, stamp, stream, world.names_of(entities))
            places = np.searchsorted(rows, drawn)
            now = {mode: {mode: packed(values[places])} for mode, values in colors.items()}
            for what, columns in (("pose", solid.poses(world, drawn)), *now.items()):
                if self._changed(name, what, columns):
                    self._pending[name, what].append((stamp, columns))

    def write(self, stream: Stream) -> None:
        """Write the kept poses and colours, each as one block per solid."""
        import rerun

        for (name, what), pending in self._pending.items():
            block = joined(pending)
            archetype = getattr(rerun, SOLIDS[name].archetype)
            poses = what == "pose"
            columns = block.drawn(archetype.from_fields(**block.columns)) if poses else block.values([what])
            stream.rows(f"{PATH}/{name}", block.stamps, columns)
        self._pending.clear()

    def _changed(self, name: str, what: str, columns: Fields) -> bool:
        last = self._last.get((name, what))
        self._last[name, what] = columns
        return last is None or not all(np.array_equal(values, last[key]) for key, values in columns.items())

    def _introduce(self, name: str, stamp: Stamp, stream: Stream, names: npt.NDArray[np.str_]) -> None:
        """Write who is which instance, and their sizes; poses and colours of them all follow."""
        import pyarrow
        import rerun

        who = dict(self._last[name, "who"])
        entities, archetype = who.pop("collider"), getattr(rerun, SOLIDS[name].archetype)
        sizes = archetype.from_fields(**who, labels=names.tolist())
        stream.row(f"{PATH}/{name}", stamp, sizes, rerun.AnyValues(collider=pyarrow.array(entities)))
        for what in ("pose", *SCENES):
            self._last.pop((name, what), None)


#: Shapes that are no solids, as they look.
LOOKED_AT = [key for key, shape in SHAPES.items() if solid_of(shape) in (None, "bounding_boxes")]
SCENERY = [f"world/{key}/**" for key in LOOKED_AT]


def colored(mode: str, **fields: Any) -> dict[str, list[Any]]:
    """Return what shows the solids in the colours of a mode, with further fields of their archetypes."""
    import rerun
    from rerun.blueprint.encodings import ComponentSourceKind, VisualizerComponentMapping

    shown = {}
    for name, solid in SOLIDS.items():
        archetype = getattr(rerun, solid.archetype)
        target, source = f"{solid.archetype}:colors", ComponentSourceKind.SourceComponent
        mapping = VisualizerComponentMapping(target, source, source_component=mode)
        shown[f"{PATH}/{name}"] = [archetype.from_fields(**fields).visualizer(mappings=[mapping])]
    return shown


def packed(colors: npt.NDArray[np.float64]) -> npt.NDArray[np.uint32]:
    """Return colours (n, 4) in 0..1 as Rerun takes them, one number each."""
    bytes_ = np.rint(255.0 * np.clip(colors, 0.0, 1.0)).astype(np.uint32)
    return np.asarray(bytes_ @ np.array([1 << 24, 1 << 16, 1 << 8, 1], np.uint32), np.uint32)
