"""The form of a world file: sections in the order of the schema, short leaves in braces, and never another meaning."""

from __future__ import annotations

from carom.ecs.errors import CaromError
from carom.worlds.check import collection
from carom.worlds.errors import Fault, WorldError
from carom.worlds.header import with_header
from carom.worlds.layout.growing import grown
from carom.worlds.layout.printing import STEP, WIDTH, flat, is_block, lines_of
from carom.worlds.layout.tree import Collection, Entry, Scalar
from carom.worlds.reader import read
from carom.worlds.schema import document

EDITORS = "# yaml-language-server: $schema="  # the comment by which an editor finds the schema of a file
SCHEMA_FILE = "carom.schema.json"  # beside a world, it is the schema that editors are to take


def formatted(text: str, name: str, *, schema: bool = False) -> str:
    """Return the text of a world file in its one form, with the header for editors where ``schema`` lies beside it.

    Raises WorldError when the text is no world file, be it one with faults in its words.
    """
    source = read(text, name)
    with_header(source)
    source.refuse_if_faulty()
    written = printed(grown(text), schema=schema)
    if repr(sections(written)) != repr({key: source.data[key] for key in sections(written)}):
        what = "cannot be laid out anew without changing what it says; please report it with the file"
        raise WorldError([Fault(name, 0, 0, "", what)])
    return written


def sections(text: str) -> dict[str, object]:
    """Return what a text says, section by section."""
    data = read(text, "").data
    if not isinstance(data, dict):
        raise CaromError("a world file must be a mapping")
    return data


def printed(root: Collection, *, schema: bool = False) -> str:
    """Return the text of a tree, which is put into form: sections in order, leaves in braces."""
    if root.flow:
        root.flow = False
    head = _ordered(root)
    if schema and not any(line.startswith(EDITORS) for line in head):
        head.insert(0, EDITORS + SCHEMA_FILE)
    for entry in root.entries:
        _compact(entry, 0, section=True)
    lines = [*head, *lines_of(root, 0)]
    while lines and not lines[0]:
        del lines[0]
    while lines and not lines[-1]:
        del lines[-1]
    return "\n".join(lines) + "\n"


def _ordered(root: Collection) -> list[str]:
    """Put the sections in the order of the schema; return the comments that are of the file as a whole.

    Those stand before the first section and a blank line. Where values are repeated by aliases nothing is moved.
    """
    first = root.entries[0]
    length = max((number + 1 for number, line in enumerate(first.above) if not line), default=0)
    header = [line for line in first.above if line.startswith(EDITORS)]
    head = header + [line for line in first.above[:length] if line not in header]
    first.above = [line for line in first.above[length:] if line not in header]
    if not _repeats(root):
        order = {key: number for number, key in enumerate(document().model_fields)}
        root.entries.sort(key=lambda entry: order.get(entry.key.value if entry.key else "", len(order)))
    return head


def _repeats(node: Collection) -> bool:
    return bool(node.anchor) or any(
        _repeats(entry.node) if isinstance(entry.node, Collection) else entry.node.text.startswith(("&", "*"))
        for entry in node.entries
    )


def _compact(entry: Entry, indent: int, *, section: bool = False) -> None:
    """Put leaves under a key in braces where they fit on its line, but sections of many items stay as written."""
    node = entry.node
    if not isinstance(node, Collection) or not is_block(node):
        return
    for under in node.entries:
        _compact(under, indent + STEP)
    if entry.key is None or (section and _of_many(entry.key.value)) or not all(map(_is_leaf, node.entries)):
        return
    fits = indent + len(entry.key.text) + 2 + len(flat(node)) <= WIDTH
    node.flow = fits and not any(under.above for under in node.entries)


def _of_many(section: str) -> bool:
    return section not in document().model_fields or collection(section) is not None


def _is_leaf(entry: Entry) -> bool:
    """Tell whether an entry is a value, or a list of values in braces."""
    if isinstance(entry.node, Scalar):
        return not entry.node.block and '"' not in entry.node.text[1:-1] and "\\" not in entry.node.text
    return entry.node.flow and entry.node.kind is list and all(map(_is_leaf, entry.node.entries))
