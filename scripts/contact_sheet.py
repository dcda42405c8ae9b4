"""One picture of each dataset of a sweep on one sheet: python3 contact_sheet.py OUT

Reads OUT/index.csv, writes OUT/contact_sheet.png: the middle ping of the first sensor, as a fan where
it is an image, else all of its records. Needs python3-matplotlib; says so and does nothing without."""
import csv
import math
import pathlib
import sys

import sonarsim_data


def picture_of(dataset):
    """(image [row, column], brightest) of a dataset; None where it holds nothing to show."""
    for sensor in dataset.sensors.values():
        if "polar" in sensor.keys and len(sensor) > 0:
            polar = sensor[len(sensor) // 2]["polar"]
            return sensor.to_fan(polar, width=320), sensor.description["full_scale"]
        for name in sensor.keys:
            if name in ("waterfall", "echogram", "scan"):
                records = sensor.records(name)
                step = [max(1, length // 320) for length in records.shape]
                shown = records[::step[0], ::step[1]]
                return shown, max(float(shown.max()), 1e-9)
    return None


def main(out):
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print(f"{out}: no contact sheet, which needs python3-matplotlib", file=sys.stderr)
        return
    with open(out / "index.csv", newline="") as file:
        folders = [row["folder"] for row in csv.DictReader(file)]
    pictures = [(name, picture_of(sonarsim_data.open_dataset(out / name))) for name in folders]
    pictures = [(name, picture) for name, picture in pictures if picture]
    if not pictures:
        return
    columns = min(len(pictures), max(2, math.ceil(math.sqrt(len(pictures)))))
    rows = math.ceil(len(pictures) / columns)
    figure, axes = pyplot.subplots(rows, columns, squeeze=False,
                                   figsize=(3.4 * columns, 3.4 * rows), layout="constrained")
    for axis in axes.flat:
        axis.axis("off")
    for axis, (name, (image, white)) in zip(axes.flat, pictures):
        axis.imshow((image / white).clip(0, 1) ** 0.5, cmap="gray", vmin=0, vmax=1, aspect="auto"
                    if image.shape[0] > 2 * image.shape[1] else "equal")
        axis.set_title(name.replace(",", "\n"), fontsize=8)
    # Without a stamp of the version, so that a sweep made again is the same.
    figure.savefig(out / "contact_sheet.png", dpi=100, metadata={"Software": None})


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
