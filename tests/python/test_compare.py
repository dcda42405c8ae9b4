"""The figures of a comparison against closed forms, its verdict on drawn recordings, and its command."""
import json
import unittest
import warnings

import numpy as np
import tool
from sonarsim.compare import coverage, measure, report, speckle  # noqa: E402
from sonarsim.compare.bootstrap import exchange_p  # noqa: E402
from sonarsim.compare.comparison import compare_recordings  # noqa: E402
from sonarsim.compare.figure import Figure  # noqa: E402
from sonarsim.compare.images import zones_of  # noqa: E402
from sonarsim.recording import Law, Recording, RecordingError, Soundings  # noqa: E402


def drawn(seed, level_db=-20.0, is_k=False, mixture=0.0, shape=(6, 128, 64)):
    """An imaging recording of speckle: Rayleigh, or K of shape 2, with a share of a neighbour's amplitude in each beam."""
    random = np.random.default_rng(seed)
    complex_ = random.standard_normal((*shape, 2)) @ [1.0, 1j]
    complex_[..., 1:] += mixture * complex_[..., :-1].copy()
    values = 0.5 * 10 ** (level_db / 10) * np.abs(complex_) ** 2
    if is_k:
        values *= 0.5 * random.standard_exponential((*shape, 2)).sum(axis=-1)
    return Recording(law=Law("power", full_value=1.0), first_range_m=1.0, range_step_m=0.01,
                     bearing_rad=0.01 * np.arange(shape[2]), values=values.astype(np.float32))


def figure(of, name):
    return next(one for one in of.figures if one.name == name)


class FiguresTest(unittest.TestCase):
    def test_speckle(self):
        random = np.random.default_rng(1)
        # The estimate varies by 0.78 shape / sqrt(n): four of these for 20,000 draws are 0.022.
        for shape in (0.8, 1.5, 2.0, 4.0):
            patch = random.weibull(shape, (1, 200, 100))
            np.testing.assert_allclose(speckle.weibull_shape(patch) / shape, 1.0, atol=0.022)
        self.assertTrue(np.isnan(speckle.weibull_shape(np.full((1, 3, 3), 2.0)))[0])
        rayleigh = random.rayleigh(1.0, (1, 200, 200))
        for of_speckle, value, off in ((speckle.variation, np.sqrt(4 / np.pi - 1), 0.01), (speckle.skewness, -1.1395, 0.12),
                                    (speckle.inverse_k_shape, 0.0, 0.03)):
            np.testing.assert_allclose(of_speckle(rayleigh), value, atol=off)
        checkers = 1.0 + 2.0 * (np.add.outer(np.arange(8), np.arange(6)) % 2)[None]
        for lag, axis, value in ((1, 1, -1.0), (2, 1, 1.0), (3, 2, -1.0), (6, 2, np.nan)):
            np.testing.assert_allclose(speckle.correlation(checkers, lag, axis), value)
        np.testing.assert_allclose(speckle.correlation_of(checkers, checkers), 1.0)

    def test_zones(self):
        powers = np.full(440, 1e-5)
        powers[:10], powers[200:300], powers[300:] = 1.0, 0.1, 1e-3
        zones = zones_of(powers)
        # Smoothing over 10 ranges moves an edge by at most 5.
        for found, value in ((zones.bottom[0], 200), (zones.bottom[1], 300), (zones.water[1], 200), (zones.tail[0], 300)):
            self.assertLessEqual(abs(found - value), 10)
        self.assertEqual(zones_of(np.full(100, 0.5)).bottom, (0, 100))

    def test_points(self):
        # exp(-x^2 / (2 s^2)) is half over a width of 2.3548 s; linear interpolation between bins errs by less than 4 %.
        y, x = np.meshgrid((np.arange(60) - 30) / 1.2, (np.arange(64) - 32) / 2.0, indexing="ij")
        image = 1e-6 + np.exp(-0.5 * (x * x + y * y))
        self.assertEqual(measure.points_of(image, 5, 55), [(30, 32)])
        self.assertAlmostEqual(measure.width_of(image[30], 32), 4.71, delta=0.2)
        self.assertAlmostEqual(measure.width_of(image[:, 32], 30), 2.826, delta=0.12)
        self.assertEqual(measure.points_of(image, 31, 55), [])

    def test_shadows(self):
        # A shadow 20 dB deep over 30 ranges that rises linearly over 12: from a quarter to three quarters are 6.
        mean = np.ones((200, 64))
        mean[80:, 20:36] = np.clip(0.01 + 0.99 * (np.arange(80, 200) - 110) / 12, 0.01, 1.0)[:, None]
        image = mean * np.random.default_rng(3).standard_exponential(mean.shape)
        found = [one for one in measure.shadows_of(image[:190], 10) if 22 <= one[0] < 34]
        self.assertGreaterEqual(len(found), 10)
        _, first, _, depth, edge = np.median(np.array(found), axis=0)
        self.assertLess(abs(first - 81), 4)
        self.assertLess(abs(depth + 20), 1.5)
        self.assertLess(abs(edge - 6), 3)
        self.assertEqual(measure.shadows_of(np.ones((100, 64)), 10), [])


