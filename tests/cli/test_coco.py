"""Labels in the format of COCO."""
import itertools
import json
import math
import struct
import subprocess
import unittest

from labelled import Labelled, box_of, mask_of, read_png
from sandbox import path_csv, python_with

# What cocodataset.org/#format-data says of instances with run-length masks, as a JSON schema.
COCO_SCHEMA = {
    "type": "object",
    "required": ["info", "images", "annotations", "categories", "licenses"],
    "properties": {
        "info": {"type": "object", "properties": {"description": {"type": "string"},
                                                  "version": {"type": "string"}}},
        "licenses": {"type": "array"},
        "images": {"type": "array", "minItems": 1, "items": {
            "type": "object", "required": ["id", "width", "height", "file_name"],
            "properties": {"id": {"type": "integer", "minimum": 1},
                           "width": {"type": "integer", "minimum": 1},
                           "height": {"type": "integer", "minimum": 1},
                           "file_name": {"type": "string", "minLength": 1}}}},
        "categories": {"type": "array", "minItems": 1, "items": {
            "type": "object", "required": ["id", "name", "supercategory"],
            "properties": {"id": {"type": "integer", "minimum": 1},
                           "name": {"type": "string"}, "supercategory": {"type": "string"}}}},
        "annotations": {"type": "array", "items": {
            "type": "object",
            "required": ["id", "image_id", "category_id", "segmentation", "area", "bbox", "iscrowd"],
            "properties": {
                "id": {"type": "integer", "minimum": 1},
                "image_id": {"type": "integer", "minimum": 1},
                "category_id": {"type": "integer", "minimum": 1},
                "area": {"type": "number", "exclusiveMinimum": 0},
                "bbox": {"type": "array", "minItems": 4, "maxItems": 4,
                         "items": {"type": "number", "minimum": 0}},
                "iscrowd": {"enum": [0, 1]},
                "segmentation": {
                    "type": "object", "required": ["size", "counts"],
                    "properties": {"size": {"type": "array", "minItems": 2, "maxItems": 2,
                                            "items": {"type": "integer", "minimum": 1}},
                                   "counts": {"type": "string", "pattern": "^[0-o]+$"}}}}}},
    },
}


def read_ids(path, upright):
    """The rows of an .npy of 16 bits; `upright`: its columns stand one after the other."""
    data = path.read_bytes()
    begin = 10 + int.from_bytes(data[8:10], "little")
    header = data[10:begin].decode()
    assert "'<u2'" in header and f"'fortran_order': {upright}" in header, header
    height, width = (int(n) for n in header.split("(")[1].split(")")[0].split(","))
    values = struct.unpack(f"<{height * width}H", data[begin:])
    if upright:
        return [values[y::height] for y in range(height)]
    return [values[y * width:(y + 1) * width] for y in range(height)]


