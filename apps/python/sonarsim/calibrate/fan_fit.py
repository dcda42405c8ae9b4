"""Fits a preset to fans as a display shows them: grey PNG files of 8 bits, boresight up, black outside of the sector. No
closed form holds for them: the echoes of a scene get noise, gain, grey law and pixels until both have one grey and grain."""
import copy

import numpy as np
from PIL import Image
from scipy import ndimage, optimize

from ..data import Sensor, middles
from .correlations import beam_correlation, predicted_correlations, taper
from .image import Fit
from .judge import Figure
from .levels import Records, is_wide
from .patches import Patches
from .statistics import Bounded, CalibrationError, LogStatistics, bootstrap

RINGS, FULL = 8, 255.0
QUANTILES = 0.1, 0.5, 0.9
# Of the grey in all ranges; in rings of the own and of a usual scene; of the grain's logarithm; of its skewness. Chosen.
GREY_ERROR, RING_ERROR, RING_ERROR_USUAL, GRAIN_ERROR, SKEWNESS_ERROR = 6.0, 6.0, 45.0, 0.04, 0.05
# How far from the start a number is looked for: a standard deviation, and limits.
NUMBERS = {"gamma": (0.25, 0.1, 2.0), "dynamic_range_db": (20.0, 10.0, 200.0), "full_scale_db": (20.0, -300.0, 300.0),
           "noise_db": (8.0, -300.0, 300.0), "tvg_log": (5.0, 0.0, 60.0), "smoothing_px": (1.0, 0.0, 3.0)}
LAWS, SMOOTHING_PX = {"gamma": "gamma", "log": "dynamic_range_db"}, 0.4
BLOCK, MIN_BLOCKS, MIN_GREY = 12, 30, 8.0
MAX_FANS, MAX_PIXELS = 64, 1 << 24
# The heights of a picture may differ by this share; outside, greys deviate by less than this share of those inside.
HEIGHT_TOLERANCE, MAX_OUTSIDE = 0.015, 0.3


class Fans(Sensor):
    """The bins that fans resolve: a pixel in range, and across one at half of the range. `pixels`: [fan, row, column]."""

    def __init__(self, name, pixels, azimuth_deg, range_m):    # pylint: disable=super-init-not-called
        half, (low, high) = 0.5 * np.radians(azimuth_deg), range_m
        self.name, self.range_edges_m, self.azimuth_edges_rad = name, np.array(range_m), np.array([-half, half])
        height, width, pixel_m = self.fan_shape(pixels.shape[2])
        cropped = height - int(low * np.cos(half) / pixel_m) if half < 0.5 * np.pi else height
        if min(abs(pixels.shape[1] - one) for one in (height, cropped)) > max(2.0, HEIGHT_TOLERANCE * height):
            raise CalibrationError(
                f"{name}: the fans are {width} x {pixels.shape[1]} pixels; a fan of {azimuth_deg:g} degrees and "
                f"{low:g} to {high:g} m is {width} x {height}, or {width} x {cropped} without what lies below it: give its "
                "opening and ranges, and cut off margins")
        missing = max(height - pixels.shape[1], 0)
        self.pixels = np.pad(pixels, [(0, 0), (0, missing), (0, 0)])[:, :height]
        self.range_edges_m = np.linspace(low, high, int((high - low) / pixel_m) + 1)
        self.azimuth_edges_rad = np.linspace(-half, half, max(int(half * high / pixel_m), 1) + 1)
        inside = self.to_fan(np.ones((len(self.range_edges_m) - 1, len(self.azimuth_edges_rad) - 1), bool), width)
        if self.pixels[:, ~inside].std() > MAX_OUTSIDE * self.pixels[:, inside].std():
            raise CalibrationError(f"{name}: the fans are not of one grey outside of {azimuth_deg:g} degrees and {low:g} to "
                                   f"{high:g} m: give their opening and ranges")
        self.index = self.from_fan(np.arange(height * width).reshape(height, width))
        varies = np.ptp(self.polar(self.pixels), axis=0).any(axis=0)
        edge = 1 + len(varies) // 50    # 2 %, chosen
        if not (varies[:edge].any() and varies[-edge:].any()):
            raise CalibrationError(f"{name}: the outermost bearings are the same in all fans: cut off margins, or give the opening")

    def __len__(self):
        return len(self.pixels)

    def polar(self, pixels):
        """Fans as float32 [fan, range, beam]: each bin is the pixel that its centre lies in."""
        return pixels.reshape(len(pixels), -1)[:, self.index].astype(np.float32)


