"""Formats of pings, which need no objects: for robots, for reconstruction, and points."""
import pathlib

from ..data import DataError
from . import clouds, holoocean, robot
from .formats import destination
from .source import named_datasets, require_known

# The writer of each, and its options beside --sensor.
KINDS = {"points": (clouds.write, {"whole"}), "holoocean": (holoocean.write, {"clean", "mesh"}), "mcap": (robot.write, set())}


def export(options):
    """Writes a format for the fans of each dataset."""
    found = [one for folder in options.folders for one in named_datasets(pathlib.Path(folder), len(options.folders) > 1)]
    require_known(options.sensor, {name: 0 for _, one in found for name in one.sensors}, "--sensor")
    lines = [f"{options.dest}: {options.format}"]
    with destination(options.dest, options.folders) as folder:
        for name, dataset in found:
            sensors = [one for one in dataset.sensors.values() if one.kind in ("imaging", "profiling") and len(one)
                       and (not options.sensor or one.name in options.sensor)]
            if not sensors:
                raise DataError(f"{dataset.folder}: has no ping of an imaging or profiling sonar to export")
            (folder / name).mkdir(exist_ok=True)
            written = KINDS[options.format][0](folder / name, dataset, sensors, options)
            lines += [f"{name}{name and ': '}{line}" for line in written]
    print("\n".join(lines))
