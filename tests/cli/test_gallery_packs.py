"""sonarsim gallery of datasets whose pings are in tar archives."""
import os
import sys
import unittest

import browser
from paged import READY, GalleryCase, dataset_of
from sandbox import digest


class GalleryPacks(GalleryCase):
    def test_packed_pictures_are_copied_beside_the_page(self):
        self.assert_renders("--out", "loose", "--set", "output.fan=jpeg")
        self.assert_renders("--set", "output.pack=tar", "--set", "output.fan=jpeg")
        before = digest(self.out)
        page = self.gallery()
        copied = self.out / "index_files/fls/fan"
        for loose in (self.folder / "loose/fls/fan").iterdir():
            ping = int(loose.stem)
            self.assertEqual((copied / f"fls-{ping:06}.fan.jpg").read_bytes(), loose.read_bytes())
        views = [sensor["views"] for sensor in dataset_of(page)["sensors"]]
        others = [sensor["views"] for sensor in dataset_of(self.gallery("loose"))["sensors"]]
        for packed, loose in zip(views, others, strict=True):
            self.assertEqual(packed[0].get("boxes"), loose[0].get("boxes"))
        self.assertEqual({name: sums for name, sums in digest(self.out, without=("index.html",)).items()
                          if not name.startswith("index_files/")}, before)
        verified = self.run_sonarsim("verify", "out")
        self.assertEqual(verified.returncode, 0, verified.stderr)
        self.assertNotIn("index", verified.stderr)
        self.assert_renders("--overwrite")
        self.assertFalse((self.out / "index_files").exists())

    def test_packs_that_cannot_be_copied(self):
        """A damaged archive is refused and leaves nothing; a link is not followed."""
        self.assert_renders("--set", "output.pack=tar")
        archive = self.out / "fls/pack/000000.tar"
        sound = archive.read_bytes()
        archive.write_bytes(sound[:len(sound) - 2000])
        self.assert_refused(self.run_sonarsim("gallery", "out"), "000000.tar")
        self.assertFalse((self.out / "index_files").exists())
        self.assertFalse((self.out / "index.html").exists())
        archive.write_bytes(sound)
        (self.folder / "elsewhere").mkdir()
        (self.out / "index_files").symlink_to(self.folder / "elsewhere")
        self.assert_refused(self.run_sonarsim("gallery", "out"), "is a symbolic link")
        self.assertEqual(list((self.folder / "elsewhere").iterdir()), [])

    @unittest.skipUnless(browser.available(), "Debian's chromium and chromium-driver are not here")
    def test_packed_variants_in_a_browser(self):
        self.render_variants("--set", "output.pack=tar")
        self.gallery()
        with browser.Browser() as window:
            window.open(self.out / "index.html")
            self.assertEqual(window.wait_for(READY), 64)
            window.press("]")
            self.assertEqual(window.wait_for(READY), 64)
            self.assertIn("index_files/variant_0001/fls/fan/", window.run("return url_of(view(), state.ping)"))
            self.assertIn("pillar_1 (pillar)", window.run("return document.getElementById('seen').textContent"))
            self.assertEqual(window.complaints(), [])


if __name__ == "__main__":
    if os.environ.get("SANITIZED") == "1":
        print("the page is the same in a sanitized build")
        sys.exit(77)
    unittest.main()
