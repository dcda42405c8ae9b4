"""The command `sonarsim calibrate`."""
import argparse
import contextlib
import copy
import json
import math
import pathlib

import numpy as np

from ..command import replaced, run
from ..recording import open_recording
from .fan_fit import LAWS, RING_ERROR, RING_ERROR_USUAL, fit_fans, read_fans, vary_block
from .image import fit_image, joined
from .judge import MAX_WHITE, check_judged, figures_of, is_worse, judge
from .law import full_value_of
from .levels import fit_levels
from .preset import new_keys, read_start, set_levels, set_shape, with_key
from .scene import Echoes, own_mission, usual_mission
from .statistics import Bounded, CalibrationError

SCENE_DECIDES = ("the scene decides law and noise: two scenes of one sonar differed by 20 dB, and the intervals are of this "
                 "scene alone")
LEVEL_KEYS = "receiver.full_scale_db", "receiver.noise_db", "receiver.tvg_log"


def result_of(name, pings, figures, notes, estimates):
    """The result as it stands in JSON. `figures`: (start, fitted pings, judged pings), each a Figure."""
    def column(figure):
        return None if figure.predicted is None else {
            "predicted": figure.predicted, "measured": figure.measured._asdict(), "agrees": bool(figure.agrees)}
    fitted = {key.split(".")[-1] for key in estimates}      # perhaps after a note that it is not
    notes = [one for one in notes if "the start is kept" not in one or one.split(":")[0].split(".")[-1] not in fitted]
    changed = sum(a.measured.low > b.measured.high or a.measured.high < b.measured.low for _, a, b in figures)
    if 5 * changed > len(figures):
        notes = [*notes, f"{changed} of {len(figures)} figures of the judged pings lie outside the intervals of the "
                 "fitted ones: the scene or the sonar changed between them"]
    columns = "start", "in_sample", "held_out"
    return {"recording": name, "pings_fitted": pings[0], "pings_judged": pings[1],
            "estimates": {key: value._asdict() if isinstance(value, Bounded) else value for key, value in estimates.items()},
            "figures": [{"figure": row[0].name, **dict(zip(columns, map(column, row)))} for row in figures],
            "agree": {of: sum(bool(row[k].agrees) for row in figures) for k, of in enumerate(columns)}, "notes": notes}


def table_of(result):
    def interval(number):
        return str(Bounded(**number)) if isinstance(number, dict) else str(number)

    def text(number):
        return f"{'-':>11}" if number is None else f"{number:11.4g}"

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
    if "rendered" in result:
        lines += ["", f"{'figure of a rendered pass':50} {'judged pings':>12} {'start':>15} {'fit':>15}"]
        lines += [f"{row['figure']:50} {row['judged']:12.4g} {text(row['start'])} {verdict[row['start_agrees']]} "
                  f"{text(row['fit'])} {verdict[row['agrees']]}" for row in result["rendered"]["rows"]]
        lines.append("{figures} figures of a rendered pass: {start} of the start agree with the judged pings, {fit} of the "
                     "fit".format(**result["rendered"]))
    return "\n".join([*lines, *(f"- {note}" for note in result["notes"])])


def check_usable(recording, kind):
    """CalibrationError with the reason if a recording cannot be calibrated."""
    if recording.kind != kind:
        raise CalibrationError(f"the preset is of another kind ({kind}) than the recording ({recording.kind}): choose "
                               "a preset of its kind")
    if kind == "soundings":
        raise CalibrationError("soundings determine no key of a preset; sonarsim compare shows how they differ")
    if len(recording) < 2:
        raise CalibrationError(f"{len(recording)} ping: a part is fitted and the other judged, so it takes two or more")
    check_values(recording.values, full_value_of(recording) * (1.0 - recording.law.offset))


def check_values(values, largest):
    if values.shape[1] < 24:
        raise CalibrationError("fewer than 24 ranges: record longer pings, or save larger fans")
    # Values are rounded to whole numbers, unless all lie below 15.
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


def calibrate(recordings, options):
    """(result as in JSON, text of the new preset) of the recordings of one sonar, each with a window of its own."""
    start = read_start(options.preset)
    check_settings(options.settings)
    name = recordings[0].name + (f" and {len(recordings) - 1} more" if len(recordings) > 1 else "")
    try:
        for recording in recordings:
            check_usable(recording, start.kind)
        notes = [note for one in recordings for note in one.notes]
        windows = [[one.part(of) for of in split(len(one), options.judge, options.reverse)] for one in recordings]
        pings = [sum(len(parts[k]) for parts in windows) for k in (0, 1)]
        source = f"{pings[0]} pings of {name}, from {options.preset}"
        starts = [copy.deepcopy(start) for _ in windows]
        for own, (part, _) in zip(starts, windows):
            set_shape(own, part, options.settings)
        fits = [fit_image(part, own) for own, (part, _) in zip(starts, windows)]
        fit, start = joined(fits), starts[0]
        shaped = [*zip(starts, windows)]
        # Of a dataset without a mission nothing is rendered: its scene is known to be another, and its law to be single speckle.
        passes = None
        if options.mission or not all((pathlib.Path(one) / "dataset.json").exists() for one in options.recordings):
            fit, text, *passes = fit_by_passes(shaped, start, fit, source, options)
            figures = all_figures(shaped, fits)
        else:
            figures = fit_by_figures(shaped, fits, fit)
            fit.notes.append(SCENE_DECIDES)
            text = text_of(start, new_keys(start, fit), source)
        result = result_of(name, pings, figures, [*notes, *fit.notes], fit.estimates)
        if passes:
            result["rendered"] = table_of_passes(*passes)
    except CalibrationError as fault:
        raise CalibrationError(f"{name}: {fault}") from fault
    return result, text


