"""COCO files of all variants of a mission together, and of all datasets of a collection."""
import json
import shutil
import unittest

from labelled import Labelled
from sandbox import digest

VARY = """
variants: 5
vary:
  - {key: sensors.fls.range_bins, whole: [40, 60]}
"""
KINDS = ("coco", "coco_fan", "coco_records")


class JoinedLabels(Labelled):
    def setUp(self):
        super().setUp()
        mission = (self.folder / "mission.yaml").read_text() + VARY
        self.write("mission.yaml", mission.replace(
            "labels: true", "labels: [coco]\n  split: {train: 0.6, val: 0.2, test: 0.2}"))

    def pictures(self, coco, prefix=""):
        """What each picture shows, by path: (instance, name of class, box, mask), sorted."""
        names = {one["id"]: one["name"] for one in coco["categories"]}
        paths = {one["id"]: prefix + one["file_name"] for one in coco["images"]}
        shown = {path: [] for path in paths.values()}
        for one in coco["annotations"]:
            shown[paths[one["image_id"]]].append(
                [one["instance_id"], names[one["category_id"]], one["bbox"], one["area"],
                 one["segmentation"]])
        return {path: sorted(objects, key=str) for path, objects in shown.items()}

    def check_joined(self, folders, part_of):
        """Each joined file says of every picture what the member's own file says, and no id is there
        twice in files of different pictures."""
        ids, categories = [], set()
        for kind in KINDS:
            whole = {}
            for folder in folders:
                own = json.loads((self.out / folder / f"labels/{kind}.json").read_text())
                whole |= self.pictures(own, folder + "/")
            joined = self.load(f"labels/{kind}.json")
            self.assertEqual(self.pictures(joined), whole)
            self.assertTrue(all((self.out / path).is_file() for path in whole))
            ids += [one["id"] for one in joined["images"] + joined["annotations"]]
            categories.add(json.dumps(joined["categories"]))
            for part, members in part_of.items():
                some = self.load(f"labels/{kind}_{part}.json")
                self.assertEqual(self.pictures(some), {
                    path: shown for path, shown in whole.items() if path.split("/")[0] in members})
                known = {one["id"]: one for one in joined["images"]}
                self.assertTrue(all(known[one["id"]] == one for one in some["images"]))
                categories.add(json.dumps(some["categories"]))
        self.assertEqual(len(ids), len(set(ids)))
        self.assertEqual(len(categories), 1)

    def parts(self):
        return {p.stem: p.read_text().split() for p in (self.out / "split").glob("*.txt")}

    def test_variants_are_one_dataset(self):
        self.assert_renders()
        parts = self.parts()
        self.assertEqual({part: len(names) for part, names in parts.items()},
                         {"train": 3, "val": 1, "test": 1})
        self.check_joined([f"variant_{k:04}" for k in range(5)], parts)
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)
        self.assertEqual(len(list((self.out / "labels").glob("coco*.json"))), 4 * len(KINDS))

    def test_shards_resume_and_merge_give_the_same_bytes(self):
        self.assert_renders()
        whole = digest(self.out)
        for k in (2, 1):
            self.assert_renders("--shard", f"{k}/2", "--out", f"part{k}")
            self.assert_renders("--shard", f"{k}/2", "--out", "shards")
            self.assertEqual((self.folder / "shards/labels").exists(), k == 1)
        self.assertFalse((self.folder / "part1/labels").exists())
        self.assertEqual(digest(self.folder / "shards"), whole)
        result = self.run_sonarsim("merge", "part1", "part2", "joined")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder / "joined"), whole)
        shutil.rmtree(self.out / "variant_0002")
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 1)
        self.assertNotIn("labels", result.stderr)
        (self.out / "labels/coco_val.json").unlink()
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)

    def test_verify_knows_them(self):
        self.assert_renders()
        whole = digest(self.out)
        path = self.out / "labels/coco_fan.json"
        path.write_bytes(path.read_bytes().replace(b"variant_0001", b"variant_0002", 1))
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 1)
        self.assertIn("labels/coco_fan.json: differs from SHA256SUMS", result.stderr)
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)
        self.assert_renders("--overwrite", "--set", "output.labels=[instance]")
        self.assertFalse((self.out / "labels").exists())
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_a_damaged_file_of_a_variant(self):
        """Each is refused with its place; SHA256SUMS never lists what was not written."""
        self.assert_renders("--shard", "1/2")
        path = self.out / "variant_0000/labels/coco.json"
        sound = path.read_text()
        for old, new, fragment in (
                ('"file_name": "fls/', '"file_name": "../fls/', "file_name"),
                ('"file_name":"fls/', '"file_name":"../fls/', "file_name"),
                ('"category_id":', '"category_id":9', "category_id"),
                ("]}\n", "", "is cut off")):
            if old not in sound:
                continue
            path.write_text(sound.replace(old, new, 1))
            result = self.render("--shard", "2/2")
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn("coco.json", result.stderr)
            self.assertIn(fragment, result.stderr)
            self.assertNotIn("labels/", (self.out / "SHA256SUMS").read_text())
        path.write_text(sound)
        self.assert_renders()
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_a_collection_is_one_dataset(self):
        self.edit("mission.yaml", VARY, "")
        self.edit("mission.yaml", "test: 0.2}", "test: 0.2, gap: 0}")
        for seed, name in ((1, "pool"), (2, "labels"), (3, "basin")):
            self.assert_renders("--seed", seed, "--set", f"name={name}", "--out", name + "_dataset")
        parts = [name + "_dataset" for name in ("pool", "labels", "basin")]
        result = self.run_sonarsim("merge", "--different", *parts, "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        # The labels of all have the folder "labels".
        self.check_joined(["basin", "labels-2", "pool"], {})
        reported = json.loads((self.out / "collection.json").read_text())
        self.assertEqual(reported["classes"], [{"id": one["id"], "name": one["name"]}
                                           for one in self.load("labels/coco.json")["categories"]])
        own = json.loads((self.out / "pool/labels/coco_val.json").read_text())
        some = self.load("labels/coco_val.json")
        self.assertEqual(len(some["images"]), 3 * len(own["images"]))
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)
        path = self.out / "labels/coco_val.json"
        path.write_text(path.read_text() + " ")
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 1)
        self.assertIn("labels/coco_val.json: differs", result.stderr)


if __name__ == "__main__":
    unittest.main()
