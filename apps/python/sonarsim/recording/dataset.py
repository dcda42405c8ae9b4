"""The pings of a dataset of sonarsim."""
import pathlib

import numpy as np

from .. import data
from .arrays import two_sides
from .description import number, read_yaml
from .recording import MOST_VALUES, Law, Recording, RecordingError, Soundings

LARGEST_MISSION = 1 << 26
LEAST_QUALITY = 0.5
KINDS = {"sidescan": "sidescan", "echosounder": "echosounder", "scanning": "scanning", "profiling": "soundings"}
FAULTS = (ValueError, KeyError, TypeError, IndexError, AttributeError, EOFError, OverflowError)


def read_dataset(folder, sensor_name, most_pings):
    """The recording of a sensor of a dataset."""
    try:
        dataset = data.open_dataset(folder)
        if not dataset.complete:
            raise RecordingError(f"{folder}: is not complete; run the render command again")
        sensor = chosen_sensor(folder, dataset, sensor_name)
        return recording_of(folder, sensor, min(len(sensor), most_pings))
    except RecordingError:
        raise
    except OSError as fault:
        raise RecordingError(f"{fault.filename or folder}: cannot be read: {fault.strerror or fault}") from fault
    except FAULTS as fault:
        text = str(fault) if isinstance(fault, ValueError) else f"{folder}: is damaged: {fault!r}"
        raise RecordingError(f"{text}; sonarsim verify says more") from fault


def chosen_sensor(folder, dataset, name):
    names = list(dataset.sensors)
    if not name and len(names) == 1:
        return dataset[names[0]]
    if name in names:
        return dataset[name]
    wrong = f"has no sensor {name!r}; there are" if name else "has several sensors; choose one with --sensor:"
    raise RecordingError(f"{folder}: {wrong} {', '.join(names)}")


def recording_of(folder, sensor, pings):
    middles = data.middles(sensor.range_edges_m)
    is_raw = "raw" in sensor.keys
    recording = Recording(KINDS.get(sensor.kind, "imaging"), name=str(folder), first_range_m=float(middles[0]),
                          range_step_m=float(middles[1] - middles[0]) if len(middles) > 1 else 0.0)
    set_facts(pathlib.Path(folder), sensor, is_raw, recording)
    if recording.kind in ("imaging", "soundings"):
        images = read_images(folder, sensor, "raw" if is_raw else "polar", pings)
    if recording.kind == "imaging":
        recording.values, recording.bearing_rad = images, data.middles(sensor.azimuth_edges_rad)
    elif recording.kind == "soundings":
        recording.soundings = soundings_of(folder, sensor, images, recording)
    else:
        recording.values = read_records(folder, sensor, recording.kind, is_raw, pings)
    # Times stand in the metadata of each ping; figures need only the order.
    recording.times_s = np.arange(pings, dtype=float)
    recording.head_rad = np.zeros(pings)
    return recording


def require_few(folder, values):
    if values > MOST_VALUES:
        raise RecordingError(f"{folder}: has {values} values; take fewer pings with --pings")


def read_images(folder, sensor, name, pings):
    """The arrays of the first pings, float32 [ping, range, azimuth]."""
    if name not in sensor.keys or (name == "polar" and not sensor.description["files"][name].endswith(".npy")):
        raise RecordingError(f"{folder}: has neither raw/ nor polar/*.npy of {sensor.name}; set output.polar: true")
    shape = (len(sensor.range_edges_m) - 1, len(sensor.azimuth_edges_rad) - 1)
    require_few(folder, pings * shape[0] * shape[1])
    images = []
    for k in range(pings):
        try:
            image = sensor.read(k, name)
        except ValueError as fault:
            raise ValueError(f"{folder}/{sensor.name}/{name}: ping {k} {fault}") from fault
        require_shape(folder, sensor, np.shape(image) == shape)
        images.append(np.asarray(image, np.float32))
    return np.array(images)


