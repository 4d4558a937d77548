"""What tests of messages share."""

from __future__ import annotations

import re
from typing import Any

import pytest


def error(kind: type[Exception], message: str) -> Any:
    """Expect an error with exactly this message."""
    return pytest.raises(kind, match=f"^{re.escape(message)}$")
