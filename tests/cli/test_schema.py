"""`sonarsim keys --json`: what the program takes, its schema takes, and what a schema can tell is wrong, both
refuse."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

from sandbox import SONARSIM, Sandbox

try:
    import jsonschema
    import yaml
except ImportError as lacking:
    print(f"skipped: {lacking}; Debian has python3-jsonschema and python3-yaml")
    sys.exit(77)

ROOT = pathlib.Path(__file__).parents[2]
SCHEMA = json.loads(subprocess.run([SONARSIM, "keys", "--json"], text=True, capture_output=True, timeout=60,
                                   check=True).stdout)
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)


class Loader(yaml.SafeLoader):
    """Numbers as YAML 1.2 has them: 3e6 is one, which PyYAML takes for text."""


Loader.add_implicit_resolver("tag:yaml.org,2002:float",
                             re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$"),
                             list("-+.0123456789"))
# Whole numbers are looked for before the others.
for character, resolvers in Loader.yaml_implicit_resolvers.items():
    resolvers.sort(key=lambda one: not one[0].endswith(":int"))

# A text that stands in the small mission, what it becomes, and the key at which it is wrong.
WRONG = (
    ("seed: 7", "sead: 7", "sead"),
    ("seed: 7", "seed: -1", "seed"),
    ("seed: 7", "seed: 1.5", "seed"),
    ("seed: 7", "seed: soon", "seed"),
    ("seed: 7", "seed: 7\nengine: cubes", "engine"),
    ("seed: 7", "seed: 7\nwater: {density_kg_m3: heavy}", "density_kg_m3"),
    ("seed: 7", "seed: 7\nwater: 997", "water"),
    ("seed: 7", "seed: 7\nclasses: {nodes: a, class: b}", "classes"),
    ("seed: 7", "seed: 7\noctree: {leaf_m: tiny}", "leaf_m"),
    ("  materials: materials.csv\n", "", "scene"),
    ("  materials: materials.csv\n", "  materials: materials.csv\n  up: w\n", "up"),
    ("  materials: materials.csv\n", "  materials: materials.csv\n  objects: [{name: hull}]\n", "objects"),
    ("  file: path.csv", "  waypoints: [{position_m: [0, 0, 0]}]", "trajectory"),
    ("  file: path.csv", "  file: path.csv\n  speed_m_s: 1", "trajectory"),
    ("kind: imaging", "kind: lidar", "kind"),
    ("    kind: imaging\n", "", "fls"),
    ("kind: imaging", "kind: sidescan", "azimuth_bins"),
    ("kind: imaging", "kind: imaging\n    opening_deg: 30", "opening_deg"),
    ("kind: imaging", "kind: imaging\n    instrument: {}", "instrument"),
    ("kind: imaging", "kind: imaging\n    model: calibrated", "noise"),
    ("kind: imaging", "kind: imaging\n    mount: {rpy_deg: [0, 0]}", "rpy_deg"),
    ("kind: imaging", "kind: imaging\n    mount: {rpy_deg: [0, 0, 361]}", "rpy_deg"),
    ("azimuth_deg: 60", "azimuth_deg: 361", "azimuth_deg"),
    ("range_max_m: 6", "range_max_m: 0", "range_max_m"),
    ("range_max_m: 6", "range_max_m: 6 m", "range_max_m"),
    ("range_bins: 48", "range_bins: 0", "range_bins"),
    ("range_bins: 48", "range_bins: 48.5", "range_bins"),
    ("range_bins: 48", "range_bins: 8193", "range_bins"),
    ("add_sigma: 0.05", "add_sigma: -0.05", "add_sigma"),
    ("  fls:", "  fore ward:", "fore ward"),
    ("image: true", "image: 1", "image"),
    ("image: true", "image: yes please", "image"),
    ("image: true", "labels: [instances]", "labels"),
    ("image: true", "labels: [share, share]", "labels"),
    ("folder: out", "folder: [out]", "folder"),
)


def faults(text):
    """Every place and message of the schema's complaint, in one text; "" where it has none."""
    lines, waiting = [], list(VALIDATOR.iter_errors(yaml.load(text, Loader)))
    while waiting:
        error = waiting.pop()
        lines.append(f"{'.'.join(map(str, error.absolute_path))}: {error.message}")
        waiting += error.context
    return "\n".join(lines)


class Schema(Sandbox):
    def test_it_is_a_schema(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        self.assertEqual(SCHEMA["properties"]["seed"]["maximum"], 2**64 - 1)
        self.assertEqual(SCHEMA["properties"]["water"]["properties"]["density_kg_m3"]["default"], 997)

    def test_examples_validate(self):
        missions = sorted((ROOT / "configs").glob("*.yaml")) + [ROOT / "tests" / "four_sonars.yaml"]
        self.assertGreater(len(missions), 15)
        for path in missions:
            with self.subTest(path=path.name):
                self.assertEqual(faults(path.read_text()), "")
        for path in sorted((ROOT / "configs" / "sensors").glob("*.yaml")):
            lines = "\n".join("    " + line for line in path.read_text().splitlines())
            small = (self.folder / "mission.yaml").read_text()
            with self.subTest(preset=path.name):
                self.assertEqual(faults(small[:small.index("    kind")] + lines + "\n"), "")

    def test_what_the_schema_refuses_the_program_refuses(self):
        sound = (self.folder / "mission.yaml").read_text()
        self.assertEqual(faults(sound), "")
        self.assertEqual(self.run_sonarsim("validate", "mission.yaml").returncode, 0)
        for right, wrong, key in WRONG:
            with self.subTest(wrong=wrong):
                self.assertIn(right, sound)
                text = sound.replace(right, wrong)
                self.assertIn(key, faults(text))
                self.write("wrong.yaml", text)
                self.assertEqual(self.run_sonarsim("validate", "wrong.yaml").returncode, 2)

    def test_what_only_looks_wrong_is_right(self):
        sound = (self.folder / "mission.yaml").read_text()
        self.write("mine.yaml", "kind: imaging\nrange_bins: 48\n")
        for right, other in (("name: box", "name: 7"), ("seed: 7", "seed: 18446744073709551615"),
                             ("range_max_m: 6", "range_max_m: 6e0"),
                             ("seed: 7", "seed: 7\nwater: {sound_speed_m_s: auto}"),
                             ("image: true", "labels: true"),
                             ("kind: imaging", "kind: imaging\n    model: paper"),
                             ("    kind: imaging\n", "    preset: mine.yaml\n")):
            with self.subTest(other=other):
                text = sound.replace(right, other)
                self.assertEqual(faults(text), "")
                self.write("other.yaml", text)
                result = self.run_sonarsim("validate", "other.yaml")
                self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    unittest.main()
