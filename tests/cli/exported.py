"""A mission to export, and strict checkers of what sonarsim export writes, by the rules of each format."""
import hashlib
import io
import json
import struct
import tarfile
import zlib

from labelled import Labelled, box_of, mask_of, read_png


def shape_of(data):
    """Width, height, bits and colour type of a PNG file; its check sums must be right."""
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        crc, = struct.unpack(">I", data[at + 8 + length:at + 12 + length])
        assert crc == zlib.crc32(data[at + 4:at + 8 + length]), kind
        at += 12 + length
    return struct.unpack(">IIBB", data[16:26])


def picture_size(data):
    """Width and height of a picture, which must have 8 bits, grey or RGB."""
    width, height, bits, colours = shape_of(data)
    assert bits == 8 and colours in (0, 2)
    return width, height


def names_of_yaml(text):
    """The classes of data.yaml, in order."""
    lines = text.split("names:\n")[1].splitlines()
    keys, names = zip(*(line.strip().split(": ", 1) for line in lines))
    assert list(map(int, keys)) == list(range(len(keys))), lines
    return [json.loads(name) for name in names]


def check_yolo(folder):
    """The rules of Ultralytics. Returns the classes and {part: {name: [(class, x, y, w, h)]}}, or the
    corners in place of the box, in pixels."""
    names = names_of_yaml((folder / "data.yaml").read_text())
    found = {}
    parts = sorted(p.name for p in (folder / "images").iterdir())
    assert parts == sorted(p.name for p in (folder / "labels").iterdir())
    for part in parts:
        assert f"{part}: images/{part}\n" in (folder / "data.yaml").read_text()
        pictures = {p.stem for p in (folder / "images" / part).iterdir()}
        labels = {p.stem for p in (folder / "labels" / part).iterdir()}
        assert pictures == labels, pictures ^ labels
        found[part] = {}
        for name in sorted(pictures):
            size = picture_size((folder / "images" / part / (name + ".png")).read_bytes())
            lines = [line.split() for line in
                     (folder / "labels" / part / (name + ".txt")).read_text().splitlines()]
            for one in lines:
                assert 0 <= int(one[0]) < len(names), one
                values = [float(v) for v in one[1:]]
                assert all(0 <= v <= 1 for v in values), one
                if len(values) == 4:
                    x, y, w, h = values
                    assert w > 0 and h > 0, one
                    assert -1e-5 < x - w / 2 and x + w / 2 < 1 + 1e-5, one
                    assert -1e-5 < y - h / 2 and y + h / 2 < 1 + 1e-5, one
                else:
                    assert len(values) >= 6 and len(values) % 2 == 0, one
            found[part][name] = [(int(a), *(round(float(v) * s, 2) for v, s in zip(b, size * len(b))))
                                 for a, *b in lines]
    return names, found


def inside_polygons(polygons):
    """The pixels whose middle lies in one of the polygons [x, y, x, y, ...] of right angles."""
    pixels = set()
    for polygon in polygons:
        corners = list(zip(polygon[0::2], polygon[1::2]))
        assert len(corners) >= 4 and len(polygon) % 2 == 0
        edges = [(a, b) for a, b in zip(corners, corners[1:] + corners[:1]) if a[0] == b[0]]
        for y in range(min(y for _, y in corners), max(y for _, y in corners)):
            xs = sorted(a[0] for a, b in edges if min(a[1], b[1]) <= y < max(a[1], b[1]))
            for left, right in zip(xs[0::2], xs[1::2]):
                pixels |= {(x, y) for x in range(left, right)}
    return pixels


