"""What COCO files and YOLO's annotate: background, specks, boxes, and what an annotation says."""
import json
import unittest

from labelled import Labelled, box_of, mask_of
from sandbox import digest

ALL = "labels: {background: [none], min_pixels: 1, min_visible_share: 0, min_contrast_db: 0}\n"


class Annotations(Labelled):
    def rules(self, text):
        self.edit("mission.yaml", ALL, text)

    def annotations(self, name="coco_fan", folder="out"):
        coco = json.loads((self.folder / folder / f"labels/{name}.json").read_text())
        return coco, {one["id"]: one for one in coco["annotations"]}

    def test_background_is_out_of_annotations_and_stays_in_label_images(self):
        """The room is the largest surface. Masks of the others, their ids and all label images stay as
        they are."""
        self.assert_renders("--out", "all")
        self.rules("labels: {min_pixels: 1, min_visible_share: 0, min_contrast_db: 0}\n")
        self.assert_renders()
        self.assertEqual(self.dataset()["labels"]["annotations"]["background"], ["walls"])
        for name in ("coco", "coco_fan", "coco_records"):
            whole, every = self.annotations(name, "all")
            coco, some = self.annotations(name)
            walls = next(one["id"] for one in whole["categories"] if one["name"] == "walls")
            self.assertEqual(coco["categories"],
                             [one for one in whole["categories"] if one["id"] != walls])
            expected = {key: one for key, one in every.items() if one["category_id"] != walls}
            self.assertEqual(set(some), set(expected))
            self.assertEqual(bool(some), name != "coco_records")  # no other sonar sees the pillars
            for key, one in some.items():
                for field in ("bbox", "segmentation", "area", "instance_id", "image_id"):
                    self.assertEqual(one[field], expected[key][field])
        for sensor in ("fls", "mbes"):
            for kind in ("instance", "class", "semantic", "fan_semantic", "shadow", "image", "fan"):
                self.assertEqual(digest(self.out / sensor / kind),
                                 digest(self.folder / "all" / sensor / kind))
        for file in (self.out / "fls/fan_yolo").iterdir():
            lines = (self.folder / "all/fls/fan_yolo" / file.name).read_text().splitlines()
            self.assertEqual(file.read_text().splitlines(),
                             [line for line in lines if not line.startswith(f"{walls - 1} ")])

    def test_specks_are_left_out_or_crowds(self):
        self.assert_renders("--out", "all")
        _, every = self.annotations(folder="all")
        areas = sorted(one["area"] for one in every.values())
        least = areas[len(areas) // 2] + 1
        limit = ALL.replace("min_pixels: 1", f"min_pixels: {least}")
        self.rules(limit)
        self.assert_renders("--out", "some")
        _, some = self.annotations(folder="some")
        self.assertEqual(some, {key: one for key, one in every.items() if one["area"] >= least})
        self.edit("mission.yaml", limit, limit.replace("}", ", faint: crowd}"))
        self.assert_renders()
        _, crowds = self.annotations()
        self.assertEqual(set(crowds), set(every))
        for key, one in crowds.items():
            self.assertEqual(one["iscrowd"], int(one["area"] < least))
        for kind in ("yolo", "fan_yolo", "yolo_polygons"):
            self.assertEqual(digest(self.out / "fls" / kind), digest(self.folder / "some/fls" / kind))

    def test_the_limits_of_visible_share_and_contrast(self):
        self.assert_renders("--out", "all")
        _, every = self.annotations("coco", "all")
        for key, field in (("min_visible_share", "visible_share"), ("min_contrast_db", "contrast_db")):
            reported = sorted(abs(one[field]) for one in every.values() if one[field] is not None)
            limit = (reported[len(reported) // 2 - 1] + reported[len(reported) // 2]) / 2
            rules = ALL.replace(key + ": 0", f"{key}: {limit}")
            self.assert_renders("--set", f"labels.{key}={limit}", "--out", key)
            _, some = self.annotations("coco", key)

            def stays(one):
                if key == "min_visible_share":
                    return one[field] is None or one[field] >= limit
                known = [abs(one[name]) for name in (field, "shadow_contrast_db")
                         if one[name] is not None]
                return not known or max(known) >= limit

            self.assertEqual(set(some), {key for key, one in every.items() if stays(one)}, rules)

    def test_an_annotation_says_where_and_how_well(self):
        """The pillars stand 1.24 m away, 14 degrees to port, and 1.12 m, 27 to starboard, before the
        turn of the sonar; walls stand all around."""
        self.rules("labels: {min_pixels: 3}\n")
        self.assert_renders()
        for name in ("coco", "coco_fan"):
            coco, annotations = self.annotations(name)
            images = {one["id"]: one for one in coco["images"]}
            names = {one["id"]: one["name"] for one in self.dataset()["labels"]["instances"]}
            seen = set()
            for one in annotations.values():
                image = images[one["image_id"]]
                distance, port_deg = {"pillar_1": (1.237, 14.04),
                                      "pillar_2": (1.118, -26.57)}[names[one["instance_id"]]]
                turned = port_deg - 3 * image["ping"]
                self.assertAlmostEqual(one["range_m"], distance, delta=0.12)
                self.assertAlmostEqual(one["bearing_deg"], -turned, delta=7)  # its width
                self.assertTrue(0.1 <= one["visible_share"] <= 1, one)
                left, top, width, height = one["shadow_bbox"]
                self.assertTrue(0 <= left <= left + width <= image["width"], one)
                self.assertTrue(0 <= top <= top + height <= image["height"], one)
                self.assertEqual(one["iscrowd"], 0)
                seen.add(one["instance_id"])
            self.assertEqual(len(seen), 2)

    def test_boxes_of_shadows(self):
        self.assert_renders("--out", "all")
        for box in ("shadow", "both"):
            self.assert_renders("--set", f"labels.box={box}", "--out", box)
            for kind in ("coco", "coco_fan"):
                _, every = self.annotations(kind, "all")
                _, found = self.annotations(kind, box)
                expected = {}
                for key, one in every.items():
                    left, top, width, height = one["bbox"]
                    shadow = one["shadow_bbox"]
                    if box == "shadow":
                        expected[key] = shadow
                    elif shadow is None:
                        expected[key] = one["bbox"]
                    else:
                        ends = [max(left + width, shadow[0] + shadow[2]),
                                max(top + height, shadow[1] + shadow[3])]
                        begin = [min(left, shadow[0]), min(top, shadow[1])]
                        expected[key] = begin + [ends[0] - begin[0], ends[1] - begin[1]]
                expected = {key: value for key, value in expected.items() if value}
                self.assertTrue(expected)
                self.assertEqual({key: one["bbox"] for key, one in found.items()}, expected)
                for key, one in found.items():
                    self.assertEqual(one["segmentation"], every[key]["segmentation"])

    def test_a_side_scan_has_an_annotation_a_side(self):
        self.assert_renders()
        coco, annotations = self.annotations("coco_records")
        sss = next(one for one in coco["images"] if one["sensor"] == "sss")
        sides = {}
        for one in annotations.values():
            if one["image_id"] != sss["id"]:
                self.assertNotIn("side", one)
                continue
            xs = {x for x, _ in mask_of(one["segmentation"])}
            is_port = max(xs) < sss["width"] // 2
            self.assertTrue(is_port or min(xs) >= sss["width"] // 2)
            self.assertEqual((one["side"], one["bearing_deg"]),
                             ("port", -90) if is_port else ("starboard", 90))
            self.assertEqual(one["bbox"], box_of(mask_of(one["segmentation"])))
            middle = (max(xs) + min(xs) + 1 - sss["width"]) / 2 * 4 / 40
            self.assertAlmostEqual(one["range_m"], abs(middle), delta=2)
            self.assertGreater(one["visible_share"], 0)
            sides.setdefault(one["instance_id"], []).append(one["side"])
        self.assertEqual(sorted(sides[1]), ["port", "starboard"])

    def test_shards_and_resume_annotate_the_same(self):
        self.rules("labels: {}\n")
        self.assert_renders()
        whole = digest(self.out)
        for k in (2, 1):
            self.assert_renders("--shard", f"{k}/2", "--out", "shards")
        self.assertEqual(digest(self.folder / "shards"), whole)
        self.assert_renders("--set", "output.pack=tar", "--out", "packed")
        for name in ("coco_records", "coco_fan"):
            self.assertEqual(*(json.dumps([one for one in self.annotations(name, folder)[1].values()])
                               for folder in ("out", "packed")))

    def test_what_is_refused(self):
        for text, fragment in (
                ("labels: {background: [wals]}\n", "there is no class 'wals' (did you mean 'walls'?)"),
                ("labels: {background: []}\n", "'background' names classes, auto or none"),
                ("labels: {min_pixels: 0}\n", "'min_pixels' must be"),
                ("labels: {min_visible_share: 2}\n", "'min_visible_share' must be"),
                ("labels: {box: shade}\n", "shade"),
                ("labels: {faint: hide}\n", "hide")):
            before = (self.folder / "mission.yaml").read_text()
            self.rules(text)
            result = self.render()
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(fragment, result.stderr)
            self.assertIn("mission.yaml:", result.stderr)
            self.assertFalse(self.out.exists())
            self.write("mission.yaml", before)


if __name__ == "__main__":
    unittest.main()
