"""Every file and every heading that a page names exists, a function that it links to stands in that
file, and code that it quotes stands there word by word.

    python3 tests/docs.py <root of the repository>

A block of C++ or of a patch follows a line <!-- from FILE -->. The rule for it is first tried on made-up pages.
"""
import pathlib
import re
import sys
import tempfile

FOLDERS = "apps|configs|docs|lib|scenes|scripts|tests|trajectories"
# A path from the root of the repository, wherever it stands; patterns with * are not paths.
PATH = re.compile(rf"(?<![\w./*-])(?:\.\./|\./)?((?:{FOLDERS})/[\w./-]*[\w/])(?![\w*<{{])")
LINK = re.compile(r"\[([^\]]*)\]\(([^)\s]+)\)")
BLOCK = re.compile(r"(?:^<!-- from (\S+) -->\n)?^```(?:cpp|diff)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
MADE_LATER = ("scenes/generated/",)  # by scripts/make_scenes.py


def anchors_of(page: pathlib.Path) -> set[str]:
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
            for title in re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)}


def faults_in_quotes(page: pathlib.Path, root: pathlib.Path) -> list[str]:
    faults = []
    text = page.read_text()
    for block in BLOCK.finditer(text):
        where = f"{page.relative_to(root)}:{text.count(chr(10), 0, block.start(2))}"
        file = block.group(1)
        if not file:
            faults.append(f"{where}: write <!-- from FILE --> above this code")
        elif not (root / file).is_file() or block.group(2) not in (root / file).read_text():
            faults.append(f"{where}: this code does not stand in {file}")
    return faults


def faults_in_api(root: pathlib.Path) -> list[str]:
    """The API in docs/development.md is what the projects of tests/consumer include."""
    page = (root / "docs/development.md").read_text()
    listed = set(re.findall(r"^\| \[([\w/]+\.h)\]", page, re.MULTILINE))
    used = {header for file in (root / "tests/consumer").glob("*.cpp")
            for header in re.findall(r'^#include "(.*)"', file.read_text(), re.MULTILINE)}
    return [f"docs/development.md and tests/consumer disagree on {header}" for header in sorted(listed ^ used)]


def try_the_rule():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "a.cpp").write_text("int a;\nint b;\n")
        page = root / "page.md"
        for text, fault in (("<!-- from a.cpp -->\n```cpp\nint b;\n```\n", ""),
                            ("<!-- from a.cpp -->\n```cpp\nint c;\n```\n", "page.md:2: this code"),
                            ("<!-- from b.cpp -->\n```cpp\nint b;\n```\n", "page.md:2: this code"),
                            ("Text\n```cpp\nint b;\n```\n", "page.md:2: write <!-- from")):
            page.write_text(text)
            found = faults_in_quotes(page, root)
            assert [line[:len(fault)] for line in found] == [fault] * bool(fault), (text, found)


def faults_of(page: pathlib.Path, root: pathlib.Path) -> list[str]:
    faults = []
    for number, line in enumerate(page.read_text().splitlines(), 1):
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
    try_the_rule()
    pages = sorted((root / "docs").rglob("*.md")) + sorted(root.glob("*.md"))
    faults = [fault for page in pages for fault in faults_of(page, root) + faults_in_quotes(page, root)]
    faults += faults_in_api(root)
    print("\n".join(faults) if faults else f"{len(pages)} pages name nothing that is not there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
