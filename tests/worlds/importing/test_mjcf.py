"""Models in MJCF move as formulas say: defaults, joints, servos, equalities and who touches whom."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from imports import imported, world_of
from PIL import Image

from carom.worlds import LoadedWorld, WorldError


def mujoco(world: str, rest: str = "", compiler: str = "") -> str:
    """Return a model with the bodies of ``world`` and further sections."""
    return f'<mujoco model="m"><compiler {compiler}/>{rest}<worldbody>{world}</worldbody></mujoco>'


def test_a_damped_hinge_decays_as_predicted(tmp_path: Path) -> None:
    """w(t) = w exp(-c t / I) about an axis through the centre of mass, of a box by its density."""
    body = """<body name="wheel" pos="0 0 1">
      <joint name="axle" axis="0 0 2" damping="0.2"/><geom type="box" size="0.1 0.2 0.05" density="500"/>
    </body>"""
    simulation = world_of(tmp_path, mujoco(body)).simulation
    mass = 500.0 * 0.2 * 0.4 * 0.1
    inertia = mass * (0.2**2 + 0.4**2) / 12.0
    assert simulation["wheel"].rigid_body.mass == pytest.approx(mass, rel=1e-12)
    simulation["wheel"].motion.angular = (0.0, 3.0, 0.0)
    simulation.step(round(0.2 / 0.002))
    measured = float(simulation["wheel"].motion.angular[1])
    assert measured == pytest.approx(3.0 * math.exp(-0.2 * 0.2 / inertia), rel=1e-3)


def test_a_servo_holds_its_joint_against_gravity(tmp_path: Path) -> None:
    """The actuator's kp gear^2 (0 - q) and the spring's k (s - q) bear m g d cos q at rest, q from the reference."""
    body = """<body name="arm"><inertial pos="0.5 0 0" mass="2" diaginertia="0.1 0.1 0.1"/>
      <joint name="j" axis="0 -1 0" ref="10" springref="40" stiffness="30" damping="8"/></body>"""
    servo = '<actuator><position joint="j" kp="20" gear="2"/></actuator>'
    simulation = world_of(tmp_path, mujoco(body, servo)).simulation
    simulation.step(2500)
    angle = float(simulation["j"].joint.position[3])
    turned = angle + math.radians(10.0)
    torque = 30.0 * (math.radians(40.0) - turned) - 20.0 * 4.0 * turned
    assert torque == pytest.approx(2.0 * 9.81 * 0.5 * math.cos(angle), rel=5e-4)


def test_defaults_go_from_class_to_class_and_body_to_body(tmp_path: Path) -> None:
    """A class has what the one around it states, a geom that of its body's childclass, and its own words go before."""
    defaults = """<default><geom rgba="1 0 0 1" type="box" size="1 1 1"/>
      <default class="a"><geom size="2 2 2"/><default class="b"><geom rgba="0 0 1 1"/></default></default></default>"""
    body = """<geom name="plain"/><body name="x" childclass="b"><geom/>
      <body name="y"><geom class="a"/></body><body name="z" childclass="a"><geom size="3 3 3"/></body></body>"""
    text = imported(tmp_path, mujoco(body, defaults)).text
    found = [line.partition("size: ")[2][:5] for line in text.splitlines() if "size" in line]
    colors = [line.partition("color: ")[2][:9] for line in text.splitlines() if "color" in line]
    assert found == ["[2, 2", "[4, 4", "[4, 4", "[6, 6"]
    assert colors == ["[1, 0, 0,", "[0, 0, 1,", "[1, 0, 0,", "[1, 0, 0,"]


@pytest.mark.parametrize(
    ("stated", "compiler"),
    [
        ('euler="20 30 40"', ""),
        ('euler="0.3490658503988659 0.5235987755982988 0.6981317007977318"', 'angle="radian"'),
        ('euler="40 30 20"', 'eulerseq="ZYX"'),
    ],
)
def test_orientations_mean_the_same(tmp_path: Path, stated: str, compiler: str) -> None:
    """Degrees and radians, turning axes in small letters and fixed ones in capitals."""
    a, b, c = np.radians([20.0, 30.0, 40.0])
    x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    z = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    there = x @ y @ z @ (1.0, 0.0, 0.0)
    body = f'<body {stated}><body name="tip" pos="1 0 0"><geom size="0.1"/></body></body>'
    place = world_of(tmp_path, mujoco(body, compiler=compiler)).simulation["tip"].transform.position
    assert place == pytest.approx([there[0], there[2], -there[1]], abs=1e-11)


