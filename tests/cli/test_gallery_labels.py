"""sonarsim gallery over several datasets, and what it does with labels: classes, masks, names, objects."""
import json
import os
import shutil
import sys
import unittest

import browser
from labelled import mask_of
from paged import READY, GalleryCase, dataset_of, json_in
from sandbox import digest

# A name that would run, or end its element, if the page took it for more than text.
HOSTILE = "</script><img src=x onerror=\"document.title='hit'\">"


class GalleryLabels(GalleryCase):
    def test_variants_have_one_page(self):
        self.render_variants()
        before = digest(self.out)
        page = self.gallery()
        self.assertEqual(self.gallery(), page)
        self.assertEqual(digest(self.out, without=("index.html",)), before)
        about = json_in(page, "page")
        drawn = json.loads((self.out / "variants.json").read_text())["variants"]
        self.assertEqual([one["folder"] for one in about["datasets"]],
                         ["variant_0000", "variant_0001", "variant_0002"])
        for k, variant in enumerate(drawn):
            # A seed of 64 bits keeps its digits: as a number JavaScript would round it.
            self.assertEqual(json_in(page, f"dataset-{k}")["seed"], str(variant["seed"]))
            reported = float(about["datasets"][k]["facts"]["water.sound_speed_m_s"])
            self.assertAlmostEqual(reported, variant["drawn"]["water.sound_speed_m_s"], delta=0.05)
        verified = self.run_sonarsim("verify", "out")
        self.assertEqual(verified.returncode, 0, verified.stderr)
        self.assertNotIn("index.html", verified.stderr)
        # A variant that is missing is reported, and the page shows the others.
        shutil.rmtree(self.out / "variant_0001")
        about = json_in(self.gallery(), "page")
        self.assertEqual((about["missing"], len(about["datasets"])), (1, 2))
        self.render_variants("--overwrite")
        self.assertFalse((self.out / "index.html").exists())
        for one in self.out.glob("variant_*"):
            shutil.rmtree(one)
        self.assert_refused(self.run_sonarsim("gallery", "out"), "no variant that is begun")

    def test_collections_have_one_page(self):
        self.assert_renders("--out", "one")
        self.assert_renders("--out", "two", "--seed", 8, "--set", "name=pool", "--set",
                            "output.pack=tar")
        done = self.run_sonarsim("merge", "--different", "one", "two", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = self.gallery()
        self.assertEqual(json_in(page, "page")["datasets"],
                         [{"folder": "labels-2", "facts": {}}, {"folder": "pool", "facts": {}}])
        self.assertEqual(json_in(page, "dataset-1")["seed"], "8")
        verified = self.run_sonarsim("verify", "out")
        self.assertEqual(verified.returncode, 0, verified.stderr)

    def test_what_annotations_say_is_on_the_page(self):
        """Numbers, the side and the box of the shadow, which lies in the picture as boxes do."""
        self.assert_renders()
        for name in ("coco_fan", "coco_records"):
            file = self.out / f"labels/{name}.json"
            lines = file.read_text().split("\n")
            for k, line in enumerate(lines):
                if '"iscrowd"' in line:  # an annotation
                    reported = json.loads(line.rstrip(",")) | {
                        "iscrowd": 1, "range_m": 1.23456789, "side": "port", "contrast_db": None,
                        "shadow_bbox": [1, 2, 3, 4]}
                    lines[k] = json.dumps(reported, separators=(",", ":")) + "," * line.endswith(",")
            file.write_text("\n".join(lines))
        sensors = {sensor["name"]: sensor for sensor in dataset_of(self.gallery())["sensors"]}
        fan = sensors["fls"]["views"][0]["boxes"][0][0][5]
        self.assertEqual((fan["range_m"], fan["side"], fan["iscrowd"]), (1.2346, "port", 1))
        self.assertEqual(fan["shadow_bbox"], [1, 2, 3, 4])
        self.assertNotIn("contrast_db", fan)
        for name in ("sss", "sounder"):
            view, = sensors[name]["views"]
            (left, top), (x, y) = view["origin"], view["pixel"]
            for box in view["boxes"]:
                self.assertEqual(box[5]["shadow_bbox"], [left + x, top + 2 * y, 3 * x, 4 * y])

    def test_damaged_labels_are_refused(self):
        """With the file and its line; a page that was there stays."""
        self.assert_renders()
        page = self.gallery()
        file = self.out / "labels/coco.json"
        sound = file.read_text()
        line = next(text for text in sound.splitlines() if '"counts"' in text)
        number = sound.splitlines().index(line) + 1
        for old, new, fragment in (
                ('"instance_id":', '"instance_id":99', "'instance_id' is"),
                ('"bbox":[', '"bbox":[1,', "four numbers"),
                ('"bbox":[', '"bbox":["x",', "'bbox[0]' is"),
                ('"counts":"', '"counts":"0', "compressed runs of the pixels of the picture"),
                ('"image_id":', '"image_id":99999', "the id of an image above")):
            with self.subTest(new=new):
                file.write_text(sound.replace(line, line.replace(old, new, 1)))
                self.assert_refused(self.run_sonarsim("gallery", "out"), f"coco.json:{number}", fragment)
        file.write_text(sound[:len(sound) // 2])
        self.assert_refused(self.run_sonarsim("gallery", "out"), "coco.json")
        file.unlink()  # the files of single pings have the boxes, too
        (self.out / "labels/coco_fan.json").unlink()
        fans = [dataset_of(text)["sensors"][0]["views"][0]["boxes"] for text in (page, self.gallery())]
        self.assertEqual(*([[[box[:5] + [box[5]["mask"]] for box in boxes or []] for boxes in pings]
                            for pings in fans]))

    def test_boxes_without_masks(self):
        """The label objects alone has none; that of yolo names classes only."""
        self.assert_renders("--set", "output.labels=[objects, coco]", "--out", "masks")
        both = dataset_of(self.gallery("masks"))["sensors"][0]["views"][0]["boxes"]
        self.assert_renders("--set", "output.labels=[objects]")
        boxes = dataset_of(self.gallery())["sensors"][0]["views"][0]["boxes"]
        self.assertEqual([[box[:5] for box in own or []] for own in boxes],
                         [[box[:5] for box in own or []] for own in both])
        self.assertNotIn("mask", boxes[0][0][5])
        self.assert_renders("--overwrite", "--set", "output.labels=[yolo]")
        page = dataset_of(self.gallery())
        first = page["sensors"][0]["views"][0]["boxes"][0][0]
        self.assertGreaterEqual(first[0], page["objects"])
        self.assertEqual(first[5], {})

    @unittest.skipUnless(browser.available(), "Debian's chromium and chromium-driver are not here")
    def test_labels_in_a_browser(self):
        self.render_variants()
        self.gallery()
        with browser.Browser() as window:
            window.open(self.out / "index.html")
            window.wait_for(READY)
            self.check_masks(window)
            self.check_classes(window)
            self.check_objects(window)
            self.check_variants(window)
            self.check_statistics(window)
            self.assertEqual(window.complaints(), [])

    def check_masks(self, window):
        """The strips that the page draws are the pixels of COCO's own definition."""
        reported = json.loads((self.out / "variant_0000/labels/coco_fan.json").read_text())
        image = next(i for i in reported["images"] if (i["sensor"], i["ping"]) == ("fls", 0))
        own = [a for a in reported["annotations"] if a["image_id"] == image["id"]]
        strips = window.run("return shown_boxes().map(box => strips_of(box[5].mask, view().mask_height))")
        self.assertEqual(len(own), len(strips))
        for annotation, found in zip(own, strips, strict=True):
            pixels = {(x, y + k) for x, y, length in found for k in range(length)}
            self.assertEqual(pixels, mask_of(annotation["segmentation"]))
        plain = window.screenshot("#picture")
        window.press("m")
        self.assertNotEqual(window.screenshot("#picture"), plain)
        window.press("m")
        self.assertEqual(window.screenshot("#picture"), plain)

    def check_classes(self, window):
        """A class that is switched off is in no picture, no plan and no list."""
        seen = "return document.getElementById('seen').textContent"
        rows = "return document.querySelectorAll('#objects button').length"
        legend = window.run("return document.getElementById('legend').textContent")
        self.assertIn("pillar 2", legend)
        boxes, names = window.run(seen), window.run(rows)
        self.assertIn("pillar_1 (pillar)", boxes)
        switch = ("[...document.querySelectorAll('#legend label')]"
                  ".find(one => one.textContent.startsWith('pillar')).querySelector('input').click()")
        window.run(switch)
        self.assertNotIn("pillar", window.run(seen))
        self.assertLess(window.run(rows), names)
        self.assertNotIn("pillar_1", window.run("return plan.names.map(name => name.text).join()"))
        window.run(switch)
        self.assertEqual(window.run(seen), boxes)
        overlaps = """
            const meets = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
            const pairs = names => names.flatMap((a, k) => names.slice(k + 1).filter(b => meets(a.area, b.area)));
            return [picture, plan].map(one => [one.names.length, pairs(one.names).length]);"""
        for named, overlapping in window.run(overlaps):
            self.assertGreater(named, 0)
            self.assertEqual(overlapping, 0)

    def check_objects(self, window):
        """A click in the plan selects; the steps are the pings whose labels have the object."""
        reported = json.loads((self.out / "variant_0000/labels/coco_fan.json").read_text())
        poses = {i["id"]: i["ping"] for i in reported["images"] if i["sensor"] == "fls"}
        instance = window.run("return data.labels.findIndex(one => one.name === 'pillar_2')") + 1
        seen = sorted(poses[a["image_id"]] for a in reported["annotations"]
                      if a["image_id"] in poses and a["instance_id"] == instance)
        window.run(f"""
            const [left, top, right, bottom] = plan.areas.find(area => area[4] === {instance - 1});
            const box = plan.canvas.getBoundingClientRect();
            const at = {{pointerId: 1, clientX: box.left + (left + right) / 2 * box.width / plan.canvas.width,
                        clientY: box.top + (top + bottom) / 2 * box.height / plan.canvas.height}};
            plan.canvas.setPointerCapture = () => {{}};
            for (const kind of ['pointerdown', 'pointerup'])
              plan.canvas.dispatchEvent(new PointerEvent(kind, at));""")
        self.assertEqual(window.run("return state.selected"), instance - 1)
        which = window.run("return document.getElementById('which').textContent")
        self.assertEqual(which, f"pillar_2 (pillar): ping 1 of {len(seen)} that show it")
        first_row = "return [...document.querySelector('#meta tr').cells].map(cell => cell.textContent)"
        area, = (a["area"] for a in reported["annotations"]
                 if poses.get(a["image_id"]) == seen[0] and a["instance_id"] == instance)
        self.assertEqual(window.run(first_row), ["pillar_2: area", str(area)])
        steps = []
        for _ in seen:
            steps.append(window.run("return pose()"))
            window.press("n")
        self.assertEqual(steps, seen)
        self.assertEqual(window.run("return pose()"), seen[0])  # the first follows the last
        window.press("p")
        self.assertEqual(window.run("return pose()"), seen[-1])
        window.press("escape")
        self.assertEqual(window.run("return state.selected"), -1)
        window.run("document.querySelector('#objects button').click()")
        self.assertGreaterEqual(window.run("return state.selected"), 0)

    def check_variants(self, window):
        window.press("]", "]", "]")
        window.wait_for(READY)
        self.assertEqual(window.run("return state.dataset"), 2)
        self.assertIn("variant_0002/fls/fan/", window.run("return url_of(view(), state.ping)"))
        seed = self.dataset(self.out / "variant_0002")["seed"]
        self.assertIn(f"seed {seed},", window.run("return document.getElementById('facts').textContent"))
        link = window.run("return document.querySelector('#meta a').getAttribute('href')")
        self.assertTrue((self.out / link).is_file(), link)

    def check_statistics(self, window):
        """Those of statistics.json, of all variants and of the one that is chosen."""
        rows = ("return [...document.querySelector('#tallies table').rows]"
                ".map(row => [...row.cells].map(cell => cell.textContent))")
        window.press("s")
        self.assertTrue(window.run("return document.getElementById('pings').hidden"))
        for k, folder in enumerate(("", "variant_0002")):
            window.run(f"document.querySelectorAll('#scopes button')[{k}].click()")
            reported = json.loads((self.out / folder / "labels/statistics.json").read_text())
            for file in ("", "labels/coco_records.json"):
                window.run(f"chosen.file = '{file}'; show_statistics()")
                tally = reported["files"][file] if file else reported["all"]
                self.assertEqual(window.run(rows)[1:], [
                    [one["name"], *(str(one[key]) for key in ("objects", "pictures", "annotations", "ignored"))]
                    for one in tally["classes"]])
                self.assertIn(f"{tally['pictures']} pictures, {tally['without_objects']} without an object",
                              window.run("return document.getElementById('tallies').textContent"))
        window.press("s")
        self.assertFalse(window.run("return document.getElementById('pings').hidden"))

    @unittest.skipUnless(browser.available(), "Debian's chromium and chromium-driver are not here")
    def test_hostile_names_are_text(self):
        """Of variants and of labels, which the page writes in lists, the legend and the table."""
        self.render_variants()
        for file in self.out.glob("variant_*/dataset.json"):
            text = json.loads(file.read_text())
            text["labels"]["instances"][1]["name"] = HOSTILE
            text["labels"]["classes"][0]["name"] = HOSTILE
            file.write_text(json.dumps(text))
        index = json.loads((self.out / "variants.json").read_text())
        index["mission"] = HOSTILE
        index["variants"][0]["drawn"] = {HOSTILE: HOSTILE}
        (self.out / "variants.json").write_text(json.dumps(index))
        page = self.gallery()
        self.assertNotIn("</script><img", page)
        with browser.Browser() as window:
            window.open(self.out / "index.html")
            window.wait_for(READY)
            window.run("select(1)")
            self.assertEqual(window.run("return document.querySelectorAll('img').length"), 0)
            self.assertEqual(window.run("return document.title"), HOSTILE + " - sonarsim")
            for element in ("legend", "objects", "which", "meta", "mission"):
                self.assertIn(HOSTILE, window.run(
                    f"return document.getElementById('{element}').textContent"), element)
            self.assertEqual(window.complaints(), [])


if __name__ == "__main__":
    if os.environ.get("SANITIZED") == "1":
        print("the page is the same in a sanitized build")
        sys.exit(77)
    unittest.main()
