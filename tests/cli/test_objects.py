"""The facts of objects: per ping, and in the pictures of all pings, against the label arrays beside them; read as the
formats' authors publish them."""
import json
import sys
import unittest

from sandbox import ROOT, Sandbox, box_gltf, gltf, run_with, sheet_mesh

run_with("numpy", "PIL")
sys.path.append(str(ROOT / "tests/python"))
import numpy as np
from PIL import Image
from tool import mask_of

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

# A fan that looks down at the foot of a wall.
WALL = """\
name: wall
seed: 7
scene: {file: room.gltf, materials: materials.csv}
trajectory: {file: path.csv}
sensors:
  fls: {kind: imaging, azimuth_deg: 40, elevation_deg: 15, range_min_m: 0.8, range_max_m: 3, range_bins: 300,
        azimuth_bins: 64, multipath: {method: cluster}, model: calibrated, instrument: {frequency_hz: 1.0e+6}}
output: {folder: out, labels: [instance, objects]}
labels: {background: [floor], mask: silhouette}
"""


def room_gltf():
    """A box with two pillars in it; y is up, so that (x, y, z) lies at (x, -z, y) of the world."""
    room = json.loads(box_gltf())
    room["nodes"] += [{"name": f"pillar_{k}", "mesh": 0, "translation": [x, 0, z],
                       "scale": [0.06, 0.5, 0.06]} for k, x, z in ((1, 1.2, -0.3), (2, 1.0, 0.5))]
    return json.dumps(room)


def picture(path):
    """Its pixels [row, column]; of a picture with a table of colours, their numbers."""
    with Image.open(path) as image:
        return np.asarray(image)


class Objects(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("room.gltf", room_gltf())

    def assert_mask(self, text, pixels, box, area, x="x", y="y"):
        """The text of a mask, its box and its area are those of the pixels."""
        np.testing.assert_array_equal(mask_of(text, *pixels.shape[::-1]), pixels)
        rows, columns = np.nonzero(pixels)
        self.assertEqual((box[x], box[y]), ([columns.min(), columns.max() + 1], [rows.min(), rows.max() + 1]))
        self.assertEqual(area, len(rows))

    def test_masks_and_boxes_are_those_of_the_label_images(self):
        self.assert_renders()
        for sensor, pings in (("fls", (0, 2, 4)), ("mbes", (0, 3))):
            for ping in pings:
                found = {one["id"]: one for one in self.objects_of(ping, sensor)}
                bins, fan = (picture(self.out / f"{sensor}/{name}/{ping:06}.png") for name in ("instance", "fan_instance"))
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
        self.assert_renders()
        found = self.json("out/sss/objects.json")
        self.assertEqual((found["picture"], found["width"], found["height"], found["pings"], found["pings_per_pixel"]),
                         ("waterfall.png", 92, 6, 6, 1))
        left = np.load(self.out / "sss/instance.npy").copy()
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
            self.assertAlmostEqual(one["range_m"], np.abs(columns + 0.5 - 46).mean() * 4 / 46, delta=0.06)
        self.assertFalse(left.any())
        sounder = self.json("out/sounder/objects.json")
        self.assertEqual((sounder["picture"], sounder["width"], sounder["height"]), ("echogram.png", 6, 40))

    def masks_of(self, kind):
        """The masks of the pillars in the pings of fls and in the waterfall, for a kind of mask."""
        self.edit("mission.yaml", "labels: {", f"labels: {{mask: {kind}, ") if kind else None
        self.assert_renders("--overwrite")
        found = {("fls", ping, one["name"]): one for ping in (0, 2, 4) for one in self.objects_of(ping, "fls")}
        found |= {("sss", one["side"], one["name"]): one for one in self.json("out/sss/objects.json")["objects"]}
        return {key: mask_of(one["mask"], *((48, 70) if key[0] == "fls" else (92, 6))) for key, one in found.items()
                if "pillar" in one["name"]}

    def test_silhouettes_lie_in_the_echo_and_have_shadows(self):
        self.edit("mission.yaml", "background: [none]", "background: [auto]")
        echo = self.masks_of("")
        drawn = self.masks_of("silhouette")
        self.assertTrue(drawn)
        self.assertLessEqual(set(drawn), set(echo))
        for key, mask in drawn.items():
            self.assertGreater((mask & echo[key]).sum(), 0.8 * mask.sum(), key)
        self.edit("mission.yaml", "mask: silhouette", "mask: silhouette+shadow")
        whole = self.masks_of("")
        self.assertEqual(set(whole), set(drawn))
        self.assertFalse(any((drawn[key] & ~mask).any() for key, mask in whole.items()))
        self.assertTrue(any(mask.sum() > drawn[key].sum() for key, mask in whole.items() if key[0] == "fls"))

    def test_what_is_background_for_its_size_is_said(self):
        """The largest part of a mesh may be what a mission is about; a bottom is not."""
        says = "'walls', the largest surface, is no object by labels.background: [auto]; [none] keeps it"
        for background, bottom, expected in (("auto", "", True), ("none", "", False), ("auto, walls", "", False),
                                             ("auto", ", bottom: [walls]", False)):
            mission = MISSION.replace("[none]", f"[{background}]").replace("materials.csv}", f"materials.csv{bottom}}}")
            self.write("mission.yaml", mission)
            with self.subTest(background=background, bottom=bottom):
                self.assertEqual(says in self.succeeds("validate", "mission.yaml").stdout, expected)

    def test_what_is_refused(self):
        labels = "labels: {background: [none]}\n"
        for old, new, *fragments in (
                (labels, "labels: {background: [wals]}\n", "there is no class 'wals' (did you mean 'walls'?)"),
                (labels, "labels: {background: []}\n", "'background' names classes, auto or none"),
                ("labels: true", "fan: false\n  labels: [fan]", "'fan'", "output.fan: true")):
            self.write("mission.yaml", MISSION)
            self.edit("mission.yaml", old, new)
            self.refused("mission.yaml:", *fragments)

    def test_a_wall_is_drawn_at_its_foot(self):
        """There floor and wall reflect the sound into each other: the brightest line of a tank is multipath. Of the
        mirror image of the floor, which the wall shows behind it, nothing is drawn."""
        self.write("room.gltf", gltf([{"name": "floor", "mesh": 0, "translation": [0, -0.8, 0]},
                                      {"name": "wall", "mesh": 1}],
                                     [sheet_mesh(5.0), ([(1.5, y, z) for y in (-0.8, 1) for z in (-5, 5)], [0, 1, 3, 0, 3, 2], 0)]))
        self.write("path.csv", "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,0,30,0\n1,0,0,0,0,25,0\n")
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


if __name__ == "__main__":
    unittest.main()
