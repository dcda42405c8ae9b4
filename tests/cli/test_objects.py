"""The facts of objects: per ping, and in the pictures of all pings, against the label arrays beside them; read as the
formats' authors publish them."""
import json
import re
import shutil
import sys

from sandbox import ROOT, Sandbox, box_gltf, csv_of, gltf, grid_mesh, mission_of, run_with, sheet_mesh

run_with("numpy", "PIL", "scipy")
sys.path.append(str(ROOT / "tests/python"))
import numpy as np
from PIL import Image
from scipy import ndimage, spatial
from tool import mask_of

MISSION = mission_of("""\
  fls: {kind: imaging, azimuth_deg: 60, elevation_deg: 20, range_min_m: 0.5, range_max_m: 4,
        range_bins: 70, azimuth_bins: 48, every: 2, noise: {add_sigma: 0.05}}
  mbes: {kind: profiling, azimuth_deg: 90, range_max_m: 4, range_bins: 40, azimuth_bins: 24}
  sss: {kind: sidescan, range_max_m: 4, range_bins: 40}
  sounder: {kind: echosounder, range_max_m: 4, range_bins: 40}
classes:
  - {nodes: "pillar*", class: pillar}
""", "labels: true, image: true", "labels: {background: [none]}\n", "file: room.gltf")

# A fan that looks down at the foot of a wall.
WALL = mission_of("""\
  fls: {kind: imaging, azimuth_deg: 40, elevation_deg: 15, range_min_m: 0.8, range_max_m: 3, range_bins: 300,
        azimuth_bins: 64, multipath: {method: cluster}, model: calibrated, instrument: {frequency_hz: 1.0e+6}}
""", "labels: [instance, objects]", "labels: {background: [floor]}\n", "file: room.gltf")


def room_gltf():
    """A box with two pillars in it; y is up, so that (x, y, z) lies at (x, -z, y) of the world."""
    room = json.loads(box_gltf())
    room["nodes"] += [{"name": f"pillar_{k}", "mesh": 0, "translation": [x, 0, z],
                       "scale": [0.06, 0.5, 0.06]} for k, x, z in ((1, 1.2, -0.3), (2, 1.0, 0.5))]
    return json.dumps(room)


BEAMS, BINS, STEPS = 96, 260, 8      # steps of the z-buffer in a beam
OUTLINES = mission_of("""\
  fls: {kind: imaging, azimuth_deg: 60, elevation_deg: 40, range_min_m: 0.8, range_max_m: 3.4, range_bins: 260,
        azimuth_bins: 96}
""", "labels: [objects]", "labels: {background: [none]}\n", "file: room.gltf")


def grid_of(u, v, point):
    """Points [u, v, 3] of a surface of two angles."""
    return np.stack(np.broadcast_arrays(*point(u[:, None], v[None, :])), -1)


def sphere(radius):
    return grid_of(np.linspace(0, np.pi, 61), np.linspace(0, 2 * np.pi, 121), lambda u, v: (
        radius * np.sin(u) * np.cos(v), radius * np.sin(u) * np.sin(v), radius * np.cos(u)))


def torus(radius, tube):
    turn = np.linspace(0, 2 * np.pi, 161)
    return grid_of(turn, turn, lambda u, v: ((radius + tube * np.cos(v)) * np.cos(u),
                                             (radius + tube * np.cos(v)) * np.sin(u), tube * np.sin(v)))


def plate(half_y, half_z):
    return grid_of(np.linspace(-1, 1, 161), np.linspace(-1, 1, 161), lambda u, v: (0.2 * u, half_y * u, half_z * v))


def silhouettes(bodies):
    """For each body, the bins [range, beam] of its nearest points in a z-buffer; points lie closer than its steps."""
    fine = [ndimage.zoom(points, (4, 4, 1), order=1).reshape(-1, 3) for points in bodies.values()]
    at, owner = np.concatenate(fine), np.repeat(range(len(fine)), [len(points) for points in fine])
    r = np.linalg.norm(at, axis=1)
    across = (30 + np.degrees(np.arctan2(at[:, 1], at[:, 0]))) / 60 * BEAMS
    up = np.degrees(np.arcsin(at[:, 2] / r)) / 60 * BEAMS
    cell = np.floor(across * STEPS).astype(int) * 100000 + np.floor(up * STEPS).astype(int) + 50000
    order = np.lexsort((r, cell))
    nearest = order[np.unique(cell[order], return_index=True)[1]]
    bins, beams = np.floor((r - 0.8) / 0.01).astype(int), np.floor(across).astype(int)
    is_in_view = (np.abs(up) < 20 / 60 * BEAMS) & (bins >= 0) & (bins < BINS) & (beams >= 0) & (beams < BEAMS)
    seen, shown = np.zeros((len(bodies), BINS, BEAMS), bool), nearest[is_in_view[nearest]]
    seen[owner[shown], bins[shown], beams[shown]] = True
    return {name: convex(ndimage.binary_fill_holes(mask)) for name, mask in zip(bodies, seen)}


