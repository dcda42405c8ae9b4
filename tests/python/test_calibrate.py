"""sonarsim.calibrate: fits of synthetic pings with drawn numbers, a small dataset, and what is refused."""
import contextlib
import dataclasses
import json
import os
import unittest
import unittest.mock

import numpy as np
from scipy import special
from tool import ROOT, ToolTest, write_recording
from sonarsim.calibrate import correlations, image, judge, law, levels, noise, preset, scene  # noqa: E402
from sonarsim.calibrate.patches import Patches  # noqa: E402
from sonarsim.calibrate.statistics import Bounded, CalibrationError, LogStatistics, bootstrap, delivered  # noqa: E402
from sonarsim.recording import Law, Recording  # noqa: E402

RANGES, BEAMS = 240, 96
STEP_M, FIRST_M = 0.02, 1.01
SINES = np.sin(np.radians(24.0)) * (2.0 * (np.arange(BEAMS) + 0.5) / BEAMS - 1.0)
SINGLE = {"samples": 1.0, "combine": "max", "expansion": 1.0}
# A start that is wrong in all that the pings tell.
START = """\
kind: imaging
model: calibrated
azimuth_deg: 40  # sheet
elevation_deg: 60
instrument:
  frequency_hz: 1e6  # sheet
  source_level_db: 0
  beam:
    width_deg: 1.4  # sheet
  speckle:
    mode: ping
  receiver:
    noise_db: -105
    gamma: 0.8  # rule
"""
MISSION = """\
scene: {file: plate.obj, materials: materials.csv, material_default: sand}
trajectory: {file: track.csv}
water: {sound_speed_m_s: 1500}
output: {polar: false}
sensors:
  made: {kind: imaging, model: calibrated, azimuth_deg: 48, elevation_deg: 60, range_min_m: 1, range_max_m: 5.8,
         range_bins: 240, azimuth_bins: 96, instrument: {frequency_hz: 1e6, source_level_db: 0,
           beam: {width_deg: 0.9, side_lobe_db: -22, spread: sine}, pulse: {resolution_m: 0.04}, speckle: {mode: ping},
           receiver: {noise_db: -105, full_scale_db: -62, tvg_log: 30, gamma: 0.6}}}
"""
TRUTH = {"beam.width_deg": 0.9, "pulse.resolution_m": 0.04, "receiver.full_scale_db": -62.0, "receiver.tvg_log": 30.0,
         "receiver.gamma": 0.6}


def speckle(draws, pings=4, width_bins=1.8, width_deg=1.0, side_lobe_db=-20.0):
    """Complex normal numbers [ping, range, beam] of power 1 with the correlations of a pulse and of an array."""
    count = RANGES + 80
    x = draws.standard_normal((pings, count, BEAMS)) + 1j * draws.standard_normal((pings, count, BEAMS))
    lags = np.minimum(np.arange(count), count - np.arange(count))
    power = np.fft.fft(correlations.pulse_at(lags / width_bins, -30.0)).real
    x = np.fft.ifft(np.fft.fft(x, axis=1) * np.sqrt(np.maximum(power, 0.0))[:, None], axis=1)[:, :RANGES]
    # Elements of noise, weighted as the array and turned into the direction of each beam.
    pedestal, half_power = correlations.taper(side_lobe_db)
    place = (np.arange(400) + 0.5) / 400 - 0.5
    turns = np.outer(place, SINES) * half_power / np.sin(0.5 * np.radians(width_deg))
    beams = ((pedestal + (1.0 - pedestal) * np.cos(np.pi * place) ** 2)[:, None] * np.exp(2j * np.pi * turns)).T
    values, vectors = np.linalg.eigh(beams @ beams.conj().T)
    x = x @ (vectors * np.sqrt(np.maximum(values, 0.0))).T
    return x / np.sqrt((np.abs(x) ** 2).mean())


def recording_of(amplitude, gamma=0.5, range_db=None, full=255):
    """Pings whose values are whole steps of a law."""
    share = 1.0 + 20.0 * np.log10(amplitude) / range_db if range_db else amplitude**gamma
    values = np.clip(np.floor(full * share + 0.5), 0.0, full).astype(np.float32)
    return Recording(kind="imaging", law=Law("gamma", full_value=full), name="made", values=values, range_step_m=STEP_M,
                     first_range_m=FIRST_M, bearing_rad=np.arcsin(SINES))


