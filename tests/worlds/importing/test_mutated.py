"""Models in which words are exchanged, cut and doubled at random become worlds that load, or are refused with words."""

from __future__ import annotations

import json
import random
import re
from pathlib import Path

import pytest
from test_gltf import NODES, scene
from test_mjcf import mujoco
from test_urdf import PENDULUM

from carom.worlds import WorldError, load_text
from carom.worlds.importing import import_model

WORDS = [
    "",
    "0",
    "-1",
    "1e308",
    "1e-320",
    "nan",
    "1e400",
    "0 0 0",
    "x",
    '"',
    "plane",
    "free",
    "ball",
    "<",
    "/>",
    "a",
    "b",
]
WORDS += ["null", "[]", "../..", "999999999999", "\x01", "é"]
BODIES = """<geom type="plane" size="1 1 1"/>
<body name="a" pos="0 0 1" childclass="c">
  <joint name="j" range="0 30"/><joint axis="0 1 0" damping="1"/>
  <geom fromto="0 0 0 0 0 1" type="capsule" size="0.1"/><frame euler="0 0 9"><geom/></frame>
  <body name="b"><joint type="ball"/><geom type="box" size="1 1 1" contype="2"/></body>
</body>"""
REST = """<default class="c"><geom size="0.1" rgba="1 0 0 1"/></default>
<equality><connect body1="a" anchor="0 0 0"/></equality><contact><exclude body1="a" body2="b"/></contact>
<actuator><position joint="j" kp="3" forcerange="-1 2"/></actuator>"""
MODELS = [(".urdf", PENDULUM), (".xml", mujoco(BODIES, REST)), (".gltf", json.dumps(scene(NODES)))]


def mutated(text: str, draw: random.Random) -> str:
    """Return a text with a value exchanged, a stretch cut out, a word put in or a tag doubled."""
    values = [match.span(1) for match in re.finditer(r'"([^"]*)"|[:\[,]\s*([\d.]+)', text) if match[1] is not None]
    tags = [match.span() for match in re.finditer(r"<[^<>]*/>", text)]
    at, change = draw.randrange(len(text)), draw.random()
    if change < 0.5 and values:
        start, end = draw.choice(values)
        return text[:start] + draw.choice(WORDS) + text[end:]
    if change < 0.7 and tags:
        start, end = draw.choice(tags)
        return text[:end] + text[start:end] + text[end:]
    return (
        text[:at] + (draw.choice(WORDS) if change < 0.85 else "") + text[at + (change >= 0.85) * draw.randrange(40) :]
    )


@pytest.mark.parametrize(("suffix", "model"), MODELS, ids=[suffix for suffix, _ in MODELS])
def test_no_model_ends_in_a_traceback(suffix: str, model: str, tmp_path: Path) -> None:
    """Nor makes a world that cannot be loaded."""
    draw, loaded, refused = random.Random(suffix), 0, 0
    for _ in range(50):
        (tmp_path / f"m{suffix}").write_text(mutated(model, draw), encoding="utf-8")
        try:
            made = import_model(tmp_path / f"m{suffix}", folder=tmp_path)
        except WorldError:
            refused += 1
            continue
        made.write_files(tmp_path)
        load_text(made.text, "world.yaml", tmp_path)
        loaded += 1
    assert min(loaded, refused) > 5
