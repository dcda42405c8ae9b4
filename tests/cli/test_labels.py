"""Labels in the formats of others: COCO, YOLO, semantic PNGs; splits; what merge and verify make of them.
Every file is read by code of this test, from what the formats' authors publish."""
import itertools
import json
import math
import shutil
import struct
import subprocess
import unittest
import zlib

from sandbox import Sandbox, box_gltf, digest, path_csv, python_with

MISSION = """\
name: labels
seed: 7
scene: {file: room.gltf, materials: materials.csv}
trajectory: {file: path.csv}
sensors:
  fls: {kind: imaging, azimuth_deg: 60, elevation_deg: 20, range_min_m: 0.5, range_max_m: 4,
        range_bins: 70, azimuth_bins: 48, every: 2, noise: {add_sigma: 0.05}}
  mbes: {kind: profiling, azimuth_deg: 90, range_max_m: 4, range_bins: 40, azimuth_bins: 24}
  sss: {kind: sidescan, range_max_m: 4, range_bins: 40}
  sounder: {kind: echosounder, range_max_m: 4, range_bins: 40}
classes:
  - {nodes: "pillar*", class: pillar}
output:
  folder: out
  fan_width_px: 64
  labels: true
  image: true
"""

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


def room_gltf():
    """A box with two pillars in it; y is up, so that (x, y, z) lies at (x, -z, y) of the world."""
    room = json.loads(box_gltf())
    room["nodes"] += [{"name": f"pillar_{k}", "mesh": 0, "translation": [x, 0, z],
                       "scale": [0.06, 0.5, 0.06]} for k, x, z in ((1, 1.2, -0.3), (2, 1.0, 0.5))]
    room["scenes"][0]["nodes"] = [0, 1, 2]
    return json.dumps(room)


def read_png(path):
    """Its rows of values, and the colour table if it has one. 8 and 16 bits, grey or with a table,
    rows stored as they are or as the difference from the one above."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    chunks, at = {}, 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        crc, = struct.unpack(">I", data[at + 8 + length:at + 12 + length])
        assert crc == zlib.crc32(kind + body), (path, kind)
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + length
    width, height, bits, colours, *_ = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert colours in (0, 3), path
    raw, stride = zlib.decompress(chunks[b"IDAT"]), width * bits // 8
    assert len(raw) == height * (stride + 1), path
    above, rows = bytes(stride), []
    for i in range(height):
        kind, *own = raw[i * (stride + 1):(i + 1) * (stride + 1)]
        assert kind in (0, 2), (path, kind)
        above = bytes((a + b) & 255 for a, b in zip(own, above)) if kind == 2 else bytes(own)
        rows.append(list(above) if bits == 8 else list(struct.unpack(f">{width}H", above)))
    return rows, chunks.get(b"PLTE")


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


def runs_of(text):
    """The numbers of compressed RLE."""
    runs, at = [], 0
    while at < len(text):
        value, shift, more = 0, 0, True
        while more:
            code = ord(text[at]) - 48
            value |= (code & 31) << shift
            more = bool(code & 32)
            at += 1
            shift += 5
            if not more and code & 16:
                value |= -1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
    return runs


def mask_of(segmentation):
    """The pixels (x, y) of a mask, column by column."""
    height, width = segmentation["size"]
    runs = runs_of(segmentation["counts"])
    assert sum(runs) == height * width and min(runs[1:]) > 0, segmentation
    pixels, at = set(), 0
    for k, run in enumerate(runs):
        if k % 2:
            pixels |= {divmod(n, height) for n in range(at, at + run)}
        at += run
    return pixels


def box_of(pixels):
    """[left, top, width, height]."""
    xs, ys = zip(*pixels)
    return [min(xs), min(ys), max(xs) - min(xs) + 1, max(ys) - min(ys) + 1]


class Labels(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("room.gltf", room_gltf())
        self.write("path.csv", path_csv(6))

    def load(self, name):
        return json.loads((self.out / name).read_text())

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
                told = {}
                for y, row in enumerate(rows):
                    for x, value in enumerate(row):
                        if value:
                            told.setdefault(value, set()).add((x, y))
                self.assertEqual(seen.get(image["id"], {}), told, image)
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
            told = {}
            for one in coco["annotations"]:
                if one["image_id"] != image["id"]:
                    continue
                pixels = mask_of(one["segmentation"])
                self.assertEqual((one["bbox"], one["area"]), (box_of(pixels), len(pixels)))
                told.setdefault(one["instance_id"], []).append(pixels)
            expected = {}
            for y, row in enumerate(rows):
                for x, value in enumerate(row):
                    if value:
                        expected.setdefault(value, set()).add((x, y))
            self.assertEqual({key: set().union(*parts) for key, parts in told.items()}, expected)
            self.assertEqual(sum(len(p) for parts in told.values() for p in parts),
                             sum(len(pixels) for pixels in expected.values()))
            self.assertEqual(len(told[1]), 1)  # the walls are always in sight
            if not upright:
                self.assertEqual([(box_of(p)[1], box_of(p)[3]) for p in told[2]], [(0, 5), (45, 5)])

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
            told = {one["instance_id"]: mask_of(one["segmentation"]) for one in coco["annotations"]
                    if one["image_id"] == image["id"]}
            self.assertEqual({key: set(pixels) for key, pixels in told.items()}, expected)
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
                told = [one for one in coco["annotations"] if one["image_id"] == image["id"]]
                self.assertEqual((len(boxes), len(outlines)), (len(told), len(told)))
                for one, box, outline in zip(told, boxes, outlines):
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
                "of 6 poses none is left for 'train'", "smaller gap")
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
