"""Every key of a heightmap, of the maps on the ground and of a made bed can be drawn by `vary`."""
import json
import pathlib
import re
import unittest

from composed import Composed
from sandbox import digest
from test_heightmap import png

DOCUMENT = pathlib.Path(__file__).parents[2] / "docs/mission.md"

REST = """\
trajectory:
  waypoints: [{position_m: [0, 0, 0]}, {position_m: [1, 0, 0]}]
  speed_m_s: 1
  rate_hz: 1
sensors:
  fls: {kind: imaging, mount: {rpy_deg: [0, 40, 0]}, azimuth_deg: 60, elevation_deg: 20, range_max_m: 8,
        range_bins: 64, azimuth_bins: 24}
output: {folder: out, labels: [material, class]}
"""

BED = """\
seed: 5
scene:
  materials: materials.csv
  seabed:
    cell_m: 0.3
    size_m: [40, 40]
    sediments: [{material: Concrete, share: 2}, {material: steel, share: 1}]
    rocks: {density_per_m2: 0.1, diameter_m: [0.3, 1.5], buried: [0.2, 0.6]}
"""
TRAIN = [("height_m", "uniform: [0.05, 0.3]"), ("direction_deg", "uniform: [-90, 90]")]
PAIRS = {"rocks.diameter_m": (0.3, 1.5), "rocks.buried": (0.2, 0.6)}
BED_RULES = [
    ("cell_m", "uniform: [0.2, 0.35]"), ("size_m.0", "uniform: [30, 40]"), ("z_m", "uniform: [-5, -4]"),
    ("class", "choice: [ground, floor]"), ("patch_m", "log_uniform: [1, 20]"),
    ("roughness.spectral_strength_cm4", "log_uniform: [0.001, 0.02]"),
    ("roughness.spectral_exponent", "uniform: [2.5, 3.5]"), ("roughness.corner_m", "uniform: [1, 4]"),
    ("ripples.length_m", "uniform: [1.5, 2]"), *[(f"ripples.{key}", rule) for key, rule in TRAIN],
    *[(f"{key}.{k}", f"uniform: [{0.9 * pair[k] - 0.01}, {pair[k]}]") for key, pair in PAIRS.items() for k in range(2)
      if pair[k] > 0],
    ("rocks.density_per_m2", "uniform: [0.02, 0.1]"),
    ("sediments.0.material", "choice: [Concrete, rubber]"), ("sediments.1.share", "uniform: [0.5, 2]"),
    ("rocks.exponent", "uniform: [1.5, 4]"), ("rocks.material", "choice: [steel, rubber]"),
    ("rocks.class", "choice: [one, other]")]
PLAIN = """\
seed: 5
scene:
  materials: materials.csv
  seabed: {cell_m: 0.3, preset: smooth.yaml, z_m: -4}
"""
PLAIN_RULES = [("preset", "choice: [smooth.yaml, rough.yaml]"), ("material", "choice: [Concrete, steel]")]

MAPS = """\
seed: 5
scene:
  materials: materials.csv
  heightmap: {file: a.png, SIZE, material: Concrete}
  sediment_map: {file: a.png, SIZE, materials: {0: Concrete, 1: steel, 2: rubber, 3: steel}}
  backscatter_map: {file: b.png, SIZE}
"""
LAID_RULES = [("file", "choice: [a.png, b.png]"), ("origin_m.0", "uniform: [18, 22]")]
MAP_RULES = [
    *[(f"{section}.{key}", rule) for section in ("heightmap", "sediment_map", "backscatter_map")
      for key, rule in LAID_RULES],
    ("heightmap.height_scale", "uniform: [0.1, 0.3]"), ("heightmap.height_offset_m", "uniform: [-5, -4]"),
    ("heightmap.material", "choice: [steel, rubber]"), ("heightmap.class", "choice: [one, other]"),
    ("sediment_map.materials.3", "choice: [Concrete, rubber]"),
    ("backscatter_map.scale_db", "uniform: [1, 3]"), ("backscatter_map.offset_db", "uniform: [-3, 3]")]
