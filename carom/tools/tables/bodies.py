"""Bodies: the pose of everything visible in every recorded frame."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Transform
from carom.ecs.column import Integers
from carom.ecs.dataframe import Flat, flat
from carom.tools.recorder.tracks.bodies import ROOT
from carom.tools.tables.source import Source, flats


def bodies(source: Source) -> list[Flat]:
    """Return a row per frame and visible entity, also in frames that did not write its pose since it stayed."""
    groups = [path for path, component in source.series if component == "entity" and path.startswith(f"/{ROOT}/")]
    parts = [_nobody(), *(_group(source, path) for path in groups)]
    frames, entities, shapes, positions, rotations = (np.concatenate(values) for values in zip(*parts, strict=True))
    order = np.lexsort((entities, frames))
    return [
        *source.keys(frames[order]),
        *source.entities("entity", "name", "handle", entities[order]),
        flat("shape", {"unit": "1", "doc": "shape it is drawn as"}, shapes[order]),
        *flats("position", Transform.columns["position"], positions[order]),
        *flats("rotation", Transform.columns["rotation"], rotations[order]),
    ]


def _group(source: Source, path: str) -> tuple[npt.NDArray[Any], ...]:
    """Return frames, handles, shapes and poses of those that look alike."""
    written = [source.series.get((path, f"InstancePoses3D:{name}")) for name in ("translations", "quaternions")]
    members, cleared = source.series[path, "entity"], source.series.get((path, "Clear:is_recursive"))
    if None in written:
        return _nobody()
    positions, rotations = (series for series in written if series)
    frames = np.array(source.frames, np.int64)
    pose, member = _last(positions.frames, frames), _last(members.frames, frames)
    here = (pose >= 0) & (pose < len(rotations.frames)) & (member >= 0)  # a kill may come between the two writes
    if cleared:
        gone = _last(cleared.frames, frames)
        here &= (gone < 0) | (np.array(cleared.frames)[gone] < np.array(members.frames)[member])
    poses = _instances(positions.values, pose[here])
    entities = np.concatenate(members.values)[_instances(members.values, member[here])]
    lengths = np.array([len(value) for value in members.values])[member[here]]
    return (
        np.repeat(frames[here], lengths),
        entities,
        np.full(len(entities), path.split("/")[2]),
        np.concatenate(positions.values)[poses],
        np.concatenate(rotations.values)[poses],
    )


def _nobody() -> tuple[npt.NDArray[Any], ...]:
    empty = np.zeros(0, np.int64)
    return empty, empty, np.zeros(0, "U1"), np.zeros((0, 3), np.float32), np.zeros((0, 4), np.float32)


def _last(written: Sequence[int], frames: Integers) -> Integers:
    """Return which row holds in each frame, -1 before the first."""
    return np.searchsorted(np.array(written), frames, side="right") - 1


def _instances(values: Sequence[npt.NDArray[Any]], rows: Integers) -> Integers:
    """Return the places of the instances of some rows in all rows one after the other."""
    lengths = np.array([len(value) for value in values])
    starts = np.cumsum(lengths) - lengths
    counts = lengths[rows]
    within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    places: Integers = np.repeat(starts[rows], counts) + within
    return places
