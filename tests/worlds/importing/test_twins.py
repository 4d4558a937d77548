"""A model and its twin in left-handed axes, written by hand, become the same world."""

from __future__ import annotations

from pathlib import Path

from imports import imported

ARM = """<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0.1 {s}0.2 0.3" rpy="{s}0.1 0.2 {s}0.3"/><mass value="2"/>
      <inertia ixx="0.3" iyy="0.2" izz="0.1" ixy="{s}0.01" ixz="0.02" iyz="{s}0.03"/>
    </inertial>
    <collision>
      <origin xyz="0 {s}0.4 0" rpy="{s}0.5 0 0"/><geometry><cylinder radius="0.1" length="1"/></geometry>
    </collision>
    <visual><origin rpy="0 0 {s}0.6"/><geometry><box size="1 2 3"/></geometry></visual>
  </link>
  <link name="lower">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="1 {s}2 3" rpy="{s}0.4 0.5 {s}0.6"/>
    <axis xyz="{t}1 2 {t}3"/><limit lower="-0.5" upper="1" effort="0" velocity="0"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="upper"/><child link="lower"/><origin xyz="0 {s}1 0"/>
    <axis xyz="1 {s}2 3"/><limit lower="-0.5" upper="1" effort="0" velocity="0"/>
  </joint>
</robot>"""


def test_twins_become_one_world(tmp_path: Path) -> None:
    """Mirrored along y: y of positions, turns about x and z and what couples y turn round, angles and limits stay."""
    right = imported(tmp_path, ARM.format(s="", t="")).text
    left = imported(tmp_path, ARM.format(s="-", t="-"), hand="left").text
    assert left.partition("name:")[2] == right.partition("name:")[2]
    assert left.partition("name:")[0].replace("left", "right") == right.partition("name:")[0]
