"""Models of MuJoCo move here as they move there: in `.ci/run`, which installs what has them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from packages import folder_of

from carom.ecs.spatial import quaternion
from carom.worlds import load_text
from carom.worlds.importing import import_model

DT, STEPS = 0.0002, 1000  # s; short, since the two integrate in different ways
UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
LEFT_OUT = ("armature", "range", "limited", "ctrllimited", "ctrlrange", "integrator", "settotalmass", "timestep")


def comparable(text: str) -> str:
    """Return a model without what does not come over, whose geoms do not touch and whose joints have no limits."""
    for word in LEFT_OUT:
        text = re.sub(rf'\s{word}="[^"]*"', "", text)
    for word in ("contype", "conaffinity"):
        text = re.sub(rf'\s{word}="[^"]*"', "", text)
        text = text.replace("<geom ", f'<geom {word}="0" ')
    return text.replace("<worldbody>", f'<option timestep="{DT}"/><worldbody>')


def velocities(mujoco: Any, model: Any, data: Any, body: int, center: np.ndarray) -> tuple[Any, Any]:
    """Return the velocity of a point of a body and its angular velocity, here."""
    found = np.zeros(6)
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, found, 0)
    spin = UPRIGHT @ found[:3]
    return UPRIGHT @ found[3:] + np.cross(spin, center - UPRIGHT @ data.xpos[body]), spin


@pytest.mark.slow
@pytest.mark.parametrize("name", ["inverted_double_pendulum", "hopper", "humanoid"])
def test_a_model_moves_as_it_does_in_mujoco(name: str, tmp_path: Path) -> None:
    """From velocities at random, after 0.2 s, every body is within 0.2 % of the longest way that one went."""
    folder_of("mujoco")
    import mujoco

    path = tmp_path / f"{name}.xml"
    stated = (folder_of("gymnasium") / f"envs/mujoco/assets/{name}.xml").read_text()
    path.write_text(comparable(stated))
    text = import_model(path, folder=tmp_path).text.replace(f"dt: {DT}", f"dt: {DT}, substeps: 1, sleeping: false")
    simulation = load_text(text, checked=False).simulation
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    data.qvel[:] = np.random.default_rng(1).uniform(-1.0, 1.0, model.nv)
    mujoco.mj_forward(model, data)
    bodies = [number for number in range(1, model.nbody) if model.body_jntnum[number]]
    start = {}
    for number in bodies:
        entity = simulation[model.body(number).name]
        start[number] = entity.transform.position.copy()
        assert entity.rigid_body.mass >= model.body_mass[number] * (1.0 - 1e-9)
        center = start[number] + quaternion.rotate(entity.transform.rotation, entity.rigid_body.center_of_mass)
        entity.motion.linear, entity.motion.angular = velocities(mujoco, model, data, number, center)
    simulation.step(STEPS)
    mujoco.mj_step(model, data, nstep=STEPS)
    now = {number: simulation[model.body(number).name].transform.position for number in bodies}
    way = max(float(np.abs(now[number] - start[number]).max()) for number in bodies)
    error = max(float(np.abs(now[number] - UPRIGHT @ data.xpos[number]).max()) for number in bodies)
    assert way > 0.1
    assert error < 0.002 * way
