"""Replay: simulate a recording again, from itself alone, and tell whether it comes out the same."""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path

from carom.tools.commands.options import declare_detail, detail, ending, print_json, whole_number


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the recording, which frames, and what to write of them."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (.rrd)")
    parser.add_argument(
        "--from", dest="first", type=whole_number, metavar="N", help="first frame; by default that of it"
    )
    parser.add_argument("--to", dest="last", type=whole_number, metavar="N", help="last frame; by default that of it")
    parser.add_argument(
        "--out", type=ending(".rrd"), metavar="FILE", help="record these frames again, every step (.rrd)"
    )
    declare_detail(parser)
    parser.add_argument("--film", type=Path, metavar="FILE", help="film these frames (.mp4, .webp or .gif)")
    parser.add_argument("--picture", type=ending(".png"), metavar="FILE", help="write a picture of the last (.png)")
    parser.add_argument(
        "--write", type=ending(".yaml", ".yml"), metavar="FILE", help="write the last as a world file (.yaml)"
    )
    parser.add_argument("--camera", metavar="NAME", help="camera of film and picture; the world's 'main' by default")


def execute(arguments: argparse.Namespace) -> int:
    """Replay and print the verdict; 1 when not every bit is the same."""
    from carom.ecs.errors import CaromError
    from carom.systems.observer import Observer
    from carom.tools.filming import Filming, photograph, shot_of
    from carom.tools.outputs import prepare_outputs
    from carom.tools.painter import Painter
    from carom.tools.recorder.of_world import recorder_of
    from carom.tools.replay import Replay
    from carom.tools.retrace import retrace
    from carom.worlds import write_world

    if arguments.out and arguments.out.resolve() == arguments.file.resolve():
        raise CaromError(f"{arguments.out} is the recording itself; write another file")
    replay = Replay(arguments.file)
    first = replay.first if arguments.first is None else arguments.first
    last = replay.last if arguments.last is None else arguments.last
    if not replay.first <= first <= last <= replay.last:
        raise CaromError(
            f"frames {first} to {last} cannot be simulated again; "
            f"{replay.path} holds frames {replay.first} to {replay.last}"
        )
    loaded = replay.loaded() if first == 0 else replay.loaded_at(first)
    simulation, shot = loaded.simulation, shot_of(loaded, arguments.camera)
    level = detail(arguments, loaded.recording.detail, bool(arguments.out), "--out FILE")
    observers: list[Observer] = []
    if arguments.out:
        stated = {"title": replay.title, "source": replay.source, "files": replay.files}
        observers.append(recorder_of(loaded, shot, arguments.out, every=1, detail=level, **stated))
    if arguments.film:
        observers.append(Filming(shot, arguments.film))
    painter = Painter(simulation, shot.look)
    if arguments.picture:
        observers.append(painter)
    written = {"recording": arguments.out, "film": arguments.film, "picture": arguments.picture}
    written["world"] = arguments.write
    prepare_outputs(written.values())
    verdict = retrace(replay, loaded, last, observers)
    if arguments.picture:
        photograph(shot, simulation, arguments.picture, painter)
    if arguments.write:
        write_world(loaded, arguments.write)
    outputs = {kind: str(path) for kind, path in written.items() if path}
    if arguments.json:
        print_json(dataclasses.asdict(verdict) | {"same": verdict.same, "outputs": outputs})
    else:
        print("\n".join([verdict.text(), *(f"  {kind:<10} {path}" for kind, path in outputs.items())]))
    return 0 if verdict.same else 1
