"""View: open a recording in the Rerun viewer."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.tools.commands.options import ending, print_json, whole_number

if TYPE_CHECKING:
    from carom.tools.showing import Spot


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the recording, where to look in it, and how to show it."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (.rrd)")
    parser.add_argument("--frame", type=whole_number, metavar="N", help="open it at this frame")
    parser.add_argument("--select", metavar="ENTITY", help="select an entity by its name")
    parser.add_argument(
        "--screenshot", type=ending(".png"), metavar="FILE", help="write a picture of the viewer instead of opening it"
    )
    parser.add_argument("--web", action="store_true", help="serve it to a browser instead of opening a window")


def execute(arguments: argparse.Namespace) -> int:
    """Hand the recording to Rerun and wait until the viewer is closed, or the browser is done with it."""
    from carom.ecs.errors import CaromError
    from carom.tools.outputs import prepare_outputs
    from carom.tools.recording import refuse_missing
    from carom.tools.showing import Service, picture, show, spot_in
    from carom.tools.viewer import has_display

    path, frame, name = arguments.file, arguments.frame, arguments.select
    refuse_missing(path)
    nowhere = frame is None and name is None and arguments.screenshot is None
    spot = None if nowhere else spot_in(path, frame, name)
    if arguments.web and arguments.screenshot:
        raise CaromError("--web: serves browsers, and --screenshot writes a picture without one; leave out either")
    if arguments.web:
        service = Service(path, spot)
        if not arguments.json:
            return service.run()
        print_json(_told(path, spot) if spot else {"command": service.words, "page": service.page})
        return 0
    if arguments.screenshot and spot:
        prepare_outputs([arguments.screenshot])
        picture(path, spot, arguments.screenshot)
        print_json({"screenshot": str(arguments.screenshot)}) if arguments.json else print(arguments.screenshot)
        return 0
    if not has_display():
        raise CaromError(f"no display to open a window on; serve it instead: carom view --web {path}")
    if arguments.json:
        print_json(_told(path, spot))
        return 0
    return show(path, spot)


def _told(path: Path, spot: Spot | None) -> dict[str, Any]:
    """Return for programs what would be shown."""
    return {"file": str(path), "frame": spot and spot.frame, "selected": spot and spot.selected}
