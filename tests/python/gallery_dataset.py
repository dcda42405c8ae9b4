"""A dataset of three sonars, without their arrays, whose pictures are white where the masks of objects are."""
import json

import numpy as np
from PIL import Image
from tool import counts_of, sensor, write_description

PINGS = 600  # three parts of the page's data
SEEN = (0, 3, 599)  # the pings of fls that show the mine


def corner(height, width, top, left):
    """An L, which looks different however it is turned or mirrored."""
    mask = np.zeros((height, width), bool)
    mask[top:top + 7, left:left + 2] = mask[top + 5:top + 7, left:left + 5] = True
    return mask


def box_of(mask, x, y):
    rows, columns = np.flatnonzero(mask.any(1)).tolist(), np.flatnonzero(mask.any(0)).tolist()
    return {x: [columns[0], columns[-1] + 1], y: [rows[0], rows[-1] + 1]}


MASKS = {"fan": corner(30, 40, 4, 25), "bins": corner(24, 16, 10, 3), "sss": corner(50, 32, 20, 20), "head": corner(31, 31, 6, 9)}


def save(path, mask, margin=0):
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.pad(np.where(mask, 255, 40).astype(np.uint8), ((margin, 0), (0, 0)))).save(path)


def in_picture(mask):
    return {"id": 2, "name": "mine_1", "class": "mine", "box_px": box_of(mask, "x", "y"), "area_px": int(mask.sum()),
            "mask": counts_of(mask), "range_m": 4.5, "contrast_db": 8.0, "visible_share": 1.0, "clipped": False}


def objects_of_ping(ping):
    floor = {"id": 1, "name": "floor", "class": "bottom", "box_bins": {"range": [0, 24], "beam": [0, 16]},
             "area_bins": 384, "range_m": 3.0, "contrast_db": None, "visible_share": None, "mask": "0P<", "fan": None}
    mine = in_picture(MASKS["bins"]) | {"box_bins": box_of(MASKS["bins"], "beam", "range"), "area_bins": int(MASKS["bins"].sum()),
        "fan": {key: value for key, value in in_picture(MASKS["fan"]).items() if key in ("box_px", "area_px", "mask")}}
    for key in ("box_px", "area_px"):
        del mine[key]
    return {"ping": ping, "objects": [floor, mine] if ping in SEEN else [floor]}


def write_dataset(folder):
    """Writes it and returns what dataset.json holds."""
    folder.mkdir(parents=True)
    for ping in (*range(6), PINGS - 1):
        save(folder / f"fls/fan/{ping:06d}.png", MASKS["fan"])
        save(folder / f"fls/image/{ping:06d}.png", MASKS["bins"])
    save(folder / "sss/waterfall_view.png", MASKS["sss"], margin=9)
    save(folder / "head/scan_0000.png", MASKS["head"])
    (folder / "fls/objects").mkdir()
    for ping in range(PINGS):
        (folder / f"fls/objects/{ping:06d}.json").write_text(json.dumps(objects_of_ping(ping)))
    for name in ("sss", "head"):
        height, width = MASKS[name].shape
        (folder / name / ("objects.json" if name == "sss" else "objects_0000.json")).write_text(json.dumps(
            {"picture": "waterfall.png", "width": width, "height": height, "pings": 50, "pings_per_pixel": 1,
             "objects": [in_picture(MASKS[name])]}))
    labels = {"instances": [{"id": 1, "name": "floor", "class": 1}, {"id": 2, "name": "mine_1", "class": 2}],
              "classes": [{"id": 1, "name": "bottom"}, {"id": 2, "name": "mine"}], "annotations": {"background": ["bottom"]}}
    fls = {"files": {"fan": "fls/fan/%06d.png", "image": "fls/image/%06d.png", "objects": "fls/objects/%06d.json"},
           "pictures": [{"title": "fan", "file": "fls/fan/%06d.png", "per": "ping", "boxes_of": "fan"},
                        {"title": "polar", "file": "fls/image/%06d.png", "per": "ping", "ahead": "down", "boxes_of": "bins"}],
           "fan": {"width_px": 40, "height_px": 30}, "range_edges_m": [0.0] * 25, "azimuth_edges_rad": [0.0] * 17}
    waterfall = {"title": "waterfall", "file": "sss/waterfall_view.png", "per": "sensor", "boxes_of": "sss/waterfall.png",
                 "origin_px": [0, 9], "pixel_px": [1, 1], "pings_along": "y", "pings_per_pixel": 1}
    scan = {"title": "scan", "file": "head/scan_%04d.png", "per": "sweep", "pings": 60, "boxes_of": "head/scan_%04d.png",
            "radius_px": 15.5, "width_px": 31}
    sensors = [sensor("fls", "imaging", PINGS, **fls), sensor("sss", "sidescan", 50, pictures=[waterfall]),
               sensor("head", "scanning", 50, pictures=[scan])]
    return write_description(folder, PINGS, sensors, mission="drawn", seed=9007199254740993, labels=labels)
