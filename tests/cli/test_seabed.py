"""Beds that are made from numbers and the mission's seed."""
import array
import json
import unittest

import clean_clone
from composed import Composed, box_mesh, gltf
from sandbox import digest

MISSION = """\
seed: 5
scene:
  materials: materials.csv
  seabed:
    cell_m: 0.2
    z_m: -2.5
    material: Concrete
    class: bottom
    roughness: {spectral_strength_cm4: 0.003}
    ripples: {height_m: 0.1, length_m: 0.8, direction_deg: 20}
  objects:
    - {name: crate, file: crate.gltf, position_m: [4, 0.5, 9], place: on_bottom}
trajectory:
  waypoints: [{position_m: [0, 0, 0]}, {position_m: [1, 0, 0]}]
  speed_m_s: 1
  rate_hz: 2
sensors:
  fls: {kind: imaging, mount: {rpy_deg: [0, 25, 0]}, azimuth_deg: 60, elevation_deg: 20, range_max_m: 8,
        range_bins: 96, azimuth_bins: 48}
output:
  folder: out
  labels: true
"""


class TestSeabed(Composed):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)

    def names(self, folder="out"):
        return [one["name"] for one in self.dataset(self.folder / folder)["labels"]["instances"]]

    def test_a_bed(self):
        """The same seed makes the same bed, another seed another; objects rest on it."""
        self.assert_renders()
        self.assertEqual(self.names(), ["seabed", "crate"])
        crate = self.dataset()["labels"]["instances"][1]["box_world_m"]
        self.assertTrue(-2.6 < crate["min"][2] < -2.4, crate)
        self.assert_renders("--set", "output.folder=again", "--threads", "1")
        self.assertEqual(digest(self.out / "fls"), digest(self.folder / "again/fls"))
        self.assert_renders("--set", "output.folder=other", "--set", "seed=6")
        self.assertNotEqual(digest(self.out / "fls/polar"), digest(self.folder / "other/fls/polar"))

    def test_its_name_is_its_own(self):
        """A node of the scene's file called seabed is not the bed; no object may be called so."""
        self.write("mission.yaml", MISSION.replace("  seabed:\n", "  file: wreck.gltf\n  seabed:\n"))
        self.write("wreck.gltf", gltf([{"name": "seabed", "mesh": 0, "translation": [5, 0, 3]}],
                                      [box_mesh()]))
        self.assert_renders()
        self.assertEqual(self.names(), ["seabed_2", "seabed", "crate"])
        self.write("mission.yaml", MISSION.replace("name: crate", "name: seabed"))
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), "mission.yaml:",
                            "an object has the name of the ground")

    RICH = MISSION.replace("    material: Concrete\n", """\
    sediments: [{material: Concrete, share: 2}, {material: steel, share: 1}]
    patch_m: 3
    rocks: {density_per_m2: 0.3, diameter_m: [0.3, 1.5], exponent: 2, material: steel}
""").replace("  labels: true\n", "  labels: [instance, class, material, objects]\n")

    def test_truth(self):
        """The files of the truth are that of what is rendered: the same heights as a heightmap, the same
        rocks in the labels, and the share of each material."""
        self.write("mission.yaml", self.RICH)
        self.assert_renders()
        reported = json.loads((self.out / "seabed/seabed.json").read_text())
        grid = reported["grid"]
        data = (self.out / "seabed/heights.tif").read_bytes()
        heights = array.array("f", data[-4 * grid["rows"] * grid["columns"]:])
        self.assertTrue(-4 < min(heights) < max(heights) < -1)
        instances = {one["name"]: one for one in self.dataset()["labels"]["instances"]}
        self.assertGreater(len(reported["rocks"]), 20)
        for rock in reported["rocks"]:
            labelled = instances[rock["name"]]["box_world_m"]
            for side in ("min", "max"):
                for a, b in zip(rock["box_world_m"][side], labelled[side], strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-4)
            self.assertTrue(0.3 <= rock["diameter_m"] <= 1.5 and 0.2 <= rock["buried"] <= 0.6)
            x, y, _ = rock["middle_m"]
            row = int((grid["north_m"] - y) / grid["cell_m"])
            column = int((x - grid["west_m"]) / grid["cell_m"])
            bottom, top = (rock["box_world_m"][side][2] for side in ("min", "max"))
            bed = heights[row * grid["columns"] + column]
            # The bed within half a cell of the middle has nearly its height.
            self.assertAlmostEqual(bottom + rock["buried"] * (top - bottom), bed, delta=0.25)
        self.assertEqual([one["material"] for one in reported["materials"]], ["Concrete", "steel"])
        self.assertAlmostEqual(sum(one["share"] for one in reported["materials"]), 1)
        names = {one["id"]: one["name"] for one in self.dataset()["labels"]["classes"]}
        self.assertEqual({names[one["class"]] for one in instances.values() if one["name"].startswith("rock_")},
                         {"rock"})
        background = self.dataset()["labels"]["annotations"]["background"]
        seen = [one for file in self.out.glob("*/objects/*.json") for one in json.loads(file.read_text())["objects"]]
        self.assertEqual({one["class"] for one in seen} - {"crate", *background}, {"rock"})
        # A dataset like any other: verified, and resumed where a file of the truth is gone.
        before = digest(self.out)
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)
        (self.out / "seabed/heights.tif").unlink()
        self.assertNotEqual(self.run_sonarsim("verify", "out").returncode, 0)
        self.assert_renders()
        self.assertEqual(digest(self.out), before)
        shards = [self.run_sonarsim("render", "mission.yaml", "--shard", f"{k}/2", "--out", f"part{k}")
                  for k in (1, 2)]
        self.assertEqual([one.returncode for one in shards], [0, 0], shards[0].stderr)
        self.assertEqual(self.run_sonarsim("merge", "part1", "part2", "merged").returncode, 0)
        self.assert_renders("--out", "merged")
        self.assertEqual(digest(self.folder / "merged/seabed"), digest(self.out / "seabed"))

    def test_heights_are_a_heightmap(self):
        """seabed/heights.tif as the bottom of the next mission gives the same images."""
        self.edit("mission.yaml", "labels: true", "labels: false")
        self.assert_renders()
        start = MISSION.index("  seabed:")
        end = MISSION.index("  objects:")
        self.write("again.yaml", MISSION[:start] + "  heightmap: {file: out/seabed/heights.tif, material: Concrete}\n"
                   + MISSION[end:].replace("labels: true", "labels: false"))
        result = self.run_sonarsim("render", "again.yaml", "--out", "again")
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("000000.npy", "000001.npy"):
            one, other = (array.array("f", (folder / "fls/polar" / name).read_bytes()[128:])
                          for folder in (self.out, self.folder / "again"))
            self.assertGreater(sum(one), 0)
            self.assertLess(sum(abs(a - b) for a, b in zip(one, other, strict=True)), 1e-4 * sum(one))

    def test_materials_are_a_sediment_map(self):
        """Both files of seabed/ as the ground of the next mission give the same images."""
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3100\nmud,1150,1470\n"
                   "sand,1900,1700\nsteel,7850,5890\n")
        self.edit("mission.yaml", "labels: true", "labels: [clean]")
        self.edit("mission.yaml", "    material: Concrete\n",
                  "    sediments: [{material: sand, share: 1}, {material: mud, share: 1}]\n    patch_m: 1\n")
        self.edit("mission.yaml", "cell_m: 0.2", "cell_m: 0.1")
        text = (self.folder / "mission.yaml").read_text()
        self.assert_renders()
        listed = json.loads((self.out / "seabed/seabed.json").read_text())["materials"]
        names = ", ".join(f"{one['value']}: {one['material']}" for one in listed)
        start, end = text.index("  seabed:"), text.index("  objects:")
        self.write("again.yaml", text[:start] + "  heightmap: {file: out/seabed/heights.tif, material: sand}\n"
                   f"  sediment_map: {{file: out/seabed/materials.png, materials: {{{names}}}}}\n" + text[end:])
        result = self.run_sonarsim("render", "again.yaml", "--out", "again")
        self.assertEqual(result.returncode, 0, result.stderr)
        one, other = (array.array("f", (folder / "fls/clean/000000.npy").read_bytes()[128:])
                      for folder in (self.out, self.folder / "again"))
        self.assertGreater(sum(one), 0)
        self.assertLess(sum(abs(a - b) for a, b in zip(one, other, strict=True)), 0.04 * sum(one))

    def test_presets(self):
        """Each bed of configs/seabeds, with keys of the mission's own above those of the file."""
        self.edit("mission.yaml", "    material: Concrete\n", "")
        self.edit("mission.yaml", "    roughness: {spectral_strength_cm4: 0.003}\n", "")
        self.edit("mission.yaml", "    ripples: {height_m: 0.1, length_m: 0.8, direction_deg: 20}\n", "")
        self.edit("mission.yaml", "    cell_m: 0.2\n", "    cell_m: 0.12\n    preset: seabeds/PRESET.yaml\n")
        text = (self.folder / "mission.yaml").read_text().replace(
            "materials.csv", str(clean_clone.ROOT / "scenes/materials.csv"))
        names = sorted(path.stem for path in (clean_clone.ROOT / "configs/seabeds").glob("*.yaml"))
        self.assertEqual(names, ["gravel", "mud", "rippled_sand", "rocky"])
        for name in names:
            with self.subTest(name=name):
                self.write("mission.yaml", text.replace("PRESET", name).replace("[crate.gltf]", "[]"))
                result = self.run_sonarsim("validate", "mission.yaml", "--set", "scene.material_default=sand",
                                           "--set", "scene.seabed.roughness.corner_m=3",
                                           "--set", "sensors.fls.range_max_m=4")
                self.assertEqual(result.returncode, 0, result.stderr + result.stdout)
        self.write("mission.yaml", text.replace("PRESET", "rockie"))
        self.refused("none of this name came with the program", "did you mean 'rocky'", "seabeds/NAME.yaml")

    def test_variants(self):
        """Each variant has a bed of its own, by its seed and by what is drawn."""
        self.edit("mission.yaml", "output:\n", "variants: 3\nvary:\n"
                  "  - {key: scene.seabed.ripples.length_m, uniform: [0.8, 1.6]}\n"
                  "  - {key: scene.seabed.roughness.spectral_exponent, uniform: [2.5, 3.5]}\noutput:\n")
        self.assert_renders()
        reported = json.loads((self.out / "variants.json").read_text())
        self.assertEqual(len({json.dumps(one["drawn"]) for one in reported["variants"]}), 3)
        images = [digest(self.out / f"variant_000{k}/fls/polar")["000000.npy"] for k in range(3)]
        self.assertEqual(len(set(images)), 3)

    def test_refused(self):
        for old, new, fragments in (
                ("cell_m: 0.2", "cell_m: 0", ("mission.yaml:5:", "cell_m", "0.001")),
                ("    cell_m: 0.2\n", "", ("lacks the key 'cell_m'",)),
                ("cell_m: 0.2", "cell_m: 0.002", ("mission.yaml:5:5: the mission needs", "raise cell_m")),
                ("cell_m: 0.2", "cell_m: 0.2\n    size_m: [0.05, 3]", ("fewer than 2 x 2 cells",)),
                ("length_m: 0.8", "length_m: 0", ("length_m", "above 0")),
                ("length_m: 0.8", "length_m: 0.79", ("ripples need 4 cells from crest to crest; lower cell_m",)),
                ("length_m: 0.8", "length_m: 0.8, height_m: 1", ("mission.yaml:", "height_m")),
                ("cell_m: 0.2", "cell_m: 0.2\n    sediments: [{material: steel, share: 1}]",
                 ("give material or sediments, not both",)),
                ("cell_m: 0.2", "cell_m: 0.2\n    rocks: {density_per_m2: 1, diameter_m: [2, 1]}",
                 ("'diameter_m' is the least and the largest",)),
                ("cell_m: 0.2", "cell_m: 0.2\n    rocks: {density_per_m2: 1}", ("lacks the key 'diameter_m'",)),
                ("cell_m: 0.2", "cell_m: 0.2\n    rocks: {density_per_m2: 9999, diameter_m: [0.1, 0.2]}",
                 ("and at most 50000 have room", "density_per_m2")),
                ("cell_m: 0.2", "cell_m: 0.2\n    rocks: {density_per_m2: 1, diameter_m: [1, 2], material: stell}",
                 ("stell", "mission.yaml:")),
                (", length_m: 0.8", "", ("lacks the key 'length_m'",)),
                ("{spectral_strength_cm4: 0.003}", "{spectral_exponent: 2}", ("spectral_exponent", "above 2")),
                ("cell_m: 0.2", "cell_m: 0.2\n    colour: red", ("unknown key 'colour'",)),
                ("    material: Concrete\n", "", ("the seabed has no material; write scene.seabed.material",)),
                ("material: Concrete", "material: Concret", ("Concret",)),
                ("  seabed:\n", "  heightmap: {file: bed.png}\n  seabed:\n", ("are both the bottom",))):
            with self.subTest(new=new):
                self.write("mission.yaml", MISSION)
                self.edit("mission.yaml", old, new)
                self.refused(*fragments)
                self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
