"""A rendered pass of the start and of the fit beside the judged pings, and the fits that are not written."""
import dataclasses

import numpy as np

from ..compare.bootstrap import tolerance_of
from ..compare.comparison import measure_both
from ..compare.figure import value_of
from .levels import scenes_of
from .scene import pass_of, with_shape
from .statistics import CalibrationError

MAX_WHITE = 0.05


def rows_beside(judged, simulated):
    """(group, figure, judged, simulated, agrees) of each figure of the judged pings, NaN where the other has none. Values of both are taken by the law of the
    judged pings, so the law of the instrument counts as well as its gain."""
    full = simulated.law.full_value
    simulated = dataclasses.replace(simulated, law=dataclasses.replace(judged.law, full_value=full if judged.law.full_value
                                                                       else 0.0))
    _, _, measured = measure_both((judged, simulated), judged.law.full_value == 0.0, False)
    others, rows = {figure.name: figure for figure in measured[1]}, []
    for figure in measured[0]:
        real, other = value_of(figure), value_of(others[figure.name]) if figure.name in others else np.nan
        if np.isfinite(real):
            rows.append((figure.group, figure.name, real, other, abs(other - real) <= tolerance_of(figure.tolerance, real)))
    return rows


@dataclasses.dataclass
class Judged:
    """A rendered pass for each window. `agree`: the figures that agree with the fitted and with the judged pings."""
    rows: list              # of rows_beside() the judged pings, for each window
    agree: tuple
    white: float            # the largest share of a pass


def judge(windows, text, mission=None, settings=()):
    """Renders a pass with the text of a preset for each window: (start of its shape, (fitted pings, judged pings))."""
    rows, white = [], 0.0
    for start, parts in windows:
        (scene, _), *_ = scenes_of(parts[1], start, mission)
        one = pass_of(start, with_shape(start, text), *scene, settings)
        rows.append([rows_beside(part, one) for part in parts])
        white = max(white, float((one.values >= one.law.full_value - 0.5).mean()))
    agree = tuple(sum(row[4] for window in rows for row in window[k]) for k in (0, 1))
    return Judged([window[1] for window in rows], agree, white)


def is_worse(fit, start, part):
    """True for a pass that is white, or in which fewer figures agree with the fitted (0) or judged (1) pings."""
    return fit.white > MAX_WHITE or fit.agree[part] < start.agree[part]


def check_judged(fit, start, lacks):
    """CalibrationError for a fit that is not to be written. `lacks`: what the recording lacks."""
    figures = sum(len(window) for window in fit.rows)
    lacks = "the recording lacks " + (", ".join(lacks) or "a scene like the rendered one: name one by --mission")
    if fit.white > MAX_WHITE:
        raise CalibrationError(f"{fit.white:.0%} of a pass that is rendered with the fit is white, so it is not written: {lacks}")
    if is_worse(fit, start, 1) or fit.agree[1] == start.agree[1] < 0.5 * figures:
        raise CalibrationError(f"{fit.agree[1]} of {figures} figures of a pass that is rendered with the fit agree with the "
                               f"judged pings, and {start.agree[1]} with the start, so it is not written: {lacks}")
