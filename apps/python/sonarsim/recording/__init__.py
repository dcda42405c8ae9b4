"""Recordings of real sonars and of datasets, as arrays of numpy.

    recording = open_recording("pings")     # a folder with recording.yaml (docs/calibrate.md), or a dataset
    recording.values                        # float32 [ping, range, beam], as the instrument delivers them
    recording.powers()                      # the same, as powers by the law of the recording
"""
import dataclasses
import pathlib

from .dataset import read_dataset
from .description import FILE_NAME, read_description
from .files import read_files, read_soundings
from .recording import MAX_VALUES, Law, Recording, RecordingError, Soundings

__all__ = ["Law", "Recording", "RecordingError", "Soundings", "open_recording"]


def open_recording(path, sensor=None, pings=None):
    """The recording in a folder with recording.yaml, in that file itself, or in a dataset. `sensor` chooses one of a
    dataset's; `pings` is the number to read, from the first. RecordingError with one sentence for anything wrong."""
    path, max_pings = pathlib.Path(path), pings or MAX_VALUES
    file = path / FILE_NAME if path.is_dir() else path
    if file.exists():
        own = read_description(file)
        recording = (read_soundings if own.source == "soundings" else read_files)(own, max_pings)
        recording.frequency_hz = recording.frequency_hz or own.frequency_hz or 0.0
        if own.full_value_is_auto or own.law is None:
            full_value = recording.found_full_value()
            recording.law = dataclasses.replace(recording.law, **({"full_value": full_value} if full_value else {}))
    elif (path / "dataset.json").exists():
        recording = read_dataset(path, sensor, max_pings)
    else:
        raise RecordingError(f"{path}: is not a recording: there is neither {FILE_NAME} (docs/calibrate.md) nor dataset.json")
    recording.check(path)
    # It stands in tables, in JSON and in a comment of a preset.
    recording.name = "".join(c if c.isprintable() else "?" for c in str(path))
    return recording
