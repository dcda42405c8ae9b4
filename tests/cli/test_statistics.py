"""labels/statistics.json against counts by hand from the COCO files, over runs, variants and collections."""
import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import unittest

from labelled import Labelled, room_gltf
from sandbox import digest

ROOT = pathlib.Path(__file__).resolve().parents[2]
AXES = ("range_m", "area", "visible_share", "contrast_db")
VARY = """
variants: 4
vary:
  - {key: water.sound_speed_m_s, uniform: [1450, 1540]}
"""


def counts_of(values, edges):
    """How many values are below the first edge, from edge to edge, and from the last on."""
    ends = [-math.inf, *edges, math.inf]
    return [sum(low <= value < high for value in values) for low, high in zip(ends, ends[1:])]


def tally_of(files, edges, joined):
    """Counted from the text of COCO files."""
    images = [image for file in files for image in file["images"]]
    member = {image["id"]: image["file_name"].split("/")[0] if joined else "" for image in images}
    annotations = [a for file in files for a in file["annotations"]]
    kept = [a for a in annotations if not a["iscrowd"]]
    names = list(dict.fromkeys(c["name"] for file in files for c in file["categories"]))
    name_of = {c["id"]: c["name"] for file in files for c in file["categories"]}
    tally = {"pictures": len(images),
             "without_objects": len(images) - len({a["image_id"] for a in kept}), "classes": []}
    for name in names:
        own = [a for a in kept if name_of[a["category_id"]] == name]
        tally["classes"].append({
            "name": name,
            "objects": len({(member[a["image_id"]], a["instance_id"]) for a in own}),
            "pictures": len({a["image_id"] for a in own}),
            "annotations": len(own),
            "ignored": sum(a["iscrowd"] and name_of[a["category_id"]] == name for a in annotations),
            **{axis: counts_of([a[axis] for a in own if a.get(axis) is not None], edges[axis])
               for axis in AXES}})
    return tally


