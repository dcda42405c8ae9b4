"""Walks the includes and fails when an arrow of the architecture runs the wrong way.

    python3 tests/layering.py <root of the repository>

A folder of lib/ includes only the folders below it (ALLOWED), a part of a folder only the parts below it (PARTS); x.h and
x.cpp count as one. No files include each other in a circle. Each rule is first tried on made-up files that break it.
"""
import graphlib
import pathlib
import re
import sys

# The doors of lib/ from the bottom up, and the folders behind them. core is a door and a folder.
DOORS = {
    "core": ("core",), "input": ("mission", "scene", "trajectory"),
    "simulate": ("water", "visibility", "trace", "paper", "calibrated", "ping", "labels", "product", "sonar", "assembly",
                 "reference"), "output": ("format", "dataset"), "run": ("checks", "job", "report", "preview")}
DOOR_OF = {folder: door for door, folders in DOORS.items() for folder in folders}
# The folders of lib/ with the folders that each includes.
ALLOWED = {folder: set(lowers.split()) for folder, lowers in {
    "core": "", "mission": "core", "water": "core", "scene": "core mission", "trajectory": "core mission",
    "visibility": "core water scene", "trace": "core water scene visibility",
    "paper": "core mission scene visibility trace", "calibrated": "core mission scene visibility trace",
    "ping": "core mission water trace", "labels": "core scene visibility trace ping",
    "product": "core mission trace ping labels", "sonar": "core mission visibility paper calibrated ping product",
    "assembly": "core mission water scene trajectory visibility trace calibrated ping product sonar",
    "reference": "core scene visibility trace ping", "format": "core",
    "dataset": "core mission scene trajectory ping labels product sonar assembly format",
    "checks": "core mission scene visibility trace sonar assembly reference dataset",
    "job": "core mission trajectory visibility sonar assembly dataset checks",
    "report": "core mission scene visibility sonar assembly reference dataset checks job",
    "preview": "core mission scene visibility product sonar assembly"}.items()}
assert ALLOWED.keys() == DOOR_OF.keys()
assert all(list(DOORS).index(DOOR_OF[lower]) <= list(DOORS).index(DOOR_OF[folder])
           for folder, lowers in ALLOWED.items() for lower in lowers), "an arrow from a door to a higher one"

# The parts of the folders that have subfolders, from the bottom up; those in one row do not know
# each other. "x/" is a subfolder, "x" the files x.h and x.cpp, "*" every other file of the folder.
PARTS = {
    "dataset": [["*"], ["writers/"], ["writers"], ["layout"], ["metadata"], ["dataset_file"], ["encode_ping"]],
    "job": [["*"], ["shard_lock"], ["journal"], ["folder", "ping_files"], ["ping_cost"], ["completion", "render_pings"],
            ["run_job", "ping_source"], ["variants"], ["dataset_folders"], ["merge", "status", "verify"]],
    "calibrated": [["signal/"], ["equation/"], ["beams/", "speckle/"], ["receiver/"], ["*"]],
    "scene": [["*"], ["images/", "meshes/"], ["heightmap/", "maps/", "seabed/"], ["gltf/", "placing/"]],
    "visibility": [["*"], ["octree/", "rays/", "strips/"], ["make_engine"]]}
# These folders work with what was traced, and take its ranges from arrivals.
AFTER_THE_TRACE = {"paper", "calibrated", "ping", "labels", "product", "sonar", "assembly", "dataset", "checks", "job"}
RANGE_OF_POSITION = re.compile(r"\bposition\.norm\(\)|\bposition / range\b|arctan2\w*\([^)]*position")
# These folders make values of files, which are the same on every processor.
SAME_BYTES = ("water/", "trace/", "paper/", "calibrated/", "ping/", "labels/", "product/", "sonar/", "scene/seabed/")
OF_THE_C_LIBRARY = re.compile(r"\bstd::(a?(sin|cos|tan)h?|atan2|exp[2m]?1?|log(2|10|1p)?|pow|cbrt|hypot|erfc?)\(")
# A class in a header; two of one name would be one to the linker.
CLASS = re.compile(r"(?:class|struct) (\w+)(?: final)?(?: :[^;{]*)? \{")
# Which folder alone may use a library.
OWNERS = {
    "yaml-cpp/": "mission", "tiny_gltf.h": "scene", "assimp/": "apps", "OpenImageIO/": "apps",
    "libdeflate.h": "format", "nettle/": "core", "embree3/": "visibility", "embree4/": "visibility", "CLI/": "apps", }


