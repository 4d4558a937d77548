"""Models of other programs as world files: URDF, MJCF and glTF."""

from carom.worlds.importing.imported import Imported, Options, import_model

__all__ = ["Imported", "Options", "import_model"]
