"""Fans as a display shows them: grey PNG files of 8 bits, boresight up, black outside of the sector."""
import numpy as np
from PIL import Image

from ..data import Sensor
from .statistics import CalibrationError

MAX_FANS, MAX_PIXELS = 64, 1 << 24
# The heights of a picture may differ by this share; outside, greys deviate by less than this share of those inside.
HEIGHT_TOLERANCE, MAX_OUTSIDE = 0.015, 0.3


class Fans(Sensor):
    """The bins that fans resolve: a pixel in range, and across a pixel at half of the range. `pixels`: [fan, row, column],
    with the sonar at the bottom."""

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