def without_door(path: str) -> str | None:
    """A path below lib/ from its folder on; None where no folder of that name lies behind that door."""
    door, *rest = path.split("/")
    if door == "core":
        return path if rest else None
    return "/".join(rest) if len(rest) > 1 and rest[0] in DOORS.get(door, ()) else None


def part_of(unit: str) -> tuple[str, int] | None:
    """The part of its folder that a unit, "folder/sub/file", belongs to, and its height; None where
    the folder has no such part."""
    folder, *rest = unit.split("/")
    heights = {part: height for height, row in enumerate(PARTS.get(folder, [["*"]])) for part in row}
    name = rest[0] + "/" if len(rest) > 1 else rest[0] if rest[0] in heights else "*"
    return (name, heights[name]) if name in heights else None


def fault_of(here: str, unit: str, name: str, quoted: bool) -> str | None:
    """What is wrong with `#include name` in a unit of the folder `here`."""
    for prefix, owner in OWNERS.items():
        if name.startswith(prefix) and here != owner:
            return f"{name} belongs to {owner} alone"
    if not quoted or here == "apps":
        return None
    target = without_door(name)
    if target is None:
        return f'write "door/folder/file.h", not "{name}"'
    folder = target.split("/")[0]
    if folder != here:
        return None if folder in ALLOWED[here] else f"{here} may not include {folder}"
    own, other = part_of(unit), part_of(target.removesuffix(".h"))
    if own and other and own != other and other[1] >= own[1]:
        return f"{here}: {own[0]} may not include {other[0]} ({name})"
    return None


def circle_of(includes: dict[str, list[str]]) -> list[str]:
    """The first circle of the includes as "a -> b -> a"; none where there is none."""
    try:
        graphlib.TopologicalSorter({unit: {*others} - {unit} for unit, others in includes.items()}).prepare()
    except graphlib.CycleError as fault:
        return [" -> ".join(reversed(fault.args[1]))]
    return []


def faults_in_code(sources: dict[str, str]) -> tuple[dict[str, list[str]], list[str]]:
    """What each unit includes, and what is wrong with the texts of files by their paths."""
    faults, includes, classes = [], {}, {}
    for path, text in sources.items():
        if path.startswith("tests/"):
            if path.endswith(".cpp") and "doctest::Approx" in text:     # which allows its epsilon for any small number
                faults.append(f"{path}: compare by test::approx (tests/support/test.h)")
            continue
        unit, _, suffix = path.rpartition(".")
        unit = without_door(unit.removeprefix("lib/")) if unit.startswith("lib/") else unit
        if unit is None:
            faults.append(f"{path}: DOORS has no such folder")
            continue
        here = unit.split("/")[0]
        if here != "apps" and not part_of(unit):
            faults.append(f"{path}: PARTS does not say where {here}/{unit.split('/')[1]}/ lies")
        for number, line in enumerate(text.splitlines(), 1):
            if here in AFTER_THE_TRACE and RANGE_OF_POSITION.search(line):
                faults.append(f"{path}:{number}: take ranges and directions from trace/arrivals.h")
            if unit.startswith(SAME_BYTES) and OF_THE_C_LIBRARY.search(line):
                faults.append(f"{path}:{number}: take elementary functions from core/elementary.h")
            defined = CLASS.match(line) if suffix == "h" else None
            if defined and classes.setdefault(defined.group(1), path) != path:
                faults.append(f"{path}:{number}: {classes[defined.group(1)]} has a {defined.group(1)}")
            match = re.match(r'\s*#\s*include\s*([<"])([^">]+)[">]', line)
            if not match:
                continue
            name, quoted = match.group(2), match.group(1) == '"'
            fault = fault_of(here, unit, name, quoted)
            if fault:
                faults.append(f"{path}:{number}: {fault}")
            if quoted:
                includes.setdefault(unit, []).append((without_door(name) or name).removesuffix(".h"))
    return includes, faults + [f"a circle: {circle}" for circle in circle_of(includes)]


