"""Mistakes that users make: which are errors and which are warnings, and in which words. Ranges and names of keys are
tested in tests/mission. A survey of a sandy sea floor with a mine on it is sound; each row spoils one thing."""
import json
import math
import os

from sandbox import Sandbox, box_gltf, box_mesh, csv_of, digest, gltf, obj, png, sheet_mesh, triangles_of

MINE = "{name: mine, file: mine.gltf, position_m: [20, 4, 0.3]}"
MISSION = f"""\
name: bay
scene:
  file: bottom.gltf
  materials: materials.csv
  objects:
    - {MINE}
trajectory: {{file: path.csv}}
sensors:
  fls:
    kind: imaging
    azimuth_deg: 90
    elevation_deg: 20
    range_max_m: 12
    range_bins: 48
    azimuth_bins: 24
    mount: {{rpy_deg: [0, 30, 0]}}
    noise: {{add_sigma: 0.01}}
output: {{folder: out}}
"""
MATERIALS = "material,density_kg_m3,sound_speed_m_s\nSand,1900,1650\nSteel,7850,5900\n"
GLB, TIFF = b"glTF\x02\0\0\0" + bytes(30), b"II*\0\x08\0\0\0" + bytes(30)


def bottom(scale=1.0, z=0.0):
    """A square of 100 m about the origin, with a ripple so that it has some height."""
    points, indices, material = sheet_mesh(50.0, 4, lambda x, _: 0.02 * (round(x / 25) % 2))
    points = [tuple(scale * p for p in point) for point in points]
    return gltf([{"name": "sand", "mesh": 0, "translation": [0, z, 0]}], [(points, indices, material)], ("Sand",))


def lone_hull():
    """A closed box of 120 m whose faces look outwards."""
    points, indices, material = box_mesh((60.0, 60.0, 60.0))
    return gltf([{"name": "hull", "mesh": 0}], [(points, indices[::-1], material)], ("Sand",))


def path(z=5.0, offset=(0.0, 0.0), step=1.0):
    """From west to east over the bottom and then north, ten poses."""
    places = [(-20 + 8 * i, 0, 0) if i < 5 else (20, 8 * (i - 5), 90) for i in range(10)]
    return csv_of(*(f"{step * i},{x + offset[0]},{y + offset[1]},{z},0,0,{yaw}" for i, (x, y, yaw) in enumerate(places)))


def edited(*pairs, text=MISSION):
    for old, new in zip(pairs[::2], pairs[1::2], strict=True):
        assert old in text, old
        text = text.replace(old, new, 1)
    return {"mission.yaml": text}


def mine_as(line):
    return edited(MINE, line)


def ground(line):
    """The scene's file is left out, `line` comes in its place; the mine is above it."""
    return edited("  file: bottom.gltf\n", f"  {line}\n", "0.3]", "50]")


def heightmap(options, file="bed.png"):
    return ground(f"heightmap: {{file: {file}, material: Sand{options}}}")


def seabed(keys):
    return ground(f"seabed: {{cell_m: 0.5, size_m: [60, 60], material: Sand{keys}}}")


def sediments(old, new):
    sound = ("bottom: [sand]\n  sediment_map: {file: quarters.png, pixel_m: 50, origin_m: [50, 50], "
             "materials: {1: Sand, 2: Steel, 3: Sand, 4: Steel}}")
    assert old in sound
    return edited("  objects:\n", f"  {sound.replace(old, new)}\n  objects:\n")


def decibels(options):
    return edited("  objects:\n", "  bottom: [sand]\n  backscatter_map: {file: quarters.png, pixel_m: 50, "
                  f"origin_m: [50, 50]{options}}}\n  objects:\n")


def moving(keys, more="name: fish, "):
    return mine_as(f"{{{more}file: mine.gltf, trajectory: {{{keys}}}}}")


