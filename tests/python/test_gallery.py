"""sonarsim.gallery: the page of a dataset, looked at by a headless Chromium."""
import io
import json
import unittest

import browser
import numpy as np
import tool
from gallery_dataset import MASKS, PINGS, SEEN, write_dataset
from PIL import Image

READY = "return data && shown_image().complete && (!sensor().chunks.length || 'objects' in known_of(state.ping))"
# A name that would run, or end its element, if the page took it for more than text.
HOSTILE = "</script><img src=x onerror=\"document.title='hit'\">\u2028'\\"
# Which pixels of the picture a mask covers, by the canvas that lies over it.
COVERED = """
    const [image, canvas] = [shown_image(), $('overlay')];
    const shown = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    const matrix = new DOMMatrix().scale(window.devicePixelRatio).multiply(area.matrix);
    return [...Array(image.naturalHeight).keys()].map(y => [...Array(image.naturalWidth).keys()].map(x => {
      const at = matrix.transformPoint({x: x + 0.5, y: y + 0.5});
      return shown[4 * (Math.floor(at.y) * canvas.width + Math.floor(at.x)) + 3] > 50;
    }));"""
CENTRES = """
    const image = shown_image();
    return [...Array(image.naturalHeight).keys()].map(y => [...Array(image.naturalWidth).keys()].map(x => {
      const at = area.matrix.transformPoint({x: x + 0.5, y: y + 0.5});
      return [at.x, at.y];
    }));"""


class Gallery(tool.ToolTest):
    def write_page(self):
        self.succeeds("gallery", self.out)

    def open(self, window):
        self.write_page()
        window.open(self.out / "index.html")
        window.wait_for(READY)

    def complaints(self, window):
        """Those of the page. Most pictures of the dataset are not there, and the test itself reads the canvas."""
        return [line for line in window.complaints()
                if ".png - Failed to load resource" not in line and "Multiple readback" not in line]

    def pixels(self, window):
        """The colours on the screen of the pixels of the picture, [row, column]."""
        screen = np.asarray(Image.open(io.BytesIO(window.screenshot("#frame"))).convert("RGB")).astype(int)
        at = np.floor(np.array(window.run(CENTRES))).astype(int) + 1  # the frame has a border
        return screen[at[..., 1], at[..., 0]]


@unittest.skipUnless(browser.CHROMIUM and browser.CHROMEDRIVER, "Debian's chromium and chromium-driver are not here")
class InBrowser(Gallery):
    def test_masks_lie_where_the_objects_are(self):
        """In a fan, in bins, in a waterfall below its axis and in a scan."""
        write_dataset(self.out)
        with browser.opened() as window:
            self.open(window)
            window.press("b")  # without boxes
            for name, keys in (("fan", ""), ("bins", "v"), ("sss", "down"), ("head", "down")):
                with self.subTest(picture=name):
                    window.press(*([keys] if keys else []))
                    window.wait_for(READY)
                    margin = 9 if name == "sss" else 0
                    window.press("end")
                    window.wait_for(READY)
                    expected = np.pad(MASKS[name], ((margin, 0), (0, 0)))
                    rows = slice(0, -1 if name == "sss" else None)  # the mark lies on the last one
                    np.testing.assert_array_equal(np.array(window.run(COVERED))[rows], expected[rows])
                    window.press("m")
                    np.testing.assert_array_equal(self.pixels(window)[..., 0] > 150, expected)
                    window.press("m")
                    is_turned = window.run("return area.matrix.a < 0 && area.matrix.d < 0")
                    self.assertEqual(is_turned, name == "bins")
            self.assertEqual(self.complaints(window), [])

    def test_classes_objects_and_colours(self):
        write_dataset(self.out)
        seen = "return $('seen').textContent"
        with browser.opened() as window:
            self.open(window)
            self.assertIn("seed 9007199254740993", window.run("return $('about').textContent"))
            # Background is off at first; a box of the legend switches a class.
            self.assertEqual(window.run(seen), "mine_1 (mine)")
            for k, names in ((1, ""), (1, "mine_1 (mine)")):
                window.run(f"document.querySelectorAll('#legend input')[{k}].click()")
                self.assertEqual(window.run(seen), names)
            # A click selects the object; n and p go through its pings, whose data are loaded when needed.
            window.run("""
                const [left, top, right, bottom] = area.boxes[0];
                const box = $('frame').getBoundingClientRect();
                $('frame').dispatchEvent(new MouseEvent('click', {
                  clientX: box.left + (left + right) / 2 / window.devicePixelRatio,
                  clientY: box.top + (top + bottom) / 2 / window.devicePixelRatio}));""")
            self.assertEqual(window.run("return $('which').textContent"), "mine_1 (mine): sighting 1 of 3")
            self.assertFalse(window.run("return chunks.has('0_0_2')"))
            for key, ping in (("n", SEEN[1]), ("n", SEEN[2]), ("n", SEEN[0]), ("p", SEEN[2])):
                window.press(key)
                self.assertEqual(window.run("return state.ping"), ping)
                window.wait_for("return $('seen').textContent === 'mine_1 (mine)'")
            window.wait_for("return $('facts').textContent.includes('contrast_db8')")
            window.press("right")
            self.assertEqual(window.run("return state.ping"), PINGS - 1)
            window.press("left")
            window.wait_for("return shown_image().complete && $('seen').textContent.includes('not rendered yet')")
            # A colour map changes the picture, and grey stays grey without one.
            window.press("home", "escape", "b", "m")
            window.wait_for(READY)
            self.assertEqual(np.ptp(self.pixels(window), axis=-1).max(), 0)
            window.press("c")  # copper
            np.testing.assert_allclose(self.pixels(window)[MASKS["fan"]].mean(0), [255, 199, 128], atol=3)
            self.assertEqual(self.complaints(window), [])

    def test_hostile_names_are_text_and_nothing_foreign_runs(self):
        description = write_dataset(self.out / "one")
        description["labels"]["instances"][1]["name"] = description["labels"]["classes"][1]["name"] = HOSTILE
        description["labels"]["instances"][0]["name"] = "__proto__"
        description["sensors"][0]["kind"] = HOSTILE
        description["seed"] = HOSTILE
        (self.out / "one/dataset.json").write_text(json.dumps(description))
        (self.out / "variants.json").write_text(json.dumps({"variants": [
            {"folder": "one", "drawn": {HOSTILE: HOSTILE, "__proto__": 1}}, {"folder": "two"}]}))
        with browser.opened() as window:
            self.open(window)
            window.run("select(1)")
            for element in ("legend", "objects", "which", "facts", "about"):
                self.assertIn(HOSTILE, window.run(f"return $('{element}').textContent"), element)
            self.assertEqual(window.run("return document.querySelectorAll('img').length"), 1)  # the picture
            self.assertEqual(window.complaints(), [])
            for attack in ("document.body.append(element('script', \"document.title='hit'\"))",
                           "new Image().src = 'http://127.0.0.1:9/x.png';"):
                window.run(attack)
                self.assertIn("Content Security Policy", "\n".join(browser.until(window.complaints, "a warning")))
            self.assertEqual(window.run("return document.title"), "out - sonarsim")


