"""The words of messages: each says where the mistake is and what would be right."""
import json
import unittest

import test_mistakes
from sandbox import Sandbox

MISSION = test_mistakes.MISSION.replace("{folder: out}", "{folder: out, labels: [objects]}")
MATERIALS = test_mistakes.MATERIALS
DEEP = test_mistakes.bottom().replace('"nodes": [{', '"nodes": [{"translation": [0, -100, 0], ')
VARIANTS = MISSION + ("variants: 3\nvary:\n"
                      "  - {key: scene.objects.0.position_m.1, uniform: [-2, 2]}\n")
GLB = b"glTF\x02\0\0\0" + bytes(30)
TIFF = b"II*\0\x08\0\0\0" + bytes(30)
CURES = ("add it to the CSV", "materials_map: {'Steel': NAME}", "scene.material_default")


def edited(old, new, text=MISSION):
    assert old in text, old
    return {"mission.yaml": text.replace(old, new, 1)}


# What is done, and words of the message.
REFUSED = {
    "a tab": (edited("    kind", "\tkind"), ("mission.yaml:10:2", "a tab in the indentation")),
    "no blank after a colon": (edited("azimuth_deg: 90", "azimuth_deg:90"),
                               ("mission.yaml:12:", "a blank follows the ':' of the line above")),
    "a quote that is open": (edited("bay", '"bay'), ("mission.yaml:1:7", "quote is not closed")),
    "a value that is left out": (edited("range_max_m: 12", "range_max_m:"),
                                 ("mission.yaml:13:5", "not nothing")),
    "a mission that is a mesh": ({"mission.yaml": GLB}, ("is a .glb mesh, not YAML",)),
    "a reversed range": (edited("range_max_m: 12", "range_min_m: 20\n    range_max_m: 12"),
                         ("mission.yaml:14:18", "(range_min_m is 20, range_max_m is 12)")),
    "layers of water without its surface": (
        edited("scene:\n", "water: {layers: [{depth_m: [2, 3], scattering_db_per_m3: -60}]}\nscene:\n"),
        ("give its height by scene.water_surface",)),
    "a key that is gone": (edited("[objects]", "[objects], split: {train: 0.8, val: 0.2}"),
                           ("'split' is no longer there; give the shares to the export",)),
    "a rule for a key that is misspelt": (
        edited("position_m.1", "positon_m.1", VARIANTS),
        ("mission.yaml:21:5", "did you mean 'position_m'?")),
    "a preset without its folder": (
        edited("kind: imaging", "preset: gemini_720"),
        ("mission.yaml:10:13", "did you mean 'gemini_720is'?", "micron", "sensors/NAME.yaml")),
    "a material of the bottom": ({"materials.csv": MATERIALS.replace("Sand", "mud")},
                                 ("materials.csv: lacks the material 'Sand' of 'sand' in",
                                  "bottom.gltf (mission.yaml:3:3)", "add it to the CSV")),
    "a material of an object": ({"materials.csv": MATERIALS.replace("Steel", "steel")},
                                ("lacks the material 'Steel' of 'mine' in", "mine.gltf",
                                 "(mission.yaml:6:7)", "did you mean 'steel'?", *CURES)),
    "a file's name in capitals": (edited("bottom.gltf", "BOTTOM.GLTF"), ("did you mean 'bottom.gltf'?",)),
    "an instrument of the paper's model": (
        edited("    noise: {add_sigma: 0.01}\n", "    instrument: {frequency_hz: 400000}\n"),
        ("unknown key 'instrument'; it needs model: calibrated",)),
    "noise outside of the sensors": (
        edited("sensors:\n", "noise: {add_sigma: 0.01}\nsensors:\n"),
        ("unknown key 'noise'; it belongs to a sensor: sensors.NAME.noise",)),
    "beams of a side-scan": (
        edited("kind: imaging", "kind: sidescan"),
        ("unknown key 'azimuth_bins'; this kind of sonar has none, leave it out",)),
    "a preset by its name alone": (
        edited("kind: imaging", "preset: oculus_m750d_750khz"),
        ("did you mean 'sensors/oculus_m750d_750khz.yaml'?",)),
    "a file's name": (edited("bottom.gltf", "botom.gltf"),
                      ("botom.gltf: cannot open", "did you mean 'bottom.gltf'?", "mission.yaml:3:3")),
    "the name of the materials": (edited("materials.csv", "material.csv"),
                                  ("did you mean 'materials.csv'?", "mission.yaml:3:3 names it")),
    "a folder that is not there": (edited("mine.gltf", "meshes/mine.gltf"),
                                   ("there is no folder", "mission.yaml:6:7")),
    "a path of Windows": (edited("bottom.gltf", "scenes\\bottom.gltf"), ("separate folders by '/'",)),
    "the home folder": (edited("bottom.gltf", "~/bottom.gltf"), ("'~' is not replaced",)),
    "a folder as a scene": (edited("bottom.gltf", "."), ("is a folder; a file is expected here",)),
    "a CSV as a scene": (edited("bottom.gltf", "path.csv"),
                         ("path.csv: is not glTF", "mission.yaml:3:3 names it")),
    "a GeoTIFF as a scene": (edited("bottom.gltf", "bathy.tif") | {"bathy.tif": TIFF},
                             ("is a TIFF picture, such as a GeoTIFF, not glTF; an image of heights belongs into "
                              "scene.heightmap", "mission.yaml:3:3")),
    "a GeoTIFF as materials": (edited("materials.csv", "bathy.tif") | {"bathy.tif": TIFF},
                               ("is a TIFF picture, such as a GeoTIFF, not a CSV",)),
    "a mesh as materials": (edited("materials.csv", "mine.glb") | {"mine.glb": GLB},
                            ("is a .glb mesh, not a CSV",)),
    "a pointer of Git LFS": ({"bottom.gltf": "version https://git-lfs.github.com/spec/v1\n"},
                             ("`git lfs pull`",)),
    "semicolons": ({"path.csv": test_mistakes.path().replace(",", ";")},
                   ("path.csv:1: the header has no comma", "not by ';'")),
    "decimal commas": ({"materials.csv": MATERIALS.replace(",", ";").replace("1900", "1900,5")},
                       ("materials.csv:1: the header has no comma", "a decimal point")),
    "tabs": ({"path.csv": test_mistakes.path().replace(",", "\t")}, ("path.csv:1:", "not by tabs")),
    "lines of an old Mac": ({"path.csv": test_mistakes.path().replace("\n", "\r").encode()},
                            ("path.csv:1: lines end in CR alone",)),
    "materials in Latin-1": ({"materials.csv": (MATERIALS + "B\xe9ton,2400,3200\n").encode("latin-1")},
                             ("materials.csv:4: is not UTF-8 text; save the file as UTF-8",)),
    "too many poses": (edited("{file: path.csv}",
                              "{lawnmower: {area_min_m: [-40, -40], area_max_m: [40, 40], z_m: 5, "
                              "line_spacing_m: 0.01, speed_m_s: 0.1, rate_hz: 50}}"),
                       ("mission.yaml: trajectory: rate_hz of 50 gives",)),
}