def read_fans(folder, azimuth_deg, range_m):
    """The fans of a folder in the order of their names, evenly some of many."""
    paths = sorted(folder.glob("*.png"))
    if len(paths) < 2:
        raise CalibrationError(f"{folder}: has {len(paths)} fans (*.png); a part is fitted and the other judged: give "
                               "two or more, better twenty")
    if not (0.0 < azimuth_deg <= 360.0 and 0.0 <= range_m[0] < range_m[1]):
        raise CalibrationError("--azimuth-deg and --range-m: give the opening, up to 360, and the least and largest range")
    paths = [paths[k] for k in np.unique(np.linspace(0, len(paths) - 1, MAX_FANS).astype(int))]
    pixels = [read_grey(path) for path in paths]
    for path, one in zip(paths, pixels):
        if one.shape != pixels[0].shape:
            raise CalibrationError(f"{path}: has another size than {paths[0].name}: take fans of one setting")
    return Fans(str(folder), np.array(pixels), azimuth_deg, range_m)


def read_grey(path):
    try:
        with Image.open(path, formats=["PNG"]) as picture:
            if picture.width * picture.height > MAX_PIXELS or picture.mode.startswith("I"):
                raise CalibrationError(f"{path}: is not a picture of 8 bits and at most {MAX_PIXELS} pixels")
            colours = np.asarray(picture.convert("RGB"))
    except (OSError, SyntaxError) as fault:
        raise CalibrationError(f"{path}: is not a whole PNG file: {fault}") from fault
    if np.ptp(colours.astype(int), axis=2).max() > 0:
        raise CalibrationError(f"{path}: is in colours; save the fans in grey")
    return colours[:, :, 0]


class Display(Records):
    """Fans of the echoes of a scene."""

    def __init__(self, fans, echoes, start, seed):
        self.fans = fans
        # Beams are formed of the same elements, so they share noise.
        beam, sines = start.instrument["beam"], np.sin(middles(echoes.sensor.azimuth_edges_rad))
        pedestal, half_power = taper(beam["side_lobe_db"])
        apart = np.abs(np.subtract.outer(sines, sines)) * half_power / np.sin(0.5 * np.radians(beam["width_deg"]))
        values, vectors = np.linalg.eigh(np.sqrt(beam_correlation(pedestal, apart)))
        root = (vectors * np.sqrt(np.maximum(values, 0.0))).astype(np.float32).T
        super().__init__(echoes, start, seed, root)
        shape = echoes.amplitude.shape[1:]
        self.index = echoes.sensor.to_fan(np.arange(shape[0] * shape[1]).reshape(shape), fans.pixels.shape[2], -1)

    def pixels(self, law, numbers):
        """Fans [ping, row, column]."""
        values, smoothing_px = super().greys(law, numbers), numbers[-1]
        fan = values.astype(np.float32).reshape(len(values), -1)[:, np.maximum(self.index, 0)] * (self.index >= 0)
        return np.round(ndimage.gaussian_filter(fan, (0.0, smoothing_px, smoothing_px), truncate=3.0))

    def greys(self, law, numbers):
        """[ping, range, beam] at the bins of the fans."""
        return self.fans.polar(self.pixels(law, numbers))


