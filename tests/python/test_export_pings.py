"""`sonarsim export --format points, holoocean, mcap`: what they write of a rendered dataset, by the rules of its readers."""
import base64
import json
import pathlib
import pickle
import re
import shutil
import struct
import subprocess
import tempfile

import numpy as np
import tool
from PIL import Image, TiffImagePlugin
from sonarsim.data import middles, moved, open_dataset
from sonarsim.export import holoocean
from sonarsim.export.source import mission_of

TANK = tool.ROOT / "scenes/tank.glb"
READER = ("@mcap/core@2", "@foxglove/rosmsg@5", "@foxglove/rosmsg2-serialization@3")


class Pings(tool.ToolTest):
    @classmethod
    def setUpClass(cls):
        cls.rendered = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="sonarsim-"))) / "out"
        subprocess.run([tool.os.environ["SONARSIM"], "render", tool.ROOT / "tests/four_sonars.yaml", "--quiet", "--out",
                        cls.rendered, "--set", "output.labels=[instance, class, elevation, clean, objects]",
                        "--set", "scene.water_surface.height_m=50"], check=True)
        cls.dataset = open_dataset(cls.rendered)

    def export(self, *words):
        return self.succeeds("export", self.rendered, self.folder / "dest", *words)

    def test_points(self):
        text = self.export("--format", "points", "--sensor", "fls", "--sensor", "mbes")
        self.assertRegex(text, r"points\nfls: \d+ points of 9 pings\nmbes: \d+ points of 9 pings\n")
        fls, name = self.dataset["fls"], self.folder / "dest/fls-000003"
        points, cloud = fls.points(fls[3]), np.load(f"{name}.npz")
        np.testing.assert_array_equal(np.stack([cloud[axis] for axis in "xyz"], 1), points.position_m)
        np.testing.assert_array_equal(cloud["instance"], points.instance)
        np.testing.assert_array_equal(cloud["intensity"], fls[3]["polar"][tuple(points.bins.T)])
        np.testing.assert_array_equal(cloud["depth_true_m"], 50.0 - cloud["z"])
        # Soundings of the floor, whose z is 0, have its instance.
        cloud = np.load(self.folder / "dest/mbes-000003.npz")
        floor = cloud["instance"] == {text: k for k, text in self.dataset.instances.items()}["floor"]
        self.assertGreater(floor.sum(), 20)
        self.assertLess(np.abs(np.median(cloud["depth_m"][floor]) - 50.0), 0.05)
        self.assertEqual(len(cloud["x"]), np.isfinite(self.dataset["mbes"][3]["soundings"][:, 0]).sum())
        shutil.rmtree(self.folder / "dest")
        self.export("--format", "points", "--whole", "--sensor", "fls")
        whole = np.load(self.folder / "dest/fls.npz")
        self.assertEqual((whole["ping"] == 3).sum(), len(points.bins))
        try:
            import meshio   # pylint: disable=import-outside-toplevel
        except ImportError:
            self.skipTest("no meshio, so nobody reads the .ply")
        mesh = meshio.read(self.folder / "dest/fls.ply")
        np.testing.assert_array_equal(mesh.points, np.stack([whole[axis] for axis in "xyz"], 1))
        for key in ("intensity", "class", "instance", "ping", "depth_true_m"):
            np.testing.assert_array_equal(mesh.point_data[key], whole[key])

    def test_what_neusis_loads(self):
        """load_data.py and get_arcs() of NeuSIS: the keys, degrees and metres of Config.json, the pickles in any order, and
        the point of a pixel (i, j) at the elevation phi. It is the one that sonarsim.data gives, within a bin."""
        bed = self.rendered / "seabed/heights.tif"
        bed.parent.mkdir()
        bed.write_bytes(b"z of a bed")
        self.export("--format", "holoocean", "--sensor", "fls", "--clean", "--mesh", TANK)
        self.assertEqual((self.folder / "dest/heights.tif").read_bytes(), bed.read_bytes())
        config = json.loads((self.folder / "dest/Config.json").read_text())
        own = [one["configuration"] for one in config["agents"][0]["sensors"] if one["sensor_type"] == "ImagingSonar"][-1]
        hfov, vfov = np.radians(own["Azimuth"]), np.radians(own["Elevation"])
        r_min, r_max = own["RangeMin"], own["RangeMax"]
        # SonarSplat takes the last sensor, others the keys at the head; AONeuS takes two more.
        self.assertEqual(config["agents"][0]["sensors"][-1]["configuration"], {key: config[key] for key in own})
        self.assertEqual((config["ds_factor"], config["simple_denoise"]), (1.0, False))
        files = sorted((self.folder / "dest/Data").iterdir(), key=lambda path: int(path.stem))
        for path, sample in zip(files, self.dataset["fls"], strict=True):
            state = pickle.loads(path.read_bytes())
            image, c2w = state["ImagingSonar"], state["PoseSensor"]
            self.assertEqual((image.dtype, image.shape, c2w.shape), (np.float32, (own["RangeBins"], own["AzimuthBins"]), (4, 4)))
            np.testing.assert_array_equal(image, sample["clean"])
            points = sample.sensor.points(sample)
            i, j = points.bins.T
            theta, phi = -hfov / 2 + (j + 0.5) * hfov / image.shape[1], sample["elevation"][i, j]
            r = (i + 0.5) * (r_max - r_min) / image.shape[0] + r_min
            own_frame = r * np.stack([np.cos(theta) * np.cos(phi), np.sin(theta) * np.cos(phi), np.sin(phi)])
            found = (c2w @ np.vstack([own_frame, np.ones_like(r)]))[:3].T
            np.testing.assert_allclose(found, points.position_m, atol=1e-6)
            self.assertLessEqual(np.abs(phi).max(), 0.5 * vfov + 1e-2)  # a parallelogram ends beside the view
        data = (self.folder / "dest/mesh.glb").read_bytes()
        size = struct.unpack_from("<I", data, 12)[0]
        self.assertEqual(struct.unpack_from("<I", data, 8)[0], len(data))
        mesh = json.loads(data[20:20 + size])
        turn = np.reshape(mesh["nodes"][mesh["scenes"][0]["nodes"][0]]["matrix"], (4, 4)).T[:3, :3]
        ends = [[one["min"], one["max"]] for one in mesh["accessors"] if "min" in one]
        corners = np.reshape(ends, (-1, 3)) @ turn.T
        np.testing.assert_allclose([corners.min(0), corners.max(0)], [[-4, -3, 0], [4, 3, 3]], atol=1e-6)

    def test_numbers_with_exponents(self):
        """The program writes large frequencies as 1e+06, which PyYAML takes for a text."""
        copy = shutil.copytree(self.rendered, self.folder / "copy")
        mission = copy / "mission.resolved.yaml"
        text = re.sub(r"sound_speed_m_s: \d+", "sound_speed_m_s: 1.5e+03", mission.read_text())
        mission.write_text(text + "more: [1e+06, 9E5, -1.5e-05, .5e3, e3, 1e, 1.e]\n")
        self.succeeds("export", copy, self.folder / "dest", "--format", "mcap", "--sensor", "fls")
        self.assertEqual(mission_of(copy)["water"]["sound_speed_m_s"], 1500.0)
        self.assertEqual(mission_of(copy)["more"], [1e6, 9e5, -1.5e-5, 500.0, "e3", "1e", "1.e"])

    def test_what_npm_readers_read(self):
        self.export("--format", "mcap", "--sensor", "fls")
        install = ["npm", "install", "--silent", *READER]
        if not shutil.which("npm") or subprocess.run(install, cwd=self.folder, capture_output=True, check=False).returncode:
            self.skipTest("npm cannot install @mcap/core, so nobody reads the MCAP file")
        shutil.copy(pathlib.Path(__file__).with_name("read_mcap.cjs"), self.folder)
        read = json.loads(subprocess.run(["node", "read_mcap.cjs", "dest/pings.mcap"], cwd=self.folder, capture_output=True,
                                         check=True).stdout)
        topics, fls = {name: one["messages"] for name, one in read["topics"].items()}, self.dataset["fls"]
        self.assertEqual(read["count"], 5 * len(fls))
        self.assertEqual({name: one["type"] for name, one in read["topics"].items()}, {
            "/fls/image/compressed": "sensor_msgs/msg/CompressedImage", "/fls/objects": "vision_msgs/msg/Detection2DArray",
            "/fls/sonar_image": "marine_acoustic_msgs/msg/ProjectedSonarImage", "/odometry": "nav_msgs/msg/Odometry",
            "/tf": "tf2_msgs/msg/TFMessage"})
        for k, sample in enumerate(fls):
            meta = sample["meta"]
            picture, sonar, boxes = (topics[f"/fls/{name}"][k] for name in ("image/compressed", "sonar_image", "objects"))
            self.assertEqual(picture["time_ns"], round(meta["time_s"] * 1e9))
            self.assertEqual(base64.b64decode(picture["data"]), fls.raw(k, "fan"))
            image = np.frombuffer(base64.b64decode(sonar["image"]["data"]), "<f4").reshape(-1, sonar["image"]["beam_count"])
            np.testing.assert_array_equal(image, sample["polar"])
            np.testing.assert_allclose(sonar["ranges"], middles(fls.range_edges_m), rtol=1e-6)
            self.assertEqual((sonar["image"]["dtype"], sonar["ping_info"]["sound_speed"]), (8, 1480))
            tf = {one["child_frame_id"]: one["transform"] for one in topics["/tf"][k]["transforms"]}
            pose = {"position_m": [tf["fls"]["translation"][axis] for axis in "xyz"],
                    "quaternion_xyzw": [tf["fls"]["rotation"][axis] for axis in "xyzw"]}
            self.assertEqual(pose, meta["T_world_sensor"])
            # Beams of the frame fls_fan, turned into that of the sonar: azimuths are positive to port.
            beams = np.array([[one[axis] for axis in "xyz"] for one in sonar["beam_directions"]])
            fan = {"position_m": [0, 0, 0], "quaternion_xyzw": [tf["fls_fan"]["rotation"][axis] for axis in "xyzw"]}
            azimuth = middles(fls.azimuth_edges_rad)
            np.testing.assert_allclose(moved(beams, fan), np.stack([np.cos(azimuth), np.sin(azimuth), 0 * azimuth], 1), atol=1e-12)
            odometry = topics["/odometry"][k]["pose"]["pose"]["position"]
            self.assertEqual([odometry[axis] for axis in "xyz"], meta["T_world_vehicle"]["position_m"])
            shown = [one for one in sample["objects"]["objects"] if one["fan"]]
            self.assertEqual([(one["results"][0]["hypothesis"]["class_id"], one["id"], one["bbox"]["size_x"]) for one in
                              boxes["detections"]], [(one["class"], one["name"], -int(np.subtract(*one["fan"]["box_px"]["x"])))
                                                     for one in shown])
        self.assertGreater(sum(len(one["detections"]) for one in topics["/fls/objects"]), 9)

    def test_poses_of_a_robot(self):
        """Those of an export come back as the trajectory of its dataset; the program reads the file."""
        self.export("--format", "mcap", "--sensor", "fls")
        bag, words = self.folder / "dest/pings.mcap", ("--out", self.folder / "robot.tum", "--topic")
        self.assertIn("robot.tum: 9 poses", self.succeeds("import_poses", bag, *words, "/odometry"))
        np.testing.assert_allclose(np.loadtxt(self.folder / "robot.tum"), self.dataset.poses(), rtol=1e-12)
        self.sonarsim("validate", str(tool.ROOT / "tests/four_sonars.yaml"), "--set", f"trajectory={{file: {self.folder}/robot.tum}}")
        data, cut = bag.read_bytes(), self.folder / "cut.mcap"
        for content, topic, text in ((data, "/tf", "has no poses of /tf; there are /odometry"), (data[:-9], "/odometry", "not a whole"),
                                     (data[:3000] + data[-8:], "/odometry", "is cut off or damaged"), (b"", "/odometry", "not a whole")):
            cut.write_bytes(content)
            self.assert_refused("import_poses", f"cut.mcap: [^\n]*{text}", cut, "--out", self.folder / "none.tum", "--topic", topic)

    def test_heights_of_a_map_are_those_of_the_world(self):
        """By the rule of docs/scenes.md: the value times height_scale plus height_offset_m, and the map less its origin."""
        source, out = self.folder / "map.tif", self.folder / "heights.tif"
        depth = np.arange(12, dtype=np.float32).reshape(3, 4)
        depth[1, 2] = -9999.0
        rule = {"pixel_m": "auto", "origin_m": [500.0, 90.0], "height_scale": -2.0, "height_offset_m": 1.0}
        for keys, half in (((), 0.0), ((1, 1, 0, 1, 1025, 0, 1, 2), 1.0)):
            info = TiffImagePlugin.ImageFileDirectory_v2()
            info[33550], info[33922], info[42113] = (2.0, 2.0, 0.0), (0.0, 0.0, 0.0, 501.0, 100.0, 0.0), "-9999"
            info.tagtype[33550] = info.tagtype[33922] = 12
            if keys:
                info[34735], info.tagtype[34735] = keys, 3
            Image.fromarray(depth).save(source, tiffinfo=info)
            holoocean.write_heights(out, source, rule)
            with Image.open(out) as image:
                np.testing.assert_array_equal(np.array(image), np.where(depth < 0, np.nan, 1.0 - 2.0 * depth))
                self.assertEqual(image.tag_v2[33550][:2], (2.0, 2.0))
                self.assertEqual(image.tag_v2[33922][:5], (0.0, 0.0, 0.0, 1.0 - half, 10.0 + half))
        Image.fromarray(depth).save(source)
        with self.assertRaisesRegex(ValueError, "has no tags of its place"):
            holoocean.write_heights(out, source, rule)
        holoocean.write_heights(out, source, {**rule, "pixel_m": 3.0, "origin_m": [0.0, 0.0]})
        with Image.open(out) as image:
            self.assertEqual(image.tag_v2[33922][3:5], (0.0, 9.0))

    def test_mistakes(self):
        for words, text in ((("points", "--sensor", "sss"), "has no ping of an imaging or profiling sonar"),
                            (("points", "--clean"), "--format points takes no --clean"),
                            (("mcap", "--tile", "64"), "--format mcap takes no --tile"),
                            (("holoocean", "--sensor", "mbes"), "has no imaging sonar"),
                            (("holoocean", "--sensor", "fls", "--mesh", tool.ROOT / "README.md"),
                             "is not the file of the scene or its heightmap")):
            self.assert_refused("export", text, self.rendered, self.folder / "dest", "--format", *words)
        self.assert_refused("export", "is given twice", self.rendered, self.rendered, self.folder / "dest", "--format", "mcap")
        shutil.copytree(self.rendered, self.folder / "less")
        with tool.edited(self.folder / "less/dataset.json") as description:
            for one in description["sensors"]:
                one["files"].pop("elevation", None)
        self.assert_refused("export", r"set output.labels: \[elevation, instance, class\]", self.folder / "less",
                            self.folder / "dest", "--format", "points", "--sensor", "fls")