def convex(mask):
    """The convex hull, in the plane of the fan, of a mask [range, beam] that covers at least 0.7 of it, else the mask."""
    bins, beams = np.indices(mask.shape)
    angle, r = np.radians((beams + 0.5) / BEAMS * 60 - 30), 0.8 + (bins + 0.5) * 0.01
    plane = np.stack([r * np.sin(angle), r * np.cos(angle)], -1)
    sides = spatial.ConvexHull(plane[mask]).equations       # outward normal and offset of each
    hull = (plane @ sides[:, :2].T + sides[:, 2] < 1e-9).all(axis=-1)
    return hull if mask.sum() >= 0.7 * hull.sum() else mask


class Objects(Sandbox):
    FILES = {"mission.yaml": MISSION, "room.gltf": room_gltf()}

    def assert_mask(self, text, pixels, box, area, x="x", y="y"):
        """The text of a mask, its box and its area are those of the pixels."""
        np.testing.assert_array_equal(mask_of(text, *pixels.shape[::-1]), pixels)
        rows, columns = np.nonzero(pixels)
        self.assertEqual((box[x], box[y]), ([columns.min(), columns.max() + 1], [rows.min(), rows.max() + 1]))
        self.assertEqual(area, len(rows))

    def test_masks_and_boxes_are_those_of_the_label_images(self):
        self.masks_of("echo")
        for sensor, pings in (("fls", (0, 2, 4)), ("mbes", (0, 3))):
            for ping in pings:
                found = {one["id"]: one for one in self.objects_of(ping, sensor)}
                bins, fan = (np.asarray(Image.open(self.out / f"{sensor}/{name}/{ping:06}.png"))
                             for name in ("instance", "fan_instance"))
                self.assertEqual(set(found), set(np.unique(bins)) - {0})
                for number, one in found.items():
                    mask = bins == number
                    self.assert_mask(one["mask"], mask, one["box_bins"], one["area_bins"], "beam", "range")
                    self.assertEqual(one["clipped"], bool(np.any([mask[0], mask[-1]]) or mask[:, [0, -1]].any()))
                    if number in fan:
                        self.assert_mask(one["fan"]["mask"], fan == number, one["fan"]["box_px"], one["fan"]["area_px"])
                    else:
                        self.assertIsNone(one["fan"])

    def test_a_side_scan_has_an_entry_a_side(self):
        self.masks_of("echo")
        found = self.json("out/sss/objects.json")
        self.assertEqual((found["picture"], found["width"], found["height"], found["pings"], found["pings_per_pixel"]),
                         ("waterfall.png", 92, 6, 6, 1))
        left, shadows = (np.load(self.out / f"sss/{name}.npy").copy() for name in ("instance", "object_shadow"))
        for one in found["objects"]:
            mask = mask_of(one["mask"], 92, 6)
            self.assertEqual(set(left[mask]), {one["id"]})
            left[mask] = 0
            columns = np.nonzero(mask)[1]
            side = "port" if columns.max() < 46 else "starboard"
            self.assertTrue(side == "port" or columns.min() >= 46)
            self.assertEqual((one["side"], one["bearing_deg"]), (side, -90 if side == "port" else 90))
            self.assert_mask(one["mask"], mask, one["box_px"], one["area_px"])
            self.assertEqual(one["pings"], one["box_px"]["y"])
            rows = np.nonzero((shadows == one["id"])[:, :46] if side == "port" else (shadows == one["id"])[:, 46:])[0]
            self.assertEqual(one.get("shadow_box_px", {}).get("y"), [rows.min(), rows.max() + 1] if rows.size else None)
            self.assertAlmostEqual(one["range_m"], np.abs(columns + 0.5 - 46).mean() * 4 / 46, delta=0.06)
        self.assertFalse(left.any())
        sounder = self.json("out/sounder/objects.json")
        self.assertEqual((sounder["picture"], sounder["width"], sounder["height"]), ("echogram.png", 6, 40))

    def masks_of(self, kind):
        """The masks of the pillars in the pings of fls and in the waterfall, for a kind of mask."""
        mission = self.folder / "mission.yaml"
        mission.write_text(re.sub(r"labels: \{(mask: [^,]*, )?", f"labels: {{mask: {kind}, ", mission.read_text()))
        self.assert_renders("--overwrite")
        found = {("fls", ping, one["name"]): one for ping in (0, 2, 4) for one in self.objects_of(ping, "fls")}
        found |= {("sss", one["side"], one["name"]): one for one in self.json("out/sss/objects.json")["objects"]}
        return {key: mask_of(one["mask"], *((48, 70) if key[0] == "fls" else (92, 6))) for key, one in found.items()
                if "pillar" in one["name"]}

    def test_outlines_are_those_of_the_bodies_in_view(self):
        """Against rays through a z-buffer of points on the bodies, closed and filled as a person draws."""
        bodies = {"ball": (sphere(0.12), (1.5, 0.5, 0.1)), "tyre": (torus(0.25, 0.08), (1.6, -0.35, -0.3)),
                  "front": (sphere(0.1), (2.2, 0.3, -0.3)), "behind": (sphere(0.2), (2.6, 0.42, -0.28)),
                  "chain": (np.concatenate([sphere(0.04) + (0, 0.05 * k, 0) for k in range(8)]), (2.7, -0.9, 0.2)),
                  "wall": (plate(0.8, 0.5), (3.2, -0.3, 0.1))}
        nodes = [{"name": name, "mesh": k} for k, name in enumerate(bodies)]
        # glTF is y up: (x, y, z) of the world lies at (x, z, -y).
        meshes = [grid_mesh(((points + np.array(at))[..., [0, 2, 1]] * (1, 1, -1)).reshape(-1, 3).tolist(), points.shape[1])
                  for points, at in bodies.values()]
        self.write("room.gltf", gltf(nodes, meshes))
        self.write("path.csv", csv_of("0,0,0,0,0,0,0", "1,0,0,0,0,0,0"))
        self.write("mission.yaml", OUTLINES)
        self.assert_renders()
        expected = silhouettes({name: points + np.array(at) for name, (points, at) in bodies.items()})
        found = {one["name"]: one for one in self.objects_of(0)}
        self.assertEqual(set(found), set(bodies))
        for name, one in found.items():
            mask, body = mask_of(one["mask"], BEAMS, BINS), expected[name]
            overlap = (mask & body).sum() / (mask | body).sum()
            self.assertGreater(overlap, 0.85, name)
            self.assertEqual(ndimage.label(mask, np.ones((3, 3)))[1], 1, name)  # one piece,
            self.assertEqual(ndimage.label(~np.pad(mask, 1))[1], 1, name)       # without holes
            self.assert_mask(one["mask"], mask, one["box_bins"], one["area_bins"], "beam", "range")

    def test_shadows_belong_to_masks_by_class(self):
        plain = self.masks_of("outline")
        self.edit("mission.yaml", "mask: outline, ", "mask: outline, shadow: [pillar], ")
        self.edit("mission.yaml", "background: [none]", "background: [auto]")
        self.assert_renders("--overwrite")
        shaded = {("fls", ping, one["name"]): mask_of(one["mask"], 48, 70) for ping in (0, 2, 4)
                  for one in self.objects_of(ping, "fls") if "pillar" in one["name"]}
        self.assertTrue(any(mask.sum() > plain[key].sum() for key, mask in shaded.items()))
        shutil.rmtree(self.out)
        self.edit("mission.yaml", "shadow: [pillar]", "shadow: [pilar]")
        self.refused("mission.yaml:", "labels.shadow: there is no class 'pilar' (did you mean 'pillar'?)")

    def test_what_is_background_for_its_size_is_said(self):
        """The largest part of a mesh may be what a mission is about; a bottom is not."""
        says = "'walls', the largest surface, is no object by labels.background: [auto]; [none] keeps it"
        for background, bottom, expected in (("auto", "", True), ("none", "", False), ("auto, walls", "", False),
                                             ("auto", ", bottom: [walls]", False)):
            mission = MISSION.replace("[none]", f"[{background}]").replace("materials.csv}", f"materials.csv{bottom}}}")
            self.write("mission.yaml", mission)
            with self.subTest(background=background, bottom=bottom):
                self.assertEqual(says in self.succeeds("validate", "mission.yaml").stdout, expected)

    def test_parts_of_a_node_are_classes_by_material(self):
        """A plate of two materials, with a wall of one of them beside it: port is glass, starboard paint."""
        self.write("plate.obj", "".join(f"v {x} {y} {z}\n" for x in (2, 3) for y in (-1, 0, 1) for z in (-1, 1))
                   + "o plate\nusemtl Glass.001\nf 3 4 6 5\nusemtl Paint\nf 1 2 4 3\no wall\nusemtl Paint\nf 7 8 12 11\n")
        self.write("materials.csv", (self.folder / "materials.csv").read_text() + "Glass,2500,5600\nPaint,1200,2000\n")
        self.write("mission.yaml", MISSION.replace("file: room.gltf", "file: plate.obj, up: z")
                   .replace('{nodes: "pillar*", class: pillar}',
                            '{materials: "Glass*", class: window}\n  - {nodes: plate, class: hull}'))
        self.assert_renders()
        labels = self.dataset()["labels"]
        names = {entry["name"]: entry["id"] for entry in labels["instances"]}
        classes = {entry["id"]: entry["name"] for entry in labels["classes"]}
        self.assertEqual({entry["name"]: classes[entry["class"]] for entry in labels["instances"]},
                         {"plate": "hull", "plate.Glass.001": "window", "wall": "wall"})
        ids = np.asarray(Image.open(self.out / "fls/instance/000000.png"))
        starboard, port = (set(np.unique(half)) - {0} for half in (ids[:, :24], ids[:, 24:]))
        self.assertEqual((port, starboard), ({names["plate.Glass.001"]}, {names["plate"]}))

    def test_what_is_refused(self):
        labels = "labels: {background: [none]}\n"
        for old, new, *fragments in ((labels, "labels: {background: [wals]}\n", "there is no class 'wals' (did you mean 'walls'?)"),
                (labels, "labels: {background: []}\n", "'background' names classes, auto or none"),
                (labels, "labels: {mask: silhouette}\n", "unknown mask 'silhouette'", "outline, echo"),
                ("labels: true", "fan: false, labels: [fan]", "'fan'", "output.fan: true")):
            self.write("mission.yaml", MISSION)
            self.edit("mission.yaml", old, new)
            self.refused("mission.yaml:", *fragments)

    def test_a_wall_is_drawn_at_its_foot(self):
        """There floor and wall reflect the sound into each other: the brightest line of a tank is multipath. Of the
        mirror image of the floor, which the wall shows behind it, nothing is drawn."""
        self.write("room.gltf", gltf([{"name": "floor", "mesh": 0, "translation": [0, -0.8, 0]}, {"name": "wall", "mesh": 1}],
                                     [sheet_mesh(5.0), ([(1.5, y, z) for y in (-0.8, 1) for z in (-5, 5)], [0, 1, 3, 0, 3, 2], 0)]))
        self.write("path.csv", csv_of("0,0,0,0,0,30,0", "1,0,0,0,0,25,0"))
        self.write("mission.yaml", WALL)
        self.assert_renders()
        sensor = self.dataset()["sensors"][0]
        edges, azimuth = (np.array(sensor[key]) for key in ("range_edges_m", "azimuth_edges_rad"))
        # At the sine y / r of a beam the foot (1.5, y, -0.8) lies at r = hypot(1.5, 0.8) / cos b.
        foot = np.hypot(1.5, 0.8) / np.cos(0.5 * (azimuth[:-1] + azimuth[1:]))
        for ping in (0, 1):
            walls = [one for one in self.objects_of(ping) if one["name"] == "wall"]
            self.assertEqual(len(walls), 1)
            mask = mask_of(walls[0]["mask"], 64, 300)
            at_foot = mask[np.searchsorted(edges, foot) - 1, np.arange(64)]
            behind = mask & (edges[:-1, None] > foot + 0.3)
            self.assertGreater(at_foot.mean(), 0.9)
            self.assertLess(behind.sum(), 0.02 * mask.sum())
