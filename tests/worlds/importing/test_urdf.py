"""Robots in URDF move as formulas say, and what is wrong with their files is told at once."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from imports import imported, world_of

from carom.ecs.spatial import quaternion
from carom.worlds import WorldError

TILT = 0.05
PENDULUM = f"""<robot name="pendulum">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="world"/>
  <link name="rod">
    <inertial>
      <origin xyz="0 0 -0.5" rpy="0.3 0 0"/><mass value="2"/>
      <inertia ixx="0.17" iyy="0.15" izz="0.05" ixy="0.01" ixz="0" iyz="0"/>
    </inertial>
    <visual>
      <origin xyz="0 0 -0.5"/><geometry><cylinder radius="0.02" length="1"/></geometry><material name="red"/>
    </visual>
    <collision><origin xyz="0 0 -0.5"/><geometry><box size="0.02 0.04 1"/></geometry></collision>
  </link>
  <link name="bob">
    <inertial><mass value="0.5"/><inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="pivot" type="continuous">
    <parent link="world"/><child link="rod"/><origin xyz="0 0 2" rpy="0 {TILT} 0"/><axis xyz="0 1 0"/>
  </joint>
  <joint name="weld" type="fixed"><parent link="rod"/><child link="bob"/><origin xyz="0 0 -1"/></joint>
</robot>"""
TENSOR = np.array([[0.17, 0.01, 0.0], [0.01, 0.15, 0.0], [0.0, 0.0, 0.05]])


def rod_about(tensor: np.ndarray) -> np.ndarray:
    """Return the tensor of the rod in the axes of its link."""
    turn = quaternion.matrix(quaternion.from_euler((0.3, 0.0, 0.0), "xyz"))
    return turn @ tensor @ turn.T


def test_a_pendulum_has_its_period(tmp_path: Path) -> None:
    """T = 2 pi sqrt(I / (m g d)) (1 + t^2 / 16) of rod and bob together, by the time of two swings."""
    simulation = world_of(tmp_path, PENDULUM).simulation
    about, moment = rod_about(TENSOR)[1, 1] + 2.0 * 0.25 + 0.001 + 0.5, 9.81 * (2.0 * 0.5 + 0.5)
    period = 2.0 * math.pi * math.sqrt(about / moment) * (1.0 + TILT**2 / 16.0)
    swing = []
    for _ in range(int(2.5 * period / simulation.settings.dt)):
        simulation.step()
        swing.append(TILT + float(simulation["pivot"].joint.position[3]))
    angle = np.array(swing)
    before = np.nonzero((angle[:-1] < 0.0) & (angle[1:] >= 0.0))[0]
    times = before + angle[before] / (angle[before] - angle[before + 1])
    assert float(np.diff(times).mean()) * simulation.settings.dt == pytest.approx(period, rel=1e-3)
    assert angle.min() == pytest.approx(-TILT, rel=1e-2)


def test_mass_and_inertia_of_what_is_fixed_together_come_over_whole(tmp_path: Path) -> None:
    """Mass, centre and tensor by Steiner's theorem, in carom's axes: (x, y, z) becomes (x, z, -y)."""
    body = world_of(tmp_path, PENDULUM).simulation["rod"].rigid_body
    tensor = rod_about(TENSOR) + np.diag([1.0, 1.0, 0.0]) * (2.0 * 0.1**2 + 0.5 * 0.4**2) + np.eye(3) * 0.001
    swap = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
    axes = quaternion.matrix(body.principal_axes)
    assert body.mass == pytest.approx(2.5, rel=1e-15)
    assert body.center_of_mass == pytest.approx([0.0, -0.6, 0.0], abs=1e-11)
    assert axes @ np.diag(body.inertia) @ axes.T == pytest.approx(swap @ tensor @ swap.T, abs=1e-11)


def test_the_text_of_a_world(tmp_path: Path) -> None:
    """An entity a line where that is short, else a word a line; each says where it comes from."""
    text = imported(tmp_path, PENDULUM.replace(f' rpy="0 {TILT} 0"', "").replace('ixy="0.01"', 'ixy="0"')).text
    assert text.replace(str(tmp_path), "") == EXPECTED


EXPECTED = """carom: 1
# From model.xml by carom import; there z is up, right-handed.
name: pendulum
layers: {robot: [default]}
entities:
  - {name: world} # model.xml:3
  - name: rod # model.xml:4
    transform: {position: [0, 2, 0]}
    body:
      mass: 2.5
      principal_axes: [0.0749297072727, 0, 0, 0.997188818112]
      inertia: [0.271, 0.0554663510874, 0.246533648913]
      center_of_mass: [0, -0.6, 0]
    collider: {box: {size: [0.02, 1, 0.04]}, position: [0, -0.5, 0], layer: robot}
    visual: {cylinder: {radius: 0.02, length: 1}, position: [0, -0.5, 0], color: [1, 0, 0, 1]}
  - {name: bob, parent: {entity: rod, position: [0, -1, 0]}} # model.xml:14
  - {name: pivot, joint: {hinge: {a: world, b: rod, at: [0, 2, 0], axis: [0, 0, -1]}}} # model.xml:17
