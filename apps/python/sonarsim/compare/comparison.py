"""Compares two recordings figure by figure (docs/calibrate.md)."""
import dataclasses

from ..recording import Recording, RecordingError
from .bootstrap import adjust, compared, exchange_p
from .images import have_one_grid, images_of, patch_size_of, zones_of
from .measure import measure_images
from .soundings import common_angles, measure_soundings
from .texture import block_sizes


@dataclasses.dataclass
class Comparison:
    real: Recording
    simulated: Recording
    has_one_grid: bool
    is_relative: bool           # one has no full value, so the gain is not compared
    figures: list               # of ComparedFigure

    @property
    def agreeing(self):
        return sum(figure.agrees for figure in self.figures)

    @property
    def differing(self):
        return sum(figure.differs for figure in self.figures)

    @property
    def is_same(self):
        return self.differing == 0

    @property
    def first_change(self):
        """The figure that is off by the most tolerances among those that differ and do not agree, else among all that
        differ. A ring has no speckle, so its standard error says nothing; it comes last."""
        return max((figure for figure in self.figures if figure.differs), default=None,
                   key=lambda figure: (figure.group != "ring", not figure.agrees, figure.tolerances_off))


def compare_recordings(real, simulated, seed=1):
    """The Comparison of two recordings. RecordingError if they are of different kinds or have no figure in common."""
    if real.kind != simulated.kind:
        raise RecordingError(f"{real.name} is of the kind {real.kind}, {simulated.name} of the kind {simulated.kind}; "
                             "compare recordings of one kind")
    # A recording without a known largest value has no absolute level.
    is_relative = real.law.full_value == 0.0 or simulated.law.full_value == 0.0
    same_places, same_pings, measured = measure_both((real, simulated), is_relative)
    others = {figure.name: figure for figure in measured[1]}
    pairs = [(figure, others[figure.name]) for figure in measured[0] if figure.name in others]
    figures = [compared(*pair, same_places, same_pings, seed) for pair in pairs]
    # Others were found at fewer than eight places.
    known = [k for k, figure in enumerate(figures) if figure.degrees > 0.0]
    pairs, figures = [pairs[k] for k in known], [figures[k] for k in known]
    if not figures:
        raise RecordingError(f"{real.name} and {simulated.name} have no figure in common: too few ranges, beams or pings")
    adjust(figures)
    if same_places:
        # A figure must also differ by exchange, as a few bright places cause other tails than Student's.
        for figure, p in zip(figures, exchange_p(pairs, [figure.error for figure in figures], seed)):
            figure.adjusted_p = max(figure.adjusted_p, float(p)) if figure.error > 0.0 else figure.adjusted_p
    return Comparison(real, simulated, same_places, is_relative, figures)


def measure_both(recordings, is_relative, have_one_zone=True):
    """(same places, same pings, figures of both)."""
    if recordings[0].kind == "soundings":
        angles = common_angles(*recordings)
        return False, False, [measure_soundings(one, angles, is_relative) for one in recordings]
    images = [images_of(one, is_relative) for one in recordings]
    a, b = images
    is_one, size, bands = have_one_grid(a, b), patch_size_of(a, b), common_bands(a, b)
    means = [one.mean_powers() for one in images]
    # With a common grid both have the zones of their mean, so that chance does not shift one's against the other's.
    zones = [zones_of(mean) for mean in ([0.5 * (means[0] + means[1])] * 2 if is_one and have_one_zone else means)]
    measured = [measure_images(one, size, own, bands, block_sizes(a, b)) for one, own in zip(images, zones)]
    return is_one, is_one and len(a.powers) == len(b.powers), measured


def common_bands(a, b):
    """The intervals of range and of bearing that both have; None for no bearings."""
    begin = max(a.first_range_m, b.first_range_m)
    end = min(one.first_range_m + one.shape[0] * one.range_step_m for one in (a, b))
    if end <= begin:
        raise RecordingError("the recordings have no ranges in common")
    if a.bearing_rad is None or b.bearing_rad is None:
        return (begin, end), None
    low, high = max(a.bearing_rad.min(), b.bearing_rad.min()), min(a.bearing_rad.max(), b.bearing_rad.max())
    return (begin, end), (low, high) if high > low else None