SECTIONS = ("heightmap", "sediment_map", "backscatter_map")
PIXELS = [(f"{section}.pixel_m", "uniform: [0.9, 1.1]") for section in SECTIONS]
SIZES = [(f"{section}.size_m.1", "uniform: [38, 42]") for section in SECTIONS]


def documented_keys():
    """The keys of docs/mission.md in the sections of the ground, without those that are sections."""
    keys = set()
    for title, table in re.findall(r"### `scene\.([a-z_.0]+)`\n(.*?)(?=\n###|\Z)", DOCUMENT.read_text(), re.DOTALL):
        if title.split(".")[0] not in (*SECTIONS, "seabed"):
            continue
        for key, kind in re.findall(r"^\| `(\w+)` \| ([^|]+) \|", table, re.MULTILINE):
            if kind != "section" and kind != "list of sections":
                keys.add(f"{title}.{key}")
    return keys


def files(dataset):
    """The sums of all files of the sonar but those of classes, which have numbers of all variants there, and the
    metadata, which name the variant."""
    return {name: sum_ for name, sum_ in digest(dataset / "fls").items() if not name.startswith(("class/", "meta/"))}


class VaryGround(Composed):
    def setUp(self):
        super().setUp()
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3200\nsteel,7850,5890\n"
                   "rubber,1500,1900\n")
        self.write("smooth.yaml", "roughness: {spectral_strength_cm4: 0.001}\n")
        self.write("rough.yaml", "roughness: {spectral_strength_cm4: 0.1}\n")
        for name, step in (("a.png", 5), ("b.png", 7)):
            (self.folder / name).write_bytes(png([[step * (r + c * c) % 4 for c in range(40)] for r in range(40)], 8))

    def assert_draws(self, mission, prefix, rules):
        """Both variants have their draws, and are what the same values with --set make."""
        rules = [(f"scene.{prefix}{key}", rule) for key, rule in rules]
        self.write("mission.yaml", mission + REST)
        varied = (mission + REST + "variants: 2\nvary:\n" +
                  "".join(f"  - {{key: {key}, {rule}}}\n" for key, rule in rules))
        self.write("varied.yaml", varied)
        done = self.run_sonarsim("render", "varied.yaml", "--overwrite", "--set", "output.folder=varied")
        self.assertEqual(done.returncode, 0, done.stderr)
        for one in json.loads((self.folder / "varied/variants.json").read_text())["variants"]:
            self.assertEqual(list(one["drawn"]), [key for key, _ in rules])
            sets = [word for key, value in one["drawn"].items() for word in ("--set", f"{key}={value}")]
            self.assert_renders("--overwrite", *sets, "--set", f"seed={one['seed']}")
            self.assertEqual(files(self.out), files(self.folder / "varied" / one["folder"]))

    def test_a_bed(self):
        self.assert_draws(BED, "seabed.", BED_RULES)
        self.assert_draws(PLAIN, "seabed.", PLAIN_RULES)

    def test_maps(self):
        self.assert_draws(MAPS.replace("SIZE", "pixel_m: 1, origin_m: [20, 20]"), "", MAP_RULES + PIXELS)
        self.assert_draws(MAPS.replace("SIZE", "size_m: [40, 40], origin_m: [20, 20]"), "", SIZES)

    def test_no_key_is_missing(self):
        drawn = {f"seabed.{key}" for key, _ in BED_RULES + PLAIN_RULES}
        drawn |= {key for key, _ in MAP_RULES + PIXELS + SIZES}
        drawn |= {re.sub(r"\.\d$", "", key) for key in drawn}
        drawn |= {re.sub(r"\.[13]$", "", key) for key in drawn} | {key.replace("sediments.1", "sediments.0") for key in drawn}
        self.assertEqual(sorted(documented_keys() - drawn), [])


if __name__ == "__main__":
    unittest.main()
