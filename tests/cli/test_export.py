"""sonarsim export: pictures, tiles, parts, and what is refused; each format is in test_export_formats.py."""
import json
import os
import shutil
import unittest

from exported import Exported, check_yolo
from labelled import box_of, mask_of, read_png
from sandbox import digest, png_file

SPLIT = "\n  split: {train: 0.5, val: 0.5, gap: 0}"


class Export(Exported):
    def coco_boxes(self, name, sensor=None):
        """{stem of the picture: [(class from 0 on, middle x, y, width, height)]}."""
        coco = self.load(f"labels/{name}.json")
        shown = {one["id"]: (one["sensor"] + "-" + one["file_name"].split("/")[-1][:-4], [])
                 for one in coco["images"] if sensor in (None, one["sensor"])}
        for one in coco["annotations"]:
            if one["image_id"] in shown:
                x, y, w, h = one["bbox"]
                shown[one["image_id"]][1].append((one["category_id"] - 1, x + w / 2, y + h / 2, w, h))
        return dict(shown.values())

    def test_yolo_of_fans(self):
        self.edit("mission.yaml", "labels: [coco]", "labels: [coco]" + SPLIT)
        self.assert_renders()
        self.assert_exports("--sensor", "fls", "--sensor", "mbes")
        names, found = check_yolo(self.dest)
        self.assertEqual(names, [one["name"] for one in self.dataset()["labels"]["classes"]])
        self.assertEqual({part: len(pictures) for part, pictures in found.items()},
                         {"train": 2 + 3, "val": 1 + 3})
        reported = {**found["train"], **found["val"]}
        expected = self.coco_boxes("coco_fan")
        self.assertEqual(set(reported), set(expected))
        for name, boxes in expected.items():
            self.assertEqual(len(reported[name]), len(boxes))
            for own, box in zip(sorted(reported[name]), sorted(boxes)):
                self.assertTrue(all(abs(a - b) < 0.011 for a, b in zip(own, box)), (own, box))
        for part, pictures in found.items():
            for name in pictures:
                sensor, number = name.split("-")
                self.assertEqual((self.dest / f"images/{part}/{name}.png").read_bytes(),
                                 (self.out / f"{sensor}/fan/{number}.png").read_bytes())

    def test_a_class_with_a_line_break_keeps_its_number(self):
        room = json.loads((self.folder / "room.gltf").read_text())
        room["nodes"][0]["extras"] = {"sonar": {"class": "a\nb\u2028c"}}
        self.write("room.gltf", json.dumps(room))
        self.edit("mission.yaml", "labels: [coco]", "labels: [coco, yolo]")
        self.assert_renders()
        names = [one["name"] for one in self.dataset()["labels"]["classes"]]
        self.assertIn("a\nb\u2028c", names)
        self.assert_exports("--sensor", "fls")
        self.assertEqual(check_yolo(self.dest)[0], names)
        self.assert_exports("--sensor", "fls", form="webdataset", dest="shards")
        for file in (self.out / "labels/classes.txt", self.folder / "shards/classes.txt"):
            lines = file.read_text().split("\n")[:-1]
            self.assertEqual([line.split("\\")[0] for line in lines],
                             [name.split("\n")[0] for name in names])

    def test_specks_are_left_out(self):
        self.assert_renders()
        coco = self.load("labels/coco_fan.json")
        areas = sorted(one["area"] for one in coco["annotations"])
        least = areas[len(areas) // 2] + 1
        few = [area for area in areas if area < least]
        result = self.assert_exports("--sensor", "fls", "--sensor", "mbes", "--least-pixels", least)
        self.assertIn(f"left out {len(few)} objects", result.stderr)
        _, found = check_yolo(self.dest)
        self.assertEqual(sum(map(len, found["train"].values())), len(areas) - len(few))

    def test_objects_are_those_that_the_dataset_annotates(self):
        """The walls are background; boxes hold the shadows, too; specks are crowds, which COCO alone
        keeps."""
        self.edit("mission.yaml", "labels: {background: [none], min_pixels: 1,",
                  "labels: {box: both, faint: crowd, min_pixels: 5,")
        self.assert_renders()
        self.assert_exports("--sensor", "fls", "--sensor", "mbes")
        names, found = check_yolo(self.dest)
        self.assertEqual(names, ["pillar"])
        coco = self.load("labels/coco_fan.json")
        kept = [one for one in coco["annotations"] if not one["iscrowd"]]
        self.assertTrue(0 < len(kept) < len(coco["annotations"]))
        expected = self.coco_boxes("coco_fan")
        crowds = {one["image_id"] for one in coco["annotations"] if one["iscrowd"]}
        shown = {one["id"]: one["sensor"] + "-" + one["file_name"].split("/")[-1][:-4]
                 for one in coco["images"]}
        for image, name in shown.items():
            if image in crowds:
                continue
            boxes = sorted(box[1:] for box in expected[name])
            self.assertEqual(len(found["train"][name]), len(boxes))
            for own, box in zip(sorted(one[1:] for one in found["train"][name]), boxes):
                self.assertTrue(all(abs(a - b) < 0.011 for a, b in zip(own, box)), (own, box))
        self.assertEqual(sum(map(len, found["train"].values())), len(kept))
        self.assert_exports("--sensor", "fls", "--sensor", "mbes", form="coco", dest="again")
        reported = json.loads((self.folder / "again/annotations/instances_train.json").read_text())
        self.assertEqual([one["name"] for one in reported["categories"]], ["pillar"])
        fields = ("bbox", "area", "iscrowd", "range_m", "bearing_deg", "contrast_db", "visible_share",
                  "shadow_bbox", "shadow_contrast_db")
        listed = [[str(one[key]) for key in fields] for one in reported["annotations"]]
        self.assertEqual(sorted(listed), sorted([str(one[key]) for key in fields]
                                                for one in coco["annotations"]))
        self.edit("mission.yaml", "{box: both,", "{background: [walls, pillar], box: both,")
        self.assert_renders("--overwrite")
        self.assert_refused(self.export(dest="none"), "annotates no class")

    def test_packs_variants_and_collections(self):
        self.assert_renders()
        self.assert_exports()
        loose = digest(self.dest, without=(".sonarsim-export.json",))
        self.assert_renders("--set", "output.pack=tar", "--out", "packed")
        self.assert_exports(source="packed", dest="again")
        self.assertEqual(digest(self.folder / "again", without=(".sonarsim-export.json",)), loose)
        names, found = check_yolo(self.dest)
        count = len(found["train"])
        self.assertEqual(count, 3 + 6 + 2)
        result = self.run_sonarsim("merge", "--different", "out", "packed", "all")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assert_exports(source="all", dest="both")
        self.assertEqual(len(check_yolo(self.folder / "both")[1]["train"]), 2 * count)
        self.assert_renders("--set", "variants=4", "--set", "output.split={train: 0.5, val: 0.5}",
                            "--out", "many")
        self.assert_exports("--without", names[0], source="many", dest="parted")
        fewer, found = check_yolo(self.folder / "parted")
        self.assertEqual(fewer, names[1:])
        self.assertEqual({part: len(pictures) for part, pictures in found.items()},
                         {"train": 2 * count, "val": 2 * count})
        self.assertTrue(all(name.startswith(("variant_0002-", "variant_0003-"))
                            for name in found["val"]))

    def test_links_and_polygons(self):
        self.assert_renders()
        self.assert_exports("--link", "--polygons", "--sensor", "fls")
        _, found = check_yolo(self.dest)
        for name, objects in found["train"].items():
            number = name.split("-")[1]
            self.assertEqual((self.dest / f"images/train/{name}.png").stat().st_ino,
                             (self.out / f"fls/fan/{number}.png").stat().st_ino)
            boxes = self.coco_boxes("coco_fan")[name]
            for own, box in zip(sorted(objects), sorted(boxes)):
                xs, ys = own[1::2], own[2::2]
                self.assertAlmostEqual(min(xs), box[1] - box[3] / 2, delta=0.02)
                self.assertAlmostEqual(max(ys), box[2] + box[4] / 2, delta=0.02)

    def sides_of(self, image, coco):
        """{(instance, class, side): pixels} of a waterfall."""
        sides = {}
        for one in coco["annotations"]:
            if one["image_id"] == image["id"]:
                for x, y in mask_of(one["segmentation"]):
                    side = x >= image["width"] // 2
                    sides.setdefault((one["id"], one["category_id"], side), set()).add((x, y))
        return sides

    def test_tiles_of_a_waterfall(self):
        """Every tile shows the pixels of the waterfall at its place, with the fan's tone, and for each
        object and side its box in the tile, if enough of it is there."""
        self.long_path()
        self.assert_renders()
        coco = self.load("labels/coco_records.json")
        image = next(one for one in coco["images"] if one["sensor"] == "sss")
        width, height = image["width"], image["height"]
        self.assertEqual((width, height), (92, 50))
        rows, _ = read_png(self.out / "sss/waterfall.png")
        grey = [[round(255 * (v / 65535) ** 0.5) for v in row] for row in rows]
        sides = self.sides_of(image, coco)
        for share in ("0.2", "0"):
            dest = f"tiles{share}"
            self.assert_exports("--sensor", "sss", "--tile", "32", "--overlap", "8", "--least-share",
                                share, dest=dest)
            _, found = check_yolo(self.folder / dest)
            places = [(y, x) for y in (0, 18) for x in (0, 24, 48, 60)]
            self.assertEqual(sorted(found["train"]),
                             [f"sss-waterfall-y{y:05}-x{x:05}" for y, x in places])
            for y, x in places:
                name = f"sss-waterfall-y{y:05}-x{x:05}"
                own, _ = read_png(self.folder / dest / f"images/train/{name}.png")
                self.assertEqual(own, [row[x:x + 32] for row in grey[y:y + 32]])
                expected = []
                for (_, class_id, _), pixels in sides.items():
                    seen = {(a - x, b - y) for a, b in pixels if x <= a < x + 32 and y <= b < y + 32}
                    if seen and len(seen) >= float(share) * len(pixels):
                        left, top, w, h = box_of(seen)
                        expected.append((class_id - 1, left + w / 2, top + h / 2, w, h))
                self.assertEqual(len(found["train"][name]), len(expected))
                for one, box in zip(sorted(found["train"][name]), sorted(expected)):
                    self.assertTrue(all(abs(a - b) < 0.011 for a, b in zip(one, box)), (one, box))
                    middle = width // 2 - x  # no box lies across the nadir
                    self.assertFalse(one[1] - one[3] / 2 + 0.02 < middle < one[1] + one[3] / 2 - 0.02)

    def test_a_split_parts_the_tiles(self):
        self.long_path()
        self.edit("mission.yaml", "labels: [coco]", "labels: [coco]" + SPLIT)
        self.assert_renders()
        result = self.assert_exports("--sensor", "sss", "--tile", "20")
        _, found = check_yolo(self.dest)
        # Rows 0 to 24 are for training; the tiles begin at the rows 0, 20 and 30.
        rows = {part: {name.split("-")[2] for name in names} for part, names in found.items()}
        self.assertEqual(rows, {"train": {"y00000"}, "val": {"y00030"}})
        self.assertIn("left out 5 pictures", result.stderr)
        self.assert_refused(self.export("--sensor", "sss", dest="whole"), "--tile")
        self.assertFalse((self.folder / "whole").exists())
        self.assertFalse((self.folder / "whole.part").exists())

    def test_echograms_and_scans(self):
        self.long_path()
        self.edit("mission.yaml", "classes:\n",
                  "  head: {kind: scanning, sector_deg: 360, step_deg: 30, range_max_m: 4, "
                  "range_bins: 40}\nclasses:\n")
        self.assert_renders()
        self.assert_exports("--sensor", "sounder", "--sensor", "head", "--tile", "40")
        _, found = check_yolo(self.dest)
        self.assertEqual(sorted(name for name in found["train"] if name.startswith("sounder")),
                         ["sounder-echogram-y00000-x00000", "sounder-echogram-y00000-x00010"])
        self.assertEqual(len([n for n in found["train"] if n.startswith("head-scan_0004-")]), 4)

    def test_bins(self):
        """The bins have the tone of the fan, from images and from arrays."""
        self.assert_renders()
        self.assert_exports("--sensor", "fls", "--bins")
        rows, _ = read_png(self.out / "fls/image/000000.png")
        own, _ = read_png(self.dest / "images/train/fls-000000.png")
        self.assertEqual(own, [[round(255 * (v / 65535) ** 0.5) for v in row] for row in rows])
        self.edit("mission.yaml", "  image: true\n", "")
        self.assert_renders("--overwrite")
        self.assert_exports("--sensor", "fls", "--bins", dest="arrays")
        again, _ = read_png(self.folder / "arrays/images/train/fls-000000.png")
        self.assertTrue(all(abs(a - b) <= 1 for x, y in zip(own, again) for a, b in zip(x, y)))

        self.assert_renders("--set", "output.pack=tar", "--out", "packed")
        self.assert_exports("--sensor", "fls", "--bins", source="packed", dest="unpacked")
        self.assertEqual(digest(self.folder / "unpacked/images"), digest(self.folder / "arrays/images"))

    def test_what_is_refused_leaves_nothing(self):
        self.assert_renders("--set", "output.fan=false")
        self.assert_refused(self.export(), "sensor 'fls' has no fans", "output.fan: true", "--bins")
        self.assert_refused(self.export("--sensor", "flss"), "--sensor", "did you mean 'fls'?")
        self.assert_refused(self.export("--bins", "--without", "pilar"), "--without",
                            "did you mean 'pillar'?")
        self.assert_refused(self.export("--tile", "20", "--overlap", "20"), "--overlap")
        self.assert_refused(self.export(form="yolo8"), "did you mean 'yolo'?", "imagefolder")
        self.assert_refused(self.export(source="nothing"), "nothing", "is no dataset")
        self.assert_refused(self.export("--bins", dest="out/exported"), "lies in the dataset")
        self.assert_renders("--overwrite", "--set", "output.labels=[instance]")
        self.assert_refused(self.export(), "labels: [coco]")
        shutil.rmtree(self.out)
        self.assert_renders("--shard", "1/2")
        self.assert_refused(self.export(), "is not complete")
        self.assertFalse(self.dest.exists())
        self.assertFalse((self.folder / "dest.part").exists())

    def test_another_folder_is_not_touched(self):
        self.assert_renders()
        self.write("dest/thesis.txt", "years of work")
        self.assert_refused(self.export(), "dest", "holds something else")
        self.assertEqual(digest(self.dest).keys(), {"thesis.txt"})
        (self.dest / "thesis.txt").unlink()
        self.write("dest.part/thesis.txt", "years of work")
        self.assert_refused(self.export(), "dest.part", "unfinished export")
        shutil.rmtree(self.folder / "dest.part")
        self.assert_exports()
        whole = digest(self.dest)
        self.assertIn("already", self.export().stderr)
        self.assert_refused(self.export("--sensor", "fls"), "dest", "holds something else")
        self.assertEqual(digest(self.dest), whole)

    def test_an_export_that_was_cut_off(self):
        self.assert_renders()
        self.assert_exports()
        whole = digest(self.dest)
        os.rename(self.dest, self.folder / "dest.part")
        shutil.rmtree(self.folder / "dest.part/labels")
        self.write("dest.part/images/train/half.png", "of an earlier run")
        self.assert_exports()
        self.assertEqual(digest(self.dest), whole)

    def test_hostile_datasets(self):
        """Each is refused with its place, and nothing is left."""
        self.assert_renders()
        path = self.out / "labels/coco_fan.json"
        sound = path.read_text()
        for old, new, fragment in (
                ('"file_name":"fls/', '"file_name":"../fls/', "file_name"),
                ('"file_name":"fls/', '"file_name":"sss/', "file_name"),
                ('"width":64', '"width":65', "size"),
                ('"width":64', '"width":9999999999', "width"),
                ('"bbox":[', '"bbox":[1', "bbox"),
                ('"counts":"', '"counts":"~', "counts"),
                ('"counts":"', '"counts":"oooooooooo', "counts"),
                ('"iscrowd":0', '"iscrowd":2', "iscrowd"),
                ('"bearing_deg":', '"bearing_deg":"x","b":', "bearing_deg"),
                ('"shadow_bbox":[', '"shadow_bbox":[999999', "shadow_bbox"),
                ('"category_id":1', '"category_id":77', "category_id"),
                ('{"id":2,"file_name"', '{"id":"x","file_name"', "id"),
                ("]}\n", "", "cut off")):
            with self.subTest(new=new):
                self.assertIn(old, sound)
                path.write_text(sound.replace(old, new, 1))
                self.assert_refused(self.export(), fragment)
                self.assertEqual([p.name for p in self.folder.glob("dest*")], [])
        path.write_text(sound)
        described = (self.out / "dataset.json").read_text()
        reported = json.loads(described)
        picture = next(one for one in reported["sensors"] if one["name"] == "sss")["pictures"][0]
        for along, each in ((None, 0), (None, "x"), ("y", 2)):
            picture.pop("pings_along", None)
            picture.update({"pings_per_pixel": each, **({"pings_along": along} if along else {})})
            self.write("out/dataset.json", json.dumps(reported))
            self.assert_refused(self.export(), "out/")
        self.write("out/dataset.json", described)
        fan = self.out / "fls/fan/000000.png"
        data = fan.read_bytes()
        fan.write_bytes(data[:-20])
        self.assert_refused(self.export(), "fls/fan/000000.png")
        fan.unlink()
        self.write("secret.png", "").write_bytes(data)
        fan.symlink_to(self.folder / "secret.png")
        self.assert_refused(self.export(), "fls/fan/000000.png")
        self.assertEqual([p.name for p in self.folder.glob("dest*")], [])

    def test_links_within_a_dataset(self):
        """They could bring files of this machine into the export, and are a fault of the dataset."""
        self.edit("mission.yaml", "labels: [coco]", "labels: [coco]" + SPLIT)
        self.assert_renders()
        for folder, name in (("fls/fan", "fls/fan/000000.png"), ("labels", "labels/coco_fan.json"),
                             ("split", "split/train.txt")):
            with self.subTest(folder=folder):
                (self.out / folder).rename(self.folder / "elsewhere")
                (self.out / folder).symlink_to(self.folder / "elsewhere")
                self.assert_refused(self.export(), "out/" + name, "behind a link")
                verdict = self.run_sonarsim("verify", "out")
                self.assertEqual(verdict.returncode, 1, verdict.stderr)
                self.assertIn(name + ": lies behind a symbolic link", verdict.stderr)
                (self.out / folder).unlink()
                (self.folder / "elsewhere").rename(self.out / folder)
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_files_of_another_kind(self):
        self.assert_renders()
        fans, records = self.out / "labels/coco_fan.json", self.out / "labels/coco_records.json"
        sound = fans.read_text()
        self.write("out/fls/x.tar", "")
        fans.write_text(sound.replace("fls/fan/000000.png", "fls/x.tar/a.png", 1))
        self.assert_refused(self.export(), "coco_fan.json", "a file in a pack")
        fans.unlink()
        os.mkfifo(fans)
        self.assert_refused(self.export(), "labels/coco_fan.json")
        fans.unlink()
        fans.write_text(sound)
        # A second image of a side-scan.
        text = records.read_text()
        line = next(one for one in text.splitlines() if '"sensor":"sss"' in one)
        records.write_text(text.replace(line, line.rstrip(",") + ",\n" +
                                        line.replace('"id":', '"id":99', 1)))
        self.assert_refused(self.export("--sensor", "sss"), "coco_records.json", "a sensor with one image")
        records.write_text(text)

    def test_a_picture_of_another_size_is_not_unpacked(self):
        self.assert_renders()
        fan = self.out / "fls/fan/000000.png"
        whole = fan.read_bytes()
        # It says 200 rows, and has one.
        fan.write_bytes(png_file(7, 200, b"\0" * 8))
        self.assert_refused(self.export(), "out/fls/fan/000000.png: has not the size")
        fan.write_bytes(whole)


if __name__ == "__main__":
    unittest.main()