def test_three_hinges_on_a_body_are_one_joint_of_three_turns(tmp_path: Path) -> None:
    """A generic joint; slides go before, and the values are those of MuJoCo's."""
    joints = '<joint name="h" axis="1 0 0"/><joint axis="0 0 1" range="-10 20"/><joint axis="0 1 0"/>'
    text = imported(tmp_path, mujoco(f'<body name="b">{joints}<geom size="1"/></body>')).text
    assert "rotation_y: {limits: [-0.174532925199, 0.349065850399]}" in text
    slides = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint axis="0 0 1"/>'
    world = world_of(tmp_path, mujoco(f'<body name="b">{slides}<geom size="1"/></body>'))
    world.simulation["b"].motion.linear = (1.0, 5.0, -2.0)
    world.simulation.step(100)
    assert world.simulation["b"].transform.position == pytest.approx([0.2, 0.0, -0.4], abs=2e-3)


def test_joints_that_no_joint_of_ours_is_are_links_in_a_row(tmp_path: Path) -> None:
    """Two hinges with axes askew: each turns about its own, by light links between, which the report says."""
    joints = '<joint name="one" axis="0 0 1"/><joint name="two" axis="1 0 1" pos="1 0 0"/>'
    made = imported(tmp_path, mujoco(f'<body name="b">{joints}<geom size="0.2" pos="1 0 0"/></body>'))
    assert [note.what for note in made.report.notes] == ["joints beside each other, now with light links between"]
    assert made.text.count("hinge:") == 2


TWO = '<body name="{name}" pos="{pos}"><freejoint/><geom {geom} size="0.5" mass="1"/></body>'


def falls(tmp_path: Path, lower: str, upper: str, rest: str = "") -> float:
    """Return how low a ball comes that falls on one which is held."""
    bodies = f'<body name="lower"><joint type="slide" axis="1 0 0"/><geom size="0.5" mass="9" {lower}/></body>'
    bodies += TWO.format(name="upper", pos="0 0 1.2", geom=upper)
    simulation = world_of(tmp_path, mujoco(bodies, rest)).simulation
    simulation.step(250)
    return float(simulation["upper"].transform.position[1])


def test_who_touches_whom(tmp_path: Path) -> None:
    """Two geoms meet where a contype shares a bit with a conaffinity; excluded bodies do not."""
    free = 1.2 - 9.81 * 0.5**2 / 2.0
    assert falls(tmp_path, "", "") > 0.95
    assert falls(tmp_path, 'contype="2" conaffinity="0"', 'contype="0" conaffinity="2"') > 0.95
    assert falls(tmp_path, 'contype="2" conaffinity="0"', "") == pytest.approx(free, abs=1e-6)
    apart = '<contact><exclude body1="lower" body2="upper"/></contact>'
    assert falls(tmp_path, "", "", apart) == pytest.approx(free, abs=5e-3)  # bodies of joints: semi-implicit steps


def test_connect_and_weld_hold(tmp_path: Path) -> None:
    """A ball at its anchor, in the frame of the first body, and a fixed joint."""
    bodies = "".join(
        TWO.format(name=name, pos=f"{x} 0 0", geom='contype="0" conaffinity="0"') for x, name in enumerate("abc")
    )
    hold = '<connect body1="a" anchor="0 0 1"/><weld body1="b" body2="c"/><joint joint1="j"/>'
    made = imported(tmp_path, mujoco(bodies, f"<equality>{hold}</equality>"))
    assert "ball: {b: a, at: [0, 1, 0]}" in made.text
    assert "fixed: {a: c, b: b, at: [1, 0, 0]}" in made.text
    assert [note.what for note in made.report.notes] == ["equalities <joint>"]


def test_included_files_stand_where_they_are_named(tmp_path: Path) -> None:
    """Each once; circles end, and faults name the file that has them."""
    (tmp_path / "part.xml").write_text('<mujocoinclude><body name="b"><geom size="1 x"/></body></mujocoinclude>')
    with pytest.raises(WorldError) as fault:
        imported(tmp_path, mujoco('<include file="part.xml"/><include file="part.xml"/>'))
    model, part = f"{tmp_path}/model.xml", f"{tmp_path.resolve()}/part.xml"
    assert str(fault.value) == (
        f"{model}:1:68: <include>: includes a file a second time; received 'part.xml'\n"
        f"{part}:1:31: <geom>: size is not right; received '1 x'; accepted: up to 3 finite numbers"
    )