# In place of the mine a slab of 2 m x 2 m x 0.2 m whose z points up.
SLAB = {"slab.obj": obj(*triangles_of(box_mesh((1.0, 1.0, 0.1))))} | mine_as(
    "{name: mine, file: slab.obj, material: Steel, position_m: [20, 4, 0.3]}")
# Millimetres that are read as metres.
POST = {"post.obj": obj(*triangles_of(box_mesh((150, 150, 450))))}
WAY = "waypoints: [{position_m: [4, -2, 1]}, {position_m: [4, 2, 1]}], rate_hz: 5, speed_m_s: "


# What is done, and words of the message.
REFUSED = (
    # Files of other kinds, and names of files.
    ({"mission.yaml": GLB}, "is a .glb mesh, not YAML"), (edited("sensors:\n", "noise: {add_sigma: 0.01}\nsensors:\n"),
     "unknown key 'noise'; it belongs to a sensor: sensors.NAME.noise"), (edited("kind: imaging", "preset: gemini_720"),
     "mission.yaml:10:13", "did you mean 'gemini_720is'?", "micron", "sensors/NAME.yaml"),
    (edited("kind: imaging", "preset: oculus_m750d_750khz"), "did you mean 'sensors/oculus_m750d_750khz.yaml'?"),
    (edited("kind: imaging", "kind: sidescan\n    preset: sensors/gemini_720is.yaml"),
     "mission.yaml:10:11: 'sensors/gemini_720is.yaml' is the preset of a sonar of the kind 'imaging'"),
    (edited("bottom.gltf", "botom.gltf"), "botom.gltf: cannot open", "did you mean 'bottom.gltf'?", "mission.yaml:3:3 names it"),
    (edited("mine.gltf", "meshes/mine.gltf"), "there is no folder", "mission.yaml:6:7"),
    (edited("bottom.gltf", "scenes\\bottom.gltf"), "separate folders by '/'"),
    (edited("bottom.gltf", "~/bottom.gltf"), "'~' is not replaced"),
    (edited("bottom.gltf", "path.csv"), "path.csv: is not glTF", "mission.yaml:3:3 names it"),
    (edited("{file: path.csv}", "{file: nope.csv}"), "nope.csv: cannot open", "mission.yaml:7:13 names it"),
    (edited("bottom.gltf", "bathy.tif") | {"bathy.tif": TIFF},
     "is a TIFF picture, such as a GeoTIFF, not glTF; an image of heights belongs into scene.heightmap"),
    (edited("bottom.gltf", "hull.DAE") | {"hull.DAE": "solid"}, "convert it: assimp export hull.DAE hull.glb"),
    ({"bottom.gltf": "version https://git-lfs.github.com/spec/v1\n"}, "`git lfs pull`"),
    (edited("{file: path.csv}", "{lawnmower: {area_min_m: [-40, -40], area_max_m: [40, 40], z_m: 5, "
            "line_spacing_m: 0.01, speed_m_s: 0.1, rate_hz: 50}}"), "mission.yaml: trajectory: rate_hz of 50 gives"),
    # Materials and objects.
    ({"materials.csv": MATERIALS.replace("Steel", "steel")}, "materials.csv: lacks the material 'Steel' of 'mine' in",
     "mine.gltf", "(mission.yaml:6:7)", "did you mean 'steel'?", "add it to the CSV or give scene.material_default"),
    ({"mine.gltf": box_gltf(material="Con\x1b[2Jcrete")}, "Con\\x1b[2Jcrete"),
    (mine_as("{name: a, file: mine.gltf, material: steal}"),
     "mission.yaml:6:7: unknown material 'steal' (did you mean 'Steel'?)", "materials.csv"),
    ({"mine.gltf": '{"asset": {"version": "2.0"}}'}, "mission.yaml:6:7: 'mine': there is no surface in", "name another file"),
    (mine_as("{name: a, file: mine.gltf, bury_m: 0.1}"), "mission.yaml:6:", "bury_m and align need place: on_bottom"),
    (edited("  objects:\n", "  bottom: [flor]\n  objects:\n"), "mission.yaml:3:3: ", "bottom: no node of", "fits 'flor'"),
    (edited("  objects:\n", "  bottom: [sand]\n  objects:\n", "name: mine", "name: sand", "out}", "out, labels: [height]}"),
     "scene.bottom names a node 'sand', too"),
    (mine_as(MINE + "\n    - " + MINE), "mission.yaml:7:7: there is an object 'mine' already"),
    (mine_as(MINE.replace("0.3", "-9")), "mission.yaml:6:7: 'mine' lies wholly below the bottom", "place: on_bottom"),
    (mine_as("{name: a, file: mine.gltf, position_m: [49.8, 0, 0], place: on_bottom}"),
     "mission.yaml:6:7: 'a' reaches beyond the bottom", "from (-50, -50) to (50, 50)", "position_m"),
    (POST | mine_as("{name: a, file: post.obj, material: Steel, place: on_bottom}"),
     "mission.yaml:6:7: 'a' reaches beyond the bottom", "; 'a' is 900 m long: millimetres? units: mm"),
    (mine_as("{name: a, file: mine.gltf, place: on_bottom, bury_m: 0.81}"), "'a' lies wholly below the bottom; lower bury_m"),
    (edited("  file: bottom.gltf\n", "", f"  objects:\n    - {MINE}\n", ""),
     "mission.yaml:3:3: 'scene' needs the key 'file', a heightmap, a seabed or objects"),
    (edited("  objects:\n    - " + MINE, "  scatter:\n    - {name: mine, files: [mine.gltf], count: 50, "
            "area_min_m: [2, -2], area_max_m: [8, 2]}"),
     "mission.yaml:6:7", "'mine': object", "of 50 finds no room in 1000 tries", "larger area, fewer or smaller objects"),
    (moving(WAY + "8"), "mission.yaml:6:7", "'fish' moves from 0 s to", "ping from 0 s to 9 s",
     "let its trajectory last as long"), (moving(WAY + "0.1", ""), "mission.yaml:6:", "an object that moves needs a name"),
    (moving(WAY + "0.1", "name: fish, place: on_bottom, "), "mission.yaml:6:", "an object that moves cannot rest on the bottom"),
    # Grounds.
    (ground("heightmap: {file: bed.png, pixel_m: 5}"), "the heightmap has no material; write scene.heightmap.material: NAME"),
    (heightmap(""), "bed.png", "no world file lies next to it", "scene.heightmap.pixel_m", "mission.yaml:3:"),
    (heightmap(", pixel_m: 1, height_scale: 0"), "height_scale of 0 makes all flat"),
    (heightmap(", pixel_m: 1") | {"bed.png": png([[5] * 96] * 40, 16, 3)},
     "has 3 channels, and a heightmap has one", "gdal_translate -b 1"),
    (heightmap(", pixel_m: 1") | {"bed.png": png([[5]], size=(30000, 30000))},
     "has 30000 x 30000 pixels of 1 value, and at most 2^26", "gdal_translate"),
    (heightmap(", pixel_m: 5}\n  seabed: {cell_m: 1, material: Sand"), "are both the bottom"),
    (heightmap(", pixel_m: 5") | edited("name: mine", "name: heightmap", text=heightmap(", pixel_m: 5")["mission.yaml"]),
     "an object has the name of the ground"),
    (sediments("4: Steel", "5: Steel"), "quarters.png: row 1, column 1: 4 has no material; add 4: MATERIAL to "
     "scene.sediment_map.materials, or mark it: gdal_translate -a_nodata 4", "mission.yaml:6:"),
    (sediments("4: Steel", '"#102030": Steel'),
     "one channel of numbers, and scene.sediment_map.materials has '#102030'; write 7: MATERIAL"),
    (sediments("bottom: [sand]\n  ", ""), "mission.yaml:3:3: maps need ground to lie on; write scene.bottom: [NAME]"),
    (sediments("pixel_m: 50, ", ""), "quarters.png: does not say how large its pixels are", "scene.sediment_map.pixel_m"),
    (decibels("") | {"quarters.png": png([[200]])}, "quarters.png: row 0, column 0: 200 dB, and at most 100 are believed"),
    (decibels("") | {"quarters.png": png([[1, 2, 3, 4]], channels=4)}, "has 4 channels, and a map of decibels has one"),
    (ground("seabed: {cell_m: 0.5}"), "the seabed has no material; write scene.seabed.material"),
    (seabed(", ripples: {length_m: 1.9, height_m: 0.1}"), "ripples need 4 cells from crest to crest; lower cell_m"),
    (seabed(", sediments: [{material: Steel, share: 1}]"), "give material or sediments, not both"),
    (seabed(", rocks: {density_per_m2: 1, diameter_m: [2, 1]}"), "'diameter_m' is the least and the largest"),
    (seabed(", rocks: {density_per_m2: 9999, diameter_m: [0.1, 0.2]}"), "and at most 50000 have room", "density_per_m2"),
    (ground("seabed: {cell_m: 0.002, material: Sand}"), "mission.yaml:3:11: the mission needs", "raise cell_m"),
    (ground("seabed: {cell_m: 0.1, preset: seabeds/rockie.yaml}"),
     "none of this name came with the program", "did you mean 'rocky'", "seabeds/NAME.yaml"), )

