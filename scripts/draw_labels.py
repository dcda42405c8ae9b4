#!/usr/bin/python3
"""Draws the labels of a dataset over its pictures:

    scripts/draw_labels.py OUT FOLDER [--every N]

Every N-th picture that labels/coco.json and labels/coco_fan.json list, and the waterfalls and echograms
of labels/coco_records.json, with masks, boxes and names; boxes of shadows are dark. The dataset needs
the label `coco`, this script numpy and PIL."""
import argparse
import io
import json
import pathlib
import tarfile

import numpy as np
from PIL import Image, ImageDraw


def colour_of(number):
    """One of many different colours."""
    hue = number * 0.618034 % 1.0
    return tuple(int(255 * (0.55 + 0.45 * np.cos(2 * np.pi * (hue - k / 3)))) for k in range(3))


def mask_of(segmentation):
    """[height, width] of COCO's compressed runs."""
    height, width = segmentation["size"]
    mask = np.zeros(height * width, bool)
    runs, value, shift = [], 0, 0
    for code in segmentation["counts"].encode():
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


def grey(values):
    """Amplitudes for display; the brightest thousandth is white."""
    values = np.sqrt(np.maximum(np.asarray(values, float), 0))
    white = np.quantile(values[values > 0], 0.999) if (values > 0).any() else 1.0
    picture = (255 * np.clip(values / white, 0, 1)).astype(np.uint8)
    return np.repeat(picture[:, :, None], 3, axis=2)


def tinted(picture, mask, colour):
    picture[mask] = (0.6 * picture[mask] + 0.4 * np.array(colour)).astype(np.uint8)


def picture_of(path):
    """The picture of a file, also of one in a pack, as OUT/fls/pack/000000.tar/fls-000000.polar.npy."""
    if path.parent.suffix == ".tar":
        with tarfile.open(path.parent) as pack:
            file = io.BytesIO(pack.extractfile(path.name).read())
    else:
        file = path
    return grey(np.load(file) if path.suffix == ".npy" else Image.open(file))


def draw_coco(out, folder, file, every):
    coco = json.loads((out / file).read_text())
    names = {one["id"]: one["name"] for one in coco["categories"]}
    of_image = {}
    for one in coco["annotations"]:
        of_image.setdefault(one["image_id"], []).append(one)
    for image in coco["images"][::every]:
        picture = picture_of(out / image["file_name"])
        annotations = of_image.get(image["id"], [])
        for one in annotations:
            tinted(picture, mask_of(one["segmentation"]), colour_of(one["instance_id"]))
        picture = Image.fromarray(picture)
        draw = ImageDraw.Draw(picture)
        for one in annotations:
            left, top, width, height = one["bbox"]
            colour = colour_of(one["instance_id"])
            draw.rectangle((left, top, left + width - 1, top + height - 1), outline=colour)
            if one.get("shadow_bbox"):
                x, y, w, h = one["shadow_bbox"]
                draw.rectangle((x, y, x + w - 1, y + h - 1), outline=tuple(c // 2 for c in colour))
            draw.text((left + 2, top + 1), f"{names[one['category_id']]} {one['instance_id']}",
                      fill=colour)
        picture.save(folder / image["file_name"].replace("/", "_").replace(".npy", ".png"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("dataset", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1)
    arguments = parser.parse_args()
    out, folder = arguments.dataset, arguments.folder
    lists = [f"labels/{name}.json" for name in ("coco", "coco_fan", "coco_records", "coco_scans")]
    lists = [file for file in lists if (out / file).exists()]
    if not lists:
        parser.error(f"{out}: nothing to draw: it has no labels/coco*.json; give the folder of a "
                     "complete dataset that was rendered with output.labels: [coco]")
    folder.mkdir(parents=True, exist_ok=True)
    for file in lists:
        of_pings = file in ("labels/coco.json", "labels/coco_fan.json")
        draw_coco(out, folder, file, arguments.every if of_pings else 1)


if __name__ == "__main__":
    main()