def fit_by_passes(shaped, start, fit, source, options):
    """(fit, text of its preset, pass of the start, pass of the fit). Gain and noise are by the noise of the start; if that
    makes a rendered pass worse, by the levels of a scene or those of the start. CalibrationError if no fit is better."""
    more = options.mission, options.settings
    before, tried = judge(shaped, start.text, *more), []
    for way in ("noise", "scene", "start"):
        one = copy.deepcopy(fit)
        if way == "noise" and "receiver.full_scale_db" not in fit.estimates:
            continue
        if way == "scene":
            fit_levels([(part, own) for own, (part, _) in shaped], start, one, *more)
        elif way == "start":
            for key in LEVEL_KEYS:
                one.estimates.pop(key, None)
            one.notes = [note for note in one.notes if not note.startswith("full_scale_db is fitted")]
        one.notes += {"noise": [SCENE_DECIDES], "scene": [], "start": [
            "gain and noise are those of the start, with which more figures of a rendered pass agree", SCENE_DECIDES]}[way]
        text = text_of(start, new_keys(start, one), source)
        after = judge(shaped, text, *more)
        tried.append((after.white <= MAX_WHITE, after.agree[0], -len(tried), after, text, one))
        if way == "noise" and not is_worse(after, before, 0):
            break
    *_, after, text, fit = max(tried, key=lambda of: of[:3])
    check_judged(after, before, fit.lacks)
    return fit, text, before, after


def all_figures(shaped, fits):
    return [row for (own, parts), one in zip(shaped, fits) for row in closed_figures(own, parts, one)]


def fit_by_figures(shaped, fits, fit):
    """The figures of a fit, with the start's gain and noise if more agree with these; CalibrationError if more still do."""
    while True:
        rows = all_figures(shaped, fits)
        lost = sum(row[0].agrees for row in rows) - sum(row[2].agrees for row in rows)
        levels = [key for key in LEVEL_KEYS if key in fit.estimates]
        if lost <= 0:
            return rows
        if not levels:
            raise CalibrationError(f"{lost} figures of the judged pings fewer agree with the fit than with the start, so it is "
                                   "not written: name a mission with their scene by --mission")
        for key in levels:
            del fit.estimates[key]
        for (start, _), one in zip(shaped, fits):
            one.level_db = start.noise_db - start.full_scale_db
            for name in ("full_scale_db", "noise_db", "tvg_log", "tvg_absorption"):
                one.instrument["receiver"][name] = start.instrument["receiver"].get(name)
        fit.notes[:] = [note for note in fit.notes if not note.startswith(("full_scale_db", "receiver.tvg_log"))]
        fit.notes.append("gain and noise are those of the start, with which more figures agree")


def table_of_passes(before, after):
    rows = [(a, b) for old, new in zip(before.rows, after.rows) for b in new for a in old if a[:2] == b[:2]]
    return {"figures": len(rows), "start": before.agree[1], "fit": after.agree[1], "rows": [
        {"group": a[0], "figure": a[1], "judged": a[2], "start": number(a[3]), "fit": number(b[3]),
         "start_agrees": bool(a[4]), "agrees": bool(b[4])} for a, b in rows]}


def number(value):
    return float(value) if math.isfinite(value) else None


def closed_figures(start, parts, fit):
    """The figures that the start and the fit both predict."""
    if fit.law is None:
        return []
    before = figures_of(parts[1], start.instrument, start.noise_db - start.full_scale_db, start, fit)
    rows = [before, *(figures_of(part, fit.instrument, fit.level_db, start, fit) for part in parts)]
    named = [{figure.name: figure for figure in figures} for figures in rows]
    return [tuple(of[name] for of in named) for name in named[2] if name in named[0] and name in named[1]]


def text_of(start, keys, source, more=()):
    """The text of the new preset. `more`: lines of its head."""
    text = start.text
    for key, (value, comment) in keys.items():
        text = with_key(text, key, value, comment, start.file)
    return "".join(f"# {line}".rstrip() + "\n" for line in (f"Fitted by sonarsim calibrate to {source}.",
        "`fit`: a number that was estimated, with its interval of 95 %; `file`: shape and law of the pings.", *more,
        "All others are those of the start, whose own head follows.", "")) + text


