"""Every file and every heading that a page names exists, and a function it links to stands in that file.

    python3 tests/docs.py <root of the repository>
"""
import pathlib
import re
import sys

FOLDERS = "apps|configs|docs|lib|scenes|scripts|tests|trajectories"
# A path from the root of the repository, wherever it stands; patterns with * are not paths.
PATH = re.compile(rf"(?<![\w./*-])(?:\.\./|\./)?((?:{FOLDERS})/[\w./-]*[\w/])(?![\w*<{{])")
LINK = re.compile(r"\[([^\]]*)\]\(([^)\s]+)\)")
MADE_LATER = ("scenes/generated/",)  # by scripts/make_scenes.py


def anchors_of(page: pathlib.Path) -> set[str]:
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
            for title in re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)}


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
    pages = sorted((root / "docs").rglob("*.md")) + sorted(root.glob("*.md"))
    faults = [fault for page in pages for fault in faults_of(page, root)]
    print("\n".join(faults) if faults else f"{len(pages)} pages name nothing that is not there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
