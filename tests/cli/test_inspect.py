"""sonarsim new, inspect, preset and preview, what a user looks at before a render; and the report of speed against error."""
import json
import math
import os
import random
import struct

from sandbox import ALL_FILES, MISSION, ROOT, Sandbox, box_gltf, box_mesh, gltf, obj, with_keys

ROW = {"sensor", "engine", "setting", "current", "on_front", "goal", "ms_per_ping", "pings_per_s", "times_131k_rays",
       "ms_131k_rays", "relative_l1", "worst_relative_l1", "miss_rate", "samples_per_ping"}
# A million rays show whether the figures are sound.
QUICK = ("--quick", "-j1", "--reference-rays", "1000000")


class Inspect(Sandbox):
    def test_a_survey_below_waves(self):
        """Its first echo is that of the surface of the water, which is no object of the scene."""
        self.write("mission.yaml", MISSION.split("sensors:")[0].replace("csv\n", "csv\n  water_surface: {height_m: 1, scatters: true}\n", 1)
                   + "water: {wind_m_s: 8}\nsensors: {sss: {preset: sensors/sidescan_400khz.yaml, range_min_m: 0.5, range_max_m: 6}}\n")
        for labels in ("[]", "[objects]"):
            survey = self.reported("validate", "mission.yaml", "--set", f"output.labels={labels}")["sensors"]["sss"]["survey"]
            self.assertAlmostEqual(survey["first_echo_m"][0], 1, delta=0.01)
            self.assertEqual(set(survey["seen_most"]), {"walls"})

    def test_a_scene(self):
        scene = self.reported("inspect", "box.gltf")
        # Half-extents 2, 1.5, 2 in glTF axes; (x, y, z)_world = (x, -z, y)_gltf.
        self.assertEqual((scene["triangles"], scene["bounds_min_m"], scene["bounds_max_m"]), (12, [-2, -2, -1.5], [2, 2, 1.5]))
        # ((2400 * 3200 - 997 * 1480) / (2400 * 3200 + 997 * 1480))^2 = 0.459.
        text = self.succeeds("inspect", "box.gltf", "--materials", "materials.csv").stdout
        self.assertEqual(text.split("reflection\n")[1].split()[:4], ["Concrete", "2400", "3200", "0.459"])
        self.assertIn("walls", text)
        self.write("box.gltf", box_gltf(material="Granite"))
        result = self.succeeds("inspect", "box.gltf", "--materials", "materials.csv")
        self.assertIn("Granite   not in materials.csv", result.stdout)

    def test_a_csv_to_fill_in(self):
        self.write("box.gltf", box_gltf(material="Con, crete"))
        result = self.succeeds("inspect", "box.gltf", "--materials-csv")
        self.assertEqual(result.stdout, 'material,density_kg_m3,sound_speed_m_s\n"Con, crete",,\n')
        self.write("materials.csv", result.stdout)
        self.assert_refused(self.render(), "materials.csv:2: density '' is not a number")
        self.write("materials.csv", result.stdout.replace(",,", ",2400,3200"))
        self.succeeds("validate", "mission.yaml")
        again = self.succeeds("inspect", "box.gltf", "--materials-csv", "--materials", "materials.csv")
        self.assertEqual(again.stdout, result.stdout.replace(",,", ",2400,3200"))

    def test_the_table_of_scattering_in_the_docs(self):
        """Every row of docs/calibrated.md under `| 400 kHz |` is what is printed."""
        rows = [[cell.strip() for cell in line.strip("|").split("|")]
                for line in (ROOT / "docs/calibrated.md").read_text().splitlines() if line.startswith("|")]
        start = [row[0] for row in rows].index("400 kHz")
        printed = self.succeeds("inspect", ROOT / "scenes/materials.csv", "--frequency-khz", 400).stdout.splitlines()
        self.assertEqual(printed[1].split(), rows[start][1:])
        reported = {line.split()[0]: line.split()[1:] for line in printed[2:]}
        for name, *strengths in rows[start + 2:start + 7]:
            self.assertEqual(reported[name], strengths, name)
        self.write("beds.csv", "material,density_kg_m3,sound_speed_m_s,grain_phi\nsand,1900,1650,12\n")
        self.assert_refused(self.run_sonarsim("inspect", "beds.csv"), "beds.csv:2: grain_phi is 12; expected a number from -10 to 9")


def pyramid(length):
    """Corners and faces of a pyramid that stands on a square with z up."""
    points = [(x * length, y * length, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))] + [(0, 0, 2 * length)]
    return points, [(0, 2, 1), (0, 3, 2), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]


