"""Every format of sonarsim export holds the same pictures and objects: those of the COCO files."""
import json
import os
import subprocess
import unittest

from exported import (Exported, check_coco, check_croissant, check_imagefolder, check_masks,
                      check_webdataset, check_yolo)
from labelled import mask_of
from sandbox import digest, python_with

TILES = ("--tile", "24", "--overlap", "8")


class Formats(Exported):
    def setUp(self):
        super().setUp()
        self.long_path()
        self.edit("mission.yaml", "labels: [coco]",
                  "labels: [coco]\n  split: {train: 0.5, val: 0.5, gap: 0}")
        self.assert_renders()

    def masks_of_fans(self):
        """{name: [(category, box, area, pixels)]} of the COCO file of the fans."""
        coco = self.load("labels/coco_fan.json")
        shown = {one["id"]: (one["sensor"] + "-" + one["file_name"].split("/")[-1][:-4], [])
                 for one in coco["images"]}
        for one in coco["annotations"]:
            shown[one["image_id"]][1].append((one["category_id"], one["bbox"], one["area"],
                                              mask_of(one["segmentation"])))
        return dict(shown.values())

    def test_coco(self):
        self.assert_exports(*TILES, form="coco")
        found = check_coco(self.dest)
        self.assertEqual(set(found), {"train", "val"})
        reported = {**found["train"], **found["val"]}
        for name, objects in self.masks_of_fans().items():
            self.assertEqual(reported[name], objects)
        self.assert_exports(*TILES, "--polygons", form="coco", dest="polygons")
        outlines = check_coco(self.folder / "polygons")
        for part, pictures in found.items():
            for name, objects in pictures.items():
                for own, other in zip(objects, outlines[part][name], strict=True):
                    self.assertEqual(own[:3], other[:3])
                    self.assertLessEqual(own[3], other[3])

    def test_masks(self):
        self.assert_exports("--without", "walls", form="masks")
        classes, found = check_masks(self.dest)
        self.assertEqual(classes, ["background", "pillar"])
        reported = {**found["train"], **found["val"]}
        names = {one["id"]: one["name"] for one in self.dataset()["labels"]["classes"]}
        for name, objects in self.masks_of_fans().items():
            expected = set().union(*(pixels for category, _, _, pixels in objects
                                     if names[category] == "pillar"))
            pixels = {(x, y) for y, row in enumerate(reported[name]) for x, v in enumerate(row) if v}
            self.assertEqual(pixels, expected)

    def test_lists_of_objects(self):
        """Image folders and WebDataset hold what YOLO does."""
        self.assert_exports(*TILES, dest="yolo")
        names, expected = check_yolo(self.folder / "yolo")
        for form, check in (("imagefolder", check_imagefolder), ("webdataset", check_webdataset)):
            with self.subTest(form=form):
                self.assert_exports(*TILES, form=form, dest=form)
                classes, found = check(self.folder / form)
                self.assertEqual(classes, names)
                boxes = {part: {name: [(number, left + w / 2, top + h / 2, w, h)
                                       for number, (left, top, w, h), _ in objects]
                                for name, objects in pictures.items()}
                         for part, pictures in found.items()}
                self.assertEqual({part: set(pictures) for part, pictures in boxes.items()},
                                 {part: set(pictures) for part, pictures in expected.items()})
                for part, pictures in expected.items():
                    for name, objects in pictures.items():
                        for own, other in zip(boxes[part][name], objects, strict=True):
                            self.assertTrue(all(abs(a - b) < 0.011 for a, b in zip(own, other)))

    def test_the_card(self):
        self.assert_exports("--licence", "cc-by-4.0", form="imagefolder")
        card = (self.dest / "README.md").read_text()
        reported = self.dataset()
        self.assertIn('license: "cc-by-4.0"\n', card)
        for text in (reported["mission"], reported["mission_hash"], str(reported["seed"]), reported["program_version"]):
            self.assertIn(text, card)
        python = python_with("yaml")
        if python:
            head = card.split("---\n")[1]
            read = subprocess.run([python, "-c", "import json, sys, yaml; "
                                   "print(json.dumps(yaml.safe_load(sys.stdin)))"],
                                  input=head, text=True, capture_output=True, check=True)
            self.assertEqual(json.loads(read.stdout)["task_categories"], ["object-detection"])

    def test_croissant(self):
        self.assert_exports("--licence", "https://creativecommons.org/licenses/by/4.0/", form="imagefolder")
        classes, sets = check_croissant(self.dest)
        names, expected = check_imagefolder(self.dest)
        self.assertEqual(classes, names)
        self.assertEqual({part: {one["file_name"][:-4]: list(zip(one["categories"], one["bbox"], one["area"]))
                                 for one in records} for part, records in sets.items()}, expected)

    def test_the_same_bytes_again(self):
        for form in ("coco", "masks", "imagefolder", "webdataset"):
            self.assert_exports(form=form, dest=form)
            whole = digest(self.folder / form)
            os.rename(self.folder / form, self.folder / (form + ".part"))
            self.assert_exports(form=form, dest=form)
            self.assertEqual(digest(self.folder / form), whole)


if __name__ == "__main__":
    unittest.main()
