"""The pings of a dataset of sonarsim."""
import numpy as np

from .. import data
from .description import Section, read_yaml
from .files import two_sides
from .recording import MAX_POWER, MAX_VALUES, Law, Recording, RecordingError, Soundings

LARGEST_MISSION, MIN_QUALITY = 1 << 26, 0.5
KINDS = {"sidescan": "sidescan", "echosounder": "echosounder", "scanning": "scanning", "profiling": "soundings"}


def read_dataset(folder, name, max_pings):
    dataset = data.open_dataset(folder)
    names = list(dataset.sensors)
    if not dataset.complete:
        raise RecordingError(f"{folder}: is not complete; run the render command again")
    if name not in names and (name or len(names) > 1):
        wrong = f"no sensor {name!r}" if name else "several sensors; choose one with --sensor"
        raise RecordingError(f"{folder}: has {wrong}; there are {', '.join(names)}")
    with data.reading(f"{folder}: sensor {name or names[0]!r}"):
        return recording_of(folder, dataset[name or names[0]], max_pings)


def recording_of(folder, sensor, max_pings, values="raw"):
    """The recording of a sensor: its values after the companding, if it has them, or "linear" before it."""
    pings, middles = min(len(sensor), max_pings), data.middles(sensor.range_edges_m)
    recording = Recording(KINDS.get(sensor.kind, "imaging"), first_range_m=float(middles[0]),
                          range_step_m=float(middles[1] - middles[0]) if len(middles) > 1 else 0.0)
    name = "raw" if values == "raw" and "raw" in sensor.keys else "polar"
    set_facts(folder, sensor, name == "raw", recording)
    if recording.kind in ("imaging", "soundings"):
        recording.values = read_images(folder, sensor, name, pings)
        recording.bearing_rad = data.middles(sensor.azimuth_edges_rad)
    else:
        recording.values = read_records(folder, sensor, recording.kind, pings, name)
    if recording.kind == "soundings":
        recording.soundings = soundings_of(folder, sensor, recording)
        recording.values = recording.bearing_rad = None
    return recording


def require(folder, sensor, is_right, values=0):
    """RecordingError unless an array has the right shape, and values are few."""
    if not is_right:
        raise RecordingError(f"{folder}: an array of {sensor.name} has another shape than dataset.json says")
    if values > MAX_VALUES:
        raise RecordingError(f"{folder}: has more than {MAX_VALUES} values; take fewer pings with --pings")


def read_images(folder, sensor, name, pings):
    """The arrays of the first pings, float32 [ping, range, azimuth]."""
    if name not in sensor.keys or (name == "polar" and not sensor.description["files"][name].endswith(".npy")):
        raise RecordingError(f"{folder}: has neither raw/ nor polar/*.npy of {sensor.name}; set output.polar: true")
    shape, images = (len(sensor.range_edges_m) - 1, len(sensor.azimuth_edges_rad) - 1), []
    require(folder, sensor, min(shape) > 0, pings * shape[0] * shape[1])
    for k in range(pings):
        images.append(np.asarray(sensor.read(k, name), np.float32))
        require(folder, sensor, images[-1].shape == shape)
    return np.array(images)


def read_records(folder, sensor, kind, pings, first):
    """Records [ping, range] or [range, ping] as float32 [ping, range, beam]."""
    name = next((name for name in (first, "waterfall", "echogram", "scan")
                 if name in sensor.keys and name not in sensor.description["files"]), None)
    if name is None:
        raise RecordingError(f"{folder}: has no records of {sensor.name}")
    records, beams = sensor.records(name), 2 if kind == "sidescan" else 1
    rows = records.T if sensor.axes(name)[-1] == "ping" else records
    require(folder, sensor, rows.ndim == 2 and len(rows) == len(sensor) and rows.shape[1] % beams == 0
            and rows.shape[1] // beams >= len(sensor.range_edges_m) - 1, pings * rows.shape[-1])
    rows = np.asarray(rows[:pings], np.float32)
    # Columns of a waterfall before range_min are blank.
    blank = sensor.description.get("waterfall", {}).get("blank_columns_a_side", 0)
    return two_sides(rows)[:, blank:] if beams == 2 else rows[:, :, None]


def soundings_of(folder, sensor, recording):
    """The bottom that a profiling sonar detected, with mean powers over footprints of beams: r width tan(angle) of range."""
    records = sensor.records("soundings")       # range, x, y, z, quality, labels
    pings, ranges, beams = recording.values.shape
    require(folder, sensor, records.ndim == 3 and records.shape[:2] == (len(sensor), beams) and records.shape[2] >= 5)
    range_m, quality = records[:pings, :, 0], records[:pings, :, 4]
    bins = (range_m - recording.first_range_m) / recording.range_step_m + 0.5
    found = (quality >= MIN_QUALITY) & (bins >= 0.0) & (bins < ranges)
    angle = np.broadcast_to(-recording.bearing_rad, range_m.shape)
    width_rad = np.abs(np.diff(sensor.azimuth_edges_rad))
    half = 0.5 * np.where(found, range_m * width_rad * np.tan(np.abs(angle)), 0.0) / recording.range_step_m
    bins = np.where(found, bins, 0.0)
    first = np.clip(bins - half, 0, ranges - 1).astype(int)
    last = np.clip(bins + half, first, ranges - 1).astype(int)
    sums = np.pad(np.cumsum(recording.powers(), axis=1, dtype=float), ((0, 0), (1, 0), (0, 0)))
    upper, lower = (np.take_along_axis(sums, at[:, None, :], axis=1)[:, 0] for at in (last + 1, first))
    recording.law = Law("power", full_value=1.0)
    intensity = (upper - lower) / (last + 1 - first)
    return Soundings(*(np.where(found, array, np.nan).astype(np.float32) for array in (range_m, angle, intensity)))


def set_facts(folder, sensor, is_raw, recording):
    """The law and the speed of sound."""
    path = folder / "mission.resolved.yaml"
    with data.reading(path):
        mission = read_yaml(path, LARGEST_MISSION)
        own, water = mission["sensors"][sensor.name].get("instrument") or {}, mission["water"]
    def section(keys):
        return Section(path, keys, keys)
    instrument, water = section(own), section(water)
    full_scale = data.numbers([sensor.description["full_scale"]], "full_scale")
    if not 0 < full_scale[0] < MAX_POWER:
        raise data.Damage("'full_scale' is not above 0")
    recording.law = Law("amplitude", full_value=float(full_scale[0]))
    if "instrument" in sensor.description:      # the calibrated model
        recording.law = Law("power", full_value=1.0)
    if is_raw:
        receiver = section(instrument.keys["receiver"])
        kind = {"gamma": "gamma", "log": "decibel"}.get(receiver.keys.get("companding", "gamma"), "amplitude")
        recording.law = Law(kind, receiver.number("gamma", 0.1, 2.0, 0.5),
                            receiver.number("dynamic_range_db", 10.0, 200.0, 60.0),
                            2.0 ** int(receiver.number("bits", 4, 16, 8)) - 1.0, receiver.number("offset", 0.0, 0.9, 0.0),
                            receiver.number("knee", 0.1, 1.0, 1.0))
    if not isinstance(water.keys.get("sound_speed_m_s"), dict):     # a section where it changes with depth
        recording.sound_speed_m_s = water.number("sound_speed_m_s", 1.0, 1e5, recording.sound_speed_m_s)
