"""`sonarsim export`: what it writes, read back by readers of its own, from a dataset that is made here."""
import io
import json
import subprocess
import tarfile

import numpy as np
import tool
from PIL import Image
from sonarsim.data import open_dataset
from sonarsim.export import formats, runs
from sonarsim.export.split import poses_parts
from sonarsim.export.stand_out import Greys
from tool import counts_of, disc, edited, mask_of, sensor, write_description

WIDTH, HEIGHT, PINGS = 40, 30, 10
ROWS, COLUMNS = 60, 24
CLASSES = ["bottom", "mine", "tyre"]
BRIGHTER = 100      # greys of objects in fans above their surroundings


def box_of(mask):
    rows, columns = np.nonzero(mask)
    left, top = int(columns.min()), int(rows.min())
    return [left, top, int(columns.max()) + 1 - left, int(rows.max()) + 1 - top]


def rectangle(shape, top, bottom, left, right):
    mask = np.zeros(shape, bool)
    mask[top:bottom, left:right] = True
    return mask


def difference(grey, mask, is_strip=False):
    """By how many greys a mask stands out of a picture."""
    pixels, (left, top, width, height) = np.flatnonzero(mask.T), box_of(mask)
    greys = Greys(grey.clip(0, 255).astype(np.uint8), [pixels], [], is_strip)
    return greys.difference(pixels, (left, left + width, top, top + height), None)


def fan_objects(ping):
    """(id, class, mask, visible share, contrast) of the objects of a fan; the mine moves."""
    return [(1, "bottom", np.ones((HEIGHT, WIDTH), bool), None, None), (2, "mine", disc(WIDTH, HEIGHT, 6 + ping, 10, 4), 0.8, 6.0),
            (3, "tyre", disc(WIDTH, HEIGHT, 30, 22, 3), 0.05 if ping == 4 else 0.5, -4.0)]


STRIP = [(2, "mine", disc(COLUMNS, ROWS, 5, 11, 3)), (3, "tyre", disc(COLUMNS, ROWS, 17, 40, 4))]
SHADOW = {"x": [10, 20], "y": [8, 12]}      # of the mine in every fan


def write_dataset(folder, mission="made"):
    for name in ("fls/fan", "fls/objects", "sss"):
        (folder / name).mkdir(parents=True)
    noise = np.random.default_rng(1)
    for ping in range(PINGS):
        fan = noise.integers(1, 120, (HEIGHT, WIDTH), np.uint8)
        for *_, mask, _, _ in fan_objects(ping)[1:]:
            fan[mask] += BRIGHTER
        Image.fromarray(fan).save(folder / f"fls/fan/{ping:06}.png")
        listed = []
        for number, name, mask, share, contrast in fan_objects(ping):
            fan = {"mask": counts_of(mask)} | ({"shadow_box_px": SHADOW} if number == 2 else {})
            listed.append({"id": number, "name": f"{name}_1", "class": name, "range_m": 5.0, "azimuth_rad": 0.5,
                           "visible_share": share, "contrast_db": contrast, "fan": fan, "clipped": False})
        (folder / f"fls/objects/{ping:06}.json").write_text(json.dumps({"ping": ping, "objects": listed}))
    waterfall = noise.integers(100, 16000, (ROWS, COLUMNS), np.uint16)
    for *_, mask in STRIP:
        waterfall[mask] += 40000
    Image.fromarray(waterfall).save(folder / "sss/waterfall.png")
    listed = [{"id": number, "class": name, "side": side, "mask": counts_of(mask), "range_m": 3.0, "bearing_deg": 90.0,
               "contrast_db": 5.0, "visible_share": 1.0} for (number, name, mask), side in zip(STRIP, ("port", "starboard"))]
    (folder / "sss/objects.json").write_text(json.dumps({"width": COLUMNS, "height": ROWS, "objects": listed}))
    sensors = [sensor("fls", "imaging", PINGS, range_edges_m=[1.0, 2.0], azimuth_edges_rad=[-0.5, 0.5],
               fan={"width_px": WIDTH, "height_px": HEIGHT}, files={"fan": "fls/fan/%06d.png", "objects": "fls/objects/%06d.json"}),
        sensor("sss", "sidescan", ROWS, range_edges_m=[1.0, 2.0], pictures=[
            {"per": "sensor", "boxes_of": "sss/waterfall.png", "file": "sss/waterfall.png"}])]
    write_description(folder, ROWS, sensors, mission=mission, seed=5, labels={
        "classes": [{"id": k + 1, "name": name} for k, name in enumerate(CLASSES)], "instances": [],
        "annotations": {"background": ["bottom"]}})


