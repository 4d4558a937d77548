"""A real browser for tests: Chromium without a window, told what to do over a pair of pipes."""

from __future__ import annotations

import io
import json
import os
import shutil
import subprocess
from base64 import b64decode
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import IO, Any

import numpy as np
from PIL import Image

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
OPTIONS = (
    "--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-sync",
    "--disable-background-networking", "--disable-component-update", "--remote-debugging-pipe",
    "--force-device-scale-factor=1", "--hide-scrollbars",
)  # fmt: skip
FLAT = ("--disable-gpu",)
# What WebGL takes where there is no graphics card.
GRAPHICS = (
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
)


class Browser:
    """A page, by Chromium's DevTools protocol: JSON ended by a zero byte, one way through each pipe."""

    def __init__(self, write: IO[bytes], read: IO[bytes]) -> None:
        self._write, self._read = write, read
        self._numbers = count(1)
        self._session: dict[str, str] = {}
        target = self._ask("Target.createTarget", url="about:blank")["targetId"]
        attached = self._ask("Target.attachToTarget", targetId=target, flatten=True)
        self._session = {"sessionId": attached["sessionId"]}

    def _ask(self, method: str, **parameters: Any) -> Any:
        number = next(self._numbers)
        asked = {"id": number, "method": method, "params": parameters, **self._session}
        self._write.write(json.dumps(asked).encode() + b"\0")
        while True:
            told = json.loads(self._message())
            if told.get("id") == number:
                assert "error" not in told, told
                return told["result"]

    def _message(self) -> bytes:
        found = bytearray()
        while (byte := self._read.read(1)) != b"\0":
            assert byte, "the browser has ended"
            found += byte
        return bytes(found)

    def open(self, page: Path | str) -> None:
        """Show a page, a file or an address, once it is there with all its pictures."""
        self._ask("Emulation.setDeviceMetricsOverride", width=900, height=1000, deviceScaleFactor=1, mobile=False)
        self._ask("Page.navigate", url=page if isinstance(page, str) else page.as_uri())
        ready = "new Promise(done => document.readyState == 'complete' ? done() : addEventListener('load', done))"
        self._ask("Runtime.evaluate", expression=ready, awaitPromise=True)

    def value(self, expression: str) -> Any:
        """Return what JavaScript makes of an expression."""
        return self._ask("Runtime.evaluate", expression=expression, returnByValue=True)["result"].get("value")

    def box(self, selector: str) -> tuple[float, float, float, float]:
        """Return left, top, width and height (px) of the first element that a selector finds."""
        found = f"document.querySelector({json.dumps(selector)}).getBoundingClientRect()"
        left, top, width, height = self.value(f"(b => [b.left, b.top, b.width, b.height])({found})")
        return left, top, width, height

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Press the mouse at a point, move it to another, and let it go."""
        for kind, (x, y), buttons in (
            ("mouseMoved", start, 0), ("mousePressed", start, 1), ("mouseMoved", end, 1), ("mouseReleased", end, 0),
        ):  # fmt: skip
            button = "left" if kind != "mouseMoved" else "none"
            self._ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=buttons, clickCount=1)

    def click(self, x: float, y: float) -> None:
        """Press and let go the mouse at a point."""
        self.drag((x, y), (x, y))

    def picture(self) -> np.ndarray:
        """Return what is seen, (height, width, 3)."""
        data = self._ask("Page.captureScreenshot", format="png")["data"]
        return np.asarray(Image.open(io.BytesIO(b64decode(data))).convert("RGB"))


@contextmanager
def browser(profile: Path, graphics: Sequence[str] = FLAT) -> Iterator[Browser]:
    """Start a browser with a new profile, and end it."""
    found = next(filter(None, map(shutil.which, NAMES)), None)
    assert found, f"no browser: none of {', '.join(NAMES)} is on PATH; run: .ci/setup test"
    their_read, our_write = os.pipe()
    our_read, their_write = os.pipe()
    # The protocol reads from descriptor 3 and writes to 4, wherever the pipes' own ends are.
    lead = f'exec "$0" "$@" 3<&{their_read} 4>&{their_write}'
    command = ["bash", "-c", lead, found, *OPTIONS, *graphics, f"--user-data-dir={profile}", "about:blank"]
    process = subprocess.Popen(command, pass_fds=(their_read, their_write), stderr=subprocess.DEVNULL)
    os.close(their_read)
    os.close(their_write)
    try:
        with os.fdopen(our_write, "wb", buffering=0) as write, os.fdopen(our_read, "rb") as read:
            yield Browser(write, read)
        process.wait(timeout=20)  # it ends when nobody is left to talk to
    finally:
        process.kill()
        process.wait()
