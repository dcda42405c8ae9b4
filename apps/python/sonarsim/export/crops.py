"""Crops: a picture around each object, and some of the bed alone, at one scale."""
import zlib

import numpy as np
from PIL import Image

from . import pieces, runs

TRIES = 20          # places that are drawn for each crop of the bed
LEAST_LIT = 0.98    # share of its pixels within the view


def crops_of(picture, pixels, objects, boxes, options):
    """(pieces, objects left out) of a picture. `boxes` are those of all objects, faint ones too."""
    image = Image.fromarray(np.ascontiguousarray(pixels))
    # A screen repeats the rows of pings that are further apart than its own.
    smoothing = Image.Resampling.BOX if picture.kind == "strip" else Image.Resampling.BILINEAR
    sides = [count * options.pixel_m / pixel_m for count, pixel_m in zip(options.crop, picture.pixel_m)]
    found, dropped = [], 0

    def add(name, middle, shown):
        frame = frame_of(middle, sides)
        part = pieces.part_of(picture, (max(0, int(frame[0])), int(np.ceil(frame[1])),
                                        max(0, int(frame[2])), int(np.ceil(frame[3]))))
        if part is not None:
            content = pieces.png_of(cut(image, frame, options.crop, smoothing))
            found.append(pieces.Piece(f"{picture.name}-{name}", part, *options.crop, picture.dataset, shown, content))
        return part is not None

    for number, one in enumerate(objects):
        middle = (one["box"][0] + one["box"][1]) / 2, (one["box"][2] + one["box"][3]) / 2
        dropped += not add(f"{one['id']}" + (f"-{number}" if picture.kind == "strip" else ""), middle, [one])
        del one["pixels"]
    drawn = np.random.default_rng(zlib.crc32(picture.name.encode()))
    lit = np.asarray(image.convert("L")) > 0
    for number in range(options.negatives):
        for _ in range(TRIES):
            middle = [low + drawn.random() * (high - low) for low, high in zip((0, 0), image.size)]
            frame = frame_of(middle, sides)
            inside = lit[max(0, round(frame[2])):round(frame[3]), max(0, round(frame[0])):round(frame[1])]
            is_bed = (inside.sum() >= LEAST_LIT * sides[0] * sides[1] and
                      not any(runs.cut_box(box, frame) for box in boxes))
            if is_bed and add(f"bed-{number}", middle, []):
                break
    return found, dropped


def frame_of(middle, sides):
    """(left, right, top, bottom) of a crop in pixels of the picture."""
    return (middle[0] - sides[0] / 2, middle[0] + sides[0] / 2, middle[1] - sides[1] / 2, middle[1] + sides[1] / 2)


def cut(image, frame, size, smoothing):
    """The part of an image in a frame as a picture of a size; black beyond its border."""
    left, top = int(np.floor(frame[0])), int(np.floor(frame[2]))
    around = image.crop((left, top, int(np.ceil(frame[1])), int(np.ceil(frame[3]))))
    return around.resize(size, smoothing, box=(frame[0] - left, frame[2] - top, frame[1] - left, frame[3] - top))