def noise_of(draws, tvg=20.0, level_db=-32.0, **shape):
    """Amplitudes of noise after a gain, level_db + tvg log r re full scale."""
    level = level_db + tvg * np.log10(FIRST_M + STEP_M * np.arange(RANGES))
    return np.abs(speckle(draws, **shape)) * 10.0 ** (0.05 * level[:, None])


class Fits(unittest.TestCase):
    def assert_within(self, found, truth):
        """An interval is 1.96 standard errors to either side; 3.3 of them hold in 999 of 1,000 draws."""
        self.assertLess(abs(found.value - truth), 3.3 / 1.96 * found.half_width, (found, truth))

    def test_closed_forms_of_log_powers(self):
        one, two, larger = LogStatistics(), LogStatistics(2, "mean"), LogStatistics(2)
        for found, known in ((one.variance, np.pi**2 / 6), (one.mean, -0.577216), (one.skewness, -1.139547),
                             (one.variation, 0.522723), (one.correlation(1.0), 1.0), (two.variance, np.pi**2 / 6 - 1),
                             (two.skewness, -0.780245), (two.correlation(0.0), 0.0),
                             (one.correlation(0.5), special.spence(0.5) * 6 / np.pi**2),
                             # The larger of two has the mean 3 / 2; its logarithm is ln 2 more and varies 2 ln(2)^2 less.
                             (larger.mean, one.mean + np.log(2.0) - np.log(1.5)),
                             (larger.variance, one.variance - 2.0 * np.log(2.0) ** 2)):
            self.assertAlmostEqual(found, known, 5)

    def test_delivered_samples_have_the_correlations_of_the_remapped_ranks(self):
        draws = np.random.default_rng(61).standard_normal((4, 400000))
        one, other = (draws[k] + 1j * draws[k + 1] for k in (0, 2))
        for of in ((9.0, "max", 1.75), (2.5, "mean", 1.0)):
            known = LogStatistics(*of)
            for k2 in (0.2, 0.7):
                logs = [of[2] * np.log(delivered(0.5 * np.abs(z) ** 2, *of[:2])) for z in
                        (one, np.sqrt(k2) * one + np.sqrt(1.0 - k2) * other)]
                self.assertAlmostEqual(np.corrcoef(logs)[0, 1], known.correlation(k2), delta=0.01)
            self.assertAlmostEqual(logs[0].std(), known.variance**0.5, delta=0.01 * logs[0].std())
        # Of docs/calibrated.md, section 5.
        nine = LogStatistics(9.0, "max", 1.75)
        self.assertAlmostEqual(nine.variation, 0.381, delta=0.003)
        self.assertAlmostEqual(nine.skewness, -0.11, delta=0.01)

    def test_bootstrap_of_a_mean(self):
        x = np.random.default_rng(1).standard_normal(400)
        found = bootstrap(len(x), lambda w: w @ x / w.sum(axis=1), draws=400)[0]
        self.assertAlmostEqual(found.half_width, 1.96 * x.std() / 20.0, delta=0.02)

    def test_even_patches_have_the_whole_variance(self):
        # The half of the patches whose quarters are most alike lacks variance; ln P of speckle has pi^2 / 6. The means of
        # 16 draws of 80 patches have a standard deviation of 1 %: four of these are 4 %.
        shares = []
        for draws in map(np.random.default_rng, range(16)):
            power = np.abs(speckle(draws, width_bins=2.5, width_deg=1.6)) ** 2
            patches = Patches(np.sqrt(power), 10.0, lambda amplitude: 2.0 * np.log(amplitude))
            even = patches.even()
            shares.append([patches.variance[even].mean(), patches.whole_variance(even, LogStatistics())[even].mean()])
        lacking, whole = np.mean(shares, axis=0) / (np.pi**2 / 6.0)
        self.assertLess(abs(whole - 1.0), 0.04)
        self.assertGreater(whole - lacking, 0.015)

    def test_noise_and_its_growth(self):
        for draws in map(np.random.default_rng, range(10, 16)):
            tvg, level = draws.uniform(10.0, 40.0), draws.uniform(-50.0, -35.0)
            amplitude = noise_of(draws, tvg, level)
            # Echoes only add to noise: they must not lift the law.
            amplitude[:, 100:150, 20:70] += 0.3
            recording = recording_of(amplitude, full=65535)
            known = law.Law(65535.0, False, law.Bounded(0.5, 0.5, 0.5), 0.0, LogStatistics())
            found = noise.fit_noise(noise.noise_blocks(recording, known), 0.0)
            self.assert_within(found.level_db, level)
            self.assert_within(found.tvg_log, tvg)

    def test_pulse_and_array(self):
        for draws in map(np.random.default_rng, range(20, 26)):
            bins, width, side_lobe = draws.uniform(1.2, 3.0), draws.uniform(0.7, 1.6), draws.uniform(-30.0, -15.0)
            logs = 2.0 * np.log(np.abs(speckle(draws, 4, bins, width, side_lobe)))
            patches = Patches(logs, np.inf, lambda ping: ping)
            chosen = np.arange(len(patches.place))
            self.assert_within(correlations.fit_pulse(patches, chosen, correlations.Pulse(SINGLE, -30.0, "noise")), bins)
            found = correlations.fit_array(*patches.beam_covariance(chosen, True), SINES, LogStatistics())
            self.assert_within(found[0], width)
            self.assertTrue(found[1].low - 2.0 < side_lobe < found[1].high + 2.0, (found[1], side_lobe))

    def test_a_logarithm_that_cuts_off_noise(self):
        for draws in map(np.random.default_rng, range(50, 54)):
            range_db = draws.uniform(50.0, 57.0)
            pings = recording_of(noise_of(draws, 20.0, -45.0, pings=10), range_db=range_db, full=4095).values
            self.assertGreater((pings == 0.0).mean(), 0.01)
            found = law.fit_law(pings, 4095.0, LogStatistics())
            self.assertTrue(found.is_log)
            self.assert_within(found.scale, range_db)

    def test_detected_samples_are_speckle(self):
        """The largest of 14 samples has logarithms of no skewness; the beams of a lens have a bent level."""
        draws = np.random.default_rng(60)
        amplitude = np.sqrt(draws.exponential(0.002, (4, 14, RANGES, BEAMS)).max(axis=1))
        expected = 2.0 * np.log(amplitude).std() / LogStatistics().variance ** 0.5
        amplitude *= np.cos(np.linspace(-1.2, 1.2, BEAMS))
        values = recording_of(amplitude, 1.0, full=65535).values
        found = law.fit_law(values, 65535.0, LogStatistics())
        self.assertAlmostEqual(found.scale.value / expected, 1.0, delta=0.1)

    def test_numbers_with_wide_intervals_are_kept_from_the_start(self):
        start = {"receiver": {"gamma": 0.5}, "beam": {"width_deg": 1.0}, "pulse": {}}
        fit = image.Fit({section: dict(keys) for section, keys in start.items()}, 0.0, start=start)
        fit.level_db = -9.0
        fit.set("receiver.gamma", Bounded(1.32, 0.40, 2.25))
        fit.set("beam.width_deg", Bounded(0.9, 0.8, 1.0))
        fit.set("receiver.full_scale_db", Bounded(-2.0, -8.0, 4.0))
        image.drop_wide(fit, 0.0)
        self.assertEqual((sorted(fit.estimates), fit.level_db), (["beam.width_deg", "receiver.full_scale_db"], -9.0))
        fit.set("receiver.tvg_log", Bounded(14.0, 0.0, 28.0))
        image.drop_wide(fit, 0.0)
        self.assertEqual((sorted(fit.estimates), fit.level_db), (["beam.width_deg"], 0.0))
        self.assertEqual(fit.instrument["receiver"]["gamma"], 0.5)
        self.assertIn("gamma", fit.lacks[0])

    def test_windows_of_one_sonar(self):
        fits = [image.Fit({"receiver": {}}, 0.0) for _ in range(2)]
        fits[0].set("receiver.gamma", Bounded(0.50, 0.48, 0.52))
        fits[1].set("receiver.gamma", Bounded(0.56, 0.52, 0.60))
        gamma = image.joined(fits).estimates["receiver.gamma"]
        self.assertAlmostEqual(gamma.value, (0.50 * 4 + 0.56) / 5)
        self.assertTrue(gamma.low < 0.48 and gamma.high > 0.54, gamma)

    def test_fits_that_are_not_written(self):
        def judged(agree, white=0.0, figures=40):
            return judge.Judged([[()] * figures], (agree, agree), white)
        judge.check_judged(judged(17), judged(12), [])
        for fit, why in ((judged(17, 0.06), "6% of a pass .* is white"), (judged(11), "11 of 40 figures .* and 12 with the start"),
                         (judged(12), "12 of 40")):
            with self.assertRaisesRegex(CalibrationError, why + ".* lacks rows that show noise alone$"):
                judge.check_judged(fit, judged(12), ["rows that show noise alone"])

    def test_gain_and_noise_together(self):
        """Noise and gain laid over echoes are found from the levels of pings, whatever the start."""
        echoes = unittest.mock.Mock(range_m=FIRST_M + STEP_M * np.arange(RANGES)[:, None])
        draws = np.random.default_rng(70)
        level_db = np.where(np.arange(RANGES) > 100, -50.0, -200.0)[:, None] - 30.0 * np.log10(echoes.range_m)
        echoes.amplitude = 10.0 ** (0.05 * level_db) * np.abs(speckle(draws, 2))[:, :, :32]
        own = unittest.mock.Mock(instrument={"receiver": {"tvg_absorption": False, "offset": 0.0}}, absorption_db_per_m=0.0)
        true = np.array([-40.0, -85.0, 25.0])
        for name, scale in (("gamma", 0.5), ("log", 80.0)):
            measured = levels.levels_of(levels.Records(echoes, own, 5).greys(name, (scale, *true, 0.0)), name, scale)
            pairs = [(levels.Records(echoes, own, 1), np.array([[levels.LEVEL_ERROR]] + levels.RINGS * [[levels.RING_ERROR]]))]
            numbers, errors = levels.numbers_of(pairs, [measured], np.array([-30.0, -100.0, 30.0]), name, scale, [])
            np.testing.assert_array_less(np.abs(numbers - true), np.array([1.0, 1.0, 2.0]), f"{name} {numbers} {errors}")

    def test_the_view_of_a_recording(self):
        """A beam 20 degrees high that meets a level bottom from 0.75 to 1.65 m hangs 0.47 m above it, 29 degrees down."""
        values = np.full((2, 240, BEAMS), 1e-3) * np.random.default_rng(3).exponential(size=(2, 240, BEAMS))
        values[:, 75:165] *= 1e4
        recording = Recording(law=Law("power", full_value=100.0), range_step_m=0.01, bearing_rad=np.arcsin(SINES), values=values)
        height_m, pitch = scene.view_of(recording, unittest.mock.Mock(instrument={"beam": {"elevation_width_deg": 20.0}}))
        self.assertAlmostEqual(height_m / np.sin(pitch + np.radians(10.0)), 0.75, delta=0.05)
        self.assertAlmostEqual(height_m / np.sin(pitch - np.radians(10.0)), 1.65, delta=0.1)