# The same of missions that can be rendered.
WARNED = {
    "depths as positive numbers": (
        edited("    - {name: mine, file: mine.gltf, position_m: [20, 4, 0.3]}",
               "    - {name: mine, file: mine.gltf, position_m: [20, 4, -99.7]}")
        | {"path.csv": test_mistakes.path(z=95), "bottom.gltf": DEEP}, "W17",
        "z points up, and depths are negative"),
    "depths and a sonar that looks down": (
        edited("rpy_deg: [0, 30, 0]", "rpy_deg: [0, 90, 0]",
               edited("[20, 4, 0.3]", "[20, 4, -99.7]")["mission.yaml"])
        | {"path.csv": test_mistakes.path(z=95), "bottom.gltf": DEEP}, "W13",
        "z points up, and depths are negative"),
}


class Messages(Sandbox):
    def setUp(self):
        super().setUp()
        self.make({})

    def make(self, files):
        for name, text in {"mission.yaml": MISSION, "materials.csv": MATERIALS,
                           "bottom.gltf": test_mistakes.bottom(), "mine.gltf": test_mistakes.box(0.4),
                           "path.csv": test_mistakes.path(), **files}.items():
            (self.folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())

    def validate(self, *arguments):
        return self.run_sonarsim("validate", "mission.yaml", *arguments)

    def test_refusals(self):
        for name, (files, words) in REFUSED.items():
            with self.subTest(mistake=name):
                self.make(files)
                before = set(self.folder.rglob("*"))
                result = self.run_sonarsim("render", "mission.yaml")
                self.assert_refused(result, *words)
                self.assertEqual(set(self.folder.rglob("*")), before)

    def test_warnings(self):
        for name, (files, number, words) in WARNED.items():
            with self.subTest(mistake=name):
                self.make(files)
                result = self.validate("--strict", "-q")
                self.assertEqual(result.returncode, 3, result.stderr)
                mine = [line for line in result.stderr.splitlines() if f": {number} " in line]
                self.assertEqual(len(mine), 1, result.stderr)
                self.assertIn(words, mine[0])

    def test_another_mission_of_a_folder(self):
        self.assert_renders()
        other = self.render("--seed", "3", "--set", "sensors.fls.range_max_m=11")
        self.assert_refused(other, "of another mission", "seed: 0 there, 3 here",
                            "sensors.fls.range_max_m: 12 there, 11 here", "--overwrite")
        self.assert_refused(self.validate("--seed", "3"), "seed: 0 there, 3 here")
        self.assert_renders("--seed", "3", "--out", "other")
        self.assert_refused(self.run_sonarsim("merge", "out", "other", "all"), "seed: 3 there, 0 here")
        self.make({"materials.csv": MATERIALS.replace("1900", "1800")})
        self.assert_refused(self.render(), "other scene, material or trajectory files (materials.csv)")
        for folder, words in (("out/fls", "give the folder above"), ("outt", "there is no such folder")):
            self.assert_refused(self.run_sonarsim("status", folder), words)
        self.assert_refused(self.run_sonarsim("render", "out"), "out: is a folder")
        self.assert_refused(self.render("--out", "path.csv/out"), "path.csv/out",
                            "choose another output.folder")
        self.assert_refused(self.render("--out", "/proc/none/out"), "/proc/none/out: cannot make",
                            "choose another output.folder")

    def test_variants(self):
        self.make({"mission.yaml": VARIANTS})
        text = self.validate().stdout
        for words in ("variants    3\n", "surveyed    variant_0000:\n", "48 x 24 bins, 10 pings",
                      "together    3 variants:\n", "30 pings, at most"):
            self.assertIn(words, text)
        self.assert_renders()
        self.assert_refused(self.render("--set", "variants=4"), "variants: 3 there, 4 here")
        self.assert_refused(self.render("--set", "sensors.fls.range_bins=40"),
                            "sensors.fls.range_bins: 48 there, 40 here")

    def test_log_of_a_run(self):
        # A triangle without area is in the mesh, and multipath and noise drop footprints.
        mesh = json.loads(test_mistakes.bottom())
        mesh["nodes"].append({"name": "line", "mesh": 0, "scale": [1, 1, 0]})
        mesh["scenes"][0]["nodes"].append(1)
        self.make(edited("noise: {add_sigma: 0.01}",
                         "noise: {add_sigma: 0.01, mult_sigma: 1, range_lambda_m: 0.1}\n"
                         "    multipath: {method: cluster}") | {"bottom.gltf": json.dumps(mesh)})
        lines = self.assert_renders().stderr.splitlines()
        self.assertEqual(len(lines), 2, lines)
        self.assertIn("bay: 44 triangles, 10 poses", lines[0])
        self.assertIn("complete; 10 pings rendered", lines[1])
        self.assertIn("all of its 10 pings were there already", self.assert_renders().stderr)
        debug = self.assert_renders("--overwrite", "--log-level", "debug").stderr
        self.assertIn("footprints dropped", debug)
        self.assertIn("multipath:", debug)

    def test_a_mission_without_a_subcommand(self):
        self.assert_refused(self.run_sonarsim("mission.yaml"), "sonarsim render mission.yaml")


if __name__ == "__main__":
    unittest.main()
