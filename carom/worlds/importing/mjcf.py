"""MJCF, MuJoCo's format, section by section (mujoco.readthedocs.io, XML Reference)."""

from __future__ import annotations

import numpy as np

from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.files import ModelFiles
from carom.worlds.importing.mjcf_bodies import Bodies
from carom.worlds.importing.mjcf_file import MAIN, Compiler, Defaults, Included
from carom.worlds.importing.mjcf_geoms import Geoms
from carom.worlds.importing.mjcf_joints import Joints
from carom.worlds.importing.model import HERE, Model
from carom.worlds.importing.report import Report

UP = "z"
STANDARD_GRAVITY = (0.0, 0.0, -9.81)
TIMESTEP = 0.002  # s, MuJoCo's default
SHORTEST = 1e-9  # s
READ = ("compiler", "option", "default", "asset", "worldbody", "contact", "equality", "actuator")
COMPILER_WORDS = ("settotalmass", "boundmass", "boundinertia", "balanceinertia", "inertiagrouprange")


def read_mjcf(root: Element, files: ModelFiles, reading: Reading, report: Report) -> Model:
    """Return the model of a ``<mujoco>``, every joint at its reference."""
    return _Mujoco(Included(files, reading).fill(root), files, reading, report).model()


class _Mujoco:
    """A model while it is read."""

    def __init__(self, root: Element, files: ModelFiles, reading: Reading, report: Report) -> None:
        self.root, self.reading, self.report = root, reading, report
        self.defaults, self.compiler = Defaults(root, reading), Compiler(root, reading)
        self.geoms = Geoms(self.compiler, files, reading, report)
        self.joints = Joints(self.compiler, self.defaults, reading, report)
        self.made = Model(
            root.attributes.get("model", ""), report, gravity=np.array(STANDARD_GRAVITY), timestep=TIMESTEP
        )
        self.bodies = Bodies(self.made, self.compiler, self.defaults, self.geoms, self.joints, reading)

    def model(self) -> Model:
        """Return all of it."""
        for section in self.root.children:
            if section.tag not in READ:
                self.report.drop(section, f"<{section.tag}>")
        for section in self.root.all("compiler"):
            for key in [key for key in COMPILER_WORDS if key in section.attributes]:
                self.report.drop(section, f"{key} of the compiler")
        for section in self.root.all("option"):
            self.option(section)
        for section in self.root.all("asset"):
            for asset in section.children:
                self.geoms.asset(self.defaults.filled(asset, MAIN))
        for section in self.root.all("worldbody"):
            self.bodies.inside(section, HERE, None, MAIN)
        self.sections()
        self.reading.refuse_if_faulty()
        self.made.layers = self.geoms.touching.layers()
        self.geoms.touching.settle_friction()
        for connection in self.made.connections:
            self.report.keep("joint", len(connection.freedoms) or 1)
        return self.made

    def sections(self) -> None:
        """Add what is stated of bodies and joints by their names."""
        for section in self.root.all("actuator"):
            for actuator in section.children:
                self.joints.actuator(actuator)
        for section in self.root.all("equality"):
            for equality in section.children:
                self.bodies.hold(self.joints.equality(equality, self.bodies.links))
        for section in self.root.all("contact"):
            for stated in section.children:
                if stated.tag == "exclude":
                    self.bodies.hold(self.joints.exclusion(stated, self.bodies.links))
                else:
                    self.report.drop(stated, f"contact <{stated.tag}>", stated.attributes.get("name", ""))

    def option(self, element: Element) -> None:
        """Read gravity and time step; how MuJoCo solves is its own."""
        self.made.gravity = np.array(self.reading.numbers(element, "gravity", 3, STANDARD_GRAVITY))
        self.made.timestep = self.reading.number(element, "timestep", TIMESTEP, least=SHORTEST)
        for key in [key for key in element.attributes if key not in ("gravity", "timestep")]:
            self.report.drop(element, f"option {key}")
        for child in element.children:
            self.report.drop(child, f"option <{child.tag}>")