def calibrate_fans(options):
    """As calibrate(), of folders of pictures, one for each window."""
    start = read_start(options.preset)
    check_settings(options.settings)
    if start.kind != "imaging":
        raise CalibrationError(f"{options.preset}: is no imaging sonar, and only these have fans")
    if options.azimuth_deg is None or len(options.range_m or []) != 2 * len(options.recordings):
        raise CalibrationError("fans need both --azimuth-deg and --range-m, with two numbers for each folder")
    windows, starts, full_scale_db = [], [], {}
    for folder, range_m in zip(options.recordings, zip(options.range_m[::2], options.range_m[1::2])):
        fans = read_fans(pathlib.Path(folder), options.azimuth_deg, range_m)
        try:
            check_values(fans.polar(fans.pixels), 255.0)
        except CalibrationError as fault:
            raise CalibrationError(f"{folder}: {fault}") from fault
        # The judged ones lie evenly between the others: the scene changes on the way.
        order = np.argsort(np.modf(np.arange(len(fans)) * options.judge + options.judge)[0] < options.judge, kind="stable")
        parts = [fans.pixels[np.sort(order[of])] for of in split(len(fans), options.judge, options.reverse)]
        own = copy.deepcopy(start)
        own.shape = {"azimuth_deg": options.azimuth_deg, "range_min_m": range_m[0], "range_max_m": range_m[1]}
        mission, name, paths_from = usual_mission("imaging", range_m[1]), "sonar", None
        if options.mission:
            (mission, name), paths_from = own_mission(options.mission, options.sensor), options.mission.absolute().parent
        water = [f"water.{key}={value}" for key, value in (mission.get("water") or {}).items()
                 if not isinstance(value, (dict, list))]
        # Full scale follows another rule where a record has a logarithm.
        for law in LAWS:
            set_levels(own, [*water, *options.settings, f"sensors.sonar.instrument.receiver.companding={law}"])
            full_scale_db.setdefault(law, own.full_scale_db)
        set_levels(own, [*water, *options.settings])
        starts.append(own)
        windows.append((parts, fans, Echoes(own, mission, name, paths_from, options.settings)))
    fit, figures = fit_fans(windows, starts[0], full_scale_db, RING_ERROR if options.mission else RING_ERROR_USUAL)
    fit.notes.append(SCENE_DECIDES if options.mission else "gain and noise are those that give sand with rocks the greys of "
                     f"the fans; name a mission with a scene like theirs by --mission. {SCENE_DECIDES}")
    pings, name = [sum(len(parts[k]) for parts, *_ in windows) for k in (0, 1)], windows[0][1].name
    agree, off = (np.array([[score(row[k]) for k in (0, 2)] for row in figures]).sum(axis=0) for score in (
        lambda figure: figure.agrees, lambda figure: abs(figure.predicted - figure.measured.value)))
    if agree[1] < agree[0] and off[1] > off[0]:
        raise CalibrationError(f"{name}: {agree[0] - agree[1]} figures of the judged fans fewer agree with the fit than with "
                               "the start, so it is not written: name a mission with their scene by --mission")
    result = result_of(name, pings, figures, fit.notes, fit.estimates)
    start = starts[0]
    return result, text_of(start, new_keys(start, fit), f"{pings[0]} fans of {name}, from {options.preset}", vary_block(fit))


def fit_preset(options):
    """Fits a preset, writes it, and prints the result."""
    if options.azimuth_deg is not None or options.range_m is not None:
        result, text = calibrate_fans(options)
    else:
        result, text = calibrate([open_recording(one, sensor=options.sensor).without_margins() for one in options.recordings],
                                 options)
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
    add("recordings", nargs="+", metavar="recording",
        help="the pings: a folder with recording.yaml, a dataset, or a folder of fans (*.png); several: windows of one sonar")
    add("--preset", required=True, metavar="START", help="the start: a file, or the name of one of configs/sensors")
    add("--out", required=True, metavar="PRESET", help="the preset to write")
    add("--report", metavar="FILE", help="writes all numbers as JSON")
    add("--judge", type=float, default=0.5, metavar="SHARE", help="the share of pings to judge (default: 0.5)")
    add("--reverse", action="store_true", help="judges the first pings and fits the last ones")
    add("--sensor", metavar="NAME", help="the sensor of a dataset, or of --mission, with several")
    add("--azimuth-deg", type=float, metavar="DEG", help="of fans: the opening")
    add("--range-m", type=float, nargs="+", metavar="METRES", help="of fans: least and largest, of each folder")
    add("--mission", metavar="FILE", type=pathlib.Path,
        help="a mission with a scene like that of the pings (default: a level bottom, that of fans with rocks)")
    add("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
        help="sets a key of the water, as water.temperature_c=20")
    add("--json", action="store_true", help="prints JSON instead of text")
    add("-q", "--quiet", action="store_true", help="prints no table")
    return run("calibrate", fit_preset, parser.parse_args(arguments))
