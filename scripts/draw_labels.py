#!/usr/bin/python3
"""Draws the objects of a dataset over its pictures:

    scripts/draw_labels.py OUT FOLDER [--every N]

Every N-th ping's fan (or image), and the waterfalls, echograms and sweeps, with masks, boxes and names; boxes of
shadows are dark. The dataset needs the label `objects`, this script numpy and PIL."""
import argparse
import json
import pathlib

import numpy as np
from PIL import Image, ImageDraw


def colour_of(number):
    """One of many different colours."""
    hue = number * 0.618034 % 1.0
    return tuple(int(255 * (0.55 + 0.45 * np.cos(2 * np.pi * (hue - k / 3)))) for k in range(3))


def mask_of(counts, height, width):
    """[height, width] of COCO's compressed runs."""
    mask = np.zeros(height * width, bool)
    runs, value, shift = [], 0, 0
    for code in counts.encode():
        code -= 48
        value |= (code & 31) << shift
        shift += 5
        if code & 32:
            continue
        if code & 16:
            value |= -1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
        value, shift = 0, 0
    ends = np.cumsum(runs)
    for begin, end in zip(ends[0::2], ends[1::2]):
        mask[begin:end] = True
    return mask.reshape(width, height).T


def grey(path):
    """Amplitudes for display; the brightest thousandth is white."""
    values = np.load(path) if path.suffix == ".npy" else np.asarray(Image.open(path))
    values = np.sqrt(np.maximum(np.asarray(values, float), 0))
    white = np.quantile(values[values > 0], 0.999) if (values > 0).any() else 1.0
    picture = (255 * np.clip(values / white, 0, 1)).astype(np.uint8)
    return np.repeat(picture[:, :, None], 3, axis=2)


def draw(picture, marks):
    """`picture` with the marks (id, name, mask, box, box of the shadow or None) of its objects."""
    for number, _, mask, _, _ in marks:
        picture[mask] = (0.6 * picture[mask] + 0.4 * np.array(colour_of(number))).astype(np.uint8)
    picture = Image.fromarray(picture)
    drawing = ImageDraw.Draw(picture)
    for number, name, _, box, shadow in marks:
        colour = colour_of(number)
        if shadow:
            drawing.rectangle((shadow["x"][0], shadow["y"][0], shadow["x"][1] - 1, shadow["y"][1] - 1),
                              outline=tuple(c // 2 for c in colour))
        left, top = box["x"][0], box["y"][0]
        drawing.rectangle((left, top, box["x"][1] - 1, box["y"][1] - 1), outline=colour)
        drawing.text((left + 2, top + 1), f"{name} {number}", fill=colour)
    return picture


def of_ping(one, shape, fan):
    """The mark of an object of a ping, in the fan or in the bins; None where it has no pixel."""
    if fan and not one["fan"]:
        return None
    facts = one["fan"] if fan else one
    box = facts["box_px"] if fan else {"x": one["box_bins"]["beam"], "y": one["box_bins"]["range"]}
    shadow = one.get("shadow")
    if shadow:
        bins = shadow["box_bins"]
        shadow = facts.get("shadow_box_px") if fan else {"x": bins["beam"], "y": bins["range"]}
    return one["id"], one["name"], mask_of(facts["mask"], *shape), box, shadow


def draw_sensor(out, sensor, background, folder, every):
    """Draws what a sensor of the dataset shows; returns the number of pictures."""
    pictures = {}
    files = sensor["files"]
    kind = next((kind for kind in ("fan", "image", "polar") if kind in files), None)
    for ping in range(0, sensor["pings"] * sensor["every"] if kind and "objects" in files else 0,
                      sensor["every"] * every):
        picture = grey(out / (files[kind] % ping))
        objects = json.loads((out / (files["objects"] % ping)).read_text())["objects"]
        marks = [of_ping(one, picture.shape[:2], kind == "fan") for one in objects if one["class"] not in background]
        pictures[f"{sensor['name']}_{kind}_{ping:06}.png"] = draw(picture, [one for one in marks if one])
    for product in sensor.get("products", []):
        name = pathlib.PurePosixPath(product).name
        if not name.startswith("objects") or not name.endswith(".json"):
            continue
        found = json.loads((out / product).read_text())
        shape = found["height"], found["width"]
        marks = [(one["id"], one["name"], mask_of(one["mask"], *shape), one["box_px"], one.get("shadow_box_px"))
                 for one in found["objects"] if one["class"] not in background]
        pictures[f"{sensor['name']}_{found['picture']}"] = draw(grey(out / sensor["name"] / found["picture"]), marks)
    for name, picture in pictures.items():
        picture.save(folder / name)
    return len(pictures)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("dataset", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1)
    options = parser.parse_args()
    file = options.dataset / "dataset.json"
    description = json.loads(file.read_text()) if file.exists() else {"sensors": []}
    background = set(description.get("labels", {}).get("annotations", {}).get("background", []))
    options.folder.mkdir(parents=True, exist_ok=True)
    if not sum(draw_sensor(options.dataset, sensor, background, options.folder, options.every)
               for sensor in description["sensors"]):
        parser.error(f"{options.dataset}: nothing to draw: give the folder of a complete dataset that was rendered "
                     "with output.labels: [objects]")


if __name__ == "__main__":
    main()
