"""Exported pictures: whole pictures, tiles or crops, with the objects that they show. Runs in worker processes."""
import dataclasses
import io
import zlib

import numpy as np
from PIL import Image

from .. import data
from . import runs
from .source import MAX_PIXELS, object_of
from .stand_out import Greys

Image.MAX_IMAGE_PIXELS = MAX_PIXELS
MAX_CROP = 4        # sides of a crop, in those of its picture
TRIES = 20          # places that are drawn for each crop of the bed
MIN_IN_VIEW = 0.98    # share of its pixels within the view
GREYS = np.floor(255 * np.sqrt(np.arange(65536) / 65535) + 0.5).astype(np.uint8)


@dataclasses.dataclass
class Piece:
    name: str
    part: str
    width: int
    height: int
    dataset: int
    objects: list
    content: object             # its bytes, or the path of the file that it is a copy of
    classes_png: bytes | None = None    # the class of each pixel, for masks


def prepare(picture, numbers, options):
    """(pieces, counts of what is left out) of a picture of a dataset."""
    frames = frames_of(picture, options)
    parts = [part_of(picture, frame) for frame in frames]
    if not any(parts) and (options.format != "crops" or picture.kind != "strip"):
        return [], {"pictures": len(frames)}
    pixels, is_copy = pixels_of(picture, len(frames) == 1, options)     # first, since the masks are as large
    with data.reading(picture.facts):
        listed = data.read_json(picture.facts.read_bytes())["objects"]
        shown = [object_of(one, picture.kind, numbers[one["class"]]) for one in listed]
        objects = with_pixels([one for one in shown if one], picture, pixels, options)
        kept = [one for one in objects if is_kept(one, picture, options)]
    faint = sum(one["iscrowd"] for one in objects) - sum(one["iscrowd"] for one in kept)
    if options.format == "crops":
        others = [object_of(one, picture.kind, 1) for one in listed if one["class"] in options.without]
        boxes = [box for one in objects for box in (one["box"], one["shadow"]) if box]
        boxes += [box for one in filter(None, others) for box in (runs.box_of(runs.pixels_of(
            one["mask"], picture.width, picture.height), picture.height), one["shadow"]) if box]
        pieces, left_out = crops_of(picture, pixels, kept, boxes, options)
        return pieces, {"faint": faint, **left_out}
    pieces, dropped = [], 0
    for frame, part in zip(frames, parts):
        if part is None:
            continue
        shown = [show(one, picture, frame, options) for one in kept]
        dropped += shown.count(False)
        piece = Piece(picture.name + (f"-y{frame[2]:05}-x{frame[0]:05}" if len(frames) > 1 else ""), part,
                      frame[1] - frame[0], frame[3] - frame[2], picture.dataset, [one for one in shown if one], picture.path)
        if not is_copy:
            piece.content = png_of(Image.fromarray(np.ascontiguousarray(pixels[frame[2]:frame[3], frame[0]:frame[1]])))
        if options.format == "masks":
            piece.classes_png = classes_png(piece)
        for one in piece.objects:
            del one["pixels"]
        pieces.append(piece)
    return pieces, {"pictures": parts.count(None), "faint": faint, "pieces": dropped}


def crops_of(picture, pixels, objects, boxes, options):
    """(crops, counts of what is left out) of a picture: one around each object and some of the bed, clear of all `boxes`."""
    image = Image.fromarray(np.ascontiguousarray(pixels))
    # A screen repeats the rows of pings that are further apart than its own.
    smoothing = Image.Resampling.BOX if picture.kind == "strip" else Image.Resampling.BILINEAR
    sides = [count * options.pixel_m / pixel_m for count, pixel_m in zip(options.crop, picture.pixel_m)]
    if max(sides) > MAX_CROP * max(image.size):
        raise ValueError(f"--pixel-m {options.pixel_m:g}: a crop would be {max(sides) / max(image.size):.3g} times as large as "
                         f"{picture.path}; take less")
    found, dropped, beds = [], 0, 0

    def add(name, middle, shown):
        frame = frame_of(middle, sides)
        part = part_of(picture, (max(0, int(frame[0])), int(np.ceil(frame[1])), max(0, int(frame[2])), int(np.ceil(frame[3]))))
        if part is not None:
            content = png_of(cut_crop(image, frame, options.crop, smoothing))
            found.append(Piece(f"{picture.name}-{name}", part, *options.crop, picture.dataset, shown, content))
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
            is_bed = (inside.sum() >= MIN_IN_VIEW * sides[0] * sides[1] and
                      not any(runs.cut_box(box, frame) for box in boxes))
            if is_bed and add(f"bed-{number}", middle, []):
                beds += 1
                break
    return found, {"pieces": dropped, "beds": options.negatives - beds}


