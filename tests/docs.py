"""Every file, heading, key and option that a page names exists; code that it quotes stands in its file word by word.

    python3 tests/docs.py <root of the repository>

A block of C++ or of a patch follows a line <!-- from FILE -->. Blocks of YAML are left out without python3-yaml. The rules
for code and keys are first tried on made-up pages.
"""
import contextlib
import importlib.util
import pathlib
import re
import sys
import textwrap

FOLDERS = "apps|configs|docs|lib|scenes|scripts|tests|trajectories"
# A path from the root of the repository, wherever it stands; patterns with * are not paths.
PATH = re.compile(rf"(?<![\w./*-])(?:\.\./|\./)?((?:{FOLDERS})/[\w./-]*[\w/])(?![\w*<{{])")
LINK = re.compile(r"\[([^\]]*)\]\(([^)\s]+)\)")
BLOCK = re.compile(r"(?:^<!-- from (\S+) -->\n)?^```(?:cpp|diff)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
MADE_LATER = ("scenes/generated/",)  # by scripts/make_scenes.py
# A command of the program in a block of commands, and a key with a dot in the text.
FILES = ("py", "h", "cpp", "md", "json", "txt", "csv", "npy", "tif", "png", "tum")
COMMAND = re.compile(r"^ {4}(?:build/)?sonarsim ([a-z][a-z-]*)(.*)$", re.MULTILINE)
DOTTED = re.compile(r"`([a-z_]+(?:\.[A-Za-z_0-9]+)+)`")
YAML = re.compile(r"^```yaml\n(.*?)^```$|^((?: {4}.*\n|\n(?= {4}))+)", re.MULTILINE | re.DOTALL)


def anchors_of(page: pathlib.Path) -> set[str]:
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
            for title in re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)}


def faults_in_quotes(page: str, text: str, root: pathlib.Path) -> list[str]:
    faults = []
    for block in BLOCK.finditer(text):
        file, code = block.groups()
        if file and (root / file).is_file() and code in (root / file).read_text():
            continue
        what = f"this code does not stand in {file}" if file else "write <!-- from FILE --> above this code"
        faults.append(f"{page}:{text.count(chr(10), 0, block.start(2))}: {what}")
    return faults


def faults_in_api(root: pathlib.Path) -> list[str]:
    """The API in docs/development.md is what the projects of tests/consumer include."""
    page = (root / "docs/development.md").read_text()
    listed = set(re.findall(r"^\| \[([\w/]+\.h)\]", page, re.MULTILINE))
    used = {header for file in (root / "tests/consumer").glob("*.cpp")
            for header in re.findall(r'^#include "(.*)"', file.read_text(), re.MULTILINE)}
    return [f"docs/development.md and tests/consumer disagree on {header}" for header in sorted(listed ^ used)]


def keys_of(root: pathlib.Path) -> set[str]:
    """The keys of docs/mission.md as paths, without numbers of items and names of sensors: scene.objects.file."""
    keys, section = set(), ""
    for line in (root / "docs/mission.md").read_text().splitlines():
        if line.startswith("### "):
            named = re.match(r"### `([\w.]+)`", line)
            section = re.sub(r"\.(?:0|NAME)\b", "", named.group(1)) + "." if named else ""
        elif row := re.match(r"\| `([\w.]+)` \|", line):
            keys.add(section + row.group(1))
    return keys


def paths_in(value, path: str, keys: set[str]):
    """The paths of the keys in a block of YAML; the names of sensors are left out."""
    if isinstance(value, list):
        for item in value:
            yield from paths_in(item, path, keys)
    elif isinstance(value, dict) and any(key.startswith(path + ".") for key in keys):
        for name, inner in value.items():
            below = path if path == "sensors" else f"{path}.{name}".lstrip(".")
            yield from () if below == path else (below,)
            yield from paths_in(inner, below, keys)


