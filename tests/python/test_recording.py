"""Recordings: arrays, and a file of each instrument's format: whole, cut off everywhere, and with hostile numbers."""
import random
import struct
import unittest
import unittest.mock
import warnings

import numpy as np
import tool
from instrument_files import FORMATS, aris, counted, didson, ek60, oculus, ping360, simrad, xtf_header, xtf_ping
from sonarsim.recording import Law, RecordingError, dataset, open_recording  # noqa: E402

ARRAYS = ("kind: imaging\nfiles: pings.npy\nlaw: {kind: gamma, exponent: 0.5}\nsound_speed_m_s: 1490\n"
          "first_range_m: 0.5\nrange_step_m: 0.1\n")


class RecordingTest(tool.ToolTest):
    def opened(self, yaml, pings=None, **files):
        for name, content in files.items():
            (self.folder / name).write_bytes(content)
        (self.folder / "recording.yaml").write_text(yaml)
        return open_recording(self.folder, pings=pings)

    def fault(self, yaml, **files):
        with self.assertRaises(RecordingError) as caught:
            self.opened(yaml, **files)
        text = str(caught.exception)
        self.assertIn(str(self.folder), text)
        self.assertNotIn("\n", text)
        return text

    def test_arrays(self):
        np.save(self.folder / "pings.npy", np.arange(24, dtype=np.float32).reshape(2, 3, 4))
        recording = self.opened(ARRAYS + "rate_hz: 5\nbearing_first_deg: -30\nbearing_last_deg: 30\nspread: sine\n"
                                "frequency_hz: 2.1e6\npitch_deg: 20\n")
        self.assertEqual(recording.values.shape, (2, 3, 4))
        np.testing.assert_allclose(np.sin(recording.bearing_rad), [-1 / 2, -1 / 6, 1 / 6, 1 / 2])
        np.testing.assert_allclose(recording.ranges_m, [0.5, 0.6, 0.7])
        self.assertEqual(len(open_recording(self.folder / "recording.yaml", pings=1)), 1)
        # A side-scan's row 0 1 2 | 3 4 5 is port 2, 1, 0 from nadir on, starboard 3, 4, 5.
        np.save(self.folder / "pings.npy", np.arange(12, dtype=np.uint16).reshape(2, 6))
        recording = self.opened(ARRAYS.replace("imaging", "sidescan"))
        np.testing.assert_array_equal(recording.values[0], [[2, 3], [1, 4], [0, 5]])

    def test_clipping_below_the_declared_value(self):
        values = np.random.default_rng(1).integers(0, 256, (3, 60, 40)).astype(np.uint8)
        for clipped, more, found in ((200, "", 200.0), (200, ", full_value: 255", 255.0), (254, "", 255.0)):
            np.save(self.folder / "pings.npy", np.where(values > clipped, np.uint8(clipped), values))
            self.assertEqual(self.opened(ARRAYS.replace("exponent: 0.5", "exponent: 0.5" + more)).law.full_value, found)

    def test_pictures(self):
        from PIL import Image
        for dtype in (np.uint8, np.uint16):
            grey = (np.arange(12).reshape(3, 4) * (np.iinfo(dtype).max // 12)).astype(dtype)
            Image.fromarray(grey).save(self.folder / "a.png")
            recording = self.opened(ARRAYS.replace("pings.npy", "a.png"))
            np.testing.assert_array_equal(recording.values[0], grey)
        whole = (self.folder / "a.png").read_bytes()
        for length in (4, 9, 30, len(whole) // 2):
            self.fault(ARRAYS.replace("pings.npy", "a.png"), **{"a.png": whole[:length]})
        Image.fromarray(np.zeros((3, 4, 3), np.uint8)).save(self.folder / "a.png")
        self.assertIn("in colours", self.fault(ARRAYS.replace("pings.npy", "a.png")))

    def test_soundings(self):
        for name, value in (("range", 10.0), ("angle", 0.1), ("level", 5.0)):
            array = np.full((2, 3), value, np.float32)
            if name == "angle":
                array[1, 2] = np.nan
            np.save(self.folder / f"{name}.npy", array)
        text = ("kind: soundings\nlaw: {kind: power}\nsound_speed_m_s: 1500\nrate_hz: 1\n"
                "soundings: {range_m: range.npy, angle_rad: angle.npy, intensity: level.npy}\n")
        np.save(self.folder / "level.npy", np.full((2, 3), 5, np.uint16))
        self.assertEqual(self.opened(text).law.full_value, 65535.0)
        np.save(self.folder / "level.npy", np.full((2, 3), 5.0, np.float32))
        recording = self.opened(text)
        self.assertEqual(recording.law.full_value, 0.0)     # floats have none
        self.assertEqual(np.isfinite(recording.soundings.range_m).sum(axis=1).tolist(), [3, 2])

    def test_each_format(self):
        opened = {name: self.opened(yaml, FILE=content) for name, (yaml, content, _) in FORMATS.items()}
        own = opened["oculus"]
        np.testing.assert_array_equal(own.values[1], [[0, 1], [2, 3], [4, 5]])
        np.testing.assert_allclose(np.degrees(own.bearing_rad), [30.0, -15.5])
        self.assertEqual((own.first_range_m, own.range_step_m, own.sound_speed_m_s), (0.125, 0.25, 1490.0))
        own = opened["xtf"]
        np.testing.assert_array_equal(own.values[1], [[3, 4], [2, 5], [1, 6]])
        self.assertEqual((own.range_step_m, own.first_range_m, own.sound_speed_m_s), (10.0, 5.0, 1500.0))
        own = opened["didson"]
        self.assertEqual(own.values[1, 2, 7], 2 * 48 + 7 + 1)
        self.assertAlmostEqual(own.range_step_m, 0.5 * 1480 / 50000)
        self.assertAlmostEqual(own.first_range_m, 0.5 * 1480 * (4 * 0.000572 + 0.5 / 50000))
        self.assertEqual(own.law, Law("decibel", range_db=90.0))
        np.testing.assert_allclose(np.degrees(own.bearing_rad[[0, -1]]), [14, -14])
        own = opened["aris"]
        self.assertEqual(own.frequency_hz, 1.2e6)    # the high one of an ARIS 1200
        self.assertEqual(own.values[1, 2, 7], 2 * 48 + 7 + 1)
        self.assertAlmostEqual(own.first_range_m, 0.5 * 1450 * 1004e-6)
        own = opened["ping360"]
        self.assertAlmostEqual(own.range_step_m, 0.5 * 1500 * 800 * 25e-9)
        self.assertEqual(own.values[0, :, 0].tolist(), [9, 8, 7])
        own = opened["ek60"]
        np.testing.assert_allclose(own.values[0, :, 0], np.maximum(200 + 10 * np.log10(2) / 256 * np.array(
            [-4000, -8000, -20000]), 0), rtol=1e-6)
        self.assertAlmostEqual(own.first_range_m, 0.5 * 1480 * 2 * 2e-4, places=6)

    def test_versions_and_sizes(self):
        yaml, *_ = FORMATS["oculus"]
        own = self.opened(yaml, FILE=b"SO noise" + oculus(2, 1, counted(12)) + b"S")
        self.assertEqual((own.values[0, 0, 1], own.law.full_value), (0x0302, 65535.0))
        self.assertIn("24 bits", self.fault(yaml, FILE=oculus(1, 2, counted(18))))
        yaml, *_ = FORMATS["xtf"]
        for form, layout, full in ((8, "B", 127.5), (2, "I", 2147483647.5), (5, "f", 255.0)):
            own = self.opened(yaml, FILE=xtf_header(form) + xtf_ping(layout=layout, weight=1))
            self.assertEqual((own.values[0, 0, 0], own.law.full_value), (1.5, full))
        own = self.opened(yaml.replace("}", ", full_value: 9}"), FILE=xtf_header() + xtf_ping())
        self.assertEqual(own.law.full_value, 9)
        self.assertIn("split the file", self.fault(yaml, FILE=xtf_header() + xtf_ping() + xtf_ping(range_m=60.0)))
        self.assertEqual(len(self.opened(FORMATS["didson"][0], FILE=didson(3))), 2)
        self.assertIn("another version", self.fault(FORMATS["didson"][0], FILE=didson(9)))
        self.assertIn("not in the order", self.fault(FORMATS["aris"][0], FILE=aris(ordered=0)))
        yaml, *_ = FORMATS["ek60"]
        two = simrad(b"CON0") + ek60() + ek60(120000.0, (-100,)) + ek60(38000.0, (1,), mode=2)
        self.assertIn("38000, 120000 Hz", self.fault(yaml, FILE=two))
        self.assertEqual(self.opened(yaml + "frequency_hz: 120000\n", FILE=two).values.shape, (1, 1, 1))
        for mark, what in ((b"XML0", "EK80"), (b"#MRZ", ".kmall"), (b"\2I..", ".all")):
            self.assertIn(what, self.fault(yaml, FILE=b"\x10\0\0\0" + mark + bytes(20)))

    def test_a_ping_of_odd_length(self):
        yaml = FORMATS["ping360"][0]
        pings = [ping360(k) for k in range(12)]
        own = self.opened(yaml, FILE=b"".join([*pings[:5], ping360(5, samples=(1, 2)), *pings[5:]]))
        self.assertEqual((own.values.shape, own.notes), ((12, 3, 1), ["1 of 13 pings have another length and are left out"]))
        # Two of four are no exception.
        self.assertIn("split the file", self.fault(yaml, FILE=b"".join(pings[:2] + [ping360(5, samples=(1, 2))] * 2)))

    def test_margins(self):
        values = np.random.default_rng(1).integers(1, 200, (4, 30, 10)).astype(np.uint8)
        values[:, :3], values[:, 25:], values[:, :, 8:] = 1, 0, 7
        np.save(self.folder / "pings.npy", values)
        own = self.opened(ARRAYS + "bearing_last_deg: 30\n").without_margins()
        self.assertEqual(own.values.shape, (4, 22, 8))
        self.assertAlmostEqual(own.first_range_m, 0.8)
        self.assertEqual(len(own.bearing_rad), 8)

    def test_several_files(self):
        yaml, content, _ = FORMATS["aris"]
        yaml = yaml.replace("FILE", "[A, B]")
        for most in (None, 3):
            self.assertEqual(len(self.opened(yaml, most, A=content, B=content)), most or 4)
        self.assertIn("another shape of its pings", self.fault(yaml, A=content, B=aris(samples=6)))
        self.assertIn("recording.yaml says scanning", self.fault("kind: scanning\nlogs: A\nlaw: {kind: power}\n", A=content))

    def test_cut_off(self):
        for name, (yaml, content, whole) in FORMATS.items():
            for length in {*range(0, len(content), max(1, len(content) // 150)), *range(len(content) - 9, len(content))}:
                with self.subTest(name, length=length):
                    (self.opened if length in whole else self.fault)(yaml, FILE=content[:length])

    def test_hostile_numbers(self):
        """Any four bytes may be anything: one sentence or a recording, and no great memory."""
        draws = random.Random(1)
        for name, (yaml, content, _) in FORMATS.items():
            headers = [k for k in range(0, len(content) - 4, 2) if any(content[k:k + 4])]
            for _ in range(150):
                at = draws.choice(headers)
                value = draws.choice([b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\0", b"\xff\xff\0\0", draws.randbytes(4)])
                with self.subTest(name, at=at), warnings.catch_warnings():
                    warnings.simplefilter("ignore", RuntimeWarning)
                    try:
                        self.assertLess(self.opened(yaml, FILE=content[:at] + value + content[at + 4:]).law.range_db, 1e3)
                    except RecordingError as fault:
                        self.assertNotIn("\n", str(fault))

    def test_hostile_arrays(self):
        def npy(kind, shape, more="'fortran_order': False, "):
            header = f"{{'descr': '{kind}', {more}'shape': {shape}, }}".ljust(117).encode() + b"\n"
            return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header + bytes(8)
        for content in (npy("<f4", (10**6, 10**6)), npy("<f4", (-1, 4)), npy("|O", (2, 2)), npy("<f4", (2, 2), ""),
                        npy("<i8", (1, 1)), b"", b"\x93NUM", b"\x93NUMPY\1\0\xff\xff", b"PK\3\4" + bytes(90)):
            self.fault(ARRAYS, **{"pings.npy": content})
        np.save(self.folder / "pings.npy", np.full((3, 4), -1.0))
        self.assertIn("negative", self.fault(ARRAYS))

    def dataset(self, kind, arrays, resolved="", **more):
        """A dataset of two pings, 3 ranges and 2 beams."""
        for name, array in arrays.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            np.save(self.folder / name, np.asarray(array, np.float32))
        more = {"pings": 2, "full_scale": 4.0, "range_edges_m": [1, 2, 3, 4], "azimuth_edges_rad": [-0.2, 0.0, 0.2], **more}
        tool.write_description(self.folder, 3, [tool.sensor("s", kind, **more)])
        (self.folder / "mission.resolved.yaml").write_text(
            f"water: {{sound_speed_m_s: 1480}}\nsensors:\n  s: {{instrument: {{{resolved}}}}}\n")
        return open_recording(self.folder)

    def test_datasets(self):
        image = np.arange(6.0).reshape(3, 2)
        polar = {f"s/polar/{k:06}.npy": image + k for k in range(2)}
        files = {"files": {"polar": "s/polar/%06d.npy"}}
        own = self.dataset("imaging", polar, **files)
        np.testing.assert_array_equal(own.values[1], image + 1)
        self.assertEqual((own.first_range_m, own.range_step_m, own.sound_speed_m_s), (1.5, 1.0, 1480.0))
        self.assertEqual(own.law, Law("amplitude", full_value=4.0))
        raw = {f"s/raw/{k:06}.npy": image for k in range(2)}
        resolved = "frequency_hz: 4.e+5, receiver: {bits: 12, companding: log, dynamic_range_db: 80}"
        own = self.dataset("imaging", raw, resolved, files={"raw": "s/raw/%06d.npy"}, instrument={})
        self.assertEqual(own.law, Law("decibel", range_db=80.0, full_value=4095.0))
        own = self.dataset("sidescan", {"s/waterfall.npy": [[0, 1, 2, 3, 4, 5]] * 2}, instrument={},
                           records={"name": "waterfall", "file": "s/waterfall.npy", "axes": ["ping", "column"]})
        np.testing.assert_array_equal(own.values[0], [[2, 3], [1, 4], [0, 5]])
        self.assertEqual(own.law, Law("power", full_value=1.0))
        records = np.zeros((2, 2, 5))
        records[0, :, 0], records[0, :, 4] = (1.4, 3.4), 0.9
        own = self.dataset("profiling", {**polar, "s/soundings.npy": records}, **files, records={
            "name": "soundings", "file": "s/soundings.npy", "axes": ["ping", "beam", "value"]})
        np.testing.assert_allclose(own.soundings.intensity, [[0, (5 / 4) ** 2], [np.nan, np.nan]])
        np.testing.assert_allclose(own.soundings.angle_rad[0], [0.1, -0.1])
        # A beam of 0.2 rad, 0.8 rad off the vertical, covers 20 x 0.2 tan(0.8) = 4.1 m of range: 41 bins of 0.1 m. The
        # power of the only bin with an echo is shared by them.
        spike = np.zeros((100, 2))
        spike[60] = 4.0
        records[0, :, 0] = 20.0
        own = self.dataset("profiling", {**{name: spike for name in polar}, "s/soundings.npy": records}, **files,
                           range_edges_m=[15 + 0.1 * k for k in range(101)], azimuth_edges_rad=[-0.9, -0.7, -0.5],
                           records={"name": "soundings", "file": "s/soundings.npy", "axes": ["ping", "beam", "value"]})
        bins = 20 * 0.2 * np.tan([0.8, 0.6]) / 0.1
        np.testing.assert_allclose(own.soundings.intensity[0], 1 / bins, rtol=0.05)
        for more, what in (({"pings": 1 << 31}, "pings, more than poses"), ({"pings": 3}, "000002.npy"),
                           ({"range_edges_m": [1, 2]}, "another shape"), ({"files": {}}, "set output.polar: true"),
                           ({"files": {"polar": "../%06d.npy"}}, "not a name that"), ({"kind": "sidescan"}, "no records")):
            with self.subTest(what), self.assertRaisesRegex(RecordingError, what):
                self.dataset(more.pop("kind", "imaging"), polar, **{**files, **more})
        with unittest.mock.patch.object(dataset, "MAX_VALUES", 11), self.assertRaisesRegex(RecordingError, "take fewer pings"):
            self.dataset("imaging", polar, **files)
        (self.folder / "s/polar/000001.npy").write_bytes(b"\x93NUMPY\1\0")
        with self.assertRaisesRegex(RecordingError, "polar/000001.npy: "):
            self.dataset("imaging", {}, **files)

    def test_recording_yaml(self):
        np.save(self.folder / "pings.npy", np.ones((2, 3, 4), np.float32))
        for yaml, what in (
                (ARRAYS + "rate: 5\n", "unknown key 'rate'; did you mean rate_hz"), ("kind: imaging\n", "one of the keys files"),
                (ARRAYS.replace("imaging", "photo"), "one of imaging, sidescan"), (ARRAYS + "xtf: a\n", "files and xtf"),
                (ARRAYS.replace("0.5}", "5}"), "'exponent' must be a number from 0.1 to 2"),
                (ARRAYS.replace("1490", ".nan"), "'sound_speed_m_s' must be"), (ARRAYS.replace("law", "# law"), "'law'"),
                (ARRAYS + "bearing_first_deg: 10\nbearing_last_deg: 10\n", "the same bearing for all beams"),
                (ARRAYS.replace("0.5}", "0.5, full_value: 0}"), "'full_value' must be a number from 1e-30"),
                (ARRAYS.replace("pings.npy", "[3]"), "'files' must be"), (ARRAYS.replace("pings.npy", "no.npy"), "cannot be read"),
                (ARRAYS + "bearings_deg: [1, 2]\nrate_hz: 1\n", "2 bearings for 4 beams"), ("a: [", "is not YAML"),
                ("[" * 20000, "is not YAML"), ("- 1", "needs keys"), (ARRAYS.replace("0.1\n", "0\n"), "range_step_m"),
                ("kind: imaging\nlogs: pings.npy\nsound_speed_m_s: 1\n", "number from 300 to 10000")):
            self.assertIn(what, self.fault(yaml), yaml)
        with self.assertRaisesRegex(RecordingError, "neither recording.yaml"):
            (self.folder / "recording.yaml").unlink()
            open_recording(self.folder)

    def test_laws(self):
        np.testing.assert_allclose(Law("amplitude").powers([0, 127.5, 255]), [0, 0.25, 1])
        np.testing.assert_allclose(Law("power", full_value=0).powers([0, 3]), [0, 3])
        np.testing.assert_allclose(Law("gamma", exponent=0.5, offset=0.1).powers([0, 0.4 * 255, 0.9 * 255]), [0, 1 / 16, 1])
        np.testing.assert_allclose(Law(knee=0.2).powers([0, 0.1 * 255, 63.359735]), [0, 0.01, 1 / 16], atol=1e-6)
        np.testing.assert_allclose(Law("decibel", range_db=60).powers([0, 127.5, 255]), [1e-6, 1e-3, 1], rtol=1e-5)
