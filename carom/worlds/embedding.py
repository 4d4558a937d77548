"""Embedding: the content of a file that a world names, as one that names no other files."""

from __future__ import annotations

import json
from base64 import b64encode
from mimetypes import guess_type
from pathlib import Path
from urllib.parse import unquote

BINARY = "application/octet-stream"


def content_of(path: Path) -> bytes:
    """Return what is in a file; a .gltf has its buffers and pictures in it, as far as they are there.

    They become data URIs, see the glTF 2.0 specification, section 2.8. Geometry is all that carom takes of the other
    formats, and it lies in the file itself.
    """
    content = path.read_bytes()
    if path.suffix.lower() != ".gltf":
        return content
    scene = json.loads(content)
    for part in (*scene.get("buffers", ()), *scene.get("images", ())):
        uri = part.get("uri", "data:")
        beside = path.parent / unquote(uri)
        if not uri.startswith("data:") and beside.is_file():
            kind = guess_type(beside.name)[0] or BINARY
            part["uri"] = f"data:{kind};base64,{b64encode(beside.read_bytes()).decode()}"
    return json.dumps(scene).encode()
