"""How many figures of a recording lie within the range of simulated datasets whose instruments were drawn."""
import dataclasses

import numpy as np

from ..recording import RecordingError
from .comparison import measure_both
from .figure import value_of

LOW, HIGH = 0.05, 0.95
FEWEST = 5      # datasets with a figure


@dataclasses.dataclass
class Cover:
    name: str
    group: str
    real: float
    low: float      # the 5 % quantile of the simulated values
    high: float     # the 95 % quantile

    @property
    def is_inside(self):
        return self.low <= self.real <= self.high


def cover_of(real, simulated):
    """A Cover of each figure that the recording and at least five of the simulated recordings have. `simulated`: an
    iterable of recordings, of which one is held at a time. RecordingError if a kind differs or no figure is common."""
    values, found = {}, {}
    for one in simulated:
        if one.kind != real.kind:
            raise RecordingError(f"{one.name} is of the kind {one.kind}, {real.name} of the kind {real.kind}")
        is_relative = real.law.full_value == 0.0 or one.law.full_value == 0.0
        ours, theirs = measure_both((real, one), is_relative, False)[2]
        found.update({figure.name: (figure, value_of(figure)) for figure in ours if figure.name not in found})
        for figure in theirs:
            values.setdefault(figure.name, []).append(value_of(figure))
    covers = []
    for name, (figure, own) in found.items():
        drawn = [value for value in values.get(name, []) if np.isfinite(value)]
        if len(drawn) >= FEWEST and np.isfinite(own):
            covers.append(Cover(name, figure.group, own, *map(float, np.quantile(drawn, (LOW, HIGH)))))
    if not covers:
        raise RecordingError(f"{real.name} has no figure in common with {FEWEST} of the simulated datasets")
    return covers


def cover_text(covers):
    width = max(len(one.name) for one in covers)
    lines = [f"{'figure':{width}}  {'real':>10}  {'5 %':>10}  {'95 %':>10}"]
    for one in covers:
        lines.append(f"{one.name:{width}}  {one.real:>10.4g}  {one.low:>10.4g}  {one.high:>10.4g}  "
                     f"{'inside' if one.is_inside else 'OUTSIDE'}")
    inside = sum(one.is_inside for one in covers)
    lines.append(f"{inside} of {len(covers)} figures ({100.0 * inside / len(covers):.0f} %) lie within the 5 to 95 % range "
                 "of the datasets.")
    return "\n".join(lines) + "\n"


def cover_json(real, covers):
    return {"format": "sonarsim cover", "format_version": 1, "real": {"name": real.name, "pings": len(real)},
            "figures_inside": sum(one.is_inside for one in covers),
            "figures": [{**dataclasses.asdict(one), "inside": one.is_inside} for one in covers]}
