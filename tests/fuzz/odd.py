"""Odd things that files may say: numbers, words, expressions, counts and sections that nobody means."""

# ruff: noqa: E501 - each stands whole, as a file would say it

from __future__ import annotations

from typing import Any

NUMBERS = (
    "0", "-0", "1", "-1", "2", "0.5", "-3.5", "1e-3", "1e3", "1e6", "-1e6", "1e-12", "1e12", "1e30", "-1e30", "1e-30",
    "1e-300", "1e154", "1e200", "1e308", "-1e308", "1.7976931348623157e308", "5e-324", "1e309", "1e999999", "1e-999999",
    "9007199254740993", "2147483648", "4294967296", "9223372036854775807", "9223372036854775808",
    "18446744073709551616", "1" + "0" * 40, "1" + "0" * 320, "9" * 5000, ".inf", "-.inf", ".nan", "0x10", "1_000",
    "1/0", "1/240", "1/3e-300", "0/0", "1e300/1e-300", "100", "10000", "1000001", "100000000",
)  # fmt: skip
UNITS = (
    "", " m", " mm", " kg", " s", " deg", " m/s", " N m", " %", " rad/s", " parsec", " m9", " m^9 m^9", " /s", " (m",
    " px", " 1/(kg m2)",
)  # fmt: skip
TEXTS = (
    "", " ", "x", "ball", "name", "world", "nobody", "all", "end", "*", "**", "rain[0,0,0]", "rain[", "a.b.c", "..", ".",
    "/", "é", "日本", "\u202eabc", "\x1b[31m", "\ufeff", "\u2028", "\U0001f600", "\x85", "a\nb", "%s %d {0}", "{}", "'", '"',
    "true", "null", "~", "0", "__class__", "__import__", "-", "*.y < 0", "a" * 63, "a" * 64, "a" * 65, "a" * 5000,
    "x." * 500, "[" * 300, "(" * 300, "1 " * 300, "0" * 100,
)  # fmt: skip
HARM = "__import__('pathlib').Path('harm').touch()"
EXPRESSIONS = (
    "${1 / 0}", "${2 ** 2 ** 2 ** 2 ** 2}", "${" + " ** ".join(["9"] * 40) + "}", "${10 ** 16 ** 16}", "${1e308 * 10}",
    "${" + "(" * 60 + "1" + ")" * 60 + "}", "${" + "-" * 150 + "1}", "${" + "1+" * 90 + "1}", "${x}", "${x.y.z}",
    "${x} ${x} ${x}", "${", "${}", "${${x}}", "${pi", "${sqrt(-1)}", "${exp(1e9)}", "${tan(90 deg)}", "${min()}",
    "${round(1e300)}", "${round(0.5 m)}", "${1 m + 1 kg}", "${1 m ** 9}", "${1 px ** 16}", "${a}" * 50, "${'a'}",
    "${" + HARM + "}", "${().__class__}", "${sin(1e300)}", "${max(" + "1," * 80 + "1)}", "${0 ** -1}", "${1e-200 ** 16}",
    "${1_000}", "${٣}", "${x[0]}", "${1 if 1 else 2}", "${lambda: 1}", "${9e999}", "${9 // 2}", "${true}", "${0/0}",
)  # fmt: skip
TOKENS = (
    " ", "\n", "\t", "\0", "\x85", "\u2028", "\ufeff", ":", ": ", "- ", "? ", "[", "]", "{", "}", ",", "#", "&a ", "*a ",
    "*", "&", "!", "!!", "|", ">", "'", '"', "%", "@", "`", "---\n", "...\n", "%YAML 1.1\n---\n", "<<: *a\n", "~", "\\x", "\r",
    "!!python/object/apply:pathlib.Path.touch [harm]", "!!python/name:os.system ", "!!binary ", "!!set ", "!!int ", "!x ",
    "  ", "\U0001f600", "é", "\x7f", "${", "}", "**", "/", "..", "-", "carom: 1\n", "entities:\n", "x: &x [*x, *x]\n",
    "[[", "{a: ", "- - ", "\ud800", "'''", "\\", "1e309", "0", ".",
)  # fmt: skip
VALUES: tuple[Any, ...] = (
    None, True, False, [], {}, [[]], [{}], {"": None}, [None], [1, 2], [1, 2, 3], [1, 2, 3, 4], ["x"], {"x": 1}, [True] * 3,
    ["nan"] * 3, [".nan"] * 3, ["1e308"] * 3, ["-1e200", "1e200", "1"], ["0"] * 3, ["0"] * 4, ["1e-320"] * 3, "x",
    {"axis": ["0", "0", "0"], "angle": "1e300"}, {"euler": ["1e300"] * 3, "order": "xyz"}, {"look_at": ["0"] * 3},
    list(range(2000)), {f"k{n}": n for n in range(500)}, *TEXTS, *NUMBERS,
)  # fmt: skip
COUNTS = ("1", "2", "50", "2000", "1000001", "1000000000", "9223372036854775808", "1" + "0" * 30, "-1", "0", "1.5")
COPIES: tuple[dict[str, Any], ...] = tuple(
    copies
    for count in COUNTS
    for copies in (
        {"grid": {"count": [count, "1", count], "spacing": "0.1"}},
        {"grid": {"count": ["10", "10", "10"], "spacing": "1e308"}},
        {"line": {"count": count, "step": ["1e307", "0", "0"]}},
        {"ring": {"count": count, "radius": "1e300"}},
        {"stack": {"count": count}},
        {"wall": {"count": [count, "2"]}},
        {"pyramid": {"base": [count, "2"]}},
        {"heap": {"count": count, "area": ["1", "1"]}},
        {"random": {"count": count, "box": ["2", "2", "2"]}},
        {"random": {"count": count, "sphere": "1e-9"}},
        {"chain": {"end": ["1", "1", "1"], "count": count, "sag": "0.1"}},
        {"chain": {"end": ["1e300", "1", "1"], "count": "5", "sag": "1e308"}},
        {"emitter": {"rate": count, "life": count}},
        {"emitter": {"burst": count, "every": "1e-9"}},
        {"keyframes": [{"at": "0"}, {"at": count, "position": ["1e308", "0", "0"]}]},
    )
    if copies != {} and (count in COUNTS[:1] or count in str(copies))
)
SECTIONS: tuple[dict[str, Any], ...] = (
    *({"include": [word]} for word in (
        "world.yaml", "part.yaml", "../world.yaml", "/etc/passwd", "/dev/zero", "missing.yaml", ".", "..", "", "a\0b.yaml",
        "part.yaml/../part.yaml", "~/x.yaml", "http://localhost/x.yaml", "x" * 5000 + ".yaml", "folder.yaml", "link.yaml",
    )),
    {"include": ["part.yaml"] * 200},
    {"include": "part.yaml"},
    {"variables": {"a": "${b}", "b": "${a}"}},
    {"variables": {f"v{n}": f"${{v{n + 1}}} ${{v{n + 1}}}" for n in range(80)} | {"v80": "x" * 50}},
    {"variables": {f"v{n}": f"${{v{n + 1} * v{n + 1}}}" for n in range(60)} | {"v60": "10"}},
    {"variables": {f"v{n}": [f"${{v{n + 1}}}"] * 3 for n in range(9)} | {"v9": ["1", "2"]}},
    {"variables": {"x": {"x": {"x": "${x}"}}}},
    {"prefabs": {"a": {"prefab": "a"}}, "entities": [{"prefab": "a"}]},
    {"prefabs": {"a": {"entities": [{"name": "b", "prefab": "a"}]}}, "entities": [{"name": "c", "prefab": "a"}]},
    {"prefabs": {f"p{n}": {"entities": [{"name": "a", "prefab": f"p{n + 1}"}, {"name": "b", "prefab": f"p{n + 1}"}]}
                 for n in range(20)} | {"p20": {"collider": {"point": {}}}}, "entities": [{"name": "c", "prefab": "p0"}]},
    {"prefabs": {"p": {"entities": []}}, "entities": [{"name": "c", "prefab": "p", "grid": {"count": ["1000"] * 3,
                                                                                         "spacing": "1"}}]},
    {"entities": [{"name": f"e{n}", "collider": {"point": {}}, "grid": {"count": ["100"] * 3, "spacing": "1"}}
                  for n in range(40)]},
    {"entities": [{"name": "e", "collider": {"mesh": {"file": name}}} for name in (
        "/dev/zero", "/etc/passwd", "..", "world.yaml", "part.obj", "\0", "x" * 5000 + ".obj", "folder.stl", "part.glb",
    )]},
    {"entities": [{"name": "e", "collider": {"height_field": {"image": name, "spacing": "1"}}} for name in (
        "/dev/zero", "/dev/stdin", "..", "world.yaml", "part.png", "folder.png",
    )]},
    {"entities": [{"name": "e", "collider": {"convex": {"points": [[str(n % 3), "0", "0"] for n in range(500)]}}}]},
    {"entities": [{"name": "e", "collider": {"mesh": {"vertices": [["0"] * 3] * 3, "faces": [["0", "1", "999999999999"]]}}}]},
    {"run": {"duration": "1e308"}}, {"run": {"frames": "1" + "0" * 30}}, {"run": {"until": "rest", "at_most": "1e300"}},
    {"step": {"dt": "1e-300"}}, {"step": {"dt": "1e300"}}, {"step": {"substeps": "1000000000"}}, {"step": {"threads": "99999"}},
    {"step": {"dt": "5e-324"}, "run": {"duration": "1e300"}}, {"seed": "1" + "0" * 100}, {"seed": "-1"},
    {"drawn": "1" + "0" * 50}, {"render": {"width": "1000000000", "height": "1000000000"}}, {"render": {"fps": "1e-300"}},
    {"layers": {f"l{n}": [] for n in range(100)}}, {"layers": [f"l{n}" for n in range(100)]},
    {"gravity": ["1e308", "1e308", "1e308"]}, {"state": {"of": "x", "snapshot": "eJw="}}, {"carom": "2"}, {"carom": True},
    {"expect": [{"never": HARM}, {"always": "(" * 200}, {"at": "1e300", "x.y": {"is": "1", "within": "0"}}]},
    {"expect": [{"never": "*.position.y < 1e999"}, {"visible": "x >= 1e999 px from y"}]},
)  # fmt: skip
