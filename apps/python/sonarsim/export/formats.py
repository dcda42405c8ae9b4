"""The layouts of trainers: each has add(piece) for every exported picture, and finish(); and what writes their files."""
import contextlib
import hashlib
import io
import json
import os
import pathlib
import re
import shutil
import tarfile

from ..command import naming, new_folder
from . import runs
from .pieces import colour_of
from .split import PARTS

SHARD_BYTES = 256 << 20
LONGEST_MEMBER = 100        # in a tar archive of the format ustar
DIGITS = {"range_m": 3, "bearing_deg": 2, "contrast_db": 2, "visible_share": 4, "shadow_contrast_db": 2}


@contextlib.contextmanager
def destination(dest, sources):
    """The folder to write into, DEST.part. It becomes DEST if no exception comes, else nothing is left."""
    dest = pathlib.Path(os.path.abspath(dest))
    for source in sources:
        if pathlib.Path(os.path.realpath(dest)).is_relative_to(os.path.realpath(source)):
            raise ValueError(f"{dest}: lies in the dataset; choose a folder outside of it")
    if dest.is_symlink() or dest.exists() and not (dest.is_dir() and not any(dest.iterdir())):
        raise ValueError(f"{dest}: holds something already; choose another folder, or remove it")
    with new_folder(dest) as part:
        yield part
        os.sync()


def place(folder, name, content, link=False):
    """Writes a file; `content` is its bytes, or the path of the file that it is a copy of."""
    folder.mkdir(parents=True, exist_ok=True)
    if isinstance(content, bytes):
        write(folder / name, content)
    elif not link:
        with naming(folder / name):
            shutil.copyfile(content, folder / name)
    else:
        try:
            os.link(content, folder / name)
        except OSError as fault:
            raise ValueError(f"{content}: cannot be linked ({fault.strerror}); leave out --link") from fault


def write(path, content):
    with naming(path):
        path.write_bytes(content if isinstance(content, bytes) else content.encode())


def bbox(box):
    return [box[0], box[2], box[1] - box[0], box[3] - box[2]]


def write_json(path, value):
    write(path, json.dumps(value, ensure_ascii=False) + "\n")


class Format:
    """`parts` holds what is known of each part of the split."""

    def __init__(self, folder, classes, info, options):
        self.folder, self.classes, self.info, self.options, self.parts = folder, classes, info, options, {}

    def place_picture(self, piece, folder):
        place(self.folder / folder / piece.part, f"{piece.name}.png", piece.content, self.options.link)


class Coco(Format):
    """PART/NAME.png and annotations/instances_PART.json. Ids are unique over all parts."""

    images = annotations = 0

    def add(self, piece):
        self.place_picture(piece, "")
        images, annotations = self.parts.setdefault(piece.part, ([], []))
        self.images += 1
        images.append(json.dumps({"id": self.images, "file_name": f"{piece.name}.png", "width": piece.width,
                                  "height": piece.height}))
        for one in piece.objects:
            self.annotations += 1
            annotations.append(json.dumps(self.annotation(one, piece)))

    def annotation(self, one, piece):
        segmentation = {"size": [piece.height, piece.width], "counts": one["mask"]}
        if self.options.polygons:
            segmentation = [[value for corner in outline for value in corner] for outline in one["outlines"]]
        found = {"id": self.annotations, "image_id": self.images, "category_id": one["class"],
                 "instance_id": one["id"], "bbox": bbox(one["box"]), "area": one["area"],
                 "segmentation": segmentation, "iscrowd": int(one["iscrowd"])}
        found |= {key: None if one[key] is None else round(one[key], digits) for key, digits in DIGITS.items()}
        found["shadow_bbox"] = one["shadow"] and bbox(one["shadow"])
        return found | {key: one[key] for key in ("side", "clipped") if key in one}

    def finish(self):
        folder = self.folder / "annotations"
        folder.mkdir()
        categories = [json.dumps({"id": k + 1, "name": name, "supercategory": "object"})
                      for k, name in enumerate(self.classes)]
        for part, (images, annotations) in self.parts.items():
            path = folder / f"instances_{part}.json"
            with naming(path), open(path, "w", encoding="utf-8") as file:
                file.write(f'{{"info": {json.dumps(self.info)},\n"licenses": []')
                for key, items in (("categories", categories), ("images", images), ("annotations", annotations)):
                    file.write(f',\n"{key}": [\n' + ",\n".join(items) + "\n]")
                file.write("}\n")


class Yolo(Format):
    """images/PART/NAME.png, labels/PART/NAME.txt and data.yaml. A line per object: class from 0 on, then middle and
    size of its box, or the corners of its outline or rectangle, as shares of the picture."""

    def add(self, piece):
        self.parts[piece.part] = True
        self.place_picture(piece, "images")
        text = "".join(self.line(one, piece.width, piece.height) for one in piece.objects)
        place(self.folder / "labels" / piece.part, f"{piece.name}.txt", text.encode())

    def line(self, one, width, height):
        left, right, top, bottom = one["box"]
        values = [((left + right) / 2, (top + bottom) / 2), (right - left, bottom - top)]
        if self.options.polygons:
            values = runs.joined(one["outlines"])
        elif self.options.oriented:
            values = runs.min_rectangle(sum(one["outlines"], []))
            if not all(-1e-6 < x < width + 1e-6 and -1e-6 < y < height + 1e-6 for x, y in values):
                values = [(left, top), (right, top), (right, bottom), (left, bottom)]     # trainers refuse corners beyond
        return " ".join([str(one["class"] - 1), *(f"{x / width:.6f} {y / height:.6f}" for x, y in values)]) + "\n"

    def finish(self):
        # Without 'path' the paths start at the folder of data.yaml. 'train' and 'val' must be there.
        text = ""
        for part in PARTS:
            if part in self.parts:
                text += f"{part}: images/{part}\n"
            elif part != "test":
                text += f"{part}: images/{next(iter(self.parts))}  # there is no such part\n"
        text += "names:\n" + "".join(f"  {k}: {json.dumps(name, ensure_ascii=False)}\n" for k, name in enumerate(self.classes))
        write(self.folder / "data.yaml", text)


