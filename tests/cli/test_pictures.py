"""sonarsim preview."""
import struct
import unittest

from sandbox import Sandbox


def png_header(data):
    """Width, height and colour type: 0 is grey, 2 RGB."""
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    width, height, _, colour = struct.unpack(">IIBB", data[16:26])
    return width, height, colour


ALL_KINDS = """\
sensors:
  fls: {kind: imaging, range_max_m: 6, range_bins: 48, azimuth_bins: 32}
  mbes: {kind: profiling, range_max_m: 6, range_bins: 48, azimuth_bins: 32}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 48, every: 2}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 48}
  head: {kind: scanning, range_max_m: 6, range_bins: 48, step_deg: 45}
output: {folder: out}
"""


class Preview(Sandbox):
    def test_one_picture_of_every_kind(self):
        text = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", text[:text.index("sensors:")] + ALL_KINDS)
        done = self.run_sonarsim("preview", "mission.yaml", "--ping", 5)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("box_preview.png: ping 5 of box", done.stderr)
        picture = (self.folder / "box_preview.png").read_bytes()
        # Five sonars and a plan: two rows of three tiles.
        self.assertEqual(png_header(picture), (3 * 612 + 12, 30 + 2 * 452, 2))
        self.assertFalse(self.out.exists())
        # The same bytes once more; another ping is another picture.
        again = self.run_sonarsim("preview", "mission.yaml", "--ping", 5, "--out", "again.png")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual((self.folder / "again.png").read_bytes(), picture)
        other = self.run_sonarsim("preview", "mission.yaml", "--ping", 0, "--out", "other.png",
                                  "--set", "sensors.fls.range_max_m=4", "-q")
        self.assertEqual(other.returncode, 0, other.stderr)
        self.assertNotIn("info:", other.stderr)
        self.assertNotEqual((self.folder / "other.png").read_bytes(), picture)

    def test_a_ping_that_is_not_there(self):
        self.assert_refused(self.run_sonarsim("preview", "mission.yaml", "--ping", 6),
                            "--ping 6: the mission has the pings 0 to 5")
        self.assertEqual(list(self.folder.glob("*.png")), [])


if __name__ == "__main__":
    unittest.main()
