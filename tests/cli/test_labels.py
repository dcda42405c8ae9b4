"""Labels as YOLO and as semantic PNGs; splits; what merge and verify make of them."""
import itertools
import shutil
import unittest

from labelled import MISSION, Labelled, box_of, mask_of, read_png
from sandbox import digest, path_csv


class Labels(Labelled):
    def test_yolo_and_semantic(self):
        self.assert_renders()
        names = (self.out / "labels/classes.txt").read_text().split()
        self.assertEqual(names, ["walls", "pillar"])
        colours = [one["colour"] for one in self.dataset()["labels"]["classes"]]
        for coco, prefix in ((self.load("labels/coco.json"), ""),
                             (self.load("labels/coco_fan.json"), "fan_")):
            for image in coco["images"]:
                w, h = image["width"], image["height"]
                number = f"{image['ping']:06d}"
                folder = self.out / image["sensor"]
                boxes = (folder / f"{prefix}yolo/{number}.txt").read_text().splitlines()
                outlines = (folder / f"{prefix}yolo_polygons/{number}.txt").read_text().splitlines()
                reported = [one for one in coco["annotations"] if one["image_id"] == image["id"]]
                self.assertEqual((len(boxes), len(outlines)), (len(reported), len(reported)))
                for one, box, outline in zip(reported, boxes, outlines):
                    left, top, width, height = one["bbox"]
                    self.assertEqual(int(box.split()[0]), one["category_id"] - 1)
                    expected = ((left + width / 2) / w, (top + height / 2) / h, width / w, height / h)
                    for a, b in zip(map(float, box.split()[1:]), expected, strict=True):
                        self.assertAlmostEqual(a, b, delta=1e-6)
                    self.assertEqual(outline.split()[0], box.split()[0])
                    self.check_outline([float(v) for v in outline.split()[1:]], w, h,
                                       mask_of(one["segmentation"]))
                semantic, table = read_png(folder / f"{prefix}semantic/{number}.png")
                classes, _ = read_png(folder / f"{prefix}class/{number}.png")
                self.assertEqual(semantic, classes)
                self.assertEqual(list(table), [0, 0, 0] + list(itertools.chain(*colours)))

    def check_outline(self, shares, width, height, pixels):
        """An outline is as large as what it surrounds: the mask, and its holes."""
        corners = [(round(x * width), round(y * height)) for x, y in zip(shares[::2], shares[1::2])]
        area = sum(a[0] * b[1] - b[0] * a[1]
                   for a, b in zip(corners, corners[1:] + corners[:1])) / 2
        left, top, w, h = box_of(pixels)
        outside = {(x, y) for x in range(left - 1, left + w + 1) for y in range(top - 1, top + h + 1)
                   if x in (left - 1, left + w) or y in (top - 1, top + h)}
        grow = list(outside)
        while grow:  # pixels that touch at a corner leave no wall: water runs through
            x, y = grow.pop()
            for near in itertools.product((x - 1, x, x + 1), (y - 1, y, y + 1)):
                if near not in outside and near not in pixels and \
                        left <= near[0] < left + w and top <= near[1] < top + h:
                    outside.add(near)
                    grow.append(near)
        self.assertEqual(area, (w + 2) * (h + 2) - len(outside))
        self.assertEqual([min(c[0] for c in corners), min(c[1] for c in corners)], [left, top])

    def test_split(self):
        self.write("path.csv", path_csv(40))
        self.edit("mission.yaml", "  labels: true\n",
                  "  labels: [coco]\n  split: {train: 0.5, val: 0.25, test: 0.25, gap: 2, rounds: 2}\n")
        self.assert_renders()
        poses = {part: [int(line) for line in (self.out / f"split/{part}.txt").read_text().split()]
                 for part in ("train", "val", "test")}
        # Two rounds of 20 poses: 10, 5 and 5, with a pose to either side of a border left out.
        self.assertEqual(poses, {"train": [*range(0, 9), *range(21, 29)],
                                 "val": [*range(11, 14), *range(31, 34)],
                                 "test": [*range(16, 19), *range(36, 40)]})
        whole = {one["id"]: one for one in self.load("labels/coco.json")["annotations"]}
        for part, numbers in poses.items():
            coco = self.load(f"labels/coco_{part}.json")
            for sensor, every in (("fls", 2), ("mbes", 1)):
                self.assertEqual([i["ping"] for i in coco["images"] if i["sensor"] == sensor],
                                 [n for n in numbers if n % every == 0])
            self.assertTrue(coco["annotations"])
            for one in coco["annotations"]:
                self.assertEqual(one, whole[one["id"]])

    def test_the_same_bytes_from_shards_and_after_a_stop(self):
        self.edit("mission.yaml", "  labels: true\n",
                  "  labels: true\n  split: {train: 0.5, test: 0.5, gap: 1}\n")
        self.assert_renders("-j1")
        whole = digest(self.out)
        self.assertIn("labels/coco_fan_train.json", whole)
        for k in "123":
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}", "-j2")
        for order in (("part1", "part2", "part3"), ("part3", "part1", "part2")):
            result = self.run_sonarsim("merge", *order, "-".join(order))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(digest(self.folder / "-".join(order)), whole)
        for name in ("labels/coco.json", "fls/objects/000002.json", "fls/fan_instance/000004.png"):
            (self.out / name).unlink()
        self.assert_renders("-j2")
        self.assertEqual(digest(self.out), whole)
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.edit("mission.yaml", "  labels: true\n", "")
        self.edit("mission.yaml", "  split: {train: 0.5, test: 0.5, gap: 1}\n", "")
        self.assert_renders("--overwrite")
        self.assertFalse((self.out / "labels").exists() or (self.out / "split").exists())

    def test_verify_knows_the_ids(self):
        self.assert_renders()
        path = self.out / "fls/instance/000002.png"
        other = self.out / "fls/share/000002.png"  # its values are no ids
        shutil.copy(other, path)
        sums = (self.out / "SHA256SUMS").read_text()
        old = next(line for line in sums.splitlines() if line.endswith("fls/instance/000002.png"))
        self.write("out/SHA256SUMS",
                   sums.replace(old[:64], digest(self.out)["fls/instance/000002.png"]))
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 1)
        self.assertIn("fls/instance/000002.png: has the id 65535, and dataset.json names 3",
                      result.stderr)

    def test_bad_input(self):
        def refused(old, new, *fragments):
            self.write("mission.yaml", MISSION)
            self.edit("mission.yaml", old, new)
            self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), *fragments)
            self.assertFalse(self.out.exists())

        labels = "  labels: true\n"
        refused(labels, "  split: {train: 0.8, val: 0.3}\n",
                "mission.yaml:16:28: train, val and test must add up to 1")
        refused(labels, "  split: {train: 0.8, val: 0.2, testing: 0.1}\n",
                "mission.yaml:16:", "unknown key 'testing'; known here: train, val, test, gap, rounds")
        refused(labels, "  split: {train: 0.8, val: 0.1, test: 0.1}\n", "mission.yaml:16:",
                "none of 6 poses is left for 'train'", "smaller gap")
        refused(labels, "  labels: [coco, boxes]\n", "mission.yaml:16:18: unknown labels 'boxes'")
        refused("fan_width_px: 64\n" + labels, "fan: false\n  labels: [fan]\n", "mission.yaml:16:11",
                "'fan'", "output.fan: true")
        refused('"pillar*"', '"pilar*"', "mission.yaml:12:", "no node of the scene fits 'pilar*'",
                "sonarsim inspect")
        refused("class: pillar}", "class: pillar, instance: p}\n"
                "  - {nodes: walls, class: wall, instance: p}",
                "mission.yaml:12:", "an instance has one class")
        one = MISSION.index("  fls:"), MISSION.index("  sss:")
        self.write("mission.yaml", (MISSION[:one[0]] + MISSION[one[1]:]).replace(
            "labels: true", "labels: [instance, yolo]"))
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), "mission.yaml:13:11",
                            "'yolo'", "only imaging and profiling sonars")


if __name__ == "__main__":
    unittest.main()