"""


def joint(words: str, limits: str = "") -> str:
    """Return a robot of two links in space and the joint between them."""
    inertia = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    ends = '<parent link="a"/><child link="b"/>'
    links = f'<link name="a">{inertia}</link><link name="b">{inertia}</link>'
    return f'<robot name="r">{links}<joint name="j" {words}>{ends}<axis xyz="0 0 1"/>{limits}</joint></robot>'


PLANE = "y: free, z: free, rotation_x: free}"


@pytest.mark.parametrize(
    ("words", "limits", "wanted"),
    [
        ('type="continuous"', '<dynamics damping="2" friction="0.5"/>',
         "hinge: {a: a, b: b, at: [0, 0, 0], axis: [0, 1, 0], motor: {damping: 2}, friction: 0.5}"),
        ('type="revolute"', '<limit lower="-1" upper="0.5" effort="0" velocity="0"/>',
         "hinge: {a: a, b: b, at: [0, 0, 0], axis: [0, 1, 0], limits: [-1, 0.5]}"),
        ('type="prismatic"', '<limit lower="-1" upper="2" effort="0" velocity="0"/>',
         "slider: {a: a, b: b, at: [0, 0, 0], axis: [0, 1, 0], limits: [-1, 2]}"),
        ('type="planar"', "", "generic: {a: a, b: b, at: [0, 0, 0], axis: [0, 1, 0], second_axis: [1, 0, 0], " + PLANE),
    ],
)  # fmt: skip
def test_joints_are_carom_s(tmp_path: Path, words: str, limits: str, wanted: str) -> None:
    """Each kind with its limits, damping and friction."""
    made = imported(tmp_path, joint(words, limits))
    assert wanted in made.text
    assert made.report.exact


def test_a_planar_joint_keeps_to_its_plane(tmp_path: Path) -> None:
    """It slides and turns on it, and does not leave it."""
    simulation = world_of(tmp_path, joint('type="planar"'), base="fixed").simulation
    simulation["b"].motion.linear, simulation["b"].motion.angular = (1.0, 2.0, -0.5), (0.5, 3.0, 0.5)
    simulation.step(60)
    assert simulation["b"].transform.position == pytest.approx([1.0, 0.0, -0.5], abs=2e-3)
    assert simulation["b"].motion.angular == pytest.approx([0.0, 3.0, 0.0], abs=1e-3)


FAULTS = """<robot name="r">
  <link name="a"><inertial><mass value="-1"/><inertia ixx="1" iyy="x" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="a"><visual><geometry><box size="1 2"/></geometry></visual></link>
  <link name="b"><collision><geometry><mesh filename="../../etc/hosts.obj"/></geometry></collision></link>
  <joint name="j" type="hinge"><parent link="a"/><child link="c"/></joint>
</robot>"""
TOLD = """\
T/model.xml:2:28: <mass>: value must be at least 0; received -1
T/model.xml:2:46: <inertia>: iyy is not right; received 'x'; accepted: 1 finite number
T/model.xml:4:3: <link>: two links of one name; received a, also at line 2
T/model.xml:4:36: <box>: size is not right; received '1 2'; accepted: 3 finite numbers
T/model.xml:5:39: <mesh>: names a file outside the root; received '../../etc/hosts.obj'; \
accepted: files below T; --root names another folder
T/model.xml:6:3: <joint>: child is no link; received 'c'; accepted: a, b"""


def test_everything_wrong_is_told_at_once_with_its_line(tmp_path: Path) -> None:
    """What, where, received and accepted."""
    with pytest.raises(WorldError) as fault:
        imported(tmp_path, FAULTS)
    assert str(fault.value).replace(str(tmp_path), "T") == TOLD


BOMB = '<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><robot name="&b;"/>'
UNSAFE = (
    "1:1: declares entities; received EntitiesForbidden; "
    "accepted: XML without entities, which could unfold without end or fetch files"
)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<robot", "1:1: is not XML: unclosed token"),
        ("<world/>", "1:1: is no model; received <world>; accepted: <robot> of URDF or <mujoco> of MJCF"),
        (BOMB, UNSAFE),
        ("<robot>" + "<a>" * 200, "1:389: is nested deeper than 128 levels"),
    ],
)  # fmt: skip
def test_what_is_no_urdf_is_refused(tmp_path: Path, text: str, message: str) -> None:
    """Entities are not expanded, depth is bounded."""
    with pytest.raises(WorldError) as fault:
        imported(tmp_path, text)
    assert str(fault.value) == f"{tmp_path}/model.xml:{message}"
