"""Models that people use come over: each with the report that is expected of it, and its joints hold."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from packages import folder_of

from carom.ecs import RigidBody
from carom.ecs.components.joint import Joint
from carom.worlds import LoadedWorld, load_world
from carom.worlds.importing import Options, import_model

REPORTS = Path(__file__).parent / "reports"
MODELS = {  # by name: package, path, and the folder below which its files lie
    "ur3e": ("airo_models", "arms/ur3e/ur3e.urdf", "arms/ur3e"),
    "robotiq_2f_85": ("airo_models", "grippers/robotiq_2f_85/urdf/robotiq_2f_85.urdf", "grippers/robotiq_2f_85"),
    "dexs_gripper": ("dexmate_urdf", "robots/hands/dexs_gripper/dexs_gripper.urdf", "robots/hands/dexs_gripper"),
    "hopper": ("gymnasium", "envs/mujoco/assets/hopper.xml", "envs/mujoco/assets"),
    "ant": ("gymnasium", "envs/mujoco/assets/ant.xml", "envs/mujoco/assets"),
    "humanoid": ("gymnasium", "envs/mujoco/assets/humanoid.xml", "envs/mujoco/assets"),
    "gripper_l1": ("dexmate_urdf", "robots/hands/dexs_gripper/meshes/visual/gripper_l1.glb", "robots/hands"),
    "lift_link": ("dexmate_urdf", "robots/humanoid/vega_1u/meshes/visual/lift_link.glb", "robots/humanoid"),
    "torso_l2": ("dexmate_urdf", "robots/humanoid/vega_1/meshes/visual/torso_l2.glb", "robots/humanoid"),
}


def summary(world: LoadedWorld) -> str:
    """Return what a world consists of, in a line."""
    entities, joints = world.simulation.world.slots.alive.sum(), len(world.simulation.world.row_numbers(Joint))
    mass = world.simulation.world[RigidBody].mass[world.simulation.world.row_numbers(RigidBody)].sum()
    return f"a world of   {entities} entities, {joints} joints, {mass:.6g} kg"


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_a_real_model_comes_over_as_expected(name: str, tmp_path: Path, pytestconfig: pytest.Config) -> None:
    """The report is the golden one, the world loads, and half a second on nothing came apart."""
    package, path, root = MODELS[name]
    folder = folder_of(package)
    made = import_model(folder / path, Options(root=folder / root), folder=tmp_path, stem=name)
    made.write_files(tmp_path)
    (tmp_path / f"{name}.yaml").write_text(made.text)
    world = load_world(tmp_path / f"{name}.yaml")
    told = "\n".join([*made.report.lines(), summary(world)]).replace(f"{folder}/", "") + "\n"
    golden = REPORTS / f"{name}.txt"
    if pytestconfig.getoption("--carom-update"):
        golden.write_text(told, encoding="utf-8")
    assert told == golden.read_text(encoding="utf-8"), "the report changed; if on purpose: pytest --carom-update"
    simulation = world.simulation
    simulation.step(round(0.5 / simulation.settings.dt))
    rows = simulation.world.row_numbers(Joint)
    if len(rows):
        assert float(np.max(simulation.world[Joint].gap[rows])) < 2e-3