class New(Sandbox):
    def assert_a_mission(self, name, *fragments):
        """`new` writes a mission that has no fault and whose images have the object; its text."""
        printed = self.succeeds("new", name).stdout
        mission = self.folder / name.split(".")[0]
        text = mission.with_suffix(".yaml").read_text()
        self.assert_has(printed + text + self.folder.joinpath(f"{mission.name}_materials.csv").read_text(), *fragments)
        self.assertIn(f"next        sonarsim preview {mission.name}.yaml\n", printed)
        small = with_keys("trajectory.count=4", "sensors.fls.azimuth_bins=128", "sensors.fls.range_bins=256",
                          "scene.seabed.cell_m=0.5")
        found = self.reported("validate", f"{mission.name}.yaml", *small)
        self.assertEqual((found["pings"], found["warnings"]), (4, []))
        self.succeeds("render", f"{mission.name}.yaml", "--out", "out", "--overwrite", *small)
        for ping in range(4):
            (seen,) = self.objects_of(ping)
            self.assertEqual((seen["name"], seen["class"]), (mission.name, mission.name))
            self.assertGreater(seen["area_bins"], 50)
        return text

    def test_an_obj_in_millimetres_with_z_up(self):
        self.write("cone.obj", obj(*pyramid(600), "usemtl Hull_Wood.001\n"))
        self.assert_a_mission("cone.obj", "units: mm, up: z", "# guess: the file is 1200 m long: millimetres",
                              "material Hull_Wood: wood\n", "# guess: the numbers of wood\nHull_Wood,720,4000,", "\nsand,1900,1650,")
        whole = {path: path.read_bytes() for path in self.folder.glob("cone*")}
        self.assert_refused(self.run_sonarsim("new", "cone.obj"), "cone.yaml: is there already", "--out")
        (self.folder / "cone.yaml").unlink()
        self.assert_refused(self.run_sonarsim("new", "cone.obj"), "cone_materials.csv: is there already")
        self.assertFalse((self.folder / "cone.yaml").exists())
        self.assert_refused(self.run_sonarsim("render", "cone.obj"), "is a mesh; `sonarsim new cone.obj` writes a mission")
        printed = self.succeeds("new", "cone.obj", "--out", "cm.yaml", "--units", "cm", "--up", "y").stdout
        self.assertNotIn("guess       the file", printed)
        self.assertIn("units: cm, up: y", (self.folder / "cm.yaml").read_text())
        self.succeeds("new", "cone.obj", "--out", "more/cone.yaml", "--preset", "gemini_720is", "--bed", "rippled_sand")
        self.succeeds("validate", "more/cone.yaml")
        self.assertEqual((self.folder / "cone_materials.csv").read_bytes(), whole[self.folder / "cone_materials.csv"])

    def test_a_glb_off_its_origin(self):
        scene = gltf([{"name": "walls", "mesh": 0, "translation": [30, 5, -4]}], [box_mesh((3, 1, 2))], ("Steel",)).encode()
        scene += b" " * (-len(scene) % 4)
        self.write("ark.glb", struct.pack("<4s4I", b"glTF", 2, 20 + len(scene), len(scene), 0x4E4F534A) + scene)
        text = self.assert_a_mission("ark.glb", "size        6 x 4 x 2 m, read as", "position_m: [-30.000, -4.000, 0]",
                                     "Steel,7850,5890,")
        self.assertNotIn("units", text)
        self.succeeds("new", "ark.glb", "--out", "turned.yaml", "--units", "km", "--up", "z")
        self.assertIn("units: km, up: z", (self.folder / "turned.yaml").read_text())

    def test_any_name_of_a_file(self):
        """`look_at` splits at commas, the ground and classes have names of their own, and YAML has its signs."""
        points, faces = pyramid(1)
        mesh = obj([(x, z, -y) for x, y, z in points], faces)
        draw = random.Random(7)
        characters = "a1,.:#-_'\"\\{}[]&*!|>%@`~$() ?=äß\u4e2d\u2028\ufeff"
        drawn = ["".join(draw.choices(characters, k=draw.randint(1, 12))) for _ in range(20)]
        names = ["my hull, v2", "seabed", "heightmap", "objects", "bottom", "background", "rock", "rock_1", "null", "true",
                 "1e5", "0x1f", ".5", "~", "none", "all", "x" * 180, *drawn]
        small = with_keys("trajectory.count=2", "sensors.fls.azimuth_bins=16", "sensors.fls.range_bins=32",
                          "scene.seabed.cell_m=0.5", "accuracy.relative_l1=0.3")
        for k, name in enumerate(names):
            with self.subTest(name=name):
                folder = self.folder / str(k)
                folder.mkdir()
                (folder / f"{name}.obj").write_text(mesh)
                bed = draw.choice(("sand", "rocky"))
                printed = self.succeeds("new", f"./{name}.obj", "--bed", bed, cwd=folder).stdout
                mission = next(folder.glob("*.yaml")).name
                self.assertIn(f"sonarsim preview {mission}\n", printed)
                self.assertRegex(mission, r"^[^-][^ ,:'\"$&*]*$")
                self.assertEqual(self.reported("validate", mission, *small, cwd=folder)["pings"], 2)
        for name in (b"a\n.obj", b"\xfcber.obj"):
            (self.folder / os.fsdecode(name)).write_text(mesh)
            self.assert_refused(self.run_sonarsim("new", os.fsdecode(name)), "rename it")

    def test_what_is_refused(self):
        self.write("note.obj", "Dear reader")
        self.write("note.txt", "Dear reader")
        for arguments, words in ((["note.obj"], "note.obj"), (["note.txt"], "note.txt"), (["none.glb"], "none.glb"),
                                 (["materials.csv"], "materials.csv"), (["mission.yaml"], "mission.yaml"),
                                 (["box.gltf", "--preset", "sidescan_400khz"], "is no imaging sonar"),
                                 (["box.gltf", "--preset", "gemini_720"], "did you mean 'gemini_720is'"),
                                 (["box.gltf", "--bed", "snow"], "snow: is not a file")):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.run_sonarsim("new", *arguments), words)
                self.assertEqual([*self.folder.glob("*_materials.csv")], [])


