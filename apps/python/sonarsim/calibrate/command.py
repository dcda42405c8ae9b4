"""The command `sonarsim calibrate`."""
import argparse
import json
import os
import pathlib
import sys

from ..recording import RecordingError, open_recording
from .image import fit_image
from .judge import figures_of
from .law import full_value_of
from .preset import new_keys, read_start, set_shape, with_keys
from .report import Calibration
from .soundings import calibrate_soundings
from .statistics import CalibrationError

MOST_FULL, MOST_ZEROS = 0.1, 0.9


def check_usable(recording, kind):
    """CalibrationError with the reason if a recording cannot be calibrated."""
    if recording.kind != kind:
        raise CalibrationError(f"the preset is of a sonar of another kind ({kind}) than the recording "
                               f"({recording.kind}): choose a preset of its kind (soundings: a profiling sonar)")
    if len(recording) < 2:
        raise CalibrationError(f"{len(recording)} ping: one part of the pings is fitted and the other judged, so it "
                               "takes two or more")
    if recording.kind == "soundings":
        return
    values = recording.values
    largest = full_value_of(recording) * (1.0 - recording.law.offset)
    # Values are rounded to whole numbers, unless all lie below 15.
    full = (values >= (largest - 0.5 if largest > 15.0 else largest)).mean()
    zeros = (values <= 0.0).mean()
    if values.min() == values.max():
        raise CalibrationError("every value is the same: it is empty")
    if zeros > MOST_ZEROS:
        raise CalibrationError(f"{100 * zeros:.0f} % of the values are 0: record with more gain")
    if full > MOST_FULL:
        raise CalibrationError(f"{100 * full:.0f} % of the values are the largest one: it is saturated; record with "
                               "less gain")


def split(recording, judged_share, is_reversed):
    """(fitted, judged) parts: the last pings are judged, at least one; `is_reversed`: the first."""
    judged = min(max(int(judged_share * len(recording)), 1), len(recording) - 1)
    if is_reversed:
        return recording.part(slice(judged, None)), recording.part(slice(0, judged))
    cut = len(recording) - judged
    return recording.part(slice(0, cut)), recording.part(slice(cut, None))


def calibrate(recording, preset, judged_share=0.5, is_reversed=False, slope_rad=0.0, settings=()):
    """(Calibration, text of the new preset) of a recording and the name or file of a preset."""
    file, start = read_start(preset, settings)
    try:
        check_usable(recording, start.kind)
        fitted, judged = parts = split(recording, judged_share, is_reversed)
        keys = {}
        if recording.kind == "soundings":
            result = Calibration(recording.name, len(fitted), len(judged), *calibrate_soundings(parts, start, slope_rad))
        else:
            set_shape(file, start, fitted, settings)
            fit = fit_image(fitted, start)
            keys = new_keys(start, fit)
            result = Calibration(recording.name, len(fitted), len(judged), judged_figures(parts, start, fit), fit.notes,
                                 fit.estimates)
    except CalibrationError as fault:
        raise CalibrationError(f"{recording.name}: {fault}") from fault
    result.note_change()
    head = (f"# Fitted by sonarsim calibrate to {len(fitted)} pings of {recording.name}, from {preset}.\n"
            "# A number with `fit` was estimated, with its interval of 95 %; `file` is the shape of the pings.\n"
            "# All others are those of the start, whose own head follows.\n#\n")
    return result, head + with_keys(start.text, keys, file)


def judged_figures(parts, start, fit):
    """The figures that the start and the fit both predict: (start, fitted pings, judged pings)."""
    fitted, judged = parts
    absorption = start.absorption_db_per_m
    before = figures_of(judged, start.instrument, start.noise_db - start.full_scale_db, absorption, fit.noise)
    inside, outside = (figures_of(part, fit.instrument, fit.level_db, absorption, fit.noise) for part in parts)
    named = [{figure.name: figure for figure in figures} for figures in (before, inside)]
    return [(named[0][f.name], named[1][f.name], f) for f in outside if all(f.name in of for of in named)]


def write(path, text):
    """Writes a file under a temporary name first, so that nothing half-written is left."""
    path = pathlib.Path(path)
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(path)
    except OSError as fault:
        temporary.unlink(missing_ok=True)
        raise CalibrationError(f"{path}: cannot be written: {fault.strerror}") from fault


def share(text):
    value = float(text)
    if not 0.01 <= value <= 0.99:
        raise argparse.ArgumentTypeError("must lie between 0.01 and 0.99")
    return value


def parsed(arguments):
    parser = argparse.ArgumentParser("sonarsim calibrate", description=(
        "Fits a preset to pings of a real sonar and judges it by other pings"))
    parser.add_argument("recording", help="the pings: a folder with recording.yaml, or a dataset")
    parser.add_argument("--preset", required=True, metavar="START",
                        help="the preset to start with: a file, or the name of one of configs/sensors")
    parser.add_argument("--out", required=True, metavar="PRESET", help="the preset to write")
    parser.add_argument("--report", metavar="FILE", help="writes all numbers as JSON")
    parser.add_argument("--judge", type=share, default=0.5, metavar="SHARE",
                        help="the share of the pings that is judged and not fitted, the last ones (default: 0.5)")
    parser.add_argument("--reverse", action="store_true", help="judges the first pings and fits the last ones")
    parser.add_argument("--slope-deg", type=float, default=0.0, metavar="DEG",
                        help="slope of the bottom across the track, positive down to port; for soundings")
    parser.add_argument("--sensor", metavar="NAME", help="the sensor of a dataset with several")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
                        help="sets a key, as water.temperature_c=20 or sensors.sonar.instrument.beam.width_deg=1")
    parser.add_argument("--json", action="store_true", help="prints JSON instead of text")
    parser.add_argument("-q", "--quiet", action="store_true", help="prints no table")
    return parser.parse_args(arguments)


def main(arguments=None):
    """The exit code: 0, or 2 for a bad input."""
    options = parsed(arguments)
    try:
        recording = open_recording(options.recording, sensor=options.sensor)
        result, text = calibrate(recording, options.preset, options.judge, options.reverse,
                                 options.slope_deg * 3.141592653589793 / 180.0, options.settings)
        write(options.out, text)
        numbers = json.dumps(result.json())
        if options.report:
            write(options.report, numbers + "\n")
    except (RecordingError, CalibrationError) as fault:
        print(f"sonarsim calibrate: {fault}", file=sys.stderr)
        return 2
    if options.json:
        print(numbers)
    elif not options.quiet:
        print(result.text())
    return 0
