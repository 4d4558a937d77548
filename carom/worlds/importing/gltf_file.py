"""glTF as a file: its JSON and bytes, from one file or several below the root (registry.khronos.org/glTF, 2.0)."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any

from carom.worlds.errors import Fault, WorldError
from carom.worlds.importing.elements import Element
from carom.worlds.importing.files import ModelFiles

MAGIC, JSON, BIN = 0x46546C67, 0x4E4F534A, 0x004E4942
MOST_BYTES = 512_000_000
DATA = ";base64,"
GEOMETRY = ("accessors", "bufferViews", "materials", "textures", "images", "samplers", "extensionsUsed")


def refusal(path: Path, what: str) -> WorldError:
    """Return the error of a file that is no glTF."""
    return WorldError([Fault(str(path), 0, 0, "", f"is not glTF: {what}")])


def read_gltf_file(path: Path, files: ModelFiles) -> tuple[dict[str, Any], bytes]:
    """Return the JSON of a ``.gltf`` or ``.glb`` and the bytes of all its buffers, of which it then has one.

    Raises WorldError for what is no glTF 2.0; images in other files are left to who looks for them.
    """
    if not path.is_file():
        raise WorldError([Fault(str(path), 0, 0, "", "does not exist")])
    if path.stat().st_size > MOST_BYTES:
        raise WorldError([Fault(str(path), 0, 0, "", f"is larger than a model may be, {MOST_BYTES} bytes")])
    content = path.read_bytes()
    try:
        text, own = _chunks(content) if path.suffix.lower() == ".glb" else (content, b"")
        data = json.loads(text)
        version = str(data["asset"]["version"])
        if not version.startswith("2."):
            raise refusal(path, f"of version {version}; accepted: 2.0")
        return _with_one_buffer(data, own, path, files)
    except (ValueError, KeyError, TypeError, AttributeError, IndexError, struct.error, RecursionError) as fault:
        raise refusal(path, f"{type(fault).__name__} {fault}") from None


def single_mesh(data: dict[str, Any], number: int, content: bytes) -> bytes:
    """Return a ``.glb`` of one mesh alone, at the origin."""
    kept = {key: data[key] for key in GEOMETRY if key in data}
    whole = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}]}
    whole |= kept | {"meshes": [data["meshes"][number]], "buffers": [{"byteLength": len(content)}]}
    text = json.dumps(whole).encode()
    text += b" " * (-len(text) % 4)
    content += b"\0" * (-len(content) % 4)
    chunks = struct.pack("<II", len(text), JSON) + text + struct.pack("<II", len(content), BIN) + content
    return struct.pack("<III", MAGIC, 2, 12 + len(chunks)) + chunks


def _chunks(content: bytes) -> tuple[bytes, bytes]:
    """Return the JSON and the bytes of a ``.glb``."""
    magic, _, _ = struct.unpack_from("<III", content)
    if magic != MAGIC:
        raise ValueError("has no header of a .glb")
    at, found = 12, {JSON: b"", BIN: b""}
    while at + 8 <= len(content):
        length, kind = struct.unpack_from("<II", content, at)
        found.setdefault(kind, content[at + 8 : at + 8 + length])
        found[kind] = found[kind] or content[at + 8 : at + 8 + length]
        at += 8 + length
    return found[JSON], found[BIN]


def _with_one_buffer(data: dict[str, Any], own: bytes, path: Path, files: ModelFiles) -> tuple[dict[str, Any], bytes]:
    """Return the data with its buffers and images as one buffer."""
    place = Element("glTF", {}, str(path), 0)
    whole, starts = bytearray(), []
    for buffer in data.get("buffers", []):
        content = _content(buffer["uri"], place, files) if "uri" in buffer else own
        if content is None or len(content) < buffer["byteLength"]:
            raise ValueError("a buffer is not there, or shorter than it says")
        starts.append(len(whole))
        whole += content + b"\0" * (-len(content) % 4)
    for view in data.get("bufferViews", []):
        view["byteOffset"] = view.get("byteOffset", 0) + starts[view["buffer"]]
        view["buffer"] = 0
    for image in data.get("images", []):
        if "uri" in image and (content := _content(image.pop("uri"), place, files)) is not None:
            image["bufferView"] = len(data["bufferViews"])
            image.setdefault("mimeType", "image/jpeg" if content[:2] == b"\xff\xd8" else "image/png")
            data["bufferViews"].append({"buffer": 0, "byteOffset": len(whole), "byteLength": len(content)})
            whole += content + b"\0" * (-len(content) % 4)
    return data, bytes(whole)


def _content(uri: str, place: Element, files: ModelFiles) -> bytes | None:
    """Return the bytes that a URI holds or names."""
    if uri.startswith("data:"):
        return base64.b64decode(uri.partition(DATA)[2])
    path = files.find(place, uri, "")
    return None if path is None else path.read_bytes()
