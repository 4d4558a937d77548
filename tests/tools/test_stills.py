"""What cameras see of one moment, as files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from carom.tools.cli import main
from carom.tools.filming import shot_of
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene
from carom.worlds import load_world

WORLD = """carom: 1
step: {dt: 1/60}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: ball, transform: {position: [0, 1, 0]}, collider: {sphere: {radius: 0.4}}, body: {}}
cameras:
  main: {position: [0, 1, 3]}
  side: {position: [8, 0.5, 0], target: ball, height: 3 m}
  round: {orbit: {around: ball, distance: 3 m, rate: 90 deg/s}}
render: {width: 64, height: 48}
"""


def test_several_cameras_write_a_file_each_of_what_each_sees(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Pictures, depths and ids are those of the renderer at that moment, with the cameras as they are then."""
    stems = {"out": "a.png", "depth": "d.npy", "ids": "i.npy"}
    outputs = [word for kind, name in stems.items() for word in (f"--{kind}", str(tmp_path / name))]
    assert main(["render", str(world), "--at", "0.2 s", "--camera", "main,side,round", *outputs, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["depth"] == [str(tmp_path / f"d-{name}.npy") for name in ("main", "side", "round")]
    loaded = load_world(world)
    loaded.simulation.step(12)
    now = loaded.simulation.world
    with Renderer(64, 48) as renderer:
        for name in ("main", "side", "round"):
            camera, batches = shot_of(loaded, name).camera(now), Scene(now).batches()
            with Image.open(tmp_path / f"a-{name}.png") as image:
                assert np.array_equal(np.asarray(image), renderer.picture(batches, camera))
            assert np.array_equal(np.load(tmp_path / f"d-{name}.npy"), renderer.depth(batches, camera))
            assert np.array_equal(np.load(tmp_path / f"i-{name}.npy"), renderer.ids(batches, camera))


def test_one_camera_writes_the_files_named_and_depths_in_millimetres_where_asked_for(
    world: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A 16-bit image holds whole millimetres, and 0 where there is sky or what is farther than 65.535 m."""
    words = ["render", str(world), "--camera", "side", "--depth"]
    assert main([*words, str(tmp_path / "d.png")]) == 0
    assert main([*words, str(tmp_path / "d.npy"), "--ids", str(tmp_path / "i.npy")]) == 0
    assert capsys.readouterr().out.splitlines()[0] == f"{tmp_path / 'd.png'}: frame 0, 0 s"
    with Image.open(tmp_path / "d.png") as image:
        millimetres = np.asarray(image)
    metres, ids = np.load(tmp_path / "d.npy"), np.load(tmp_path / "i.npy")
    assert (millimetres.dtype, metres.dtype) == (np.uint16, np.float32)
    near = metres <= 65.535
    np.testing.assert_allclose(millimetres[near], metres[near] * 1e3, rtol=0.0, atol=0.51)
    assert (millimetres[~near] == 0).all() and (~near).any()
    row = load_world(world).simulation.world.row(load_world(world).simulation.world.find("ball"))
    assert metres[ids == row].min() == pytest.approx(8.0156 - 0.4, abs=0.01)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--ids", "a.png"], "argument --ids: must end in .npy, received 'a.png'"),
        (["--depth", "a.jpg"], "argument --depth: must end in .npy or .png, received 'a.jpg'"),
    ],
)
def test_other_formats_are_refused(
    words: list[str], message: str, world: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The message names the option, what was received and what is accepted."""
    with pytest.raises(SystemExit) as ended:
        main(["render", str(world), *words])
    assert ended.value.code == 2
    assert message in capsys.readouterr().err