def features(greys):
    """What is matched: quantiles, mean and deviation of the grey in all ranges and in rings; the grain, which is the
    deviation over the mean in blocks of low, middle and high grey; and the skewness of the logarithm of the grey in even
    blocks, which no gain and no gamma change: only smoothing does."""
    rings = np.array([[*np.quantile(ring, QUANTILES), ring.mean(), ring.std()]
                      for ring in (greys, *np.array_split(greys, RINGS, axis=1))])
    pings, rows, columns = greys.shape[0], greys.shape[1] // BLOCK, greys.shape[2] // BLOCK
    blocks = greys[:, :rows * BLOCK, :columns * BLOCK].reshape(pings, rows, BLOCK, columns, BLOCK).swapaxes(2, 3)
    blocks = blocks.reshape(-1, BLOCK, BLOCK)
    mean = blocks.mean(axis=(1, 2))
    usable = (mean > MIN_GREY) & ((blocks >= FULL).mean(axis=(1, 2)) < 0.02) & ((blocks <= 0.0).mean(axis=(1, 2)) < 0.05)
    if usable.sum() < MIN_BLOCKS:
        return rings, np.full(3, np.nan), np.nan
    blocks, mean = blocks[usable], mean[usable]
    # Half the mean square difference of values half a block apart along range, without that of a trend.
    off = blocks[:, BLOCK // 2:] - blocks[:, :BLOCK // 2]
    variance = 0.5 * (off**2).mean(axis=(1, 2)) - 0.5 * off.mean(axis=(1, 2)) ** 2
    grain = np.sqrt(np.maximum(variance, 1e-6)) / mean
    # Edges and texture of a scene make blocks coarser: a low quantile is that of speckle.
    third = np.searchsorted(np.quantile(mean, (1 / 3, 2 / 3)), mean)
    grains = [np.log(np.quantile(grain[third == k], 0.3)) if (third == k).any() else np.nan for k in range(3)]
    even = np.log(np.maximum(blocks[grain <= np.median(grain)], 0.5))
    even -= even.mean(axis=(1, 2), keepdims=True)
    return rings, np.array(grains), (even**3).mean() / (even**2).mean() ** 1.5


def fit_numbers(displays, law, measured, first, ring_error):
    """(cost, law, numbers, their standard errors) with which all displays, one for each window, have the measured features."""
    scale, low, high = np.array([NUMBERS[name] for name in (LAWS[law], *list(NUMBERS)[2:])]).T
    grey_errors = np.array([[GREY_ERROR]] + RINGS * [[ring_error]])

    def residuals(z, greys_alone=False):
        # Offset by 10, since the steps of least_squares are shares of z.
        z = z - 10.0
        out = [z]
        for display, own in zip(displays, measured):
            found = features(display.greys(law, np.clip(first + z * scale, low, high)))
            rings, grains, skewness = (a - b for a, b in zip(found, own))
            out.append((rings / grey_errors).ravel())
            if not greys_alone:
                out += grains / GRAIN_ERROR, [skewness / SKEWNESS_ERROR]
        return np.nan_to_num(np.concatenate(out))
    # The gain may be far off, where all is black or white and no step helps; such fans have no grain that is off.
    shifts = np.arange(-2.0, 2.01, 0.3)
    costs = [np.sum(residuals(10.0 + np.array([0.0, shift, 0.0, 0.0, 0.0]), True) ** 2) for shift in shifts]
    begin = 10.0 + np.array([0.0, shifts[np.argmin(costs)], 0.0, 0.0, 0.0])
    found = optimize.least_squares(residuals, begin, diff_step=[0.005, 0.0025, 0.006, 0.01, 0.01], max_nfev=8)
    errors = scale * np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)) * max(2.0 * found.cost / len(found.fun), 1.0))
    return found.cost, law, np.clip(first + (found.x - 10.0) * scale, low, high), errors


