"""The facts of objects: per ping, and in the pictures of all pings, against the label arrays beside them; read as the
formats' authors publish them."""
import json
import struct
import unittest
import zlib

from sandbox import Sandbox, box_gltf, digest, numbers_of

MISSION = """\
name: labels
seed: 7
scene: {file: room.gltf, materials: materials.csv}
trajectory: {file: path.csv}
sensors:
  fls: {kind: imaging, azimuth_deg: 60, elevation_deg: 20, range_min_m: 0.5, range_max_m: 4,
        range_bins: 70, azimuth_bins: 48, every: 2, noise: {add_sigma: 0.05}}
  mbes: {kind: profiling, azimuth_deg: 90, range_max_m: 4, range_bins: 40, azimuth_bins: 24}
  sss: {kind: sidescan, range_max_m: 4, range_bins: 40}
  sounder: {kind: echosounder, range_max_m: 4, range_bins: 40}
classes:
  - {nodes: "pillar*", class: pillar}
output:
  folder: out
  labels: true
  image: true
labels: {background: [none]}
"""


def room_gltf():
    """A box with two pillars in it; y is up, so that (x, y, z) lies at (x, -z, y) of the world."""
    room = json.loads(box_gltf())
    room["nodes"] += [{"name": f"pillar_{k}", "mesh": 0, "translation": [x, 0, z],
                       "scale": [0.06, 0.5, 0.06]} for k, x, z in ((1, 1.2, -0.3), (2, 1.0, 0.5))]
    return json.dumps(room)


