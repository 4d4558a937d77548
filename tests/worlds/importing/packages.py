"""Where packages lie whose models the tests import."""

from __future__ import annotations

import os
from importlib.util import find_spec
from pathlib import Path

import pytest

MISSING = "the package {} is not there: pip install 'carom[models]'"


def folder_of(package: str) -> Path:
    """Return where a package lies; without it the test is skipped, or fails where it must not be."""
    found = find_spec(package)
    if found is None or not found.submodule_search_locations:
        if os.environ.get("CAROM_MODELS") == "required":
            pytest.fail(MISSING.format(package))
        pytest.skip(MISSING.format(package))
    return Path(found.submodule_search_locations[0])