def unused_permissions(includes: dict[str, list[str]]) -> list[str]:
    """The arrows of ALLOWED that no include takes."""
    used = {(unit.split("/")[0], name.split("/")[0]) for unit, names in includes.items() for name in names}
    return [f"ALLOWED: no file of {folder} includes {lower}; remove it" for folder, lowers in ALLOWED.items()
            for lower in sorted(lowers) if (folder, lower) not in used]


def faults_in_table(text: str) -> list[str]:
    """The folders that the table of docs/development.md leaves out."""
    listed = re.findall(r"^\| `lib/(?:\w+/)?(\w+)` \|", text, re.MULTILINE)
    return [f"docs/development.md: no row for lib/{DOOR_OF[folder]}/{folder}" for folder in ALLOWED
            if folder not in listed]


def try_the_rules():
    """Each rule finds what breaks it, and nothing else."""
    sound = {
        "lib/core/text.h": "#include <string>\nclass Text;\nstruct Text {\n",
        "lib/simulate/visibility/engine.h": '#include "simulate/visibility/view.h"\n',
        "lib/simulate/visibility/view.h": '#include "core/text.h"\n',
        "lib/simulate/visibility/rays/rays.h": '#include "simulate/visibility/engine.h"\n',
        "lib/simulate/visibility/make_engine.cpp": '#include "simulate/visibility/rays/rays.h"\n',
        "apps/sonarsim/main.cpp": '#include <CLI/CLI.hpp>\n#include "simulate/visibility/make_engine.h"\n'}
    assert faults_in_code(sound)[1] == [], faults_in_code(sound)
    for name, text, fault in (
            ("lib/core/file.h", '#include "simulate/visibility/view.h"', "core may not include visibility"),
            ("lib/simulate/visibility/view.h", '#include "simulate/visibility/rays/rays.h"', "* may not include rays/"),
            ("lib/simulate/visibility/view.h", '#include "simulate/visibility/make_engine.h"',
             "* may not include make_engine"),
            ("lib/simulate/visibility/octree/tree.h", '#include "simulate/visibility/rays/rays.h"',
             "octree/ may not include rays/"),
            ("lib/simulate/visibility/view.cpp", '#include "simulate/visibility/engine.h"',
             "a circle: visibility/engine -> visibility/view -> visibility/engine"),
            ("lib/simulate/visibility/lamps/lamp.h", "", "does not say where visibility/lamps/ lies"),
            ("lib/lamps/lamp.h", "", "DOORS has no such folder"),
            ("lib/simulate/paper/file.h", "float r = sample.position.norm();", "from trace/arrivals.h"),
            ("lib/simulate/labels/file.h", "x = std::asin(y);", "from core/elementary.h"),
            ("tests/core/text_test.cpp", "CHECK(x == doctest::Approx(1e-8));", "compare by test::approx"),
            ("lib/simulate/visibility/view.h", "class Text final {", "lib/core/text.h has a Text"),
            ("lib/core/file.h", '#include "text.h"', 'write "door/folder/file.h"'),
            ("lib/core/file.h", "#include <yaml-cpp/yaml.h>", "belongs to mission alone")):
        found = faults_in_code({**sound, name: text + "\n"})[1]
        assert any(fault in line for line in found), f"not found: {fault}; but {found}"
    assert len(faults_in_table("| `lib/core` | |\n| `lib/input/mission` | |\n")) == len(ALLOWED) - 2
    unused = unused_permissions({"mission/keys": ["core/text"]})
    assert len(unused) == sum(map(len, ALLOWED.values())) - 1, unused
    assert not any("no file of mission includes core" in line for line in unused), unused


def main(root: pathlib.Path) -> int:
    try_the_rules()
    sources = {path.relative_to(root).as_posix(): path.read_text() for top in ("lib", "apps", "tests")
               for path in sorted((root / top).rglob("*")) if path.suffix in (".h", ".cpp")}
    includes, faults = faults_in_code(sources)
    faults += unused_permissions(includes) + faults_in_table((root / "docs/development.md").read_text())
    print("\n".join(faults) if faults else f"{len(sources)} files, no arrow runs the wrong way")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
