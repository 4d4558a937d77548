"""Led page: Rerun's page for browsers, with a script that leads its viewer to a frame and an entity.

No address does that for a recording that is streamed to it. The viewer in a page is asked as the one in a window is, by
messages of Rerun's ``viewer_control.proto``, of which a few are written here, with the numbers of their fields in 0.41.
"""

from __future__ import annotations

import json
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.error import HTTPError
from urllib.request import urlopen

from carom.tools.recorder.stream import FRAME

OPEN, SET_TIME_CURSOR, RUN_COMMAND = 4, 6, 11
PAUSED, SEQUENCE = 1, 1
STEADY = 3  # looks in a row that find it at the frame: it moves on its own until it has loaded
SCRIPT = """<script>
(async () => {
  const ask = text => window._handle.viewer_control(Uint8Array.from(text, letter => letter.charCodeAt(0)));
  const state = () => Array.from(window._handle.viewer_state(), byte => String.fromCharCode(byte)).join("");
  const pause = () => new Promise(done => setTimeout(done, 200));
  const [time, cursor, ...others] = ASKED;
  for (let there = 0; there < STEADY; ) {
    try {
      await ask(time);
      await pause();
      there = state().includes(cursor) ? there + 1 : 0;
    } catch (fault) {  // nothing is there yet
      there = 0;
      await pause();
    }
  }
  for (const other of others) await ask(other);
})();
</script>
"""


def message(*fields: tuple[int, int | str | bytes]) -> bytes:
    """Return a message of Protocol Buffers: fields by their numbers; 0 is left out, as it is what others are."""
    found = b""
    for number, value in fields:
        if isinstance(value, int):
            found += _varint(number << 3) + _varint(value) if value else b""
        else:
            block = value.encode() if isinstance(value, str) else value
            found += _varint(number << 3 | 2) + _varint(len(block)) + block
    return found


def script(frame: int, selected: str) -> str:
    """Return what leads the viewer of a page to a frame, and then selects a path, where there is one."""
    time = message((1, frame))
    cursor = message((1, message((1, FRAME))), (2, SEQUENCE), (3, time))
    asked = [message((SET_TIME_CURSOR, message((2, message((1, FRAME))), (3, time), (5, PAUSED)))), cursor]
    if selected:
        asked.append(message((OPEN, message((1, f"recording:/{selected}"), (2, 1)))))
        asked.append(message((RUN_COMMAND, message((1, "ui.expand_selection_panel")))))
    texts = json.dumps([one.decode("latin-1") for one in asked]).replace("<", "\\u003c")
    return SCRIPT.replace("ASKED", texts).replace("STEADY", str(STEADY))


def led_pages(port: int, source: str, frame: int, selected: str) -> ThreadingHTTPServer:
    """Return a server for this machine of what there is at an address, its page with the script."""
    added = f"{script(frame, selected)}</body>".encode()

    class Pages(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            try:
                with urlopen(source + self.path) as answer:
                    body, kind = answer.read(), answer.headers["Content-Type"]
            except HTTPError as fault:
                self.send_error(fault.code)
                return
            if self.path.partition("?")[0] == "/":
                body = body.replace(b"</body>", added)
            self.send_response(200)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *told: object) -> None:
            """Say nothing."""

    return ThreadingHTTPServer(("127.0.0.1", port), Pages)


def _varint(number: int) -> bytes:
    found = bytearray()
    while number > 0x7F:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*found, number])