# The same of missions that can be rendered: the number of the warning, and words of it.
WARNED = (({"bottom.gltf": bottom(1000)}, "W04", "scene.units: mm"),
    ({"bottom.gltf": bottom(0.001)} | edited("  objects:\n    - " + MINE + "\n", ""), "W04",
     "check its units (scene.units: mm"), (edited("range_max_m: 12", "range_max_m: 15000"), "W04", "range_max_m is in metres"),
    ({"mine.gltf": box_gltf([6000] * 3, "Steel")} | mine_as(MINE.replace("0.3", "6001")), "W01", "mine.gltf is 1.2e+04 m long"),
    ({"materials.csv": MATERIALS.replace("7850", "7.85")}, "W01", "looks like g/cm^3"),
    ({"materials.csv": MATERIALS.replace("5900", "5.9")}, "W01", "looks like km/s"),
    ({"path.csv": path(z=-5)} | edited("\n    - " + MINE, " []"), "W10", "z points up"),
    ({"mine.gltf": box_gltf([3] * 3, "Steel")} | mine_as(MINE.replace("[20, 4, 0.3]", "[4, 0, 5]")), "W11", "it is inside 'mine'"),
    ({"bottom.gltf": lone_hull()} | edited("\n    - " + MINE, " []"), "W11", "it is inside 'hull'"),
    ({"path.csv": path(z=30)}, "W13", "raise range_max_m or sail nearer"), ({"path.csv": path(z=95), "bottom.gltf": bottom(z=-100)}
     | edited("0.3]", "-99.7]", "[0, 30, 0]", "[0, 90, 0]"), "W13", "z points up, and depths are negative"),
    (edited("range_max_m: 12", "range_min_m: 90\n    range_max_m: 120"), "W14", "lower range_min_m"),
    (edited("rpy_deg: [0, 30, 0]", "rpy_deg: [0, 0, 0]", "elevation_deg: 20", "elevation_deg: 5"), "W15",
     "raise elevation_deg, or tilt the sonar"),
    (edited("rpy_deg: [0, 30, 0]", "rpy_deg: [0, -80, 0]", "azimuth_deg: 90", "azimuth_deg: 20"), "W16",
     "turn it with mount.rpy_deg"), ({"path.csv": path(offset=(4e5, 6e6))}, "W17", "the nearest ever is 6.01"),
    (edited("add_sigma: 0.01", "add_sigma: 5"), "W18", "lower noise.add_sigma"),
    ({"path.csv": path(offset=(27, 0))} | edited("\n    - " + MINE, " []"), "W40", "the scene ends within its view"),
    (edited("azimuth_deg: 90", "azimuth_deg: 1.57"), "W38", "1.57 radians are 89.95 degrees; radians? azimuth_deg: 89.95"),
    ({"path.csv": path(step=0.005)}, "W39", "9 of its 9 pings after the first begin before"),
    (SLAB, "W01", "slab.obj stands on its edge with y up and would lie flat with z up: does its z point up? up: z"),
    (mine_as(MINE.replace("[20, 4, 0.3]}", "[20, 4, 0.3], units: mm}")), "W21", "1 object is not resolved"),
    (mine_as(MINE.replace("[20, 4, 0.3]", "[-45, -45, 0.3]")), "W21", "1 object is not in view"),
    (mine_as(MINE + "\n    - {name: b, file: mine.gltf, scale: 0.5, position_m: [20, 4, 0.3]}"), "W21", "'b'; these may lie behind"),
    (edited("output:", "vary: [{key: sensors.fls.mount.rpy_deg.2, uniform: [175, 185], per: ping}]\noutput:", "[20, 4, 0.3]",
            "[20, 38, 0.3]"), "W21", "'mine'; move these"),
    (decibels("") | {"quarters.png": png([[0]])}, None, "scene.backscatter_map changes nothing: each of its pixels is unknown or 0 dB"),
    (edited("  objects:\n", "  bottom: [sand]\n  backscatter_map: {file: quarters.png, pixel_m: 4.5, origin_m: "
            "[1000, 5]}\n  objects:\n"), None, "scene.backscatter_map lies outside the scene and changes nothing: the map has x"),
    (edited("scene:\n", "scene:\n  water_surface: {height_m: 9}\n"), None, "scene.water_surface reflects no sound"),
    (edited("scene:\n", "scene:\n  water_surface: {height_m: 3}\n", "    noise:", "    multipath: {method: exact}\n    noise:"),
     None, "scene.water_surface at 3 m lies below the sonar in 10 of 10 pings"),
    (edited("scene:\n", "water: {profile: {named: summer}}\nscene:\n  water_surface: {height_m: 3}\n"),
     None, "scene.water_surface at 3 m lies below the sonar in 10 of 10 pings"), )