def require_shape(folder, sensor, is_right):
    if not is_right:
        raise ValueError(f"{folder}: an array of {sensor.name} has another shape than dataset.json says")


def read_records(folder, sensor, kind, is_raw, pings):
    """Records [ping, range] or [range, ping] as float32 [ping, range, beam]."""
    name = "raw" if is_raw else next(iter(set(sensor.keys) & {"waterfall", "echogram", "scan"}), None)
    if name is None:
        raise RecordingError(f"{folder}: has no records of {sensor.name}")
    records = sensor.records(name)
    require_shape(folder, sensor, records.ndim == 2)
    rows = records.T if sensor.axes(name)[-1] == "ping" else records
    beams = 2 if kind == "sidescan" else 1
    side = rows.shape[1] // beams
    require_shape(folder, sensor, len(rows) == len(sensor) and rows.shape[1] == side * beams
                  and side >= len(sensor.range_edges_m) - 1)
    require_few(folder, pings * rows.shape[1])
    rows = np.asarray(rows[:pings], np.float32)
    return two_sides(rows) if beams == 2 else rows[:, :, None]


def soundings_of(folder, sensor, images, recording):
    """The bottom that a profiling sonar detected, with the values of its images there."""
    records = sensor.records("soundings")       # range, x, y, z, quality, and x, y, z where sound bends
    pings, ranges, beams = images.shape
    require_shape(folder, sensor, records.ndim == 3 and records.shape[:2] == (len(sensor), beams)
                  and records.shape[2] in (5, 8))
    range_m, quality = records[:pings, :, 0], records[:pings, :, 4]
    with np.errstate(invalid="ignore"):
        bins = (range_m - recording.first_range_m) / recording.range_step_m + 0.5
        found = (quality >= LEAST_QUALITY) & (bins >= 0.0) & (bins < ranges)
    bins = np.where(found, bins, 0.0).astype(int)
    intensity = np.take_along_axis(images, bins[:, None, :], axis=1)[:, 0]
    angle = np.broadcast_to(-data.middles(sensor.azimuth_edges_rad), range_m.shape)
    return Soundings(*(np.where(found, array, np.nan).astype(np.float32) for array in (range_m, angle, intensity)))


def set_facts(folder, sensor, is_raw, recording):
    """The law, the speed of sound and the frequency."""
    path = folder / "mission.resolved.yaml"
    mission = read_yaml(path, LARGEST_MISSION)
    instrument = section(section(section(mission, "sensors"), sensor.name), "instrument")
    is_calibrated = "instrument" in sensor.description
    if is_raw:
        recording.law = law_of_raw(path, section(instrument, "receiver"))
    elif is_calibrated:
        recording.law = Law("power", full_value=1.0)
    else:
        recording.law = Law("amplitude", full_value=float(sensor.description["full_scale"]))
    water = section(mission, "water")
    if isinstance(water.get("sound_speed_m_s"), (int, float, str)):     # a profile has a section
        recording.sound_speed_m_s = number(path, water, "sound_speed_m_s", (1.0, 1e4))
    if is_calibrated and "frequency_hz" in instrument:
        recording.frequency_hz = number(path, instrument, "frequency_hz", (1.0, 1e9))


def section(mapping, key):
    value = mapping.get(key)
    return value if isinstance(value, dict) else {}


def law_of_raw(path, receiver):
    """The law of raw/, which the keys of the receiver set."""
    if not receiver:
        raise RecordingError(f"{path}: lacks the receiver of the sensor")

    def own(key, default, limits):
        return number(path, receiver, key, limits) if key in receiver else default
    kind = {"gamma": "gamma", "log": "decibel"}.get(receiver.get("companding", "gamma"), "amplitude")
    return Law(kind, own("gamma", 0.5, (0.1, 2.0)), own("dynamic_range_db", 60.0, (10.0, 200.0)),
               2.0 ** int(own("bits", 8, (4, 16))) - 1.0, own("offset", 0.0, (0.0, 0.9)))