def test_cameras_that_stand_still_come_over(tmp_path: Path) -> None:
    """Place, target, up and field of view."""
    world: LoadedWorld = world_of(tmp_path, mujoco('<camera name="c" pos="1 2 3" xyaxes="1 0 0 0 0 1" fovy="30"/>'))
    camera = world.cameras["c"]
    assert camera.position == pytest.approx((1.0, 3.0, -2.0))
    assert camera.target == pytest.approx((1.0, 3.0, -3.0))
    assert (camera.fov, camera.up) == (pytest.approx(math.radians(30.0)), pytest.approx((0.0, 1.0, 0.0)))


def test_geoms_by_their_ends_and_sizes(tmp_path: Path) -> None:
    """Fromto leads along z from the first to the second, sizes are half sizes."""
    geoms = '<geom type="capsule" fromto="0 0 0 0 0 2" size="0.1"/><geom type="cylinder" size="0.2 0.3"/>'
    geoms += '<geom type="ellipsoid" size="1 2 3"/>'
    text = imported(tmp_path, mujoco(geoms)).text
    for shape in ("capsule: {radius: 0.1, length: 2}", "cylinder: {radius: 0.2, length: 0.6}", "radii: [1, 3, 2]"):
        assert shape in text


def test_the_report_counts_and_groups(tmp_path: Path) -> None:
    """What is dropped is told by kind, with who and where first."""
    made = imported(tmp_path, mujoco(
        '<body name="b"><joint name="j" armature="1"/><geom size="1"/><site name="s"/></body>',
        '<tendon/><sensor/><keyframe/><actuator><motor name="m" joint="j"/></actuator>'))  # fmt: skip
    assert [line.replace(str(tmp_path), "T") for line in made.report.lines()] == [
        "kept          1 link, 1 joint, 1 body, 1 collider",
        "dropped       <tendon>; T/model.xml:1",
        "dropped       <sensor>; T/model.xml:1",
        "dropped       <keyframe>; T/model.xml:1",
        "dropped       armature, the inertia of a rotor: j; T/model.xml:1",
        "dropped       <site>: s; T/model.xml:1",
        "dropped       actuators <motor>, which push as a program commands: m; T/model.xml:1",
    ]


def test_what_is_neither_seen_nor_touched_weighs_all_the_same(tmp_path: Path) -> None:
    """Geoms of hidden groups, as many models have for their mass."""
    hidden = '<geom size="0.1" mass="2" group="3" contype="0" conaffinity="0"/>'
    simulation = world_of(tmp_path, mujoco(f'<body name="b"><freejoint/>{hidden}</body>')).simulation
    assert simulation["b"].rigid_body.mass == 2.0
    assert simulation["b"].rigid_body.inertia == pytest.approx([0.4 * 2.0 * 0.01] * 3, rel=1e-11)


def test_land_is_as_high_as_in_mujoco(tmp_path: Path) -> None:
    """Black is 0 and the brightest point as high as stated; the first row of the image is the farthest along y."""
    Image.fromarray(np.array([[10, 10, 10], [10, 60, 10], [10, 10, 110]], np.uint8)).save(tmp_path / "land.png")
    land = '<asset><hfield name="land" file="land.png" size="2 3 5 1"/></asset>'
    body = '<geom name="hills" type="hfield" hfield="land" pos="10 0 1"/>'
    space = world_of(tmp_path, mujoco(body, land)).simulation.space
    for x, y, height in ((0.0, 0.0, 2.5), (1.999, -2.999, 5.0), (-1.999, 2.999, 0.0)):
        hit = space.cast_ray((10.0 + x, 50.0, -y), (0.0, -1.0, 0.0))
        assert hit is not None and 50.0 - hit.distance == pytest.approx(1.0 + height, abs=1e-2)


def test_faults_of_bodies_are_told_together(tmp_path: Path) -> None:
    """Two of one name in each other, which must not be walked round for ever, and values that nothing can have."""
    text = mujoco("""<body name="b"><body name="b"><geom size="1"/></body></body>
<body name="c"><joint name="j" type="ball" range="0 0"/><geom size="1" friction="-1"/></body>""")
    with pytest.raises(WorldError) as fault:
        imported(tmp_path, text)
    assert [str(one).partition(": ")[2] for one in fault.value.faults] == [
        "<body>: two bodies of one name; received b, also at line 1",
        "<joint>: a ball has no range to move in; received 0 0",
        "<geom>: friction must be at least 0; received -1",
    ]