class Preset(Sandbox):
    def test_a_preset_that_came_with_the_program(self):
        text = self.succeeds("preset", "gemini_720is").stdout
        self.assertIn("Mean echo and noise are equal at (bottoms at 20 degrees of grazing)", text)
        self.assertEqual(self.succeeds("preset", "sensors/gemini_720is.yaml").stdout.splitlines()[1:], text.splitlines()[1:])
        base = self.reported("preset", "gemini_720is")
        ranges = base["noise_range_m"]
        self.assertTrue(ranges["mud"] < ranges["sand"] < ranges["rock"], ranges)
        # The range of a sphere is the sonar equation; more source level and less noise reach farther.
        r = ranges["sphere"]
        echo = base["source_level_db"] - 20 - 40 * math.log10(r) - 2 * base["absorption_db_per_m"] * r
        self.assertAlmostEqual(echo, base["noise_db"], places=6)
        for key, name, by in (("source_level_db", "source_level_db", 10.0), ("noise_db", "receiver.noise_db", -3.0)):
            other = self.reported("preset", "gemini_720is", "--set", f"sensors.sonar.instrument.{name}={base[key] + by}")
            self.assertAlmostEqual(other[key] - base[key], by, places=1)
            self.assertGreater(other["noise_range_m"]["sand"], ranges["sand"])

    def test_a_file_and_all_of_them(self):
        self.write("mine.yaml", "kind: echosounder\nmodel: calibrated\n")
        self.assertEqual(self.reported("preset", "mine.yaml")["grazing_angle_deg"], 90)
        for text, name, *words in (("kind: echosounder\n", "mine.yaml", "mine.yaml", "model: calibrated"),
                ("kind: echosounder\nmodel: calibrated\nazimut_bins: 3\n", "mine.yaml", "mine.yaml:3:1", "azimut_bins"),
                ("", "gemini_720", "did you mean 'gemini_720is'?", "there are: aris_3000")):
            self.write("mine.yaml", text)
            self.assert_refused(self.run_sonarsim("preset", name), *words)
        names = [one["preset"] for one in self.reported("preset")]
        self.assertEqual(names, sorted(p.stem for p in (ROOT / "configs/sensors").glob("*.yaml")))

    def test_levels_that_do_not_fit(self):
        noise = MISSION[MISSION.index("    noise:"):MISSION.index("output:")]
        for levels, advice in (("source_level_db: 210, receiver: {noise_db: -100}", None),
                               ("source_level_db: 0, receiver: {noise_db: -20}", r"lower instrument.receiver.noise_db \(-20\)"),
                               ("source_level_db: 120, frequency_hz: 2.5e6", "raise instrument.source_level_db")):
            self.write("mission.yaml", MISSION.replace(noise, f"    model: calibrated\n    instrument: {{{levels}}}\n"))
            if advice is None:
                self.refused("mission.yaml:17:", "source_level_db: 0")
            else:
                self.assertRegex(self.succeeds("validate", "mission.yaml").stderr, rf"W18.*{advice} by \d+ dB")
        # White bins of the ringing are no noise that hides echoes.
        ringing = "receiver: {ring_down_db: 160, ring_down_m: 0.24}"
        self.write("mission.yaml", MISSION.replace(noise, f"    model: calibrated\n    instrument: {{{ringing}}}\n"))
        self.assertNotIn("W18", self.succeeds("validate", "mission.yaml").stderr)


