"""Recordings in the files of instruments: joins files, and takes from recording.yaml what the format lacks."""
import struct

import numpy as np

from . import aris, didson, ek60, oculus, ping360, xtf
from .arrays import bearings_of, set_times
from .log import FASTEST_SOUND_M_S
from .recording import MOST_VALUES, RecordingError, Soundings

LARGEST_FILE = 1 << 31
NO_LONGER_READ = "is {} file, which is not read; write its pings as arrays (docs/compare.md)"


def read_files(own, recording, most_pings):
    """Fills the recording from the files of `xtf`, `oculus` or `logs`."""
    if own.source == "logs" and own.kind == "sidescan":
        own.refuse("has 'logs' of the kind sidescan; these come from 'xtf'")
    logs = []
    for path in own.files:
        rest = most_pings - sum(len(log.times_s if log.soundings else log.values) for log in logs)
        if rest <= 0:
            break
        log = read_file(path, own, rest)
        if log.kind != own.kind:
            raise RecordingError(f"{path}: has pings of the kind {log.kind}, and recording.yaml says {own.kind}")
        if logs:
            require_alike(path, log, logs[0])
        logs.append(log)
        if sum(size(log) for log in logs) > MOST_VALUES:
            raise RecordingError(f"{path}: makes more than {MOST_VALUES} values in all; take fewer pings")
    take_law(own, logs[0], recording)
    if own.kind == "soundings":
        take_soundings(own, logs, recording)
    else:
        take_pings(own, logs, recording)


def size(log):
    return sum(len(ping[0]) for ping in log.soundings) if log.soundings else log.values.size


def read_file(path, own, most_pings):
    """The Log of a file; RecordingError if it is damaged or of another format."""
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise ValueError("is larger than 2 GB; split it")
        data = path.read_bytes()
        if own.source == "xtf":
            read = xtf.read_soundings if own.kind == "soundings" else xtf.read
        else:
            read = oculus.read if own.source == "oculus" else reader_of(data)
        return read(data, most_pings, own.frequency_hz)
    except OSError as fault:
        raise RecordingError(f"{path}: cannot be read: {fault.strerror}") from fault
    except struct.error as fault:
        raise RecordingError(f"{path}: is cut off") from fault
    except ValueError as fault:
        raise RecordingError(f"{path}: {fault}") from fault


def reader_of(data):
    """The reader of the format that the first bytes show."""
    if data[4:8] == b"CON0":
        return ek60.read
    if data[:4] == aris.MARK:
        return aris.read
    if data[:3] == b"DDF":
        return didson.read
    if data[4:8] == b"XML0":
        raise ValueError(NO_LONGER_READ.format("an EK80"))
    if data[4:5] == b"#":
        raise ValueError(NO_LONGER_READ.format("a .kmall"))
    if len(data) > 5 and data[4] == 2 and data[5:6] == b"I":
        raise ValueError(NO_LONGER_READ.format("an .all"))
    return ping360.read


def require_alike(path, log, first):
    """RecordingError if a file has other ranges, beams or levels than the first."""
    if log.soundings is not None:
        return
    def differ(a, b, share):
        return abs(a - b) > share * abs(b)
    for is_other, what in (
            (log.kind != first.kind, "another kind of sonar"),
            (log.law != first.law or log.full_value != first.full_value, "another scale of levels"),
            (log.values.shape[1:] != first.values.shape[1:], "another number of ranges or beams"),
            # Side-scans and the Oculus round their ranges; sonars round frequencies. Chosen.
            (differ(log.range_step, first.range_step, 1e-2 if log.kind == "sidescan" else 1e-4), "another step of range"),
            (abs(log.first_range - first.first_range) > 0.5 * first.range_step, "another first range"),
            (differ(log.frequency_hz, first.frequency_hz, 0.01), "another frequency")):
        if is_other:
            raise RecordingError(f"{path}: has {what} than the first file; split the recording there")


def take_law(own, log, recording):
    """The law is in the format, or in recording.yaml."""
    if log.law and own.law:
        own.refuse("has 'law', but the values of this format are decibels: leave it out")
    if not log.law and not own.law:
        own.refuse("lacks 'law': this format does not say what a value means")
    recording.law = log.law or own.law
    if own.full_value_is_auto and log.full_value:
        recording.law.full_value = log.full_value


def take_pings(own, logs, recording):
    first = logs[0]
    recording.values = np.concatenate([log.values for log in logs])
    recording.sound_speed_m_s = own.sound_speed_m_s or first.sound_speed_m_s
    if not 0.0 < recording.sound_speed_m_s < FASTEST_SOUND_M_S:
        own.refuse("lacks 'sound_speed_m_s', which is not in this format or file")
    metres = 1.0 if first.is_in_metres else 0.5 * recording.sound_speed_m_s
    recording.first_range_m, recording.range_step_m = metres * first.first_range, metres * first.range_step
    if not own.frequency_hz and 0.0 < first.frequency_hz < 1e9:
        recording.frequency_hz = first.frequency_hz
    recording.altitude_m = own.altitude_m or first.altitude_m or None
    if own.kind == "imaging":
        take_bearings(own, first, recording)
    if first.times_s is None and own.kind == "imaging":
        set_times(own, recording)
        return
    # A Ping360 has directions without times.
    count = len(recording)
    known = None if first.times_s is None else np.concatenate([log.times_s for log in logs])
    recording.times_s = np.arange(count) / (own.rate_hz or 1.0) if known is None else known
    heads = np.zeros(count) if first.head_rad is None else np.concatenate([log.head_rad for log in logs])
    recording.head_rad = np.radians(own.head_first_deg) + heads


def take_bearings(own, first, recording):
    is_given = own.bearings_deg or own.bearing_first_deg != own.bearing_last_deg
    if first.bearing_rad is None and not is_given:
        own.refuse("lacks 'bearing_first_deg' and 'bearing_last_deg', or 'bearings_deg': this format has no bearings")
    beams = recording.values.shape[2]
    recording.bearing_rad = bearings_of(own, beams) if first.bearing_rad is None else first.bearing_rad


def take_soundings(own, logs, recording):
    pings = []
    for log in logs:
        for (two_way_s, angles, intensities), speed in zip(log.soundings, log.sounding_speeds_m_s):
            speed = own.sound_speed_m_s or speed
            if not speed:
                own.refuse("lacks 'sound_speed_m_s', which the file does not have")
            if not pings:
                recording.sound_speed_m_s = speed
            pings.append((0.5 * speed * two_way_s, angles, intensities))
    recording.soundings = Soundings.of(pings)
    recording.times_s = np.concatenate([log.times_s for log in logs])
    recording.head_rad = np.zeros(len(pings))