class Coco(Labelled):
    def test_coco(self):
        self.assert_renders()
        names = {one["id"]: one["name"] for one in self.dataset()["labels"]["classes"]}
        ids = []
        for name, labels in (("coco", "instance"), ("coco_fan", "fan_instance")):
            coco = self.load(f"labels/{name}.json")
            images = {image["id"]: image for image in coco["images"]}
            self.assertEqual(len(images), 3 + 6)  # the first sensor pings at every second pose
            self.assertEqual({one["id"]: one["name"] for one in coco["categories"]}, names)
            seen = {}
            for one in coco["annotations"]:
                image = images[one["image_id"]]
                ids += [one["id"]]
                pixels = mask_of(one["segmentation"])
                self.assertEqual(one["segmentation"]["size"], [image["height"], image["width"]])
                self.assertEqual(one["area"], len(pixels))
                self.assertEqual(one["bbox"], box_of(pixels))
                seen.setdefault(image["id"], {})[one["instance_id"]] = pixels
            for image in images.values():
                rows, _ = read_png(self.out / image["file_name"].replace(
                    "image/" if labels == "instance" else "fan/", labels + "/"))
                self.assertEqual((len(rows), len(rows[0])), (image["height"], image["width"]))
                reported = {}
                for y, row in enumerate(rows):
                    for x, value in enumerate(row):
                        if value:
                            reported.setdefault(value, set()).add((x, y))
                self.assertEqual(seen.get(image["id"], {}), reported, image)
                self.assertTrue((self.out / image["file_name"]).exists())
            ids += list(images)
        self.assertEqual(len(ids), len(set(ids)))  # none is there twice, images and masks of both

    def test_coco_of_waterfalls_and_echograms(self):
        # Past the first pillar for 5 pings, far from it for 40, and past it again.
        xs = [1.2] * 5 + [-1.2] * 40 + [1.2] * 5
        self.write("path.csv", "\n".join(
            ["t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg",
             *(f"{0.2 * k:.1f},{x},0,1.2,0,0,0" for k, x in enumerate(xs))]) + "\n")
        self.edit("mission.yaml", "labels: true", "labels: [coco]")
        self.assert_renders()
        coco = self.load("labels/coco_records.json")
        self.assertEqual([(one["file_name"], one["width"], one["height"]) for one in coco["images"]],
                         [("sss/waterfall.png", 2 * (40 + 6), 50), ("sounder/echogram.png", 50, 40)])
        others = self.load("labels/coco.json"), self.load("labels/coco_fan.json")
        taken = {one["id"] for other in others for one in other["images"] + other["annotations"]}
        self.assertFalse(taken & {one["id"] for one in coco["images"] + coco["annotations"]})
        for image, file, upright in zip(coco["images"], ("sss/instance.npy", "sounder/instance.npy"),
                                        (False, True)):
            rows = read_ids(self.out / file, upright)
            reported = {}
            for one in coco["annotations"]:
                if one["image_id"] != image["id"]:
                    continue
                pixels = mask_of(one["segmentation"])
                self.assertEqual((one["bbox"], one["area"]), (box_of(pixels), len(pixels)))
                reported.setdefault(one["instance_id"], []).append(pixels)
            expected = {}
            for y, row in enumerate(rows):
                for x, value in enumerate(row):
                    if value:
                        expected.setdefault(value, set()).add((x, y))
            self.assertEqual({key: set().union(*parts) for key, parts in reported.items()}, expected)
            self.assertEqual(sum(len(p) for parts in reported.values() for p in parts),
                             sum(len(pixels) for pixels in expected.values()))
            # The walls are always in sight: an annotation a side of the side-scan sonar, none across.
            sides = sorted({x >= 46 for x, _ in pixels} for pixels in reported[1])
            self.assertEqual(sides, [{False, True}] if upright else [{False}, {True}])
            if not upright:
                self.assertEqual([(box_of(p)[1], box_of(p)[3]) for p in reported[2]], [(0, 5), (45, 5)])

    def test_coco_of_scans(self):
        """Every pixel of a round picture holds the instance of the bin that its centre lies in."""
        self.write("path.csv", path_csv(20))
        self.edit("mission.yaml", "classes:\n",
                  "  head: {kind: scanning, sector_deg: 360, step_deg: 30, range_max_m: 4, "
                  "range_bins: 40}\nclasses:\n")
        self.edit("mission.yaml", "labels: true", "labels: [coco]")
        self.assert_renders()
        coco = self.load("labels/coco_scans.json")
        self.assertEqual([(one["file_name"], one["width"], one["height"]) for one in coco["images"]],
                         [(f"head/scan_000{k}.png", 64, 64) for k in (0, 1)])
        others = [self.load(f"labels/{name}.json") for name in ("coco", "coco_fan", "coco_records")]
        taken = {one["id"] for other in others for one in other["images"] + other["annotations"]}
        self.assertFalse(taken & {one["id"] for one in coco["images"] + coco["annotations"]})
        # Each picture of records has room for 65536 annotations.
        pictures = [one["id"] for one in others[-1]["images"]]
        first = min(one["id"] for one in coco["annotations"])
        self.assertGreaterEqual(first, (max(pictures) + 1 + len(pictures)) * 65536)
        rows = read_ids(self.out / "head/instance.npy", False)
        least = next(s for s in self.dataset()["sensors"] if s["name"] == "head")["range_edges_m"][0]
        shown = {}  # by step; 20 pings are a sweep of 12 and eight of the next
        for sweep, image in enumerate(coco["images"]):
            shown.update({ping % 12: rows[ping] for ping in range(12 * sweep, min(12 * sweep + 12, 20))})
            expected = {}
            for row, column in itertools.product(range(64), repeat=2):
                x, y = 4 - (row + 0.5) / 8, 4 - (column + 0.5) / 8  # pixels of 1/8 m
                distance, turn = math.hypot(x, y), math.atan2(y, x) / math.tau + 0.5
                if least <= distance < 4:
                    bins = shown[min(int(12 * turn), 11)]
                    value = bins[int((distance - least) / (4 - least) * 40)]
                    if value:
                        expected.setdefault(value, set()).add((column, row))
            reported = {one["instance_id"]: mask_of(one["segmentation"]) for one in coco["annotations"]
                    if one["image_id"] == image["id"]}
            self.assertEqual({key: set(pixels) for key, pixels in reported.items()}, expected)
            self.assertTrue(expected)

    def test_coco_against_the_published_format(self):
        python = python_with("jsonschema")
        if not python:
            self.skipTest("jsonschema is not installed")
        self.assert_renders()
        self.write("schema.json", json.dumps(COCO_SCHEMA))
        for name in ("coco", "coco_fan", "coco_records"):
            check = ("import json, jsonschema\n"
                     f"jsonschema.validate(json.load(open('out/labels/{name}.json')),"
                     " json.load(open('schema.json')))")
            result = subprocess.run([python, "-c", check], cwd=self.folder, capture_output=True,
                                    text=True, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    unittest.main()