class Masks(Format):
    """img_dir/PART/NAME.png, ann_dir/PART/NAME.png with the class of each pixel (0: background), splits/PART.txt, meta.json."""

    def add(self, piece):
        self.place_picture(piece, "img_dir")
        place(self.folder / "ann_dir" / piece.part, f"{piece.name}.png", piece.classes_png)
        self.parts.setdefault(piece.part, []).append(piece.name + "\n")

    def finish(self):
        for part, names in self.parts.items():
            place(self.folder / "splits", f"{part}.txt", "".join(names).encode())
        write_json(self.folder / "meta.json", {"classes": ["background", *self.classes],
                                               "palette": [colour_of(k) for k in range(len(self.classes) + 1)]})


class WebDataset(Format):
    """PART-000000.tar with NAME.png and NAME.json for each picture, and classes.txt."""

    def add(self, piece):
        if len(piece.name) + 5 > LONGEST_MEMBER:
            raise ValueError(f"--format webdataset: {piece.name!r} is too long for the name of a file in an archive")
        objects = {key: [one[key] for one in piece.objects] for key in ("id", "area", "mask")}
        objects["bbox"] = [bbox(one["box"]) for one in piece.objects]
        objects["categories"] = [one["class"] - 1 for one in piece.objects]
        text = json.dumps({"width": piece.width, "height": piece.height, "objects": objects}) + "\n"
        png = piece.content if isinstance(piece.content, bytes) else piece.content.read_bytes()
        number, shard = self.parts.get(piece.part, (-1, None))
        if shard is None or shard.offset + len(png) + len(text) + 4096 > SHARD_BYTES:
            self.close(shard)
            path = self.folder / f"{piece.part}-{number + 1:06}.tar"
            with naming(path):
                shard = tarfile.open(path, "w", format=tarfile.USTAR_FORMAT)
            self.parts[piece.part] = number + 1, shard
        for ending, content in ((".png", png), (".json", text.encode())):
            member = tarfile.TarInfo(piece.name + ending)
            member.size = len(content)
            with naming(shard.name):
                shard.addfile(member, io.BytesIO(content))

    def close(self, shard):
        if shard:
            with naming(shard.name):
                shard.close()

    def finish(self):
        for _, shard in self.parts.values():
            self.close(shard)
        # A line each, whatever is in a name.
        write(self.folder / "classes.txt", "".join(json.dumps(name, ensure_ascii=False)[1:-1] + "\n" for name in self.classes))


CARD = """---
license: {licence}
task_categories:
- object-detection
tags:
- sonar
- synthetic
configs:
- config_name: default
  data_dir: data
---
# {mission}

{pictures} pictures with boxes that sonarsim {version} rendered, {seed}. Licence: {licence}. `objects` of a row has
`bbox` (x, y, width and height in pixels), `area` (pixels of its mask), `category` and `id`, the number of the thing. Categories: {classes}.
`sha256sum -c SHA256SUMS` checks the files.
"""


class HuggingFace(Format):
    """data/PART/NAME.png and metadata.jsonl, README.md (the card), and SHA256SUMS."""

    def add(self, piece):
        self.place_picture(piece, "data")
        rows = self.parts.setdefault(piece.part, [])
        row = {"file_name": f"{piece.name}.png", "image_id": len(rows), "width": piece.width, "height": piece.height, "objects": {
            "bbox": [bbox(one["box"]) for one in piece.objects], "category": [one["class"] - 1 for one in piece.objects],
            "id": [one["id"] for one in piece.objects], "area": [one["area"] for one in piece.objects]}}
        rows.append(json.dumps(row) + "\n")

    def finish(self):
        for part, rows in self.parts.items():
            place(self.folder / "data" / part, "metadata.jsonl", "".join(rows).encode())
        classes = ", ".join(f"{k} {json.dumps(name, ensure_ascii=False)}" for k, name in enumerate(self.classes))
        write(self.folder / "README.md", CARD.format(
            licence=self.options.licence, mission=self.info["description"], version=self.info["version"],
            seed="each variant by its seed" if self.info["seed"] is None else f"seed {self.info['seed']}", pictures=sum(map(len, self.parts.values())), classes=classes))
        write(self.folder / "SHA256SUMS", "".join(
            f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.relative_to(self.folder)}\n"
            for path in sorted(self.folder.rglob("*")) if path.is_file()))


class Crops(Format):
    """PART/CLASS/NAME.png; crops without an object are in PART/background."""

    def __init__(self, *options):
        super().__init__(*options)
        self.folders = ["background", *(re.sub(r"[^\w+-]", "_", name) for name in self.classes)]
        if len(set(self.folders)) < len(self.folders):
            raise ValueError(f"--format crops: two of the folders {', '.join(self.folders)} are one; rename a class in the mission")

    def add(self, piece):
        kind = self.folders[piece.objects[0]["class"] if piece.objects else 0]
        place(self.folder / piece.part / kind, f"{piece.name}.png", piece.content)
        self.parts[piece.part] = True

    def finish(self):
        for part in self.parts:     # ImageFolder numbers the folders that are there
            for kind in self.folders:
                (self.folder / part / kind).mkdir(exist_ok=True)


KINDS = {"coco": Coco, "yolo": Yolo, "masks": Masks, "webdataset": WebDataset, "crops": Crops, "hf": HuggingFace}
