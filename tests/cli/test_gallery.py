"""sonarsim gallery: the page beside a dataset, looked at by a headless Chromium."""
import json
import os
import re
import sys
import unittest

import browser
from sandbox import Sandbox, digest

SENSORS = """\
sensors:
  fls: {kind: imaging, azimuth_deg: 60, range_max_m: 6, range_bins: 48, azimuth_bins: 32}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 48, every: 2}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 48}
  head: {kind: scanning, range_max_m: 6, range_bins: 48, step_deg: 120}
classes: [{nodes: walls, class: wall}]
output: {folder: out, fan_width_px: 64, image: true, labels: [coco]}
labels: {background: [none], min_pixels: 1}
"""
OBJECT = "walls (wall)"  # what the page calls the only one


def json_in(page, element):
    text = re.search(rf'<script type="application/json" id="{element}">(.*?)</script>', page, re.DOTALL)
    return json.loads(text.group(1))


def dataset_in(page, number=0):
    """What the page knows of a dataset."""
    return json_in(page, f"dataset-{number}")


class Gallery(Sandbox):
    def setUp(self):
        super().setUp()
        text = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", text[:text.index("sensors:")] + SENSORS)

    def gallery(self):
        done = self.run_sonarsim("gallery", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.out / "index.html").read_text()

    def test_the_page_is_no_part_of_the_dataset(self):
        self.assert_renders()
        before = digest(self.out)
        page = self.gallery()
        self.assertEqual(self.gallery(), page)  # it replaces its own
        self.assertEqual(digest(self.out, without=("index.html",)), before)
        self.assertNotRegex(page, r"https?://")
        verified = self.run_sonarsim("verify", "out")
        self.assertEqual(verified.returncode, 0, verified.stderr)
        self.assertNotIn("index.html", verified.stderr)
        # What the page knows is what the dataset says.
        shown = dataset_in(page)
        self.assertEqual([s["name"] for s in shown["sensors"]], ["fls", "sss", "sounder", "head"])
        yaw = 0
        for k, difference in enumerate(shown["track"]["yaw"]):
            yaw += difference
            self.assertEqual(yaw, 300 * k)  # 3 degrees from pose to pose, in hundredths
        fls = shown["sensors"][0]
        for view in fls["views"]:
            self.assertTrue((self.out / (view["file"] % 5)).is_file(), view)
        for index, table in (("fan", "fan"), ("image", "polar")):
            boxes = next(v for v in fls["views"] if v["title"] == table)["boxes"]
            coco = "coco.json" if index == "image" else "coco_fan.json"
            reported = json.loads((self.out / "labels" / coco).read_text())
            names = {image["id"]: image["file_name"] for image in reported["images"]}
            for annotation in reported["annotations"]:
                ping = int(names[annotation["image_id"]][-10:-4])
                self.assertIn([annotation["bbox"], annotation["segmentation"]["counts"]],
                              [[box[1:5], box[5]["mask"]] for box in boxes[ping]])
        # A waterfall and an echogram are shown with axes and margins: boxes move with the pings.
        records = json.loads((self.out / "labels/coco_records.json").read_text())
        for sensor, image in zip(shown["sensors"][1:3], records["images"], strict=True):
            view, = sensor["views"]
            reported = [a["bbox"] for a in records["annotations"] if a["image_id"] == image["id"]]
            (left, top), (x_step, y_step) = view["origin"], view["step"]
            self.assertEqual([[(x - left) / x_step, (y - top) / y_step, w / x_step, h / y_step]
                              for _, x, y, w, h, _ in view["boxes"]], reported, sensor["name"])
        # The boxes of a scanning sonar are those of each sweep.
        scans = json.loads((self.out / "labels/coco_scans.json").read_text())
        view, = shown["sensors"][3]["views"]
        self.assertEqual(
            [[box[1:5] for box in boxes] for boxes in view["boxes"]],
            [[a["bbox"] for a in scans["annotations"] if a["image_id"] == image["id"]]
             for image in scans["images"]])
        self.assertEqual(len(view["boxes"]), 2)  # six pings, three to a turn
        # One object has one name, in pings, waterfalls, scans and the plan.
        (walls, wall), about = shown["labels"], json_in(page, "page")
        self.assertEqual((shown["objects"], about["classes"]), (1, ["wall"]))
        self.assertEqual((walls["name"], walls["class"], wall["name"], wall["class"]),
                         ("walls", 0, "wall", 0))
        self.assertEqual(about["datasets"], [{"folder": "", "facts": {}}])
        # A resume leaves the page alone, a new dataset takes it away.
        self.assert_renders()
        self.assertTrue((self.out / "index.html").exists())
        self.assert_renders("--overwrite", "--seed", 8)
        self.assertFalse((self.out / "index.html").exists())

    def test_what_the_page_cannot_show_is_told(self):
        self.assert_renders("--set", "output.pack=tar", "--set", "output.labels=false")
        notes = [s["note"] for s in dataset_in(self.gallery())["sensors"]]
        self.assertIn("The pictures were copied out of them", notes[0])
        self.assert_renders("--overwrite", "--set", "output.fan=false", "--set", "output.image=false",
                            "--set", "output.labels=false")
        notes = [s["note"] for s in dataset_in(self.gallery())["sensors"]]
        self.assertIn("output.fan or output.image", notes[0])
        self.assertEqual(notes[1:], ["", "", ""])

    def test_an_older_dataset_lists_no_pictures(self):
        self.assert_renders("--set", "output.labels=false")
        description = json.loads((self.out / "dataset.json").read_text())
        for sensor in description["sensors"]:
            del sensor["pictures"]
        self.write("out/dataset.json", json.dumps(description))
        self.assert_refused(self.run_sonarsim("gallery", "out"), "dataset.json",
                            "lists no pictures of sensor 'fls'", "render the dataset again")

    def test_the_pictures_are_those_that_the_dataset_lists(self):
        """No name of a file decides on a picture: another title and another file are shown as well."""
        self.assert_renders()
        description = json.loads((self.out / "dataset.json").read_text())
        for sensor in description["sensors"]:
            for picture in sensor["pictures"]:
                picture["title"] = "A " + picture["title"]
                picture["file"] = picture["file"].replace("_view.png", "_other.png")
        self.write("out/dataset.json", json.dumps(description))
        views = {s["name"]: s["views"] for s in dataset_in(self.gallery())["sensors"]}
        self.assertEqual([view["title"] for view in views["fls"]], ["A fan", "A polar"])
        view, = views["sss"]
        self.assertEqual((view["title"], view["file"]), ("A waterfall", "sss/waterfall_other.png"))
        self.assertTrue(view["boxes"])
        # Ten pings in a row of pixels: the n-th ping lies n tenths of a row from the first.
        description["sensors"][1]["pictures"][0]["pings_per_pixel"] = 10
        self.write("out/dataset.json", json.dumps(description))
        folded, = dataset_in(self.gallery())["sensors"][1]["views"]
        self.assertEqual(folded["step"], [1, 0.1])
        self.assertEqual(folded["boxes"], view["boxes"])

    def test_the_seed_is_a_text(self):
        """JavaScript rounds whole numbers from 2^53 on."""
        self.assert_renders("--seed", "9007199254740993", "--set", "output.labels=false")
        self.assertEqual(dataset_in(self.gallery())["seed"], "9007199254740993")

    def test_folders_that_are_no_dataset(self):
        (self.folder / "empty").mkdir()
        self.assert_refused(self.run_sonarsim("gallery", "empty"), "is no dataset")
        self.assert_renders("--set", "output.labels=false")
        self.write("out/index.html", "<p>mine</p>")
        self.assert_refused(self.run_sonarsim("gallery", "out"), "is not of sonarsim's making")
        self.assertEqual((self.out / "index.html").read_text(), "<p>mine</p>")
        self.assertIn("index.html: is no file of the dataset",
                      self.run_sonarsim("verify", "out").stderr)

    @unittest.skipUnless(browser.available(), "Debian's chromium and chromium-driver are not here")
    def test_in_a_browser(self):
        self.assert_renders()
        self.gallery()
        seen = "return document.getElementById('seen').textContent"
        number = "return Number(document.getElementById('number').value)"
        ready = "return image_of(url_of(view(), state.ping)).naturalWidth"
        with browser.Browser() as window:
            window.open(self.out / "index.html")
            self.assertEqual(window.wait_for(ready), 64)
            self.assertEqual(window.run(seen), f"1 box: {OBJECT}")
            # Boxes are drawn: without them the picture looks different.
            boxed = window.screenshot("#picture")
            window.press("b")
            self.assertEqual(window.run(seen), "")
            self.assertNotEqual(window.screenshot("#picture"), boxed)
            window.press("b")
            self.assertEqual(window.screenshot("#picture"), boxed)
            # Arrows change the ping, and the picture with it.
            window.press("right", "right")
            self.assertEqual(window.run(number), 2)
            window.wait_for(ready)
            self.assertIn("fls/fan/000002.png", window.run("return url_of(view(), state.ping)"))
            self.assertNotEqual(window.screenshot("#picture"), boxed)
            window.press("left")
            self.assertEqual(window.run(number), 1)
            window.press("end", "right")
            self.assertEqual(window.run(number), 5)
            # The polar picture is shown as the fan is: turned by half a turn.
            window.press("v")
            self.assertEqual(window.wait_for(ready), 32)
            self.assertTrue(window.run("return view().turned"))
            # Of a sensor that pings at every other pose the ping nearest to this one.
            for name, where in (("sss", 4), ("sounder", 4), ("head", 4)):
                window.press("down")
                window.wait_for(ready)
                self.assertEqual(window.run("return sensor().name"), name)
                self.assertEqual(window.run(number), where)
                # The side-scan sonar has a box a side.
                boxes = f"2 boxes: {OBJECT}, {OBJECT}" if name == "sss" else f"1 box: {OBJECT}"
                self.assertEqual(window.run(seen), boxes)
                boxed = window.screenshot("#picture")
                window.press("b")
                self.assertNotEqual(window.screenshot("#picture"), boxed)
                window.press("b")
            # Zooming in and all of it again.
            wheel = ("document.getElementById('picture').dispatchEvent(new WheelEvent('wheel',"
                     "{deltaY: -800, clientX: 300, clientY: 300})); return picture.zoom")
            self.assertGreater(window.run(wheel), 2)
            self.assertEqual(window.run("document.getElementById('picture').dispatchEvent("
                                        "new MouseEvent('dblclick')); return picture.zoom"), 1)
            self.assertEqual(window.complaints(), [])

    @unittest.skipUnless(browser.available(), "Debian's chromium and chromium-driver are not here")
    def test_nothing_foreign_runs_in_the_page(self):
        """The reader lets no such link into the page; where one gets in, the policy stops it."""
        self.assert_renders("--set", "output.labels=false")
        page = self.gallery()
        self.assertIn("default-src 'none'", page)
        click = ("const link = document.createElement('a'); link.href = \"javascript:document.title='hit'\";"
                 "document.body.append(link); link.click();")
        inline = ("const script = document.createElement('script');"
                  "script.textContent = \"document.title='hit'\"; document.body.append(script);")
        with browser.Browser() as window:
            window.open(self.out / "index.html")
            window.wait_for("return image_of(url_of(view(), state.ping)).naturalWidth")
            self.assertEqual(window.complaints(), [])
            for attack in (click, inline):
                window.run(attack)
                self.assertIn("Content Security Policy", window.wait_for_complaint())
            self.assertEqual(window.run("return document.title"), "box - sonarsim")
            window.run("new Image().src = 'http://127.0.0.1:9/x.png';")
            self.assertIn("Content Security Policy", window.wait_for_complaint())


if __name__ == "__main__":
    if os.environ.get("SANITIZED") == "1":
        print("the page is the same in a sanitized build")
        sys.exit(77)
    unittest.main()