class Command(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "start.yaml").write_text(START)

    def words(self, recording, start, *options):
        start = self.folder / start if start.endswith(".yaml") else start
        return "calibrate", self.folder / recording, "--preset", start, "--out", self.folder / "mine.yaml", *options

    def calibrate(self, *words):
        """The report of a calibration."""
        self.succeeds(*self.words(*words), "--report", self.folder / "mine.json")
        return json.loads((self.folder / "mine.json").read_text())

    def refused(self, sentence, values, *options, start="start.yaml"):
        write_recording(self.folder, values, {"kind": "gamma", "exponent": 0.5, "full_value": 255}, first_range_m=FIRST_M,
                        range_step_m=STEP_M, bearing_first_deg=-24, bearing_last_deg=24, spread="sine")
        name, *words = self.words("recording.yaml", start, *options)
        self.assert_refused(name, sentence, *words)

    def test_program_beside_the_package(self):
        with unittest.mock.patch.dict(os.environ, {"PATH": "", "SONARSIM": ""}):
            for program, python in (("build/sonarsim", "build/python"), ("usr/bin/sonarsim", "usr/lib/sonarsim/python")):
                package, program = self.folder / python / "sonarsim", self.folder / program
                package.mkdir(parents=True)
                program.parent.mkdir(exist_ok=True)
                self.assertEqual(preset.program_of(package), "sonarsim")
                program.touch()
                self.assertEqual(preset.program_of(package), str(program))

    def test_a_pass_writes_nothing_into_the_folder_of_the_caller(self):
        (self.folder / "out").touch()   # where nothing can be written
        start = preset.read_start(str(ROOT / "configs/sensors/ping360.yaml"))
        start.shape = {"range_min_m": 0.1, "range_max_m": 2.0, "range_bins": 50}
        with contextlib.chdir(self.folder):
            one = scene.pass_of(start, scene.with_shape(start, start.text), scene.usual_mission("scanning", 2.0, (1.0, 0.5)),
                                "sonar", None)
        self.assertEqual(one.values.shape[1:], (50, 1))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["out", "start.yaml"])

    def test_the_frequency_of_the_pings(self):
        start = preset.read_start("aris_3000")
        pings = dataclasses.replace(recording_of(noise_of(np.random.default_rng(1))), range_step_m=0.1)
        with self.assertRaisesRegex(CalibrationError, "water absorbs [0-9]+ dB.*frequency_hz in recording.yaml"):
            preset.set_shape(start, pings, [])
        preset.set_shape(start, dataclasses.replace(pings, frequency_hz=1.2e6), [])
        self.assertEqual(start.shape["instrument.frequency_hz"], "1.2e+06")

    def test_what_is_refused(self):
        pings = recording_of(noise_of(np.random.default_rng(1))).values.astype(np.uint8)
        row, beam = np.meshgrid(np.arange(RANGES), np.arange(BEAMS), indexing="ij")
        light = 120.0 + 60.0 * np.sin(0.05 * row) * np.cos(0.08 * beam)
        light = light + np.random.default_rng(2).uniform(-2.0, 2.0, (2, RANGES, BEAMS))
        for why, values in (("1 ping: a part is fitted", pings[:1]), ("it is empty", 0 * pings),
                            ("96% of the values are 0: record with more gain", pings * (np.arange(BEAMS) < 4)),
                            ("saturated", np.maximum(pings, 255 * (np.arange(BEAMS) < 24)).astype(np.uint8)),
                            ("photograph", light.astype(np.uint8))):
            self.refused(why, values)
        self.refused("no preset of this name came with the program; there are: aris_3000", pings, start="nobody")
        self.refused("of another kind", pings, start="sidescan_400khz")
        self.refused("--judge", pings, "--judge", "1")
        self.refused("only keys of the water", pings, "--set", "name=x")
        for text, why in (("kind: imaging\n", "nothing to calibrate"), ("[1]", "not a preset"), ("a: [", "is not YAML"),
                          (START + "    lustre: 1\n", "lustre"),
                          (START.replace("\n    mode: ping", " {mode: ping}") + "  pulse: {}\n", "own")):
            (self.folder / "other.yaml").write_text(text)
            self.refused(why, pings, start="other.yaml")

    def test_a_dataset_gives_its_instrument_back(self):
        (self.folder / "plate.obj").write_text("v 3 -3 -1\nv 4 -3 -1\nv 4 3 -1\nv 3 3 -1\nf 1 2 3\nf 1 3 4\n")
        (self.folder / "materials.csv").write_bytes((ROOT / "scenes" / "materials.csv").read_bytes())
        (self.folder / "track.csv").write_text("t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n"
                                               + "".join(f"{0.1 * k},0,0,0,0,0,0\n" for k in range(8)))
        # Speckle of one sample, and of the largest of nine, stretched, whose form and correlations are those of the program.
        for number, known in enumerate(([], ["samples: 9", "expansion: 1.75"])):
            with self.subTest(known=known):
                (self.folder / "start.yaml").write_text(START + "".join(f"    {key}\n" for key in known))
                (self.folder / "mission.yaml").write_text(MISSION.replace("gamma: 0.6", ", ".join(["gamma: 0.6", *known])))
                out = f"out{number}"
                self.sonarsim("render", "mission.yaml", "--out", out, "-q")
                found = self.calibrate(out, "start.yaml")
                for key, truth in TRUTH.items():
                    fitted = found["estimates"][key]
                    half = 0.5 * (fitted["high"] - fitted["low"])
                    self.assertLess(abs(fitted["value"] - truth), 3.3 / 1.96 * half, key)
                self.assertGreaterEqual(found["agree"]["held_out"], 0.9 * len(found["figures"]))
                self.assertGreater(found["agree"]["held_out"], found["agree"]["start"])
                # The program renders the preset.
                written = (self.folder / "mine.yaml").read_text()
                for line in ("  frequency_hz: 1e6  # sheet\n", "\ninstrument:\n  pulse:\n    resolution_m: 0.0"):
                    self.assertIn(line, written)
                head = MISSION.split("sensors:")[0]
                (self.folder / "again.yaml").write_text(head + "sensors: {made: {preset: mine.yaml}}\n")
                self.sonarsim("render", "again.yaml", "--out", f"again-{out}", "-q")

    def test_gain_of_a_scene_without_rows_of_noise_stays_that_of_the_start(self):
        """In a tank echoes fill all ranges; the start is the true preset."""
        self.sonarsim("render", str(ROOT / "configs/tank_calibrated.yaml"), "--set", "trajectory.rate_hz=3", "--out", "tank", "-q")
        found = self.calibrate("tank", "oculus_m1200d_2100khz_10m")
        self.assertNotIn("receiver.full_scale_db", found["estimates"])
        self.assertAlmostEqual(found["estimates"]["receiver.gamma"]["value"], 0.5, delta=0.02)
        self.assertGreaterEqual(found["agree"]["held_out"], found["agree"]["start"])