def frame_of(middle, sides):
    """(left, right, top, bottom) of a crop in pixels of the picture."""
    return (middle[0] - sides[0] / 2, middle[0] + sides[0] / 2, middle[1] - sides[1] / 2, middle[1] + sides[1] / 2)


def cut_crop(image, frame, size, smoothing):
    """The part of an image in a frame as a picture of a size; black beyond its border."""
    left, top = int(np.floor(frame[0])), int(np.floor(frame[2]))
    around = image.crop((left, top, int(np.ceil(frame[1])), int(np.ceil(frame[3]))))
    return around.resize(size, smoothing, box=(frame[0] - left, frame[2] - top, frame[1] - left, frame[3] - top))


def frames_of(picture, options):
    """The frames (left, right, top, bottom) of the tiles of a picture; fans and bins stay whole."""
    if not options.tile or picture.kind in ("fan", "bins"):
        return [(0, picture.width, 0, picture.height)]
    width, height = options.tile
    return [(left, min(left + width, picture.width), top, min(top + height, picture.height))
            for top in begins(picture.height, height, options.overlap)
            for left in begins(picture.width, width, options.overlap)]


def begins(length, side, overlap):
    """The begins of tiles along a length; the last one ends with it."""
    last = max(length - side, 0)
    return [*range(0, last, side - overlap), last]


def part_of(picture, frame):
    """The part of all pings in a frame; None if they are not in one part."""
    if picture.kind != "strip":
        return picture.parts[0]
    first, end = frame[2:] if picture.rows_are_pings else frame[:2]
    shown = set(picture.parts[first:end])
    return shown.pop() if len(shown) == 1 else None


def with_pixels(objects, picture, pixels, options):
    """The objects of a picture with their pixels, area, box and, if it decides, grey difference."""
    for one in objects:
        one["pixels"] = runs.pixels_of(one["mask"], picture.width, picture.height)
        one["area"], one["box"] = one["pixels"].size, runs.box_of(one["pixels"], picture.height)
    if options.min_grey and objects:
        greys = Greys(pixels, [one["pixels"] for one in objects], [one["shadow"] for one in objects],
                      picture.kind in ("bins", "strip"))
        for one in objects:
            keep_visible_parts(one, greys, picture, options)
            one["grey"] = greys.difference(one["pixels"], one["box"], one["shadow"])
    return objects


def keep_visible_parts(one, greys, picture, options):
    """Leaves parts of an object out that do not stand out by themselves, but the largest."""
    largest, *others = runs.parts(one["pixels"], picture.height)
    kept = [largest, *(part for part in others if options.min_grey <= greys.difference(
        part, runs.box_of(part, picture.height), None))]
    if len(kept) <= len(others):
        one["pixels"] = np.sort(np.concatenate(kept))
        one["mask"] = runs.counts_of(one["pixels"], picture.width, picture.height)
        one["area"], one["box"] = one["pixels"].size, runs.box_of(one["pixels"], picture.height)


def is_kept(one, picture, options):
    """True for an object that this picture has in this format; sets its iscrowd."""
    contrasts = [abs(one[key]) for key in ("contrast_db", "shadow_contrast_db") if one[key] is not None]
    share = 1.0 if one["visible_share"] is None else one["visible_share"]
    one["iscrowd"] = (one["area"] < options.min_pixels or share < options.min_visible_share or
                      bool(contrasts) and max(contrasts) < options.min_contrast_db or
                      one.get("grey", options.min_grey) < options.min_grey)
    has_crowds = options.faint == "crowd" and options.format in ("coco", "masks")
    has_box = options.format == "masks" or box_of(one, picture.height, one["shadow"], options.box) is not None
    return (not one["iscrowd"] or has_crowds) and has_box


def box_of(one, height, shadow, sort):
    """The box of an object, of its shadow, or around both; None for a shadow that is not there."""
    own = runs.box_of(one["pixels"], height)
    if sort == "shadow":
        return shadow
    if sort == "object" or shadow is None:
        return own
    return (min(own[0], shadow[0]), max(own[1], shadow[1]), min(own[2], shadow[2]), max(own[3], shadow[3]))


