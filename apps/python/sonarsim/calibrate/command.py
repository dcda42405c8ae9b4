"""The command `sonarsim calibrate`."""
import argparse
import contextlib
import json
import math
import pathlib

import numpy as np

from ..command import replaced, run
from ..recording import open_recording
from .fan_fit import RING_ERROR, RING_ERROR_USUAL, fit_fans, vary_block
from .fans import read_fans
from .image import fit_image
from .judge import figures_of
from .law import full_value_of
from .preset import new_keys, read_start, set_levels, set_shape, with_key
from .scene import Echoes, own_mission, usual_mission
from .soundings import NOTES, soundings_figures
from .statistics import Bounded, CalibrationError


def result_of(name, pings, figures, notes, estimates):
    """The result as it stands in JSON. `figures`: (start, fitted pings, judged pings), each a Figure."""
    def column(figure):
        return None if figure.predicted is None else {
            "predicted": figure.predicted, "measured": figure.measured._asdict(), "agrees": bool(figure.agrees)}
    changed = sum(a.measured.low > b.measured.high or a.measured.high < b.measured.low for _, a, b in figures)
    if 5 * changed > len(figures):
        notes = [*notes, f"{changed} of {len(figures)} figures of the judged pings lie outside the intervals of the "
                 "fitted ones: the scene or the sonar changed between them"]
    columns = "start", "in_sample", "held_out"
    return {"recording": name, "pings_fitted": pings[0], "pings_judged": pings[1],
            "estimates": {key: value._asdict() if isinstance(value, Bounded) else value
                          for key, value in estimates.items()},
            "figures": [{"figure": row[0].name, **dict(zip(columns, map(column, row)))} for row in figures],
            "agree": {of: sum(bool(row[k].agrees) for row in figures) for k, of in enumerate(columns)}, "notes": notes}


def table_of(result):
    def interval(number):
        return str(Bounded(**number)) if isinstance(number, dict) else str(number)

    verdict = {True: "yes", False: " NO"}
    lines = [f"{result['recording']}: {result['pings_fitted']} pings fitted, {result['pings_judged']} judged", "",
             *(f"  {key:28} {interval(number)}" for key, number in result["estimates"].items()), "",
             f"{'figure':44} {'start':>14} {'fit, fitted pings':>41} {'fit, judged pings':>41}"]
    for row in result["figures"]:
        start = f"{row['start']['predicted']:10.4g} {verdict[row['start']['agrees']]}" if row["start"] else f"{'-':>14}"
        fits = [f"{c['predicted']:9.4g} {interval(c['measured']):>27} {verdict[c['agrees']]}"
                for c in (row["in_sample"], row["held_out"])]
        lines.append(f"{row['figure']:44} {start} {' '.join(fits)}")
    lines.append("{} figures agree: {start} of the start, {in_sample} of the fit with the fitted pings, "
                 "{held_out} with the judged ones".format(len(result["figures"]), **result["agree"]))
    return "\n".join([*lines, *(f"- {note}" for note in result["notes"])])


def check_usable(recording, kind):
    """CalibrationError with the reason if a recording cannot be calibrated."""
    if recording.kind != kind:
        raise CalibrationError(f"the preset is of another kind ({kind}) than the recording ({recording.kind}): choose "
                               "a preset of its kind (soundings: a profiling sonar)")
    if len(recording) < 2:
        raise CalibrationError(f"{len(recording)} ping: a part is fitted and the other judged, so it takes two or more")
    if recording.kind == "soundings":
        return
    if recording.values.shape[1] < 24:
        raise CalibrationError("fewer than 24 ranges: record longer pings")
    # Values are rounded to whole numbers, unless all lie below 15.
    values, largest = recording.values, full_value_of(recording) * (1.0 - recording.law.offset)
    full = (values >= (largest - 0.5 if largest > 15.0 else largest)).mean()
    if values.min() == values.max():
        raise CalibrationError("every value is the same: it is empty")
    for share, most, why in (((values <= 0.0).mean(), 0.9, "0: record with more gain"),
                             (full, 0.1, "the largest one, it is saturated: record with less gain")):
        if share > most:
            raise CalibrationError(f"{share:.0%} of the values are {why}")


def split(count, judged_share, is_reversed):
    """The slices of fitted and judged pings: the last are judged, at least one; `is_reversed`: the first."""
    if not 0.01 <= judged_share <= 0.99:
        raise CalibrationError("--judge: the share must lie between 0.01 and 0.99")
    judged = min(max(int(judged_share * count), 1), count - 1)
    cut = judged if is_reversed else count - judged
    parts = slice(0, cut), slice(cut, None)
    return parts[::-1] if is_reversed else parts


def check_settings(settings):
    if not all(setting.startswith("water.") for setting in settings):
        raise CalibrationError("--set: sets only keys of the water; write others into the preset")


