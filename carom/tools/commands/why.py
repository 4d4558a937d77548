"""Why: what moved a body in a frame and where that began, why it is awake, why two do not touch."""

from __future__ import annotations

import argparse

from carom.tools.commands.options import print_json, whole_number


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the run and the question."""
    parser.add_argument("run", metavar="RUN", help="a recording (.rrd), a world file, or the name of a library world")
    asked = parser.add_mutually_exclusive_group(required=True)
    asked.add_argument("--moved", metavar="NAME", help="what changed a body's velocity in a frame, and who began it")
    asked.add_argument("--awake", metavar="NAME", help="who keeps a body and its island from falling asleep")
    asked.add_argument("--no-contact", nargs=2, metavar="NAME", help="what keeps two entities from touching")
    parser.add_argument("--frame", type=whole_number, metavar="N", help="in that frame; by default the last")


def execute(arguments: argparse.Namespace) -> int:
    """Print the answer."""
    from carom.systems.detection.why import why_no_contact
    from carom.systems.why_awake import why_awake
    from carom.tools.reasons import motion
    from carom.tools.side import Side

    side = Side(arguments.run)
    frame = side.last if arguments.frame is None else arguments.frame
    if arguments.moved:
        found = motion(side, arguments.moved, frame)
        print_json(found.values()) if arguments.json else print(found.text())
        return 0
    simulation = side.simulation_at(frame)
    if arguments.awake:
        answer = why_awake(simulation, arguments.awake)
    else:
        answer = why_no_contact(simulation, *arguments.no_contact)
    print_json({"frame": frame, "answer": answer}) if arguments.json else print(f"frame {frame}: {answer}")
    return 0