def show(one, picture, frame, options):
    """The part of an object that a frame shows; None if there is none, False if it is too small."""
    is_whole = frame == (0, picture.width, 0, picture.height)
    pixels = one["pixels"] if is_whole else runs.cut(one["pixels"], picture.height, frame)
    if not pixels.size:
        return None
    width, height = frame[1] - frame[0], frame[3] - frame[2]
    shadow = one["shadow"] and runs.cut_box(one["shadow"], frame)
    shown = {**one, "pixels": pixels, "area": pixels.size, "shadow": shadow}
    box = box_of(shown, height, shadow, options.box)
    if options.format == "masks":       # maps of classes have pieces of any size
        return shown
    is_small = pixels.size < options.least_share * one["area"]
    if is_small or box is None or pixels.size < options.min_pixels and not one["iscrowd"]:
        return False
    shown["box"] = box
    if not is_whole:
        shown["mask"] = runs.counts_of(pixels, width, height)
        shown["clipped"] = one.get("clipped", False) or pixels.size < one["area"]
    if options.polygons or options.oriented:
        shown["outlines"] = runs.outlines(pixels, height)
    return shown


def pixels_of(picture, is_whole, options):
    """A picture's greys (the square root, raw/: linear) or colours in 8 bits, None if not needed; may its file be copied."""
    is_copy, is_raw = False, picture.kind in ("fan", "bins") and picture.path.parent.name == "raw"
    try:
        if picture.path.suffix == ".npy":
            values = data.read_npy(picture.path.read_bytes()).astype(np.float64)
            shares = np.nan_to_num(values / picture.full_scale) if picture.full_scale > 0 else 0 * values
            pixels = np.floor(255 * np.sqrt(shares.clip(0, 1)) + 0.5).astype(np.uint8)
        else:
            with Image.open(picture.path, formats=["PNG"]) as image:
                if image.width * image.height > data.MAX_INFLATED * picture.path.stat().st_size:
                    raise data.Damage("its width and height cannot be right")
                is_grey = image.mode in ("L", "I", "I;16")
                is_copy = (is_whole and picture.bins is None and image.mode in ("L", "P", "RGB")
                           and not (is_raw and picture.full_scale < 255) and image.size == (picture.width, picture.height))
                if is_copy and not options.min_grey and options.format != "crops":
                    return None, True
                pixels = np.asarray(image if is_grey else image.convert("RGB"))
            if is_raw:
                pixels = np.floor(255 * (pixels / picture.full_scale).clip(0, 1) + 0.5).astype(np.uint8)
            elif pixels.dtype != np.uint8:
                pixels = GREYS[pixels.astype(np.uint16)]
            if picture.bins is not None and picture.bins.max() < pixels.size:
                pixels = np.where(picture.bins < 0, 0, pixels.ravel()[np.maximum(picture.bins, 0)])
    except (*data.FAULTS, OSError) as fault:
        if isinstance(fault, OSError) and fault.errno:
            raise
        what = fault if isinstance(fault, data.Damage) else "it is not a whole picture as its dataset says"
        raise data.DataError(f"{picture.path}: cannot be read: {what}") from fault
    if pixels.shape[:2] != (picture.height, picture.width):
        raise data.DataError(f"{picture.path}: is not {picture.width} x {picture.height} pixels, as its dataset says")
    return pixels, is_copy


def png_of(image):
    file = io.BytesIO()
    image.save(file, "PNG", compress_level=1 if image.mode == "P" else 6)
    return file.getvalue()


def classes_png(piece):
    """A PNG with the number of the class of each pixel and a palette; 0 is the background."""
    pixels = np.zeros(piece.width * piece.height, np.uint8)
    for one in piece.objects:
        pixels[one["pixels"]] = one["class"]
    image = Image.fromarray(np.ascontiguousarray(pixels.reshape(piece.width, piece.height).T), "P")
    image.putpalette(sum((colour_of(k) for k in range(256)), ()))
    return png_of(image)


def colour_of(number):
    """The colour of a class in masks: neighbouring numbers differ strongly."""
    return tuple(sum((number >> 3 * k + channel & 1) << 7 - k for k in range(8)) for channel in range(3))