def read_png(path):
    """Its rows of values, 8 and 16 bits, grey or with a colour table, rows stored as they are or as the difference
    from the row above or the pixel to the left."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    chunks, at = {}, 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        crc, = struct.unpack(">I", data[at + 8 + length:at + 12 + length])
        assert crc == zlib.crc32(kind + body), (path, kind)
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + length
    width, height, bits, colours, *_ = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert colours in (0, 3), path
    raw, stride = zlib.decompress(chunks[b"IDAT"]), width * bits // 8
    assert len(raw) == height * (stride + 1), path
    above, rows = bytes(stride), []
    for i in range(height):
        kind, *own = raw[i * (stride + 1):(i + 1) * (stride + 1)]
        assert kind in (0, 1, 2), (path, kind)
        if kind == 1:
            for k in range(bits // 8, stride):
                own[k] = (own[k] + own[k - bits // 8]) & 255
        above = bytes((a + b) & 255 for a, b in zip(own, above)) if kind == 2 else bytes(own)
        rows.append(list(above) if bits == 8 else list(struct.unpack(f">{width}H", above)))
    return rows


def runs_of(text):
    """The numbers of compressed RLE."""
    runs, at = [], 0
    while at < len(text):
        value, shift, more = 0, 0, True
        while more:
            code = ord(text[at]) - 48
            value |= (code & 31) << shift
            more = bool(code & 32)
            at += 1
            shift += 5
            if not more and code & 16:
                value |= -1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
    return runs


def mask_of(counts, width, height):
    """The pixels (x, y) of a mask, column by column."""
    runs = runs_of(counts)
    assert sum(runs) == height * width and min(runs[1:]) > 0, counts
    pixels, at = set(), 0
    for k, run in enumerate(runs):
        if k % 2:
            pixels |= {divmod(n, height) for n in range(at, at + run)}
        at += run
    return pixels


def pixels_of(rows):
    """The pixels (x, y) of every number but 0."""
    pixels = {}
    for y, row in enumerate(rows):
        for x, number in enumerate(row):
            if number:
                pixels.setdefault(number, set()).add((x, y))
    return pixels


class Objects(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("room.gltf", room_gltf())

    def objects(self, sensor, ping):
        return {one["id"]: one for one in self.objects_of(ping, sensor)}

    def assert_box(self, box, mask, x="x", y="y"):
        xs, ys = zip(*mask)
        self.assertEqual((box[x], box[y]), ([min(xs), max(xs) + 1], [min(ys), max(ys) + 1]))

    def test_masks_and_boxes_are_those_of_the_label_images(self):
        self.assert_renders()
        for sensor, pings in (("fls", (0, 2, 4)), ("mbes", (0, 3))):
            for ping in pings:
                found = self.objects(sensor, ping)
                rows = read_png(self.out / sensor / f"instance/{ping:06}.png")
                pixels, width, height = pixels_of(rows), len(rows[0]), len(rows)
                self.assertEqual(set(found), set(pixels))
                for number, one in found.items():
                    mask = mask_of(one["mask"], width, height)
                    self.assertEqual(mask, pixels[number])
                    self.assert_box(one["box_bins"], mask, "beam", "range")
                    self.assertEqual(one["area_bins"], len(mask))
                    xs, ys = map(set, zip(*mask))
                    self.assertEqual(one["clipped"], bool({0, width - 1} & xs or {0, height - 1} & ys))
                rows = read_png(self.out / sensor / f"fan_instance/{ping:06}.png")
                pixels = pixels_of(rows)
                for number, one in found.items():
                    if number not in pixels:
                        self.assertIsNone(one["fan"])
                        continue
                    mask = mask_of(one["fan"]["mask"], len(rows[0]), len(rows))
                    self.assertEqual(mask, pixels[number])
                    self.assert_box(one["fan"]["box_px"], mask)
                    self.assertEqual(one["fan"]["area_px"], len(mask))

    def test_where_and_how_well(self):
        """The pillars stand 1.24 m away, 14 degrees to port, and 1.12 m, 27 to starboard, before the turn. The room is
        the largest surface: the background, which has no contrast."""
        self.edit("mission.yaml", "labels: {background: [none]}\n", "")
        self.assert_renders()
        self.assertEqual(self.dataset()["labels"]["annotations"], {"background": ["walls"]})
        visible = set()
        for ping in (0, 2, 4):
            for one in self.objects("fls", ping).values():
                self.assertEqual(one["contrast_db"] is None, one["class"] == "walls")
                if one["class"] != "pillar" or one["area_bins"] < 3:
                    continue
                distance, port_deg = {"pillar_1": (1.237, 14.04), "pillar_2": (1.118, -26.57)}[one["name"]]
                self.assertAlmostEqual(one["range_m"], distance, delta=0.12)
                self.assertAlmostEqual(one["azimuth_rad"] * 57.2958, port_deg - 3 * ping, delta=7)  # its width
                self.assertTrue(0.1 <= one["visible_share"] <= 1, one)
                self.assertGreater(one["shadow"]["area_bins"], 0)
                visible.add(one["name"])
        self.assertEqual(visible, {"pillar_1", "pillar_2"})

    def test_a_side_scan_has_an_entry_a_side(self):
        self.assert_renders()
        found = json.loads((self.out / "sss/objects.json").read_text())
        self.assertEqual((found["picture"], found["width"], found["height"], found["pings"], found["pings_per_pixel"]),
                         ("waterfall.png", 92, 6, 6, 1))
        numbers = numbers_of(self.out / "sss/instance.npy")
        left = {(k % 92, k // 92): number for k, number in enumerate(numbers) if number}
        for one in found["objects"]:
            mask = mask_of(one["mask"], 92, 6)
            self.assertEqual({left.pop(pixel) for pixel in mask}, {one["id"]})
            side = "port" if max(x for x, _ in mask) < 46 else "starboard"
            self.assertTrue(side == "port" or min(x for x, _ in mask) >= 46)
            self.assertEqual((one["side"], one["bearing_deg"]), (side, -90 if side == "port" else 90))
            self.assert_box(one["box_px"], mask)
            self.assertEqual((one["pings"], one["area_px"]), (one["box_px"]["y"], len(mask)))
            self.assertAlmostEqual(one["range_m"], sum(abs(x + 0.5 - 46) * 4 / 46 for x, _ in mask) / len(mask), delta=0.06)
        self.assertEqual(left, {})
        sounder = json.loads((self.out / "sounder/objects.json").read_text())
        self.assertEqual((sounder["picture"], sounder["width"], sounder["height"]), ("echogram.png", 6, 40))

    def test_shards_and_resume_have_the_same(self):
        self.edit("mission.yaml", "  labels: true\n", "  labels: [objects]\n")
        self.assert_renders()
        whole = digest(self.out)
        self.assertFalse(any("/instance/" in name for name in whole))
        for k in "123":
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}", "-j2")
        self.succeeds("merge", "part3", "part1", "part2", "merged")
        self.assert_renders("--out", "merged")
        self.assertEqual(digest(self.folder / "merged"), whole)
        for name in ("sss/objects.json", "fls/objects/000002.json"):
            (self.out / name).unlink()
        self.assert_renders("-j2")
        self.assertEqual(digest(self.out), whole)

    def test_what_is_refused(self):
        labels = "labels: {background: [none]}\n"
        for old, new, *fragments in (
                (labels, "labels: {background: [wals]}\n", "there is no class 'wals' (did you mean 'walls'?)"),
                (labels, "labels: {background: []}\n", "'background' names classes, auto or none"),
                ("labels: true", "labels: [coco]", "'coco' is no longer there", "labels: [objects]"),
                ("labels: true", "labels: [boxes]", "unknown labels 'boxes'"),
                ("labels: true", "fan: false\n  labels: [fan]", "'fan'", "output.fan: true"),
                ('"pillar*"', '"pilar*"', "no node of the scene fits 'pilar*'", "sonarsim inspect")):
            self.write("mission.yaml", MISSION)
            self.edit("mission.yaml", old, new)
            self.refused("mission.yaml:", *fragments)


if __name__ == "__main__":
    unittest.main()
