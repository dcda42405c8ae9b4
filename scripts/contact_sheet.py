#!/usr/bin/env python3
"""One picture of each dataset of a sweep, or of each variant of a mission, on one sheet:

    ./scripts/contact_sheet.py OUT [--sensor NAME] [--ping N]

Reads OUT/index.csv or OUT/variants.json, writes OUT/contact_sheet.png, or contact_sheet_NAME.png: of
the first sensor, or of the one that is named, the middle ping or the N-th, counted from 0, as a fan
where it is an image, else all of its records. Needs python3-matplotlib; says so and does nothing
without."""
import argparse
import csv
import json
import math
import pathlib
import sys

import sonarsim_data

MANY = 36  # pictures, beyond which they are smaller


def folders_of(out):
    """The names of the folders below `out`."""
    if (out / "variants.json").exists():
        index = json.loads((out / "variants.json").read_text())
        return [one["folder"] for one in index["variants"]]
    if not (out / "index.csv").exists():
        sys.exit(f"{out}: holds neither variants nor a sweep: it has no variants.json and no index.csv")
    with open(out / "index.csv", newline="") as file:
        return [row["folder"] for row in csv.DictReader(file)]


def picture_of(dataset, sensor_name, ping):
    """(image [row, column], brightest) of a dataset; None if it has no image."""
    for sensor in dataset.sensors.values():
        if sensor_name not in (None, sensor.name):
            continue
        chosen = len(sensor) // 2 if ping is None else ping
        if "polar" in sensor.keys and chosen < len(sensor):
            polar = sensor[chosen]["polar"]
            return sensor.to_fan(polar, width=320), sensor.description["full_scale"]
        for name in sensor.keys:
            if name in ("waterfall", "echogram", "scan"):
                records = sensor.records(name)
                step = [max(1, length // 320) for length in records.shape]
                shown = records[::step[0], ::step[1]]
                return shown, max(float(shown.max()), 1e-9)
    return None


def main(out, sensor_name=None, ping=None):
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print(f"{out}: no contact sheet, which needs python3-matplotlib", file=sys.stderr)
        return
    pictures = [(name, picture_of(sonarsim_data.open_dataset(out / name), sensor_name, ping))
                for name in folders_of(out)]
    pictures = [(name, picture) for name, picture in pictures if picture]
    if not pictures:
        sys.exit(f"{out}: nothing to show" + (f" of '{sensor_name}'" if sensor_name else ""))
    columns = min(len(pictures), max(2, math.ceil(math.sqrt(len(pictures)))))
    rows = math.ceil(len(pictures) / columns)
    inches = 3.4 if len(pictures) <= MANY else 1.7
    figure, axes = pyplot.subplots(rows, columns, squeeze=False,
                                   figsize=(inches * columns, inches * rows), layout="constrained")
    for axis in axes.flat:
        axis.axis("off")
    for axis, (name, (image, white)) in zip(axes.flat, pictures):
        axis.imshow((image / white).clip(0, 1) ** 0.5, cmap="gray", vmin=0, vmax=1, aspect="auto"
                    if image.shape[0] > 2 * image.shape[1] else "equal")
        axis.set_title(name.replace(",", "\n"), fontsize=8)
    # The file has no stamp of the version, so that a repeated sweep gives the same bytes.
    sheet = "contact_sheet" + (f"_{sensor_name}" if sensor_name else "") + ".png"
    figure.savefig(out / sheet, dpi=100, metadata={"Software": None})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--sensor", metavar="NAME")
    parser.add_argument("--ping", type=int, metavar="N")
    options = parser.parse_args()
    main(options.out, options.sensor, options.ping)