def calibrate(recording, preset, judged_share=0.5, is_reversed=False, slope_rad=0.0, settings=()):
    """(result as in JSON, text of the new preset) of a recording and the name or file of a preset."""
    start = read_start(preset)
    check_settings(settings)
    try:
        check_usable(recording, start.kind)
        parts = [recording.part(of) for of in split(len(recording), judged_share, is_reversed)]
        pings, keys = [len(part) for part in parts], {}
        if recording.kind == "soundings":
            result = result_of(recording.name, pings, soundings_figures(parts, slope_rad), NOTES, {})
        else:
            set_shape(start, parts[0], settings)
            fit = fit_image(parts[0], start)
            keys = new_keys(start, fit)
            # The figures that the start and the fit both predict.
            before = figures_of(parts[1], start.instrument, start.noise_db - start.full_scale_db, start, fit)
            rows = [before, *(figures_of(part, fit.instrument, fit.level_db, start, fit) for part in parts)]
            named = [{figure.name: figure for figure in figures} for figures in rows]
            figures = [tuple(of[name] for of in named) for name in named[2] if name in named[0] and name in named[1]]
            result = result_of(recording.name, pings, figures, fit.notes, fit.estimates)
    except CalibrationError as fault:
        raise CalibrationError(f"{recording.name}: {fault}") from fault
    return result, text_of(start, keys, f"{pings[0]} pings of {recording.name}, from {preset}")


def text_of(start, keys, source, more=()):
    """The text of the new preset. `more`: lines of its head."""
    text = start.text
    for key, (value, comment) in keys.items():
        text = with_key(text, key, value, comment, start.file)
    return "".join(f"# {line}".rstrip() + "\n" for line in (
        f"Fitted by sonarsim calibrate to {source}.",
        "`fit`: a number that was estimated, with its interval of 95 %; `file`: the shape of the pings.", *more,
        "All others are those of the start, whose own head follows.", "")) + text


def calibrate_fans(options):
    """As calibrate(), of a folder of pictures."""
    start = read_start(options.preset)
    check_settings(options.settings)
    if start.kind != "imaging":
        raise CalibrationError(f"{options.preset}: is no imaging sonar, and only these have fans")
    if options.azimuth_deg is None or options.range_m is None:
        raise CalibrationError("fans need both --azimuth-deg and --range-m")
    fans = read_fans(pathlib.Path(options.recording), options.azimuth_deg, options.range_m)
    # The judged ones lie evenly between the others: the scene changes on the way.
    order = np.argsort(np.modf(np.arange(len(fans)) * options.judge + options.judge)[0] < options.judge, kind="stable")
    parts = [fans.pixels[np.sort(order[of])] for of in split(len(fans), options.judge, options.reverse)]
    start.shape = {"azimuth_deg": options.azimuth_deg, "range_min_m": options.range_m[0], "range_max_m": options.range_m[1]}
    mission, name, paths_from = usual_mission(options.range_m[1]), "sonar", None
    if options.mission:
        path = pathlib.Path(options.mission)
        (mission, name), paths_from = own_mission(path, options.sensor), path.absolute().parent
    water = [f"water.{key}={value}" for key, value in (mission.get("water") or {}).items() if not isinstance(value, (dict, list))]
    set_levels(start, [*water, *options.settings])
    fit, figures = fit_fans(parts, fans, Echoes(start, mission, name, paths_from, options.settings), start,
                            RING_ERROR if paths_from else RING_ERROR_USUAL)
    if not paths_from:
        fit.notes.append("gain and noise are those that give sand with rocks the greys of the fans; name a mission with a "
                         "scene like theirs by --mission")
    pings = [len(part) for part in parts]
    result = result_of(fans.name, pings, figures, fit.notes, fit.estimates)
    return result, text_of(start, new_keys(start, fit), f"{pings[0]} fans of {fans.name}, from {options.preset}",
                           vary_block(fit))


def fit_preset(options):
    """Fits a preset, writes it, and prints the result."""
    if options.azimuth_deg is not None or options.range_m is not None or options.mission:
        result, text = calibrate_fans(options)
    else:
        recording = open_recording(options.recording, sensor=options.sensor)
        result, text = calibrate(recording, options.preset, options.judge, options.reverse,
                                 math.radians(options.slope_deg), options.settings)
    with contextlib.ExitStack() as files:
        files.enter_context(replaced(options.out)).write_text(text, "utf-8")
        if options.report:
            files.enter_context(replaced(options.report)).write_text(json.dumps(result) + "\n", "utf-8")
    if options.json or not options.quiet:
        print(json.dumps(result) if options.json else table_of(result))


def main(arguments=None):
    parser = argparse.ArgumentParser("sonarsim calibrate", description=(
        "Fits a preset to pings of a real sonar and judges it by other pings"))
    add = parser.add_argument
    add("recording", help="the pings: a folder with recording.yaml, a dataset, or a folder of fans (*.png)")
    add("--preset", required=True, metavar="START", help="the start: a file, or the name of one of configs/sensors")
    add("--out", required=True, metavar="PRESET", help="the preset to write")
    add("--report", metavar="FILE", help="writes all numbers as JSON")
    add("--judge", type=float, default=0.5, metavar="SHARE", help="the share of pings to judge (default: 0.5)")
    add("--reverse", action="store_true", help="judges the first pings and fits the last ones")
    add("--slope-deg", type=float, default=0.0, metavar="DEG", help="slope of the bottom under soundings, down to port")
    add("--sensor", metavar="NAME", help="the sensor of a dataset, or of --mission, with several")
    add("--azimuth-deg", type=float, metavar="DEG", help="of fans: the opening")
    add("--range-m", type=float, nargs=2, metavar=("MIN", "MAX"), help="of fans: the ranges")
    add("--mission", metavar="FILE", help="of fans: a mission with a scene like theirs (default: sand with rocks)")
    add("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
        help="sets a key of the water, as water.temperature_c=20")
    add("--json", action="store_true", help="prints JSON instead of text")
    add("-q", "--quiet", action="store_true", help="prints no table")
    return run("calibrate", fit_preset, parser.parse_args(arguments))
