"""Twenty-five mistakes that users make: which are errors and which are warnings, and in which words.

A survey of a flat sea floor with a mine on it, which is sound; each test spoils one thing."""
import json
import math
import unittest

from sandbox import Sandbox

MISSION = """\
name: bay
scene:
  file: bottom.gltf
  materials: materials.csv
  objects:
    - {name: mine, file: mine.gltf, position_m: [20, 4, 0.3]}
trajectory: {file: path.csv}
sensors:
  fls:
    kind: imaging
    azimuth_deg: 90
    elevation_deg: 20
    range_max_m: 12
    range_bins: 48
    azimuth_bins: 24
    mount: {rpy_deg: [0, 30, 0]}
    noise: {add_sigma: 0.01}
output: {folder: out}
"""
MATERIALS = "material,density_kg_m3,sound_speed_m_s\nSand,1900,1650\nSteel,7850,5900\n"


def mesh(corners, faces, material):
    """A glTF of triangles, its positions as the file has them (y up)."""
    import base64
    import struct
    data = b"".join(struct.pack("<3f", *corner) for corner in corners)
    indices = struct.pack(f"<{3 * len(faces)}H", *(i for face in faces for i in face))
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": material.lower(), "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": material}],
        "buffers": [{"byteLength": len(data + indices), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data + indices).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)},
                        {"buffer": 0, "byteOffset": len(data), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3",
                       "min": [min(c[k] for c in corners) for k in range(3)],
                       "max": [max(c[k] for c in corners) for k in range(3)]},
                      {"bufferView": 1, "componentType": 5123, "count": 3 * len(faces),
                       "type": "SCALAR"}]})


def bottom(scale=1.0):
    """A square of 100 m about the origin, with a ripple so that it has some height."""
    side = [-50.0, -25.0, 0.0, 25.0, 50.0]
    corners = [(scale * x, scale * y, scale * 0.02 * (i % 2)) for i, x in enumerate(side) for y in side]
    corners = [(x, z, -y) for x, y, z in corners]
    quads = [5 * i + k for i in range(4) for k in range(4)]
    return mesh(corners, [f for a in quads for f in ((a, a + 5, a + 6), (a, a + 6, a + 1))], "Sand")


def box(half):
    corners = [tuple(half if i >> k & 1 else -half for k in range(3)) for i in range(8)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return mesh(corners, [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))], "Steel")


def path(z=5.0, offset=(0.0, 0.0)):
    """From west to east over the bottom and then north, ten poses."""
    rows = []
    for i in range(10):
        x, y, yaw = (-20 + 8 * i, 0, 0) if i < 5 else (20, 8 * (i - 5), 90)
        rows.append(f"{i},{x + offset[0]},{y + offset[1]},{z},0,0,{yaw}")
    return "\n".join(["t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg", *rows]) + "\n"


def path_wxyz():
    """The same way with quaternions in the order of another program below our header."""
    rows = []
    for i in range(10):
        x, y, yaw = (-20 + 8 * i, 0, 0.2) if i < 5 else (20, 8 * (i - 5), 90)
        half = math.radians(yaw) / 2
        rows.append(f"{i},{x},{y},5,{math.cos(half)},0,0,{math.sin(half)}")
    return "\n".join(["t_s,x_m,y_m,z_m,qx,qy,qz,qw", *rows]) + "\n"


def spoil_materials(text):
    return {"files": {"materials.csv": text}}


def set_key(*settings):
    return {"set": settings}