class Statistics(Labelled):
    def setUp(self):
        super().setUp()
        self.edit("mission.yaml", "  labels: true\n", "  labels: [coco]\n")

    def check(self, folder, joined=False):
        """Returns what the file says."""
        reported = json.loads((folder / "labels/statistics.json").read_text())
        files = {f"labels/{path.name}": json.loads(path.read_text())
                 for path in (folder / "labels").glob("coco*.json")}
        self.assertEqual(sorted(reported["files"]), sorted(files))
        for name, file in files.items():
            self.assertEqual(reported["files"][name], tally_of([file], reported["edges"], joined), name)
        # Fans show the pings of the polar images once more.
        whole = [f"labels/coco{sort}.json" for sort in ("", "_records", "_scans")]
        whole = [files[name] for name in whole if name in files]
        self.assertEqual(reported["all"], tally_of(whole, reported["edges"], joined))
        return reported

    def test_a_dataset(self):
        printed = self.assert_renders().stdout
        reported = self.check(self.out)
        pillar = next(one for one in reported["all"]["classes"] if one["name"] == "pillar")
        self.assertEqual(pillar["objects"], 2)
        self.assertGreater(pillar["pictures"], 2)
        pictures = f"{reported['all']['pictures']} pictures, {reported['all']['without_objects']} without an object"
        row = f"pillar {pillar['objects']:>8}"
        status = self.run_sonarsim("status", "out")
        for text in (printed, status.stdout):
            self.assertIn(pictures, text)
            self.assertIn(row, " ".join(text.split("pillar")[0:1]) + text[text.index("pillar"):])
            self.assertIn("pixels: ", text)
        machine = json.loads(self.run_sonarsim("status", "out", "--json").stdout)
        self.assertEqual(machine["labels"], reported["all"])
        verified = self.run_sonarsim("verify", "out")
        self.assertEqual(verified.returncode, 0, verified.stderr)

    def test_a_split(self):
        self.edit("mission.yaml", "  image: true\n",
                  "  image: true\n  split: {train: 0.5, val: 0.25, test: 0.25, gap: 0, rounds: 1}\n")
        self.assert_renders()
        self.assertIn("labels/coco_val.json", self.check(self.out)["files"])

    def test_the_same_bytes_after_resume_shards_and_merge(self):
        self.assert_renders()
        expected = (self.out / "labels/statistics.json").read_bytes()
        for shard in ("1/2", "2/2"):
            self.assert_renders("--shard", shard, "--out", f"part{shard[0]}")
        self.assertFalse((self.folder / "part1/labels/statistics.json").exists())
        done = self.run_sonarsim("merge", "part1", "part2", "whole")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "whole/labels/statistics.json").read_bytes(), expected)
        (self.out / "fls/objects/000002.json").unlink()
        (self.out / "labels/statistics.json").unlink()
        self.assert_renders()
        self.assertEqual((self.out / "labels/statistics.json").read_bytes(), expected)

    def test_variants(self):
        text = (self.folder / "mission.yaml").read_text()
        self.write("variants.yaml", text.replace("  image: true\n", "  image: true\n  split: "
                                                 "{train: 0.5, val: 0.25, test: 0.25}\n") + VARY)
        render = ("render", "variants.yaml")
        self.assertEqual(self.run_sonarsim(*render).returncode, 0)
        reported = self.check(self.out, joined=True)
        each = [self.check(folder) for folder in sorted(self.out.glob("variant_*"))]
        self.assertEqual(reported["all"]["pictures"], sum(one["all"]["pictures"] for one in each))
        pillars = [one["all"]["classes"] for one in (reported, *each)]
        pillars = [next(c["objects"] for c in classes if c["name"] == "pillar") for classes in pillars]
        self.assertEqual(pillars, [8, 2, 2, 2, 2])  # those of different fields are different
        whole = digest(self.out)
        for shard in ("1/2", "2/2"):
            done = self.run_sonarsim(*render, "--shard", shard, "--out", f"part{shard[0]}")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.run_sonarsim("merge", "part1", "part2", "merged").returncode, 0)
        self.assertEqual(digest(self.folder / "merged"), whole)
        shutil.rmtree(self.out / "variant_0002")
        self.assertNotIn("pictures", self.run_sonarsim("status", "out").stdout)  # they may be others now
        (self.out / "labels/statistics.json").unlink()
        self.assertEqual(self.run_sonarsim(*render).returncode, 0)
        self.assertEqual(digest(self.out), whole)
        machine = json.loads(self.run_sonarsim("status", "out", "--json").stdout)
        self.assertEqual(machine["labels"], reported["all"])

    def test_values_of_annotations(self):
        """Random values, some on the borders of the histograms, some absent, some ignored."""
        self.write("variants.yaml", (self.folder / "mission.yaml").read_text() + VARY)
        self.assertEqual(self.run_sonarsim("render", "variants.yaml").returncode, 0)
        draw = random.Random(5)
        borders = json.loads((self.out / "labels/statistics.json").read_text())["edges"]
        spans = {"range_m": (0, 1200), "visible_share": (0, 1), "contrast_db": (-30, 40)}
        for path in self.out.glob("variant_*/labels/coco*.json"):
            lines = path.read_text().split("\n")
            for k, line in enumerate(lines):
                if '"bbox"' not in line:
                    continue
                sound = line.rstrip(",")
                annotation = json.loads(sound)
                del annotation["segmentation"]  # a file of another size would be made anew
                annotation["iscrowd"] = int(draw.random() < 0.2)
                for key in draw.sample(list(spans), 2):
                    value = draw.choice((round(draw.uniform(*spans[key]), 2), draw.choice(borders[key]), None))
                    annotation[key] = value
                text = json.dumps(annotation, separators=(",", ":"))
                self.assertLessEqual(len(text), len(sound))
                lines[k] = text.ljust(len(sound)) + line[len(sound):]
            path.write_text("\n".join(lines))
        shutil.rmtree(self.out / "labels")  # the run makes them anew from those of the variants
        self.assertEqual(self.run_sonarsim("render", "variants.yaml").returncode, 0)
        reported = self.check(self.out, joined=True)["all"]
        self.assertGreater(sum(one["ignored"] for one in reported["classes"]), 0)
        for axis in AXES:
            self.assertGreater(sum(sum(one[axis]) for one in reported["classes"]), 0, axis)
        printed = self.run_sonarsim("status", "out").stdout
        for title in ("range, m: ", "pixels: ", "visible share: ", "contrast, dB: "):
            self.assertIn(title, printed)

    def test_a_collection(self):
        self.assert_renders("--out", "one")
        self.assert_renders("--out", "two", "--seed", 8, "--set", "name=pool", "--set",
                            "output.pack=tar")
        done = self.run_sonarsim("merge", "--different", "one", "two", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        reported = self.check(self.out, joined=True)
        status = json.loads(self.run_sonarsim("status", "out", "--json").stdout)
        self.assertEqual((status["datasets"], status["labels"]), (2, reported["all"]))
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_a_class_that_is_hardly_there(self):
        """A pillar behind the wall is in no picture."""
        room = json.loads(room_gltf())
        room["nodes"].append({"name": "buoy", "mesh": 0, "translation": [0, 0, 9],
                              "scale": [0.06, 0.5, 0.06]})
        room["scenes"][0]["nodes"].append(3)
        self.write("room.gltf", json.dumps(room))
        self.edit("mission.yaml", "  - {nodes: \"pillar*\", class: pillar}\n",
                  "  - {nodes: \"pillar*\", class: pillar}\n  - {nodes: buoy, class: buoy}\n")
        done = self.assert_renders()
        pictures = self.check(self.out)["all"]["pictures"]
        sentence = (f"W33 labels: hardly any of {pictures} pictures shows an object of these classes: "
                    "'buoy' (0); place more of them")
        self.assertIn(sentence, done.stderr)
        self.assertNotIn("'pillar' (", done.stderr)
        self.assertIn(sentence, self.run_sonarsim("status", "out").stderr)
        machine = json.loads(self.run_sonarsim("status", "out", "--json").stdout)
        self.assertIn(sentence, machine["warnings"][0])

    def test_damaged_and_missing(self):
        self.assert_renders()
        file = self.out / "labels/statistics.json"
        sound = json.loads(file.read_text())
        for place, value, fragment in ((("format",), "mine", "'format' is \"mine\""),
                                       (("all", "pictures"), -1, "'all.pictures' is -1"),
                                       (("all", "classes", 0, "area"), [1], "'all.classes[0].area' is"),
                                       (("all", "classes", 0, "name"), 7, "'all.classes[0].name' is 7")):
            with self.subTest(place=place):
                broken = json.loads(json.dumps(sound))
                inner = broken
                for key in place[:-1]:
                    inner = inner[key]
                inner[place[-1]] = value
                file.write_text(json.dumps(broken))
                for command in ("status", "gallery"):
                    self.assert_refused(self.run_sonarsim(command, "out"), "statistics.json", fragment)
        file.unlink()
        done = self.run_sonarsim("status", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("pictures", done.stdout)
        self.assertEqual(self.run_sonarsim("gallery", "out").returncode, 0)
        self.assertIn("statistics.json", self.run_sonarsim("verify", "out").stderr)

    def test_without_coco_there_are_none(self):
        self.assert_renders("--set", "output.labels=[objects]")
        self.assertFalse((self.out / "labels/statistics.json").exists())

    def test_the_minefields(self):
        """The example with variants, by hand."""
        scenes = self.folder / "scenes"
        subprocess.run([sys.executable, "-B", ROOT / "scripts/make_scenes.py", "minefield", "--out",
                        scenes / "generated"], check=True, capture_output=True)
        shutil.copy(ROOT / "scenes/materials.csv", scenes)
        (self.folder / "configs").mkdir()
        shutil.copy(ROOT / "configs/minefield_variants.yaml", self.folder / "configs")
        done = self.run_sonarsim("render", "configs/minefield_variants.yaml", "--set", "variants=3",
                                 "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        reported = self.check(self.out, joined=True)
        self.assertEqual(reported["all"]["pictures"], 3 * (9 + 1))  # a waterfall beside nine images
        drawn = [self.dataset(folder)["labels"]["instances"] for folder in self.out.glob("variant_*")]
        mines = sum("mine" in instance["name"] for instances in drawn for instance in instances)
        found = next(one for one in reported["all"]["classes"] if one["name"] == "mine")
        self.assertLessEqual(found["objects"], mines)
        self.assertGreater(found["objects"], 0)


if __name__ == "__main__":
    unittest.main()
