"""sonarsim contact-sheet: one picture with the pictures of a dataset, of variants or of a sweep."""
import struct
import sys
import unittest
import zlib

from sandbox import Sandbox, path_csv

SENSORS = """\
sensors:
  fls: {kind: imaging, azimuth_deg: 60, range_max_m: 6, range_bins: 48, azimuth_bins: 32}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 48}
output: {folder: out, fan_width_px: 400}
"""


def png_size(data):
    return struct.unpack(">II", data[16:24])


class ContactSheet(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("path.csv", path_csv(3))
        text = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", text[:text.index("sensors:")] + SENSORS)

    def sheet(self, *arguments):
        return self.run_sonarsim("contact-sheet", "out", "--out", *arguments)

    def assert_draws(self, name, *arguments):
        done = self.sheet(name, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / name).read_bytes(), done.stderr

    def test_a_dataset(self):
        self.assert_renders()
        # Three fans of 400 pixels, made smaller, and one echogram: two rows of two.
        png, log = self.assert_draws("sheet.png")
        self.assertIn("4 pictures", log)
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        width, height = png_size(png)
        self.assertEqual(width, 2 * (320 + 8) + 8)
        self.assertGreater(height, 2 * 250)
        self.assertEqual(self.assert_draws("sheet.png")[0], png)
        jpeg, log = self.assert_draws("sheet.jpg", "--sensor", "fls", "--ping", "1")
        self.assertIn("1 pictures", log)
        self.assertEqual(jpeg[:3], b"\xff\xd8\xff")
        webp = self.assert_draws("sheet.webp")[0]
        self.assertEqual(webp[:4] + webp[8:12], b"RIFFWEBP")

    def test_fans_in_webp(self):
        self.assert_renders("--set", "output.fan=webp")
        self.assertIn("4 pictures", self.assert_draws("sheet.png")[1])

    def test_variants(self):
        self.assert_renders("--set", "variants=2", "--set", "seed=3")
        _, log = self.assert_draws("sheet.png")
        self.assertIn("2 pictures", log)

    def test_refused(self):
        self.assert_renders()
        self.assert_refused(self.sheet("sheet.tiff"), "is a .png, a .jpg or a .webp")
        self.assert_refused(self.sheet("sheet.png", "--sensor", "nobody"), "no pictures of 'nobody'")
        fan = next(self.out.glob("fls/fan/*.png"))
        whole = fan.read_bytes()
        fan.write_bytes(whole[:len(whole) // 2])
        cut = self.sheet("sheet.png")
        self.assertEqual(cut.returncode, 2, cut.stderr)
        self.assertRegex(cut.stderr, f"sheet.png: not written: .*{fan.name}.*end of file")
        fan.write_bytes(b"")
        self.assert_refused(self.sheet("sheet.png"), "sheet.png: not written", fan.name)
        head = struct.pack(">IIBBBBB", 20000, 20000, 8, 0, 0, 0, 0)  # a bomb: 400 MB of zeros in 0.4 MB
        rows = zlib.compress(bytes(20001 * 20000), 1)
        fan.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
            for kind, data in ((b"IHDR", head), (b"IDAT", rows), (b"IEND", b""))))
        self.assert_refused(self.sheet("sheet.png"), "sheet.png: not written", fan.name, "more than 2^28 values")
        (self.out / "dataset.json").write_text("{")
        self.assert_refused(self.sheet("sheet.png"), "dataset.json")
        self.assertEqual([p.name for p in self.folder.glob("sheet*")], [])


if __name__ == "__main__":
    sys.exit(unittest.main())