# What is done, and what is said of it: the number of a warning, or "error", and words of the message.
MISTAKES = {
    # Errors: the mission cannot be rendered.
    "a key is misspelt": (set_key("sensors.fls.range_mx_m=12"), "error",
                          "unknown key 'range_mx_m' (did you mean 'range_max_m'?)"),
    "a kind is misspelt": (set_key("sensors.fls.kind=imagin"), "error",
                           "unknown kind 'imagin' (did you mean 'imaging'?)"),
    "a number with its unit": (set_key("sensors.fls.range_max_m=12m"), "error",
                               "'range_max_m' must be a finite number, not '12m'"),
    "ranges the wrong way round": (set_key("sensors.fls.range_min_m=20"), "error",
                                   "range_min_m must be below range_max_m"),
    "a mesh of another format": (set_key("scene.file=bottom.fbx") | {"files": {"bottom.fbx": "v 0 0 0\n"}},
                                 "error", "convert it: assimp export"),
    "a material that the CSV lacks": (
        spoil_materials(MATERIALS.replace("Sand", "sand bank")), "error", "Sand"),
    "a file that is not there": (set_key("trajectory.file=pth.csv"), "error", "pth.csv"),
    "times that do not increase": ({"files": {"path.csv": path().replace("\n2,", "\n1,")}}, "error",
                                   "times must increase strictly"),
    "quaternions that are none": ({"files": {"path.csv": path_wxyz().replace("1.0,0,0", "3.0,0,0")
                                             .replace("0.99", "3.99")}}, "error",
                                  "a rotation has norm 1"),
    "an object below the bottom": (set_key("scene.objects.0.position_m=[20, 4, -9]"), "error",
                                   "lies wholly below the bottom"),
    # Warnings: it can, and the pictures are probably not what was meant.
    "a mesh in millimetres": ({"files": {"bottom.gltf": bottom(1000)}}, "W04",
                              "scene.units: mm"),
    "a mesh that is 100 times too large": (
        {"files": {"bottom.gltf": bottom(95), "path.csv": path(z=500)}}, "W04", "check its units"),
    "a mesh in kilometres": ({"files": {"bottom.gltf": bottom(0.001)}} | set_key("scene.objects=[]"),
                             "W04", "check its units"),
    "a range in millimetres": (set_key("sensors.fls.range_max_m=15000"), "W04",
                               "range_max_m is in metres"),
    "water in g/cm^3": (set_key("water.density_kg_m3=1.025"), "error",
                         "must be at least 900"),
    "water in km/s": (set_key("water.sound_speed_m_s=1.48"), "error",
                      "must be at least 1000"),
    "a material in g/cm^3": (spoil_materials(MATERIALS.replace("7850", "7.85")), "W01",
                             "looks like g/cm^3"),
    "a material in km/s": (spoil_materials(MATERIALS.replace("5900", "5.9")), "W01", "looks like km/s"),
    "a material like the water": (spoil_materials(MATERIALS.replace("1900,1650", "997,1480")), "W09",
                                  "its impedance is that of the water"),
    "depths as positive numbers": (
        {"files": {"path.csv": path(z=-5)}} | set_key("scene.objects=[]"), "W10", "z points up"),
    "a way through an object": (
        {"files": {"mine.gltf": box(3.0)}} | set_key("scene.objects.0.position_m=[4, 0, 5]"), "W11",
        "it is inside 'mine'"),
    "a way that leaves the scene": ({"files": {"path.csv": path(offset=(45.0, 0.0))}}, "W12",
                                    "pings are blind"),
    "a range that ends above the bottom": ({"files": {"path.csv": path(z=30)}}, "W13",
                                           "raise range_max_m or sail nearer"),
    "a range that begins below the bottom": (
        set_key("sensors.fls.range_min_m=90", "sensors.fls.range_max_m=120"), "W14",
        "lower range_min_m"),
    "an elevation that misses the bottom": (
        set_key("sensors.fls.mount.rpy_deg=[0, 0, 0]", "sensors.fls.elevation_deg=5"), "W15",
        "raise elevation_deg, or tilt the sonar"),
    "a sonar that looks up": (set_key("sensors.fls.mount.rpy_deg=[0, -80, 0]",
                                      "sensors.fls.azimuth_deg=20"), "W16",
                              "turn it with mount.rpy_deg"),
    "coordinates of another place": ({"files": {"path.csv": path(offset=(4e5, 6e6))}}, "W17",
                                     "the nearest ever is 6.01"),
    "noise above the echoes": (set_key("sensors.fls.noise.add_sigma=5"), "W18", "lower noise.add_sigma"),
    "pictures that are white": (set_key("output.full_scale=1e-3"), "W19", "raise output.full_scale"),
    "pictures that are black": (set_key("output.full_scale=1e4"), "W20", "lower output.full_scale"),
    "an object that no ping sees": (set_key("scene.objects.0.position_m=[-45, -45, 0.3]"), "W21",
                                    "1 object is not in view"),
}