class Mistakes(Sandbox):
    FILES = {"mission.yaml": MISSION, "materials.csv": MATERIALS, "bottom.gltf": bottom(), "path.csv": path(),
             "mine.gltf": box_gltf([0.4] * 3, "Steel"), "quarters.png": png([[1, 2], [3, 4]]),
             "bed.png": png([[r * c % 7 for c in range(20)] for r in range(20)])}

    def make(self, files):
        self.write_all({**self.FILES, **files})

    def validate(self, *arguments, code):
        return self.run_sonarsim("validate", "mission.yaml", "--json", *arguments, code=code)

    def test_a_sound_mission_has_no_warning(self):
        reported = json.loads(self.validate("--strict", code=0).stdout)
        self.assertEqual(reported["warnings"], [])
        surveyed = reported["sensors"]["fls"]["survey"]
        self.assertEqual((surveyed["pings_tried"], surveyed["blind"]), (10, 0))
        # Five metres above the bottom, which ripples by two centimetres; the beam's lower edge is 40 degrees down.
        low, high = surveyed["altitude_m"]
        self.assertTrue(4.9 < low <= high <= 5.0, surveyed)
        self.assertAlmostEqual(surveyed["first_echo_m"][0], 5 / math.sin(math.radians(40)), delta=0.3)
        self.assertFalse(self.out.exists())

    def test_refusals(self):
        for files, *words in REFUSED:
            with self.subTest(words=words[0]):
                self.make(files)
                before = digest(self.folder)
                # libpng leaves an error by a jump, past what would free memory.
                env = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}
                result = self.run_sonarsim("render", "mission.yaml", env=env, code=2)
                self.assert_has(result.stderr, *words)
                # A library may have its own lines.
                self.assertEqual(len([x for x in result.stderr.splitlines() if x.startswith("error: ")]), 1, result.stderr)
                self.assertNotIn("\x1b", result.stderr)
                same = self.run_sonarsim("validate", "mission.yaml", env=env)
                self.assertEqual((same.returncode, same.stderr), (2, result.stderr))
                self.assertEqual(digest(self.folder), before)

    def test_warnings(self):
        for files, number, words in WARNED:
            with self.subTest(number=number, words=words):
                self.make(files)
                result = self.validate("--strict", code=3)
                lines = [json.loads(line) for line in result.stderr.splitlines()]
                found = [line for line in lines if words in line["message"]]
                self.assertEqual(len(found), 1, result.stderr)
                if number is not None:
                    self.assertEqual(found[0]["code"], number)
                    numbers = [w["number"] for w in json.loads(result.stdout)["warnings"]]
                    self.assertIn(number, numbers)
                    # That pings are blind comes after the reasons.
                    after = numbers[numbers.index("W12"):] if "W12" in numbers else []
                    self.assertFalse({"W10", "W11", "W13", "W14", "W15", "W16", "W17"} & set(after), numbers)

    def test_how_a_file_without_axes_is_read(self):
        self.make(SLAB | POST)
        self.assertIn("it is 900 m long: millimetres? units: mm", self.reported("inspect", "post.obj")["questions"])
        self.assertEqual(self.reported("validate", "mission.yaml")["read_as"], ["slab.obj: metres, y up (no `up` given)"])
        self.assertRegex(self.succeeds("validate", "mission.yaml").stdout, r"read as +slab.obj: metres, y up \(no `up` given\)\n")
        self.assertRegex(self.succeeds("inspect", "slab.obj").stdout, r"^read as +metres, y up \(no `up` given\)\n")
        self.assertIn("question: slab.obj stands on its edge", self.succeeds("inspect", "slab.obj").stdout)
        said = self.reported("inspect", "slab.obj", "--up", "z", "--units", "cm")
        self.assertEqual((said["read_as"], said["questions"]), ("centimetres, z up", []))
        self.assert_near(said["bounds_max_m"], (0.01, 0.01, 0.001))
        for up in ("y", "z"):  # an answer is not questioned
            self.make(mine_as("{name: mine, file: slab.obj, up: %s, material: Steel, position_m: [20, 4, 0.3]}" % up))
            said = self.reported("validate", "mission.yaml")
            self.assertEqual((said["read_as"], said["warnings"]), ([f"slab.obj: metres, {up} up"], []))

    def test_faults_of_several_files_and_in_json(self):
        self.make({"path.csv": "t_s\n", "materials.csv": "material\n", "bottom.gltf": "{"})
        self.assert_has(self.validate(code=2).stderr, "path.csv", "materials.csv", "bottom.gltf")
        self.make(edited("range_max_m", "range_mx_m"))
        fault = json.loads(self.validate(code=2).stderr.splitlines()[-1])
        self.assertEqual((fault["file"], fault["line"], fault["column"]), ("mission.yaml", 13, 5))

    def test_render_warns_of_blind_pings(self):
        self.make({"path.csv": path(offset=(45.0, 0.0))})
        result = self.run_sonarsim("render", "mission.yaml", "--no-files", "--strict", "-q", code=3)
        # The bottom ends at x = 50 m; at 49 m and beyond, seven poses, the sonar looks past it.
        self.assertIn("W12 sensor 'fls': 7 of 10 pings are blind", result.stderr)
        result = self.run_sonarsim("render", "mission.yaml", "--no-files", "--json", "--set", "output.full_scale=1e4")
        self.assertEqual([text[:3] for text in json.loads(result.stdout)["warnings"]], ["W12", "W20"])