def check_coco(folder):
    """The rules of the COCO dataset. Returns {part: {name: [(category, box, area, pixels)]}}."""
    found, ids = {}, {"images": [], "annotations": []}
    for file in sorted((folder / "annotations").iterdir()):
        part = file.stem.removeprefix("instances_")
        coco = json.loads(file.read_text())
        assert set(coco) == {"info", "licenses", "categories", "images", "annotations"}
        classes = [one["id"] for one in coco["categories"]]
        assert classes == list(range(1, len(classes) + 1))
        for key, all_ids in ids.items():
            all_ids += [one["id"] for one in coco[key]]
        images = {one["id"]: one for one in coco["images"]}
        shown = {one["file_name"]: [] for one in coco["images"]}
        assert {p.name for p in (folder / part).iterdir()} == set(shown)
        for one in coco["images"]:
            data = (folder / part / one["file_name"]).read_bytes()
            assert picture_size(data) == (one["width"], one["height"])
        for one in coco["annotations"]:
            image = images[one["image_id"]]
            assert one["category_id"] in classes and one["iscrowd"] == 0
            left, top, width, height = one["bbox"]
            assert left >= 0 and top >= 0 and width > 0 and height > 0
            assert left + width <= image["width"] and top + height <= image["height"]
            if isinstance(one["segmentation"], dict):
                assert one["segmentation"]["size"] == [image["height"], image["width"]]
                pixels = mask_of(one["segmentation"])
                assert len(pixels) == one["area"]
            else:
                pixels = inside_polygons(one["segmentation"])
                assert len(pixels) >= one["area"]  # outlines have no holes
            assert box_of(pixels) == one["bbox"]
            shown[image["file_name"]].append((one["category_id"], one["bbox"], one["area"], pixels))
        found[part] = {name.removesuffix(".png"): objects for name, objects in shown.items()}
    for all_ids in ids.values():
        assert len(all_ids) == len(set(all_ids))
    return found


def check_masks(folder):
    """The rules of MMSegmentation. Returns the classes and {part: {name: rows of classes}}."""
    meta = json.loads((folder / "meta.json").read_text())
    assert len(meta["classes"]) == len(meta["palette"]) and meta["classes"][0] == "background"
    table = bytes(v for colour in meta["palette"] for v in colour)
    found = {}
    for file in sorted((folder / "splits").iterdir()):
        names = file.read_text().split()
        assert len(names) == len(set(names))
        found[file.stem] = {}
        for sub in ("img_dir", "ann_dir"):
            assert {p.stem for p in (folder / sub / file.stem).iterdir()} == set(names)
        for name in names:
            picture = (folder / "img_dir" / file.stem / (name + ".png")).read_bytes()
            mask = folder / "ann_dir" / file.stem / (name + ".png")
            assert shape_of(mask.read_bytes())[2:] == (8, 3)
            rows, palette = read_png(mask)
            assert palette == table and (len(rows[0]), len(rows)) == picture_size(picture)
            assert max(map(max, rows)) < len(meta["classes"])
            found[file.stem][name] = rows
    return meta["classes"], found


def check_objects(objects, size, classes):
    """Lists with an entry per object. Returns [(class from 0 on, box, area)]."""
    assert len({len(objects[key]) for key in ("id", "bbox", "area", "categories")}) == 1
    for (left, top, width, height), area in zip(objects["bbox"], objects["area"]):
        assert left >= 0 and top >= 0 and 0 < area <= width * height
        assert left + width <= size[0] and top + height <= size[1]
    assert all(0 <= number < classes for number in objects["categories"])
    return list(zip(objects["categories"], objects["bbox"], objects["area"]))


def check_imagefolder(folder):
    """The rules of Hugging Face's image folder. Returns {part: {name: [(class, box, area)]}}."""
    card = (folder / "README.md").read_text()
    head = card.split("---\n")
    assert head[0] == "" and "license: " in head[1] and "task_categories:" in head[1]
    classes = card.split("| number | class | objects |\n|---|---|---|\n")[1].split("\n\n")[0]
    classes = [line.split(" | ")[1] for line in classes.splitlines()]
    found = {}
    for file in folder.glob("*/metadata.jsonl"):
        lines = [json.loads(line) for line in file.read_text().splitlines()]
        assert {p.name for p in file.parent.glob("*.png")} == {one["file_name"] for one in lines}
        assert len({one["file_name"] for one in lines}) == len(lines)
        shown = found[file.parent.name] = {}
        for one in lines:
            size = picture_size((file.parent / one["file_name"]).read_bytes())
            assert size == (one["width"], one["height"])
            shown[one["file_name"].removesuffix(".png")] = check_objects(one["objects"], size,
                                                                         len(classes))
    return classes, found


