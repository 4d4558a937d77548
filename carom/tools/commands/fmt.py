"""Fmt: put world files into one form; comments stay, and what the files say."""

from __future__ import annotations

import argparse
import difflib
import sys
from pathlib import Path

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the files, and what is done instead of writing them."""
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="world files")
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 where a file is not in form")
    parser.add_argument("--diff", action="store_true", help="write nothing; print what would change")


def execute(arguments: argparse.Namespace) -> int:
    """Write files that are not in form and name them; 1 when ``--check`` names one, 2 when one cannot be read."""
    from carom.worlds import library
    from carom.worlds.errors import WorldError
    from carom.worlds.layout import formatted
    from carom.worlds.layout.form import SCHEMA_FILE

    unlike, unread = [], []
    for path in arguments.files:
        try:
            text = library.read_text(path, str(path))
            written = formatted(text, str(path), schema=(path.parent / SCHEMA_FILE).is_file())
        except WorldError as fault:
            unread.append(str(path))
            print(fault, file=sys.stderr)
            continue
        if written == path.read_bytes().decode():
            continue
        unlike.append(str(path))
        if not (arguments.check or arguments.diff):
            path.write_text(written, encoding="utf-8", newline="\n")
        if arguments.diff and not arguments.json:
            before, after = text.splitlines(keepends=True), written.splitlines(keepends=True)
            sys.stdout.writelines(difflib.unified_diff(before, after, str(path), str(path)))
    kept = arguments.check or arguments.diff
    if arguments.json:
        print_json({"changed": [] if kept else unlike, "to_change": unlike if kept else [], "unread": unread})
    elif arguments.check or not arguments.diff:
        print("".join(f"{'not in form' if kept else 'changed'}  {path}\n" for path in unlike), end="")
    return 2 if unread else int(arguments.check and bool(unlike))
