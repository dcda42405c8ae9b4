"""Walks the includes and fails when an arrow of the architecture runs the wrong way."""
import pathlib
import re
import sys

# What each folder of lib/ may include besides itself (docs/development.md).
ALLOWED = {
    "core": set(),
    "mission": {"core"},
    "scene": {"core"},
    "trajectory": {"core"},
    "visibility": {"core", "scene"},
    "ping": {"core", "mission", "scene", "visibility"},
    "product": {"core", "mission", "ping"},
    "sonar": {"core", "mission", "scene", "visibility", "ping", "product"},
    "dataset": {"core", "mission", "scene", "trajectory", "visibility", "ping", "sonar", "product"},
    "validation": {"core", "mission", "scene", "trajectory", "visibility", "ping", "sonar", "product",
                   "dataset"},
    "benchmark": {"core", "mission", "scene", "trajectory", "visibility", "ping", "sonar", "product",
                  "dataset", "validation"},
}
# Which folder alone may use a library.
OWNERS = {
    "yaml-cpp/": "mission",
    "tiny_gltf.h": "scene",
    "OpenImageIO/": "dataset",
    "embree3/": "visibility",
    "embree4/": "visibility",
    "CLI/": "apps",
}


def main(root: pathlib.Path) -> int:
    faults = []
    files = sorted(p for top in ("lib", "apps") for p in (root / top).rglob("*")
                   if p.suffix in (".h", ".cpp"))
    if not files:
        faults.append(f"no sources under {root}")
    for path in files:
        parts = path.relative_to(root).parts
        here = parts[1] if parts[0] == "lib" else "apps"
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*([<"])([^">]+)[">]', line)
            if not match:
                continue
            name = match.group(2)
            where = f"{path.relative_to(root)}:{number}"
            for prefix, owner in OWNERS.items():
                if name.startswith(prefix) and here != owner:
                    faults.append(f"{where}: {name} belongs to {owner} alone")
            if match.group(1) == "<":
                continue
            target = name.split("/")[0]
            if "/" not in name or (here != "apps" and target not in ALLOWED):
                if here != "apps":
                    faults.append(f'{where}: write "folder/file.h", not "{name}"')
            elif here != "apps" and target != here and target not in ALLOWED[here]:
                faults.append(f"{where}: {here} may not include {target}")
    print("\n".join(faults) if faults else f"{len(files)} files, no arrow runs the wrong way")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