def beam_width(start, sensor, measured, simulated):
    """The width whose correlations across the beams differ from those of the start as fans' do from simulated ones, in
    degrees; None without even patches. In the farther half a beam of the sensor has pixels of its own."""
    beam, found, rows, columns = start.instrument["beam"], [], *measured.shape[1:]
    index = sensor.from_fan(np.arange(rows * columns).reshape(rows, columns))
    for pixels in (measured, simulated):
        patches = Patches(pixels.reshape(len(pixels), -1)[:, index[len(index) // 2:]], FULL,
                          lambda ping: np.log(np.maximum(ping, 0.5)))
        even = patches.even()
        if len(even) < MIN_BLOCKS:
            return None
        found.append(patches.correlations(even))

    sines = np.sin(middles(sensor.azimuth_edges_rad))

    def predicted(width):
        return predicted_correlations({**beam, "width_deg": width}, sines, LogStatistics())
    widths = beam["width_deg"] * np.geomspace(0.4, 2.5, 93)
    table = np.array([predicted(width) for width in widths]) - predicted(beam["width_deg"])
    at_start = found[1](np.ones((1, patches.places)))[0, 1]
    return bootstrap(patches.places, lambda weights: widths[[np.nansum((table - row) ** 2, axis=1).argmin() for row in
                                                             found[0](weights)[:, 1] - at_start]])[0]


def grey_figures(display, fans, law, numbers, where=""):
    """The figures that a display predicts of the greys of fans, [fan, range, beam]."""
    def columns(greys):
        thirds = [part.mean(axis=(1, 2)) for part in np.array_split(greys, 3, axis=1)]
        return np.stack([greys.mean(axis=(1, 2)), (greys**2).mean(axis=(1, 2)), *thirds,
                         *np.quantile(greys, (0.5, 0.9, 0.99), axis=(1, 2))], axis=1)

    def estimate(weights, of):
        mean, square, *others = (weights @ of / weights.sum(axis=1)[:, None]).T
        return np.stack([mean, np.sqrt(np.maximum(square - mean**2, 0.0)), *others], axis=1)
    fan_columns, scene_columns = columns(fans), columns(display.greys(law, numbers))
    measured = bootstrap(len(fan_columns), lambda weights: estimate(weights, fan_columns))
    names = "mean", "standard deviation", "mean, near", "mean, middle", "mean, far", "50 %", "90 %", "99 %"
    return [Figure(f"grey: {name}{where}", 0.1, float(value), of) for name, value, of in zip(
        names, estimate(np.ones((1, len(scene_columns))), scene_columns)[0], measured)]


def fit_fans(windows, start, full_scale_db, ring_error):
    """(Fit, figures) of the windows of a sonar: fitted and judged pictures [fan, row, column], the Fans and the Echoes."""
    fit, receiver = Fit(copy.deepcopy(start.instrument), 0.0), start.instrument["receiver"]
    displays = [[Display(fans, echoes, start, seed) for _, fans, echoes in windows] for seed in (1, 2)]
    greys = [[fans.polar(part) for part in parts] for parts, fans, _ in windows]
    measured, begin = [features(own[0]) for own in greys], {law: np.array([
        receiver[key], full_scale_db[law], start.noise_db, receiver["tvg_log"], SMOOTHING_PX]) for law, key in LAWS.items()}
    _, law, numbers, errors = min((fit_numbers(displays[0], law, measured, first, ring_error)
                                   for law, first in begin.items()), key=lambda found: found[0])
    fit.set("receiver.companding", law)
    for k, name in reversed([*enumerate((LAWS[law], "full_scale_db", "noise_db", "tvg_log"))]):
        number = Bounded(numbers[k], numbers[k] - 1.96 * errors[k], numbers[k] + 1.96 * errors[k])
        if errors[k] <= 0.9 * NUMBERS[name][0] and not is_wide(name, number):
            fit.set(f"receiver.{name}", number)
            continue
        fit.notes.append(f"{name}: the fans hardly show it; that of the start is kept")
        numbers[k] = begin[law][k]
        if name == "tvg_log":   # the level in the middle stays
            numbers[1] += (numbers[k] - number.value) * np.log10(np.mean(windows[0][1].range_edges_m))
    (parts, _, echoes), *_ = windows
    width = beam_width(start, echoes.sensor, parts[0], displays[0][0].pixels(law, numbers))
    if width is None or is_wide("width_deg", width):
        fit.notes.append("beam.width_deg: the fans hardly show it; that of the start is kept")
    else:
        fit.set("beam.width_deg", width)
    if numbers[-1] > 0.6:
        fit.notes.append(f"the fans are smoothed, as by a Gaussian of {numbers[-1]:.1f} pixels, which no key does")
    at_start = "log" if receiver["companding"] == "log" else "gamma"
    rows = []
    for k, own in enumerate(greys):
        chosen = (displays[1][k], own[1], at_start, begin[at_start]), *((of[k], part, law, numbers)
                                                                        for of, part in zip(displays, own))
        rows += zip(*(grey_figures(*one, f", window {k + 1}" * (len(greys) > 1)) for one in chosen))
    return fit, rows


def vary_block(fit):
    """The lines that vary the fitted numbers in a mission: the law by its interval, gain and noise by 2 dB."""
    lines = ["vary:  # for a mission with this preset; NAME is that of its sonar"]
    for key, value in fit.estimates.items():
        name = key.removeprefix("receiver.")
        if name in ("full_scale_db", "noise_db"):
            value = Bounded(value.value, value.value - 2.0, value.value + 2.0)
        elif name not in ("gamma", "dynamic_range_db"):
            continue
        lines.append(f"  - {{key: sensors.NAME.instrument.{key}, uniform: [{value.low:.4g}, {value.high:.4g}]}}")
    return lines