class Preview(Sandbox):
    """Its picture: tests/preview."""

    def test_one_picture_of_every_kind(self):
        self.write("mission.yaml", ALL_FILES.replace(
            "output:", "  head: {kind: scanning, range_max_m: 6, range_bins: 48, step_deg: 45}\noutput:"))
        self.assertIn("box_preview.png: ping 5 of box", self.succeeds("preview", "mission.yaml", "--ping", 5).stderr)
        picture = (self.folder / "box_preview.png").read_bytes()
        # Five sonars and a plan: two rows of three tiles, RGB.
        self.assertEqual(struct.unpack(">II", picture[16:24]) + (picture[25],), (3 * 612 + 12, 30 + 2 * 452, 2))
        self.succeeds("preview", "mission.yaml", "--ping", 0, "--out", "other.png", "-q")
        self.assertNotEqual((self.folder / "other.png").read_bytes(), picture)
        self.assertFalse(self.out.exists())
        self.assert_refused(self.run_sonarsim("preview", "mission.yaml", "--ping", 6, "--out", "none.png"),
                            "--ping 6: the mission has the pings 0 to 5")
        self.assertFalse((self.folder / "none.png").exists())

    def test_scene_for_a_viewer(self):
        """Turned back to z up, the file has the mission's own scene, and lines, which inspect leaves out."""
        self.write("mission.yaml", ALL_FILES)
        self.succeeds("preview", "mission.yaml", "--gltf", "scene.glb")
        of_mission, of_file = (self.reported("inspect", name) for name in ("box.gltf", "scene.glb"))
        for key in ("triangles", "bounds_min_m", "bounds_max_m"):
            self.assertEqual(of_file[key], of_mission[key])
        data = (self.folder / "scene.glb").read_bytes()
        names = [node["name"] for node in json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])["nodes"]]
        self.assertIn("trajectory", names)
        self.assertEqual(sum(name.startswith("view of ") for name in names), 4)


class Report(Sandbox):
    """Its figures: tests/report."""

    def test_quick(self):
        """Multipath and streaks are no error against the reference, which knows direct echoes only."""
        self.edit("mission.yaml", "    noise:", "    multipath: {method: cluster, delta_deg: 15}\n"
                  "    streaks: {mode: add}\n    noise:")
        result = self.succeeds("report", "mission.yaml", *QUICK, "--out", "report", "--json", "elsewhere.json")
        self.assertIn("fls: the noise of the reference is", result.stdout)
        self.assertRegex(result.stdout, r"\n\| cluster \| 5.00 \| 15.0 \|.* the mission's own\n")
        report = self.json("elsewhere.json")
        self.assertEqual(report, self.json("report/report.json"))
        self.assertEqual({row["engine"] for row in report["rows"]}, {"rays", "strips", "octree", "auto"})
        for row in report["rows"]:
            self.assertEqual(set(row), ROW)
            self.assertGreater(row["ms_per_ping"], 0)
            self.assertIn(row["goal"], ("met", "missed") if row["engine"] in ("rays", "strips", "auto") else ("-",))
        # Inside a plain box the rays have no trouble.
        finest = [r for r in report["rows"] if (r["engine"], r["setting"]) == ("rays", "relative_l1=0.01")]
        self.assertLess(finest[0]["relative_l1"], 0.05)
        self.assertGreater(len(report["multipath_rows"]), 10)
        self.assertIn("| rays | relative_l1=0.01 |", (self.folder / "report/report.md").read_text())
        self.assertEqual({path.name for path in (self.folder / "report").iterdir()}, {"report.json", "report.md"})

    def test_bad_input(self):
        octree = ("--set", "sensors.fls.range_bins=8", "--engines", "octree")
        profile = ("--set", "scene.water_surface={height_m: 5}", "--set", "water.profile={named: summer}")
        for arguments, words in (((), ""), (("mission.yaml", "--hard"), "unknown option"), (("none.yaml",), "none.yaml"),
                (("mission.yaml", "--engines", "sonar"), ""),
                (("mission.yaml", "--set", "variants=2", *QUICK), "this mission has variants"),
                (("mission.yaml", *octree, *QUICK), "--engines: no setting"), (("mission.yaml", *profile, *QUICK), "water.profile")):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.run_sonarsim("report", *arguments), words)
