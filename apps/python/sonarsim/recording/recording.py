"""What a recording holds: the pings of one instrument, the law of its values, its ranges and bearings."""
import dataclasses

import numpy as np

from ..data import DataError as RecordingError   # one sentence: the file, what is wrong and what would be right

KINDS = ("imaging", "sidescan", "scanning", "echosounder", "soundings")
LAWS = ("amplitude", "power", "gamma", "decibel")
MAX_VALUES = 1 << 28       # of one file, and of all pings of a recording
MAX_RANGES = 1 << 20
MAX_POWER = 1e30           # a float32 holds it, and a double its cube
# Values clip at the largest one if this share and number are at it, and so many times those in the two per cent below.
MIN_CLIPPED, FEWEST_CLIPPED, MAX_LIKE_OTHERS = 1e-3, 30, 2.0
MIN_KEPT = 0.5            # share of ranges and beams that are no margin


@dataclasses.dataclass
class Law:
    """The law from the amplitude A of an echo to a value."""
    kind: str = "amplitude"     # amplitude: value ~ A; power: A^2; gamma: A^exponent; decibel: 20 log A
    exponent: float = 0.5       # of gamma
    range_db: float = 0.0       # of decibel: from the value 0 to full_value
    full_value: float = 255.0   # the largest value of the instrument, 0 if there is none
    offset: float = 0.0         # share of full_value that the instrument subtracts
    knee: float = 1.0           # share of full_value above which values approach it

    @property
    def largest_value(self):
        """The largest value that the instrument delivers; 0 if it is not known."""
        return self.full_value * (1.0 - self.offset)

    def powers(self, values):
        """The powers A^2 of values as float32, 1 for largest_value (for the value 1 without full_value). The
        value 0 has the power 0; under the law decibel it has that of the lowest level."""
        values = np.asarray(values, np.float64)
        share = values / (self.full_value or 1.0) + self.offset
        if self.knee < 1.0:
            rest = np.clip((share - self.knee) / (1.0 - self.knee), 0.0, 0.999)
            share = np.minimum(share, self.knee) - (1.0 - self.knee) * np.log1p(-rest)
        with np.errstate(over="ignore"):
            if self.kind == "decibel":
                powers = 10.0 ** ((share - 1.0) * self.range_db / 10.0)
            else:
                power = {"power": 1.0, "amplitude": 2.0, "gamma": 2.0 / self.exponent}[self.kind]
                powers = np.where(values > 0.0, np.maximum(share, 0.0) ** power, 0.0)
        return np.minimum(powers, MAX_POWER).astype(np.float32)


@dataclasses.dataclass
class Soundings:
    """The detected bottom, each array float32 [ping, beam]; all three are NaN where a beam found none."""
    range_m: np.ndarray
    angle_rad: np.ndarray       # from the vertical, negative to port
    intensity: np.ndarray       # in values of the recording's law


@dataclasses.dataclass
class Recording:
    """Pings of one instrument in the order of time, from a real sonar or from a dataset."""

    kind: str = "imaging"
    law: Law = dataclasses.field(default_factory=Law)
    name: str = ""                          # the path, for messages and tables
    sound_speed_m_s: float = 1500.0
    first_range_m: float = 0.0              # slant range of the middle of the first sample
    range_step_m: float = 0.0
    frequency_hz: float = 0.0               # of the sound; 0: not known
    bearing_rad: np.ndarray | None = None   # of each beam of the kind imaging, positive to port
    # float32 [ping, range, beam], the law not undone; side-scan: port first; echosounder: 1 beam; soundings: None.
    values: np.ndarray | None = None
    soundings: Soundings | None = None      # of the kind soundings alone
    notes: list = dataclasses.field(default_factory=list)   # what a reader left out

    def __len__(self):
        return len(self.soundings.range_m if self.kind == "soundings" else self.values)

    @property
    def ranges_m(self):
        """The slant ranges of the middles of the samples."""
        return self.first_range_m + self.range_step_m * np.arange(self.values.shape[1])

    def powers(self):
        """The powers of all values by the law, float32 [ping, range, beam]."""
        return np.stack([self.law.powers(ping) for ping in self.values])

    def found_full_value(self):
        """The value at which many samples clip below the declared largest one; None if there is none."""
        full = self.law.largest_value
        if self.values is None or not full:
            return None
        largest = float(self.values.max())
        at, below = (self.values >= largest).mean(), ((self.values >= 0.98 * largest) & (self.values < largest)).mean()
        is_many = at > max(MIN_CLIPPED, MAX_LIKE_OTHERS * below) and at * self.values.size > FEWEST_CLIPPED
        return largest if largest < full and is_many else None

    def without_margins(self):
        """The recording without ranges and beams at its ends that have one value in all pings, below the largest."""
        if self.values is None or not len(self):
            return self
        same = (np.ptp(self.values, axis=0) == 0.0) & (len(self) > 1) & (self.values[0] < (self.law.largest_value or np.inf))
        is_imaging, ends = self.kind == "imaging", []
        for axis in (1, 0):
            kept = np.flatnonzero(~same.all(axis=axis))
            is_margin = kept.size > MIN_KEPT * same.shape[1 - axis]   # else it is a recording of nothing
            ends.append(slice(kept[0], kept[-1] + 1) if is_margin else slice(None))
        values = self.values[:, ends[0], ends[1] if is_imaging else slice(None)]
        return dataclasses.replace(self, values=values, bearing_rad=self.bearing_rad[ends[1]] if is_imaging else None,
                                   first_range_m=self.first_range_m + (ends[0].start or 0) * self.range_step_m)

    def part(self, pings):
        """The recording of some of the pings, not of soundings: a slice, or an array of their numbers or of booleans."""
        return dataclasses.replace(self, values=self.values[pings])

    def check(self, source):
        """RecordingError unless there are pings, and each value can be one of the law."""
        if not len(self) or (self.values is not None and not self.values.size):
            raise RecordingError(f"{source}: has no pings, or pings without values")
        least = -np.inf if self.law.kind == "decibel" else 0.0
        for k, ping in enumerate(() if self.values is None else self.values):
            if not (np.isfinite(ping) & (ping >= least)).all():
                raise RecordingError(f"{source}: ping {k} has values that are negative or not finite; give the law of "
                                     "what the instrument delivers, and 0 where nothing was received")
        if self.kind == "imaging" and len(self.bearing_rad) != self.values.shape[2]:
            raise RecordingError(f"{source}: has {len(self.bearing_rad)} bearings for {self.values.shape[2]} beams")
