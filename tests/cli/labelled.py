"""A mission with every label, and readers of what it writes, from what the formats' authors publish."""
import json
import struct
import zlib

from sandbox import Sandbox, box_gltf, path_csv

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
    room["scenes"][0]["nodes"] = [0, 1, 2]
    return json.dumps(room)


def read_png(path):
    """Its rows of values, and the colour table if it has one. 8 and 16 bits, grey or with a table,
    rows stored as they are or as the difference from the row above or the pixel to the left."""
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
    return rows, chunks.get(b"PLTE")


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


def mask_of(segmentation):
    """The pixels (x, y) of a mask, column by column."""
    height, width = segmentation["size"]
    runs = runs_of(segmentation["counts"])
    assert sum(runs) == height * width and min(runs[1:]) > 0, segmentation
    pixels, at = set(), 0
    for k, run in enumerate(runs):
        if k % 2:
            pixels |= {divmod(n, height) for n in range(at, at + run)}
        at += run
    return pixels


def box_of(pixels):
    """[left, top, width, height]."""
    xs, ys = zip(*pixels)
    return [min(xs), min(ys), max(xs) - min(xs) + 1, max(ys) - min(ys) + 1]


class Labelled(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("room.gltf", room_gltf())
        self.write("path.csv", path_csv(6))

    def load(self, name):
        return json.loads((self.out / name).read_text())