def faults_in_keys(page: str, text: str, keys: set[str]) -> list[str]:
    """Keys that no mission has: in blocks that begin with a section of the mission or of a scene or sensor."""
    sections = {key.rsplit(".", 1)[0] for key in keys if "." in key}
    last = {part for section in sections for part in section.split(".")}
    faults = [f"{page}: no mission has a key {name}" for name in DOTTED.findall(text)
              if name.split(".")[0] in last and name.rsplit(".", 1)[1] not in FILES
              and not any(f".{key}".endswith("." + re.sub(r"\.\d+\b", "", name).replace(".NAME", "")) for key in keys)]
    if importlib.util.find_spec("yaml") is None:
        return faults
    import yaml
    for block in YAML.finditer(text):
        body = textwrap.dedent(block.group(1) or block.group(2))
        first = re.match(r"(\w+):(?: |$)", body.split("\n")[0])
        for above in [one for one in ("", "scene.", "sensors.") if first and one + first.group(1) in keys][:1]:
            with contextlib.suppress(yaml.YAMLError):  # commands may stand in the same block
                paths = set(paths_in(yaml.safe_load(body), above.rstrip("."), keys))
                faults += [f"{page}: no mission has a key {path}" for path in sorted(paths - keys)]
    return faults


def faults_in_commands(page: str, text: str, root: pathlib.Path) -> list[str]:
    """Commands and options of the program that its sources do not name."""
    program = "".join(file.read_text() for folder in ("apps/sonarsim", "apps/python/sonarsim")
                      for file in (root / folder).rglob("*") if file.suffix in (".cpp", ".h", ".py"))
    faults = []
    for command, rest in COMMAND.findall(text.replace("\\\n", "")):
        unknown = [option for option in re.findall(r"(?<=\s)--[a-z][a-z-]*", re.split(r"\s{2,}#| # ", rest)[0])
                   if f'"{option}"' not in program and f",{option}" not in program]
        unknown += [] if f'"{command}"' in program else [command]
        faults += [f"{page}: sonarsim {command} does not have {name}" for name in unknown]
    return faults


def try_the_rules(root: pathlib.Path):
    keys = {"seed", "scene", "scene.objects", "scene.objects.file", "sensors", "sensors.noise", "sensors.noise.gain"}
    cases = [(faults_in_quotes("page.md", text, root), fault) for text, fault in (
        ("<!-- from tests/docs.py -->\n```cpp\nimport sys\n```\n", ""),
        ("<!-- from tests/docs.py -->\n```cpp\nimport c\n```\n", "page.md:2: this code"),
        ("<!-- from tests/none.py -->\n```cpp\nimport sys\n```\n", "page.md:2: this code"),
        ("Text\n```cpp\nint b;\n```\n", "page.md:2: write <!-- from"))]
    cases += [(faults_in_keys("page.md", text, keys), fault) for text, fault in (
        ("`scene.objects.0.file` and `noise.gain`, `scene.file`\n", "page.md: no mission has a key scene.file"),
        ("`numpy.array`\n", ""), ("    sonarsim render\n", ""),
        ("```yaml\nsensors: {fls: {noise: {gain: 1}}}\n```\n", ""),
        *([("    objects:\n      - {file: a.glb, of: 1}\n", "page.md: no mission has a key scene.objects.of")]
          if importlib.util.find_spec("yaml") else []))]
    for found, fault in cases:
        assert [line[:len(fault)] for line in found] == [fault] * bool(fault), (found, fault)


def faults_of(page: pathlib.Path, text: str, root: pathlib.Path) -> list[str]:
    faults = []
    for number, line in enumerate(text.splitlines(), 1):
        where = f"{page.relative_to(root)}:{number}"
        for path in PATH.findall(line):
            if not path.startswith(MADE_LATER) and not (root / path).exists():
                faults.append(f"{where}: {path} does not exist")
        for label, target in LINK.findall(line):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            linked = page.parent / file if file else page
            if not linked.exists():
                faults.append(f"{where}: {target} does not exist")
            elif anchor and anchor not in anchors_of(linked):
                faults.append(f"{where}: no heading makes the anchor {target}")
            name = re.fullmatch(r"`(\w+)`", label)
            if name and file and linked.is_file() and name.group(1) not in linked.read_text():
                faults.append(f"{where}: {target} does not hold {name.group(1)}")
    return faults


def main(root: pathlib.Path) -> int:
    try_the_rules(root)
    keys = keys_of(root)
    pages = sorted((root / "docs").rglob("*.md")) + sorted(root.glob("*.md"))
    faults = faults_in_api(root)
    for page in pages:
        name, text = str(page.relative_to(root)), page.read_text()
        faults += faults_of(page, text, root) + faults_in_quotes(name, text, root) + faults_in_commands(name, text, root)
        faults += faults_in_keys(name, text, keys) if page.name != "CHANGELOG.md" else []
    print("\n".join(faults) if faults else f"{len(pages)} pages name nothing that is not there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