class Files(Gallery):
    def refused(self, text):
        self.assert_refused("gallery", text, self.out)

    def test_every_sonar_of_a_rendered_dataset_has_its_objects(self):
        self.render_tank("out", "trajectory.rate_hz=3", "sensors.head.step_deg=40")     # two sweeps
        self.write_page()
        about = json.loads(json.loads((self.out / "index_files/0.js").read_text()[len('take("0",'):-2]))
        self.assertEqual([sensor["name"] for sensor in about["sensors"]], ["sss", "sounder", "head", "fls"])
        for sensor in about["sensors"]:
            with self.subTest(sensor=sensor["name"]):
                files = [*self.out.glob(f"{sensor['name']}/objects*.json"), *self.out.glob(f"{sensor['name']}/objects/*.json")]
                listed = {seen["id"] - 1 for file in files for seen in json.loads(file.read_text())["objects"]}
                of_pictures = [entry[0] for entries in sensor["pictures"].values() for entry in entries]
                self.assertEqual({int(label) for label in [*sensor["seen"], *of_pictures]}, listed)
                self.assertTrue(listed)
                for view in sensor["views"]:
                    # The labelled picture lies within the one that is shown.
                    size = np.multiply(view.get("pixel_px", [1, 1]), (view["width"], view["height"]))
                    with Image.open(self.out / view["file"].replace("%06d", "000000").replace("%04d", "0000")) as picture:
                        self.assertTrue((view.get("origin_px", [0, 0]) + size <= picture.size).all())
        self.assertNotIn("index", self.sonarsim("verify", "out").stderr)

    def test_bad_datasets_are_refused_in_one_sentence(self):
        description = write_dataset(self.out)
        for value in ("../other/%06d.png", "/etc/%06d.png", 7):
            description["sensors"][0]["pictures"][0]["file"] = value
            (self.out / "dataset.json").write_text(json.dumps(description))
            self.refused("dataset.json")
        description["sensors"][0]["pictures"].pop(0)
        (self.out / "dataset.json").write_text(json.dumps(description))
        for text in ('{"objects": [{"id": 9}]}', '{"objects": [{"id": 2, "box_px": {}}]}', "\0", '{"objects": 1e999}'):
            (self.out / "fls/objects/000003.json").write_text(text)
            self.refused("000003.json: is damaged")

    def test_only_its_own_files_are_replaced(self):
        write_dataset(self.out)
        self.write_page()
        index, foreign = self.out / "index.html", self.out / "index_files/mine.txt"
        page = index.read_bytes()
        self.assertEqual(sorted(path.name for path in foreign.parent.iterdir()),
                         ["0.js", "0_0_0.js", "0_0_1.js", "0_0_2.js", "page.css", "page.js"])
        self.write_page()
        self.assertEqual(index.read_bytes(), page)
        foreign.write_text("mine")
        self.refused("index_files: is not of sonarsim's making")
        foreign.unlink()
        index.write_text("<p>mine</p>")
        self.refused("index.html: is not of sonarsim's making")
        self.assertEqual(index.read_text(), "<p>mine</p>")