class Mistakes(Sandbox):
    def setUp(self):
        super().setUp()
        self.make({})

    def make(self, files):
        for name, text in {"mission.yaml": MISSION, "materials.csv": MATERIALS, "bottom.gltf": bottom(),
                           "mine.gltf": box(0.4), "path.csv": path(), **files}.items():
            self.write(name, text)

    def validate(self, *arguments):
        return self.run_sonarsim("validate", "mission.yaml", "--json", *arguments)

    def test_a_sound_mission_has_no_warning(self):
        result = self.validate("--strict")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        reported = json.loads(result.stdout)
        self.assertEqual(reported["warnings"], [])
        seen = reported["sensors"]["fls"]["survey"]
        self.assertEqual((seen["pings_tried"], seen["blind"]), (10, 0))
        # Five metres above the bottom, which ripples by two centimetres.
        self.assertTrue(4.9 < seen["altitude_m"][0] <= seen["altitude_m"][1] <= 5.0, seen)
        # The beam's lower edge is 40 degrees down, the upper 20: 5 m / sin 40 and beyond 12 m.
        self.assertAlmostEqual(seen["first_echo_m"][0], 5 / math.sin(math.radians(40)), delta=0.3)
        self.assertEqual(set(seen["seen_most"]), {"sand", "mine"})
        self.assertGreater(reported["hours"], 0)
        self.assertGreater(reported["set_up_seconds"], 0)
        self.assertGreater(reported["bytes"], 0)
        self.assertFalse(self.out.exists())

    def test_each_is_reported(self):
        self.assertGreaterEqual(len(MISTAKES), 25)
        for name, (spoilt, number, words) in MISTAKES.items():
            with self.subTest(mistake=name):
                self.make(spoilt.get("files", {}))
                settings = [word for one in spoilt.get("set", ()) for word in ("--set", one)]
                result = self.validate("--strict", *settings)
                lines = [json.loads(line) for line in result.stderr.splitlines()]
                messages = [line["message"] for line in lines]
                if number == "error":
                    self.assertEqual(result.returncode, 2, result.stderr)
                    self.assertTrue(any(words in message for message in messages), messages)
                    continue
                self.assertEqual(result.returncode, 3, result.stderr)
                mine = [m for m in messages if m.startswith(number) and words in m]
                self.assertEqual(len(mine), 1, messages)
                self.assertIn((number, mine[0]), [(line["code"], line["message"]) for line in lines])
                reported = [w for w in json.loads(result.stdout)["warnings"] if w["number"] == number]
                self.assertTrue(reported, result.stdout)

    def test_all_errors_at_once(self):
        self.make({"mission.yaml": MISSION.replace("azimuth_deg", "azimut_deg")
                   .replace("range_bins: 48", "range_bins: many").replace("folder: out", "fan: yes")})
        for command in ("validate", "render"):
            result = self.run_sonarsim(command, "mission.yaml")
            self.assertEqual(result.returncode, 2)
            lines = result.stderr.splitlines()
            self.assertEqual([line.split(": ")[1] for line in lines],
                             ["mission.yaml:14:17", "mission.yaml:11:5", "mission.yaml:18:15"], lines)
        # Beyond the mission: its trajectory, its materials and its scene are read, all three.
        self.make({"path.csv": "t_s\n", "materials.csv": "material\n", "bottom.gltf": "{"})
        result = self.validate()
        self.assertEqual(result.returncode, 2)
        for name in ("path.csv", "materials.csv", "bottom.gltf"):
            self.assertIn(name, result.stderr)

    def test_render_warns_of_blind_pings(self):
        self.make({"path.csv": path(offset=(45.0, 0.0))})
        result = self.run_sonarsim("render", "mission.yaml", "--no-files", "--strict", "-q")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertRegex(result.stderr, "W12 sensor 'fls': [0-9] of 10 pings are blind")
        result = self.run_sonarsim("render", "mission.yaml", "--no-files", "--json",
                                   "--set", "output.full_scale=1e4")
        self.assertEqual([text[:3] for text in json.loads(result.stdout)["warnings"]], ["W12", "W20"])
        self.make({})
        result = self.run_sonarsim("render", "mission.yaml", "--no-files", "--strict", "-q")
        self.assertEqual((result.returncode, result.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