class ComparisonTest(unittest.TestCase):
    def test_same(self):
        # Each pair is called different with a probability of at most 5 %; 4 or more of 10 with one of 0.001.
        laws = [{"is_k": k % 2 == 0, "mixture": 0.5} for k in range(10)]
        different = sum(not compare_recordings(drawn(2 * k, **law), drawn(2 * k + 1, **law)).is_same for k, law in enumerate(laws))
        self.assertLess(different, 4)

    def test_decibel(self):
        one = compare_recordings(drawn(1), drawn(2, level_db=-19.0))
        level = figure(one, "image: level, dB")
        self.assertTrue(level.differs)
        # 49,152 exponential powers give 4.343 / sqrt(49152) dB, the difference sqrt(2) of it.
        self.assertAlmostEqual(level.difference, 1.0, delta=5 * 0.0277)
        self.assertAlmostEqual(level.error / 0.0277, 1.0, delta=0.5)
        # One gain is one row.
        self.assertEqual([one.name for one in one.figures if one.differs], ["image: level, dB"])
        self.assertEqual(one.first_change, level)
        self.assertIn("DIFFERS", report.comparison_text(compare_recordings(drawn(1), drawn(2, level_db=-18.0))))

    def test_what_an_eye_sees(self):
        """A side-scan whose bottom begins at 5 m, with steps behind its first return, patches of 64 x 64 samples, pings that
        are off, and a ring."""
        def made(seed, steps_db=(-14.0, -10.0, -5.0, -3.0), patches_db=2.0, is_off=True, ring=1e3, samples=832):
            random = np.random.default_rng(seed)
            power = np.full((256, samples), 1e-4)
            for begin, level_db in zip((100, 106, 115, 130, 164), (*steps_db, 0.0)):
                power[:, begin:] = 10 ** (0.1 * level_db)
            power = np.stack([power] * 2, axis=2)
            patches = np.kron(random.standard_normal((4, 10, 2)), np.ones((64, 64, 1)))
            power[:, 192:] *= 10 ** (0.1 * patches_db * patches[:, :samples - 192])
            power *= random.gamma(4.0, 0.25, power.shape)
            if is_off:
                power[5::12] *= 6.3     # 8 dB
                power[9::24] *= 0.3     # -5 dB
            power[:, :8] = ring
            return Recording("sidescan", Law("power", full_value=2e4), first_range_m=0.025, range_step_m=0.05,
                             values=power.astype(np.float32))
        one = compare_recordings(made(1), made(2, (-18.0, -30.0, -18.0, -7.0), 0.5, False, 1e4, 800))
        for name, real, simulated, off in (
                ("0.5 m behind the first return, dB", -10.0, -30.0, 0.7), ("1 m behind the first return, dB", -5.0, -18.0, 0.7),
                ("2 m behind the first return, dB", -3.0, -7.0, 0.7), ("means over 0.4 m: spread, dB", 2.0, 0.5, 0.5),
                ("means over 3.2 m: spread, dB", 2.0, 0.5, 0.7), ("pings 6 dB over their neighbours", 21 / 256, 0.0, 0.01),
                ("pings 3 dB under their neighbours", 11 / 256, 0.0, 0.01)):
            with self.subTest(name):
                self.assertAlmostEqual(figure(one, name).real, real, delta=off)
                self.assertAlmostEqual(figure(one, name).simulated, simulated, delta=off)
        # A ring has no speckle: it is thousands of standard errors off, but what lies behind the first return matters more.
        self.assertTrue(figure(one, "ring: level over the bottom, dB").differs)
        self.assertEqual(one.first_change.name, "0.5 m behind the first return, dB")
        self.assertIn("-- behind strong echoes: ", report.comparison_text(one))

    def test_levels_behind_a_wall(self):
        recording = drawn(1, level_db=-40.0)
        recording.values[:, 40:43], recording.values[:, 53:] = 1.0, 1e-3
        one = compare_recordings(recording, recording)
        self.assertAlmostEqual(figure(one, "0.1 m behind the strongest echo, dB").real, -40.0, delta=2.0)
        self.assertAlmostEqual(figure(one, "0.2 m behind the strongest echo, dB").real, -30.0, delta=0.1)

    def test_law_and_correlation(self):
        shape = figure(compare_recordings(drawn(1), drawn(2, is_k=True)), "image: inverse K shape")
        self.assertTrue(shape.differs)
        # K of shape 2 has the inverse 1/2; the fit of the trend takes about 0.02.
        self.assertAlmostEqual(shape.simulated, 0.5, delta=0.1)
        self.assertAlmostEqual(shape.real, 0.0, delta=0.05)
        one = figure(compare_recordings(drawn(1), drawn(2, mixture=0.5)), "image: correlation over 1 beams")
        # Complex amplitudes have the correlation 0.5 / 1.25; that of Rayleigh amplitudes is 0.92 times its square.
        self.assertAlmostEqual(one.simulated, 0.92 * 0.16, delta=0.03)
        self.assertTrue(one.differs and not one.agrees)

    def test_itself(self):
        recording = drawn(3)
        one = compare_recordings(recording, recording)
        self.assertTrue(one.is_same and one.agreeing == len(one.figures))
        self.assertEqual(report.comparison_json(one), report.comparison_json(compare_recordings(recording, recording)))
        for value, is_same in ((9.0, True), (90.0, False)):
            flat = [drawn(1), drawn(1)]
            flat[0].values[:], flat[1].values[:] = 9.0, value
            self.assertEqual(compare_recordings(*flat).is_same, is_same)

    def test_exchange(self):
        # One of 40 places has a value 1,000 times the others'. Its exchange gives the same size, so it never differs.
        places, ones = np.arange(40), np.ones(40)
        def made(values):
            return Figure.of("a", "mean", "tenth", places, 0, values)
        self.assertEqual(exchange_p([(made(np.where(places == 7, 1e3, 1.0)), made(ones))], [1e-3], 1), [1.0])
        # A difference of 1 at each place is never reached: 2^-39 of the exchanges have it.
        self.assertEqual(exchange_p([(made(2.0 * ones), made(ones))], [0.1], 1), [1.0 / 500.0])

    def test_coverage(self):
        """Levels from -30 to -10 dB cover -20 dB and not 0 dB; one law of speckle covers itself and not the other."""
        shape = (3, 64, 32)
        simulated = [drawn(seed, level, shape=shape) for seed, level in enumerate(np.linspace(-30.0, -10.0, 11))]
        def inside(real):
            return {one.name: one.is_inside for one in coverage.cover_of(real, iter(simulated))}
        covered, off = inside(drawn(50, shape=shape)), inside(drawn(51, level_db=0.0, is_k=True, shape=shape))
        self.assertTrue(covered["image: level, dB"])
        self.assertFalse(off["image: level, dB"])
        self.assertFalse(off["95 % of the levels over their median, dB"])
        # A figure of a like recording is outside with a chance of about 0.17, so half of 34 are with one below 1e-4.
        self.assertGreater(np.mean(list(covered.values())), 0.5)
        with self.assertRaisesRegex(RecordingError, "no figure in common with 5"):
            coverage.cover_of(drawn(1, shape=shape), iter(simulated[:4]))

    def test_refusals(self):
        other, far, tiny = drawn(1), drawn(1), drawn(1, shape=(1, 2, 1))
        other.kind, far.first_range_m = "echosounder", 100.0
        for pair in ((drawn(1), other), (drawn(1), far), (tiny, tiny)):
            self.assertRaises(RecordingError, compare_recordings, *pair)

    def test_extremes(self):
        """Tiny, empty and huge recordings are compared or refused."""
        random = np.random.default_rng(6)
        for kind, shape in (("imaging", (20, 9, 3)), ("imaging", (9, 70, 24)), ("sidescan", (40, 60, 2)), ("echosounder", (3, 5, 1))):
            for scale in (0.0, 1.0, 1e36):
                recordings = [Recording(kind, Law("amplitude", full_value=1.0), range_step_m=0.1,
                                        bearing_rad=0.01 * np.arange(shape[2]) if kind == "imaging" else None,
                                        values=np.float32(scale * random.random(shape))) for _ in range(2)]
                with self.subTest(kind=kind, shape=shape, scale=scale), warnings.catch_warnings():
                    warnings.simplefilter("error")
                    try:
                        json.dumps(report.comparison_json(compare_recordings(*recordings)), allow_nan=False)
                    except RecordingError as fault:
                        self.assertIn("no figure in common", str(fault))

    def test_soundings(self):
        def soundings(seed, spread, intensity, full_value=1.0):
            random = np.random.default_rng(seed)
            angle = np.broadcast_to(np.linspace(-1, 1, 120), (160, 120))
            ranges = 10 / np.cos(angle) * (1 + spread * random.standard_normal(angle.shape))
            return Recording("soundings", Law("power", full_value=full_value), soundings=Soundings(
                ranges, angle, intensity * random.standard_exponential(angle.shape)))
        self.assertTrue(compare_recordings(soundings(1, 1e-3, 1.0), soundings(2, 1e-3, 1.0)).is_same)
        one = compare_recordings(soundings(1, 1e-3, 1.0), soundings(2, 2e-3, 2.0))
        spread = figure(one, "10 to 20 degrees: spread of ranges, %")
        # The mean of a root of 7 degrees of freedom is 0.965 of the root of the mean.
        self.assertAlmostEqual(spread.real, 0.1, delta=0.01)
        self.assertAlmostEqual(spread.simulated, 0.2, delta=0.02)
        self.assertAlmostEqual(figure(one, "level, dB").simulated, 3.01, delta=0.2)
        self.assertAlmostEqual(figure(one, "10 to 20 degrees: level over all, dB").simulated, 0.0, delta=0.3)
        relative = compare_recordings(soundings(1, 1e-3, 1.0, 0.0), soundings(2, 1e-3, 2.0))
        self.assertTrue(relative.is_relative and relative.is_same)


class CommandTest(tool.ToolTest):
    def test_command(self):
        pair = [self.folder / str(k) for k in (1, 2)]
        for k, folder in enumerate(pair, 1):
            folder.mkdir()
            tool.write_recording(folder, drawn(k).values, {"kind": "power", "full_value": 1})
        out = self.folder / "out"
        self.assertIn("figures agree", self.succeeds("compare", *pair, "--out", out))
        self.assertEqual([one.name for one in out.iterdir()], ["compare.json"])
        printed = json.loads(self.succeeds("compare", *pair, "--json"))
        self.assertEqual(printed, json.loads((out / "compare.json").read_text()))
        (self.folder / "file").write_text("")
        for words, what, code in (((*pair, "--out", out), "holds a comparison already", 2), ((pair[0], self.folder / "file"),
                                  "needs keys", 2), ((*pair, "--pings", "0"), "must be 1 or more", 2),
                                  ((*pair, "--out", self.folder / "file/a"), "Not a directory", 1)):
            self.assert_refused("compare", what, *words, code=code)