def check_croissant(folder):
    """The rules of Croissant 1.0 and the files that it names. Returns the classes and {part: the records}."""
    reported = json.loads((folder / "croissant.json").read_text())
    assert reported["@type"] == "sc:Dataset" and reported["conformsTo"] == "http://mlcommons.org/croissant/1.0"
    assert all(isinstance(reported[key], str) for key in ("name", "description", "license"))
    ids = [one["@id"] for one in reported["distribution"] + reported["recordSet"]]
    ids += [field["@id"] for one in reported["recordSet"] for field in one["field"]]
    assert len(ids) == len(set(ids))
    files, pictures = {}, set()
    for one in reported["distribution"]:
        assert one["@type"] in ("cr:FileObject", "cr:FileSet") and one["encodingFormat"]
        if one["@type"] == "cr:FileObject":
            data = (folder / one["contentUrl"]).read_bytes()
            assert hashlib.sha256(data).hexdigest() == one["sha256"]
            files[one["@id"]] = [json.loads(line) for line in data.splitlines()]
        else:
            found = set(folder.glob(one["includes"]))
            assert found and not found & pictures
            pictures |= found
    assert pictures == set(folder.glob("*/*.png"))
    sets, classes = {}, None
    for one in reported["recordSet"]:
        assert one["@type"] == "cr:RecordSet" and one["key"]["@id"] in ids
        if one["@id"] == "classes":
            classes = [row["classes/name"] for row in one["data"]]
            assert [row["classes/number"] for row in one["data"]] == list(range(len(classes)))
            continue
        for field in one["field"]:
            lines = files[field["source"]["fileObject"]["@id"]]
            path = field["source"]["extract"]["jsonPath"].removeprefix("$.").removesuffix("[*]").split(".")
            for record, line in zip(sets.setdefault(one["@id"], [{} for _ in lines]), lines, strict=True):
                for key in path:
                    line = line[key]
                assert isinstance(line, list) == field.get("repeated", False)
                record[field["name"]] = line
    return classes, sets


def check_webdataset(folder):
    """The rules of WebDataset: samples lie together, with one key up to the first point. Returns
    {part: {name: [(class, box, area)]}}."""
    classes = (folder / "classes.txt").read_text().splitlines()
    found = {}
    for file in sorted(folder.glob("*.tar")):
        part, number = file.stem.split("-")
        assert len(number) == 6
        with tarfile.open(file) as archive:
            members = archive.getmembers()
            files = [(one.name, archive.extractfile(one).read()) for one in members]
        assert len(files) % 2 == 0
        for (picture, png), (label, text) in zip(files[0::2], files[1::2]):
            name = picture.split(".")[0]
            assert (picture, label) == (name + ".png", name + ".json")
            one = json.load(io.BytesIO(text))
            size = picture_size(png)
            assert size == (one["width"], one["height"])
            assert name not in found.setdefault(part, {})
            found[part][name] = check_objects(one["objects"], size, len(classes))
            for counts, area in zip(one["objects"]["mask"], one["objects"]["area"]):
                assert len(mask_of({"size": size[::-1], "counts": counts})) == area
    return classes, found


class Exported(Labelled):
    def setUp(self):
        super().setUp()
        self.edit("mission.yaml", "labels: true", "labels: [coco]")
        self.dest = self.folder / "dest"

    def export(self, *arguments, form="yolo", source="out", dest="dest"):
        return self.run_sonarsim("export", source, dest, "--format", form, *arguments)

    def assert_exports(self, *arguments, **options):
        result = self.export(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertFalse((self.folder / "dest.part").exists())
        return result

    def long_path(self):
        """Fifty pings past the first pillar."""
        self.write("path.csv", "\n".join(
            ["t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg",
             *(f"{0.2 * k:.1f},{-0.9 + 0.05 * k:.2f},0,1.2,0,0,0" for k in range(50))]) + "\n")