class Export(tool.ToolTest):
    def setUp(self):
        super().setUp()
        write_dataset(self.out)

    def export(self, kind, *words, sources=()):
        """Exports in a format into `dest`, a new folder, which is returned; what is said of it is `printed`."""
        self.dest = self.folder / f"dest{len(list(self.folder.iterdir()))}"
        self.printed = self.succeeds("export", *(sources or [self.out]), "--format", kind, *words, self.dest)
        return self.dest

    def refused(self, text, *words):
        self.assert_refused("export", text, self.out, *words, self.folder / "none")

    def coco(self, part="train", dest=None):
        file = json.loads(((dest or self.dest) / f"annotations/instances_{part}.json").read_text())
        names = {one["id"]: one["file_name"] for one in file["images"]}
        found = {name: [] for name in names.values()}
        for one in file["annotations"]:
            found[names[one["image_id"]]].append(one)
        return file, found

    def change_mines(self, change):
        """Gives the mine other greys in every fan."""
        for ping in range(PINGS):
            path = self.out / f"fls/fan/{ping:06}.png"
            fan = np.asarray(Image.open(path))
            Image.fromarray(np.where(fan_objects(ping)[1][2], change(fan), fan)).save(path)

    def test_coco(self):
        self.export("coco")
        file, found = self.coco()
        self.assertEqual([one["name"] for one in file["categories"]], ["mine", "tyre"])
        self.assertEqual(len(found), PINGS + 1)
        for ping in range(PINGS):
            name = f"fls-{ping:06}.png"
            self.assertEqual((self.dest / "train" / name).read_bytes(), (self.out / f"fls/fan/{ping:06}.png").read_bytes())
            expected = [one for one in fan_objects(ping) if one[1] != "bottom" and one[3] >= 0.1]
            for one, (number, _, mask, share, contrast) in zip(found[name], expected, strict=True):
                self.assertEqual((one["instance_id"], one["category_id"], one["iscrowd"]), (number, number - 1, 0))
                self.assertEqual((one["bbox"], one["area"]), (box_of(mask), mask.sum()))
                np.testing.assert_array_equal(mask_of(one["segmentation"]["counts"], WIDTH, HEIGHT), mask)
                self.assertEqual((one["visible_share"], one["contrast_db"], one["bearing_deg"], one["clipped"]),
                                 (share, contrast, -28.65, False))
                self.assertEqual(one["shadow_bbox"], [10, 8, 10, 4] if number == 2 else None)
        self.assertEqual([one["side"] for one in found["sss-waterfall.png"]], ["port", "starboard"])
        linear = np.asarray(Image.open(self.out / "sss/waterfall.png")) / 65535
        np.testing.assert_array_equal(np.asarray(Image.open(self.dest / "train/sss-waterfall.png")),
                                      np.floor(255 * np.sqrt(linear) + 0.5))
        ids = [one["id"] for one in file["annotations"]]
        self.assertEqual(len(set(ids)), len(ids))

    def test_rules_and_boxes(self):
        for words, expected in ((("--box", "shadow"), {2: [10, 8, 10, 4]}), (("--min-visible-share", "0.9"), {}),
                                (("--box", "both"), {2: [2, 6, 18, 9], 3: [27, 19, 7, 7]}), (("--min-pixels", "60"), {}),
                                (("--min-contrast-db", "5"), {2: [2, 6, 9, 9]}), (("--without", "mine"), {3: [27, 19, 7, 7]})):
            self.export("coco", "--sensor", "fls", *words)
            found = self.coco()[1]["fls-000000.png"]
            self.assertEqual({one["instance_id"]: one["bbox"] for one in found}, expected, words)
        self.export("coco", "--faint", "crowd", "--min-pixels", "40")
        self.assertEqual([one["iscrowd"] for one in self.coco()[1]["fls-000000.png"]], [0, 1])

    def test_a_slope_of_the_grey_hides_nothing(self):
        """On a ramp of 160 greys and noise of 6, a patch 30 brighter is visible, one 3 brighter is not, at any slope."""
        noise = 110 + np.random.default_rng(3).normal(0, 6, (120, 120))
        ramp, mask = np.linspace(-80, 80, 120), rectangle((120, 120), 40, 80, 40, 80)
        for slope in (np.zeros((120, 120)), ramp[:, None] + 0 * ramp, ramp + 0 * ramp[:, None], 0.5 * np.add.outer(ramp, -ramp)):
            for brighter, is_seen in ((30, True), (3, False)):
                found = difference((noise + slope + brighter * mask).clip(1), mask)
                self.assertEqual(found >= 12, is_seen, (brighter, found))

    def test_water_hides_what_is_as_black(self):
        """Beside the bed's edge, straight or askew, a mask that is water is no dark thing, and none at the end of a slope. A
        bright one is visible, as is one that is as black on the bed."""
        rows, columns = np.mgrid[:80, :120]
        noise = np.random.default_rng(4).normal(0, 3, (80, 120))
        for tilt, water in ((0, 0), (0, 3), (0.6, 0), (-0.6, 2)):
            inland = columns - 60 - tilt * (rows - 40)
            for bed in (30 + 0 * inland, 8 + inland.clip(0, 30)):
                grey = np.where(inland < 0, water * (1 + 0.1 * noise), bed + noise).round().clip(0)
                for x, brighter, is_seen in ((53, 0, False), (53, 40, True), (75, 0, True)):
                    mask = disc(120, 80, x, 40, 5)
                    found = difference(np.where(mask, brighter + grey[40, 5], grey), mask, True)
                    self.assertEqual(found >= 12, is_seen, (tilt, water, bed.max(), x, brighter, found))

    def test_a_thin_bright_shape_beside_water(self):
        """Water in much of the surroundings is no grain: a bar 60 brighter than the bed is visible, the bed is not."""
        bed, mask = np.random.default_rng(5).normal(100, 20, (90, 90)).clip(1, 255), rectangle((90, 90), 43, 49, 20, 70)
        bed[50:] = 10
        for brighter, is_seen in ((60, True), (0, False)):
            self.assertEqual(difference(bed + brighter * mask, mask) >= 12, is_seen)

    def test_few_grains_do_not_stand_out_by_chance(self):
        """Speckle of 5 beams to a grain: a mask of 7 x 8 pixels stands out in 1.7 of 100 pictures, 13 without `chance`."""
        drawn, found = np.random.default_rng(1), 0
        mask = rectangle((64, 64), 28, 35, 26, 34)
        for _ in range(100):
            wide = drawn.normal(size=(2, 64, 68))
            real, imaginary = sum(wide[:, :, k:k + 64] for k in range(5)) / 5 ** 0.5
            found += difference((55 * np.hypot(real, imaginary)).clip(1), mask) >= 12
        self.assertLessEqual(found, 5)

    def test_objects_that_no_eye_sees(self):
        """Objects that add 8 greys to a noise of 34 are faint, dark ones are not; all formats agree on it."""
        self.change_mines(lambda grey: grey - (BRIGHTER - 8))
        faint = {}
        for words, expected in (((), [3]), (("--min-grey", "0"), [2, 3]), (("--min-grey", "200"), [])):
            coco, yolo, masks = (self.export(kind, "--sensor", "fls", *words) for kind in ("coco", "yolo", "masks"))
            faint[words] = json.loads((masks / "statistics.json").read_text())["left_out"]["faint"]
            for ping in range(4):
                found = self.coco(dest=coco)[1][f"fls-{ping:06}.png"]
                self.assertEqual([one["instance_id"] for one in found], expected, words)
                lines = (yolo / f"labels/train/fls-{ping:06}.txt").read_text().splitlines()
                self.assertEqual([int(line.split()[0]) + 2 for line in lines], expected)
                for line, one in zip(lines, found):
                    x, y, width, height = np.array(line.split()[1:], float) * (WIDTH, HEIGHT, WIDTH, HEIGHT)
                    np.testing.assert_allclose(one["bbox"], (x - width / 2, y - height / 2, width, height), atol=0.01)
                marks = np.asarray(Image.open(masks / f"ann_dir/train/fls-{ping:06}.png"))
                for one in found:
                    mask = mask_of(one["segmentation"]["counts"], WIDTH, HEIGHT)
                    np.testing.assert_array_equal(marks == one["category_id"], mask)
                self.assertEqual(set(np.unique(marks)), {0} | {number - 1 for number in expected})
        self.change_mines(lambda grey: grey // 20)
        self.export("coco", "--sensor", "fls")
        self.assertEqual([one["instance_id"] for one in self.coco()[1]["fls-000001.png"]], [2, 3])
        self.assertLess(faint["--min-grey", "0"], faint[()])
        self.assertLess(faint[()], faint["--min-grey", "200"])

    def test_parts_of_masks(self):
        """Each has one outline, and they hold all pixels."""
        drawn = np.random.default_rng(2)
        for share in (0.2, 0.5, 0.6, 0.8) * 20:
            height, width = drawn.integers(2, 25, 2)
            pixels = np.append(np.flatnonzero(drawn.random(height * width) < share), height * width)
            parts = runs.parts(pixels, height)
            self.assertEqual([len(runs.outlines(part, height)) for part in parts], [1] * len(parts))
            self.assertEqual(len(runs.outlines(pixels, height)), len(parts))
            np.testing.assert_array_equal(np.sort(np.concatenate(parts)), pixels)

    def test_parts_that_no_eye_sees(self):
        """A part of a mask that shows the bed alone is left out of it."""
        disc, noise = fan_objects(1)[1][2], rectangle((HEIGHT, WIDTH), 20, 27, 4, 11)
        with edited(self.out / "fls/objects/000001.json") as listed:
            listed["objects"][1]["fan"]["mask"] = counts_of(disc | noise)
        for words, expected in (((), disc), (("--min-grey", "0"), disc | noise)):
            self.export("coco", "--sensor", "fls", *words)
            found = self.coco()[1]["fls-000001.png"][0]
            mask = mask_of(found["segmentation"]["counts"], WIDTH, HEIGHT)
            np.testing.assert_array_equal(mask, expected)
            self.assertEqual((found["area"], found["bbox"]), (expected.sum(), box_of(expected)))

    def test_crops(self):
        """Around each object and of the bed, at a scale in metres; 1:1 a crop has the pixels of the picture."""
        half = np.arcsin(20 / 30)       # a fan of 40 x 30 m with pixels of 1 m
        with edited(self.out / "dataset.json") as description:
            description["sensors"][0].update(range_edges_m=[1.0, 30.0], azimuth_edges_rad=[-half, half])
            description["sensors"][1]["range_edges_m"] = [0.0, 0.5]     # of a column
        with self.assertRaisesRegex(ValueError, "two of the folders background, a_b, a_b are one"):
            formats.Crops(self.folder, ["a b", "a/b"], {}, None)
        fls, sss = ("crops", "--sensor", "fls", "--crop", "20x16"), ("crops", "--sensor", "sss", "--pixel-m")
        self.export(*fls, "--pixel-m", "0.5", "--negatives", "2")
        found = sorted(str(one.relative_to(self.dest)) for one in self.dest.rglob("*.png"))
        for kind, count in (("mine", PINGS), ("tyre", PINGS - 1), ("background", 2 * PINGS)):
            self.assertEqual(sum(name.startswith(f"train/{kind}/") for name in found), count)
        crop = np.asarray(Image.open(self.dest / "train/tyre/fls-000002-3.png"))
        fan = np.asarray(Image.open(self.out / "fls/fan/000002.png")).astype(float)
        self.assertEqual(crop.shape, (16, 20))
        np.testing.assert_allclose(crop.mean(), fan[18:26, 25:35].mean(), atol=8)
        counts = json.loads((self.dest / "statistics.json").read_text())["all"]
        self.assertEqual((counts["pictures"], counts["without_objects"]), (4 * PINGS - 1, 2 * PINGS))
        for name in found:
            if "background" in name:
                self.assertLess(np.asarray(Image.open(self.dest / name)).max(), 121, name)
        folders = self.export(*fls, "--pixel-m", "0.5", "--negatives", "0").glob("train/*")     # empty ones, too
        self.assertEqual(sorted(one.name for one in folders), ["background", "mine", "tyre"])
        self.refused("needs --pixel-m", "--format", *fls)
        self.refused("'sss' stands still", "--format", *sss, "0.1")
        (self.out / "trajectory.tum").write_text("".join(f"{k} {0.5 * k} 0 0 0 0 0 1\n" for k in range(ROWS)))
        crop = np.asarray(Image.open(next(self.export(*sss, "0.5", "--crop", "17").glob("train/mine/*.png"))))
        linear = np.asarray(Image.open(self.out / "sss/waterfall.png"))[3:20, :14] / 65535     # its middle is (5.5, 11.5)
        np.testing.assert_allclose(crop[:, 3:], np.floor(255 * np.sqrt(linear) + 0.5), atol=1)
        self.assertEqual(crop[:, :3].max(), 0)
        rows = np.asarray(Image.open(next(self.export(*sss, "0.25", "--crop", "32").glob("train/mine/*.png")))).astype(int)
        changes = np.abs(np.diff(rows, axis=0)).max(axis=1) > 0     # pings are two pixels apart
        self.assertLessEqual(changes.sum(), 16)
        left_out = json.loads((self.dest / "statistics.json").read_text())["left_out"]
        self.assertEqual(left_out["beds"] + len(list(self.dest.glob("train/background/*.png"))), 1)
        self.assertFalse((changes[1:] & changes[:-1]).any())

    def test_yolo_polygons(self):
        """The area of an outline by the shoelace formula is that of the mask. Boxes: test_objects_that_no_eye_sees."""
        dest = self.export("yolo", "--sensor", "fls", "--polygons")
        text = (dest / "labels/train/fls-000004.txt").read_text()
        number, *values = text.split()
        self.assertEqual((text.count("\n"), number), (1, "0"))
        x, y = (np.array(values, float).reshape(-1, 2) * (WIDTH, HEIGHT)).T
        self.assertAlmostEqual(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)), fan_objects(4)[1][2].sum(), delta=0.1)
        self.assertEqual((dest / "data.yaml").read_text(), "train: images/train\nval: images/train  # there is no "
                         'such part\nnames:\n  0: "mine"\n  1: "tyre"\n')

    def test_oriented_boxes(self):
        """Of a bar that lies askew: the rectangle holds all pixels, and no direction has a smaller one."""
        rows, columns = np.mgrid[:HEIGHT, :WIDTH]
        turn = np.radians(33)
        along, across = ((columns - 20) * a + (rows - 15) * b for a, b in ((np.cos(turn), np.sin(turn)),
                                                                           (-np.sin(turn), np.cos(turn))))
        mask = (np.abs(along) < 11) & (np.abs(across) < 3)
        path, oriented = self.out / "fls/objects/000002.json", ("yolo", "--sensor", "fls", "--oriented", "--min-grey", "0")
        with edited(path) as listed:
            listed["objects"][1]["fan"] = {"mask": counts_of(mask)}
        self.export(*oriented)
        number, *values = (self.dest / "labels/train/fls-000002.txt").read_text().splitlines()[0].split()
        corners = np.array(values, float).reshape(4, 2) * (WIDTH, HEIGHT)
        sides = np.diff(corners, axis=0, append=corners[:1])
        self.assertEqual(number, "0")
        np.testing.assert_allclose((sides * np.roll(sides, 1, axis=0)).sum(axis=1), 0, atol=0.01)
        area = np.prod(np.linalg.norm(sides[:2], axis=1))
        y, x = np.nonzero(mask)
        pixels = np.array([(x + a, y + b) for a in (0, 1) for b in (0, 1)]).transpose(0, 2, 1).reshape(-1, 2)
        for side, corner in zip(sides, corners):        # all lie on one side of each side
            self.assertGreater((side[0] * (pixels - corner)[:, 1] - side[1] * (pixels - corner)[:, 0]).min(), -0.01)
        angles = np.radians(np.arange(0, 90, 0.1))
        widths = [np.ptp(pixels @ (np.cos(angles + more), np.sin(angles + more)), axis=0) for more in (0, np.pi / 2)]
        self.assertLess(area, np.prod(widths, axis=0).min() + 0.05)
        self.assertLess(area, 0.6 * np.prod(box_of(mask)[2:]))
        self.refused("--format coco takes no --oriented", "--format", "coco", "--oriented")
        with edited(path) as listed:
            listed["objects"][1]["fan"] = {"mask": counts_of(mask & (columns >= 15) | (rows + columns < 3))}    # at the border
        for line in (self.export(*oriented) / "labels/train/fls-000002.txt").read_text().splitlines()[:1]:
            x, y = np.array(line.split()[1:], float).reshape(4, 2).T * ((WIDTH,), (HEIGHT,))
            self.assertEqual((x.min(), x[0], x[1], y[0], y[2]), (0, x[3], x[2], y[1], y[3]))    # upright, in the picture

    def test_hugging_face(self):
        """An imagefolder: a row of metadata.jsonl for each picture, boxes as in COCO, a card with a head in YAML."""
        self.export("coco", "--sensor", "fls")
        found = self.coco()[1]
        self.export("hf", "--split", "train=0.5,test=0.5", "--gap", "0", "--rounds", "6", "--licence", "cc-by-4.0", "--sensor", "fls")
        head, text = (self.dest / "README.md").read_text().removeprefix("---\n").split("\n---\n")
        self.assertRegex(head, "^license: cc-by-4.0\n")
        self.assertIn("data_dir: data", head)
        for words in ("# made", "seed 5", "sonarsim 0 rendered", '0 "mine", 1 "tyre"'):
            self.assertIn(words, text)
        for part, pings in (("train", range(5)), ("test", range(5, PINGS))):
            folder = self.dest / "data" / part
            rows = [json.loads(line) for line in (folder / "metadata.jsonl").read_text().splitlines()]
            self.assertEqual([(row["image_id"], row["file_name"]) for row in rows],
                             [(k, f"fls-{ping:06}.png") for k, ping in enumerate(pings)])
            for row in rows:
                with Image.open(folder / row["file_name"]) as picture:
                    self.assertEqual(picture.size, (row["width"], row["height"]))
                self.assertEqual(list(zip(row["objects"]["bbox"], row["objects"]["category"])),
                                 [(one["bbox"], one["category_id"] - 1) for one in found[row["file_name"]]])
        subprocess.run(["sha256sum", "-c", "--quiet", "SHA256SUMS"], cwd=self.dest, check=True)

    def test_raw_values_as_fans(self):
        """A fan of raw/ has at each pixel the bin that the fan of its bins' numbers names."""
        raw_fans = "yolo", "--image", "raw", "--sensor", "fls"
        self.refused("has no raw; leave out --image", "--format", *raw_fans)
        bins = np.arange(120 * 60).reshape(120, 60)
        edges = {"range_edges_m": np.linspace(1, 13, 121).tolist(), "azimuth_edges_rad": np.linspace(-0.6, 0.6, 61).tolist()}
        width, height = 2 * 13 * np.sin(0.6), 13
        with edited(self.out / "dataset.json") as description:
            own = description["sensors"][0]
            own.update(edges, fan={"width_px": 80, "height_px": int(np.ceil(height * 80 / width))})
            own["files"]["raw"] = "fls/raw/%06d.png"
        (self.out / "fls/raw").mkdir()
        of_bins = open_dataset(self.out)["fls"].to_fan(bins, 80, -1)
        for ping in range(PINGS):
            (self.out / f"fls/objects/{ping:06}.json").write_text(json.dumps({"objects": []}))
        for bits in (4, 8, 12, 16):     # white is the largest value of these bits, as in fan/
            largest = 2 ** bits - 1
            (self.out / "mission.resolved.yaml").write_text(f"sensors: {{fls: {{instrument: {{receiver: {{bits: {bits}}}}}}}}}\n")
            for ping in range(PINGS):
                raw = (bins * 9 % (largest + 1)).astype(np.uint8 if bits <= 8 else np.uint16)
                Image.fromarray(raw).save(self.out / f"fls/raw/{ping:06}.png")
            found = np.asarray(Image.open(next(self.export(*raw_fans).rglob("fls-000002.png"))))
            np.testing.assert_array_equal(found, np.where(of_bins < 0, 0, np.floor(255 * (of_bins * 9 % (largest + 1)) / largest + 0.5)))
        self.assertLess((found == 0).mean(), 0.5)
        with edited(self.out / "dataset.json") as description:
            del description["sensors"][0]["fan"], description["sensors"][0]["files"]["fan"]
        self.refused("has no fans; set output.fan: true .* or take the pictures of its bins with --bins", "--format", *raw_fans)

    def test_masks_and_webdataset(self):
        self.export("masks", "--sensor", "fls")
        self.assertEqual(json.loads((self.dest / "meta.json").read_text())["palette"], [[0, 0, 0], [128, 0, 0], [0, 128, 0]])
        self.assertEqual((self.dest / "splits/train.txt").read_text().split()[:2], ["fls-000000", "fls-000001"])
        with tarfile.open(self.export("webdataset", "--link") / "train-000000.tar") as archive:
            members = {one.name: archive.extractfile(one).read() for one in archive}
        self.assertEqual(len(members), 2 * (PINGS + 1))
        self.assertEqual(Image.open(io.BytesIO(members["fls-000003.png"])).size, (WIDTH, HEIGHT))
        objects = json.loads(members["fls-000003.json"])["objects"]
        self.assertEqual((objects["categories"], objects["bbox"][0]), ([0, 1], box_of(fan_objects(3)[1][2])))
        np.testing.assert_array_equal(mask_of(objects["mask"][1], WIDTH, HEIGHT), fan_objects(3)[2][2])

    def test_tiles(self):
        self.export("coco", "--sensor", "sss", "--tile", "24x16", "--min-pixels", "1")
        self.assertIn("left out: 0 pictures", self.printed)
        found = self.coco()[1]
        self.assertEqual(sorted(found), [f"sss-waterfall-y{top:05}-x00000.png" for top in (0, 16, 32, 44)])
        for top in (0, 16, 32, 44):
            pieces = {number: mask[top:top + 16] for number, _, mask in STRIP if mask[top:top + 16].sum() >= max(1, 0.2 * mask.sum())}
            shown = found[f"sss-waterfall-y{top:05}-x00000.png"]
            self.assertEqual([one["instance_id"] for one in shown], list(pieces))
            for one in shown:
                piece = pieces[one["instance_id"]]
                self.assertEqual((one["bbox"], one["area"]), (box_of(piece), piece.sum()))
                np.testing.assert_array_equal(mask_of(one["segmentation"]["counts"], 24, 16), piece)

    def test_split(self):
        split = ("--split", "train=0.5,test=0.5")
        self.export("coco", *split, "--gap", "4", "--rounds", "6", "--tile", "16x16")
        # Six stretches of ten poses; four poses around each border are in no part.
        self.assertEqual(list(self.coco("train")[1]), [f"fls-{ping:06}.png" for ping in range(3)])
        self.assertEqual(list(self.coco("test")[1]), [f"fls-{ping:06}.png" for ping in (7,)])
        # A border of twenty poses takes two, not ten.
        parts = poses_parts({"train": 0.8, "val": 0.2}, 20, None, 1)
        self.assertEqual([parts.count(part) for part in ("train", None, "val")], [15, 2, 3])
        dest = self.export("yolo", *split, "--gap", "0", "--sensor", "sss", "--tile", "24x30")
        self.assertEqual(len(list(dest.glob("images/*/*.png"))), 2)

    def test_a_strip_that_no_part_holds(self):
        split = ("--format", "yolo", "--sensor", "sss", "--split", "train=0.5,test=0.5")
        self.refused("left for 'train': .* is 24 x 60 pixels; cut it with --tile 24x16", *split)
        self.refused("cut it with --tile 24x16", *split, "--tile", "512")
        self.refused("shows pings of other parts; take a smaller --gap", *split, "--rounds", "6", "--gap", "0")
        split = (*split[:-1], "train=0.7,val=0.3", "--gap", "0")
        self.refused("left for 'val': .*cut it with --tile 24x16", *split, "--tile", "24x30")     # only of 'train'
        self.assertTrue(list(self.export(*split[1:], "--tile", "24x16").glob("images/val/*.png")))
        self.refused("none of 60 poses is left for 'train'", *split, "--gap", "200")

    def test_variants_and_several_datasets(self):
        names = [f"variant_{k:04}" for k in range(5)]
        for name in names:
            write_dataset(self.folder / "many" / name)
        (self.folder / "many/variants.json").write_text(json.dumps({"variants": [{"folder": name} for name in names]}))
        self.export("coco", "--split", "train=0.8,val=0.2", "--sensor", "fls", sources=(self.folder / "many", self.out))
        train, val = self.coco("train"), self.coco("val")
        self.assertEqual(sum(name.startswith("many-variant_0004-") for name in val[1]), PINGS)
        self.assertEqual(sum(name.startswith("many-") for name in train[1]), 4 * PINGS)
        self.assertEqual(sum(name.startswith("out-fls-") for name in train[1]), PINGS)
        ids = [one["id"] for file, _ in (train, val) for one in file["images"]]
        self.assertEqual(len(set(ids)), len(ids))
        counts = json.loads((self.dest / "statistics.json").read_text())["parts"]["val"]["classes"]
        self.assertEqual([(one["name"], one["objects"], one["annotations"]) for one in counts],
                         [("mine", 1, PINGS), ("tyre", 1, PINGS - 1)])
        self.export("coco", "--split", "train=0.8,val=0.2", "--sensor", "fls",
                    sources=[self.folder / "many" / name for name in names])
        self.assertEqual({name.split("-")[0] for name in self.coco("val")[1]}, {"variant_0004"})

    def test_mistakes(self):
        coco = ("--format", "coco")
        for words, text in (((*coco, "--sensor", "no"), "there is no 'no'; there are: fls, sss"),
                            ((*coco, "--split", "train=0.5"), "the shares sum to 0.5"),
                            ((*coco, "--tile", "64x8"), "'64x8' must be N or WIDTHxHEIGHT, of 16 to 65536"),
                            ((*coco, "--gap", "5"), "--gap and --rounds take --split"),
                            ((*coco, "--overlap", "4"), "--overlap and --least-share take --tile"),
                            ((*coco, "--mesh", "x.glb"), "--format coco takes no --mesh"),
                            (("--format", "masks", "--polygons"), "takes no --polygons"),
                            (("--format", "yolo", "--polygons", "--box", "both"), "the outlines of yolo are the object's"),
                            (("--format", "crops", "--sensor", "fls", "--pixel-m", "50"), "times as large as"),
                            (("--format", "voc"), "argument --format: invalid choice"), ((*coco, self.out), "is given twice")):
            self.refused(text, *words)
        described, facts = self.out / "dataset.json", self.out / "fls/objects/000003.json"
        sound, text = json.loads(described.read_text()), facts.read_text()
        for path, bad, words in ((described, json.dumps(sound | {"labels": {}}), "has no objects; set output.labels"),
                (described, json.dumps(sound | {"poses": "x"}), "'poses' is 'x'"),
                (described, json.dumps(sound | {"sensors": [sound["sensors"][0] | {"fan": 3}]}), "is damaged"),
                *((facts, bad, "000003.json: ") for bad in (
                    "[]", text.replace('"mask": "', '"mask": "0'), text.replace('"fan"', '"f"'), "[" * 100000))):
            with tool.replaced(path, bad):
                self.refused(words, *coco)
        fan = self.out / "fls/fan/000000.png"
        fan.rename(self.folder / "secret.png")
        fan.symlink_to(self.folder / "secret.png")
        self.refused("000000.png: is missing, or lies behind a link", "--format", "yolo")
        (self.folder / "secret.png").replace(fan)
        (self.folder / "none").mkdir()
        (self.folder / "none/mine.txt").write_text("")
        self.refused("holds something", *coco)
