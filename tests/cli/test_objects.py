"""The facts of objects: per ping, and in the pictures of all pings, against the label arrays beside them."""
import json
import struct
import unittest

from labelled import Labelled, box_of, mask_of, read_png
from sandbox import digest


def u2_records(path, columns):
    """The rows of a file of uint16 records."""
    data = path.read_bytes()
    data = data[10 + struct.unpack("<H", data[8:10])[0]:]
    values = struct.unpack(f"<{len(data) // 2}H", data)
    return [values[k:k + columns] for k in range(0, len(values), columns)]


class Objects(Labelled):
    def objects(self, sensor, ping, folder="out"):
        file = self.folder / folder / sensor / f"objects/{ping:06}.json"
        return {one["id"]: one for one in json.loads(file.read_text())["objects"]}

    def test_masks_and_boxes_are_those_of_the_label_images(self):
        self.assert_renders()
        for sensor, pings in (("fls", (0, 2, 4)), ("mbes", range(6))):
            for ping in pings:
                for kind, shape in (("instance", None), ("fan_instance", "fan")):
                    ids, _ = read_png(self.out / sensor / kind / f"{ping:06}.png")
                    pixels = {}
                    for y, row in enumerate(ids):
                        for x, number in enumerate(row):
                            if number:
                                pixels.setdefault(number, set()).add((x, y))
                    found = self.objects(sensor, ping)
                    if shape is None:
                        self.assertEqual(set(found), set(pixels))
                    for number, one in found.items():
                        facts = one if shape is None else one["fan"]
                        if number not in pixels:
                            self.assertIsNone(facts)
                            continue
                        mask = mask_of({"size": [len(ids), len(ids[0])], "counts": facts["mask"]})
                        self.assertEqual(mask, pixels[number])
                        box = facts["box_bins"] if shape is None else facts["box_px"]
                        x, y = (box["beam"], box["range"]) if shape is None else (box["x"], box["y"])
                        self.assertEqual([x[0], y[0], x[1] - x[0], y[1] - y[0]], box_of(mask))
                        self.assertEqual(facts["area_bins" if shape is None else "area_px"], len(mask))
                        if shape is None:
                            edges = {0, len(ids[0]) - 1} & {x for x, _ in mask} or {0, len(ids) - 1} & {y for _, y in mask}
                            self.assertEqual(one["clipped"], bool(edges))

    def test_background_has_no_contrast(self):
        """The room is the largest surface. All label images stay as they are."""
        self.assert_renders("--out", "all")
        self.edit("mission.yaml", "labels: {background: [none]}\n", "")
        self.assert_renders()
        self.assertEqual(self.dataset()["labels"]["annotations"], {"background": ["walls"]})
        every, some = self.objects("fls", 2, "all"), self.objects("fls", 2)
        self.assertEqual(set(every), set(some))
        for number, one in some.items():
            is_wall = one["class"] == "walls"
            self.assertEqual(one["contrast_db"] is None, is_wall)
            self.assertEqual(one["mask"], every[number]["mask"])
            self.assertFalse(is_wall and "shadow" in one)
        for sensor in ("fls", "mbes"):
            for kind in ("instance", "class", "shadow", "image", "fan"):
                self.assertEqual(digest(self.out / sensor / kind), digest(self.folder / "all" / sensor / kind))

    def test_where_and_how_well(self):
        """The pillars stand 1.24 m away, 14 degrees to port, and 1.12 m, 27 to starboard, before the turn."""
        self.edit("mission.yaml", "labels: {background: [none]}\n", "")
        self.assert_renders()
        seen = set()
        for ping in (0, 2, 4):
            for one in self.objects("fls", ping).values():
                if one["class"] != "pillar" or one["area_bins"] < 3:
                    continue
                distance, port_deg = {"pillar_1": (1.237, 14.04), "pillar_2": (1.118, -26.57)}[one["name"]]
                self.assertAlmostEqual(one["range_m"], distance, delta=0.12)
                self.assertAlmostEqual(one["azimuth_rad"] * 57.2958, port_deg - 3 * ping, delta=7)  # its width
                self.assertTrue(0.1 <= one["visible_share"] <= 1, one)
                self.assertGreater(one["shadow"]["area_bins"], 0)
                seen.add(one["name"])
        self.assertEqual(seen, {"pillar_1", "pillar_2"})

    def test_a_side_scan_has_an_entry_a_side(self):
        self.assert_renders()
        found = json.loads((self.out / "sss/objects.json").read_text())
        self.assertEqual((found["picture"], found["width"], found["height"], found["pings"], found["pings_per_pixel"]),
                         ("waterfall.png", 92, 6, 6, 1))
        rows = u2_records(self.out / "sss/instance.npy", 92)
        left = {(x, y): number for y, row in enumerate(rows) for x, number in enumerate(row) if number}
        for one in found["objects"]:
            mask = mask_of({"size": [6, 92], "counts": one["mask"]})
            self.assertEqual({left.pop(pixel) for pixel in mask}, {one["id"]})
            xs = {x for x, _ in mask}
            side = "port" if max(xs) < 46 else "starboard"
            self.assertTrue(side == "port" or min(xs) >= 46)
            self.assertEqual((one["side"], one["bearing_deg"]), (side, -90 if side == "port" else 90))
            box = one["box_px"]
            self.assertEqual([box["x"][0], box["y"][0], box["x"][1] - box["x"][0], box["y"][1] - box["y"][0]],
                             box_of(mask))
            self.assertEqual((one["pings"], one["area_px"]), (box["y"], len(mask)))
            self.assertAlmostEqual(one["range_m"], sum(abs(x + 0.5 - 46) * 4 / 46 for x, _ in mask) / len(mask), delta=0.06)
            self.assertGreater(one["visible_share"], 0)
        self.assertEqual(left, {})
        sounder = json.loads((self.out / "sounder/objects.json").read_text())
        self.assertEqual((sounder["picture"], sounder["width"], sounder["height"]), ("echogram.png", 6, 40))
        self.assertFalse((self.out / "sss/objects").exists())
        for name in ("instance", "object_shadow", "visible_share"):
            self.assertTrue((self.out / f"sss/{name}.npy").exists())

    def test_shards_and_resume_know_the_same(self):
        self.edit("mission.yaml", "  labels: true\n", "  labels: [objects]\n")
        self.assert_renders()
        whole = digest(self.out)
        self.assertFalse(any("/instance/" in name for name in whole))
        for k in (2, 1):
            self.assert_renders("--shard", f"{k}/2", "--out", "shards")
        self.assertEqual(digest(self.folder / "shards"), whole)
        for k in "123":
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}", "-j2")
        result = self.run_sonarsim("merge", "part3", "part1", "part2", "merged")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assert_renders("--out", "merged")
        self.assertEqual(digest(self.folder / "merged"), whole)
        for name in ("sss/objects.json", "fls/objects/000002.json"):
            (self.out / name).unlink()
        self.assert_renders("-j2")
        self.assertEqual(digest(self.out), whole)
        self.edit("mission.yaml", "  labels: [objects]\n", "")
        self.assert_renders("--overwrite")
        self.assertFalse((self.out / "fls/objects").exists() or (self.out / "sss/objects.json").exists())

    def test_what_is_refused(self):
        labels = "labels: {background: [none]}\n"
        for old, new, *fragments in (
                (labels, "labels: {background: [wals]}\n", "there is no class 'wals' (did you mean 'walls'?)"),
                (labels, "labels: {background: []}\n", "'background' names classes, auto or none"),
                (labels, "labels: {min_pixels: 4}\n", "'min_pixels' is no longer there", "sonarsim export"),
                ("labels: true", "labels: [coco]", "'coco' is no longer there", "labels: [objects]"),
                ("labels: true", "split: {train: 1}", "'split' is no longer there", "--split"),
                ("labels: true", "pack: tar", "'pack' is no longer there", "webdataset"),
                ("labels: true", "polar: exr", "'exr' is no longer there", "polar: true"),
                ("labels: true", "labels: [boxes]", "unknown labels 'boxes'"),
                ("labels: true", "fan: false\n  labels: [fan]", "'fan'", "output.fan: true"),
                ('"pillar*"', '"pilar*"', "no node of the scene fits 'pilar*'", "sonarsim inspect")):
            before = (self.folder / "mission.yaml").read_text()
            self.edit("mission.yaml", old, new)
            self.assert_refused(self.render(), "mission.yaml:", *fragments)
            self.assertFalse(self.out.exists())
            self.write("mission.yaml", before)


if __name__ == "__main__":
    unittest.main()
