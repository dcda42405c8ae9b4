"""Every mission of configs/ is rendered by scripts/render.sh from a clone without generated scenes: a
few pings of each."""
import concurrent.futures
import json
import pathlib
import re
import shutil

from clone import Clone

# Its mesh is of Debian's openfoam-examples and converted by assimp, which render.sh installs; here it is
# rendered where both are there.
FROM_A_PACKAGE = "motorbike_imaging"
PACKAGE = pathlib.Path("/usr/share/doc/openfoam-examples")


class Examples(Clone):
    def assert_refused(self, result, sentence):
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)
        self.assertIn(sentence, result.stderr)

    def render_group(self, group):
        """What went wrong, by mission: one ping of each, or one variant."""
        faults = {}
        for name in group:
            # Without files the error is not measured, which takes longer than the pings.
            result = self.run_script("render.sh", f"configs/{name}.yaml", "--shard", "1/1000", "--no-files", "--json")
            if result.returncode != 0 or not json.loads(result.stdout)["pings"]:
                faults[name] = f"exit code {result.returncode}\n{result.stdout}{result.stderr}"
        return faults

    def test_each_renders(self):
        self.assertFalse((self.clone / "scenes/generated").exists())
        groups = {}     # missions of one scene, one after the other: the first makes it
        for path in sorted((self.clone / "configs").glob("*.yaml")):
            made = re.search(r"generated/(\w+)|\bstock: ", path.read_text())
            if path.stem != FROM_A_PACKAGE or PACKAGE.exists() and shutil.which("assimp"):
                groups.setdefault(made[1] or "stock" if made else path.stem, []).append(path.stem)
        self.assertGreater(sum(map(len, groups.values())), 30)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for faults in pool.map(self.render_group, sorted(groups.values(), key=len, reverse=True)):
                self.assertEqual(faults, {})

    def test_each_stage_can_be_left_out_of_its_mission(self):
        """The table of docs/calibrated.md: its keys exist; that its missions do: tests/docs.py."""
        table = (self.clone / "docs/calibrated.md").read_text().split("## What each stage changes", 1)[1].split("\n## ", 1)[0]
        keys, missions = re.findall(r"`(\w+): .*?`", table), re.findall(r"\(\.\./configs/(\w+)\.yaml\)", table)
        self.assertGreater(min(len(keys), len(missions)), 15)
        for key in keys:
            self.assertIn(f"\n| `{key}` |", (self.clone / "docs/mission.md").read_text())

    def test_only_what_is_named_is_made(self):
        """In quotes, in a list, in an option; not in a comment. A file that no script makes is refused."""
        made = self.clone / "scenes/generated"
        shutil.rmtree(made, ignore_errors=True)
        text = (self.clone / "configs/tank_imaging.yaml").read_text()
        self.assertIn("file: ../scenes/tank.glb", text)
        (self.clone / "own.yaml").write_text(text.replace("file: ../scenes/tank.glb", """\
file: "scenes/tank.glb"  # not scenes/generated/wreck.glb
  objects: [{name: a, file: 'scenes/generated/stock/drum_6.glb', position_m: [1, 0, 1]},
    {name: b, file: scenes/anchor.obj, units: mm, up: z, position_m: [-1, 0, 1]}]""").replace("../", ""))
        words = ("render.sh", "--shard", "1/60", "--out", "out/own", "own.yaml", "--set")
        result = self.run_script(*words, "scene.objects.0.file=scenes/generated/stock/stone_1.glb")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual({path.name for path in made.rglob("*.*")}, {"drum_6.glb", "stone_1.glb"})
        self.assert_refused(self.run_script(*words, "scene.objects.0.file=scenes/generated/reef.glb"), "scenes/generated/reef.glb, "
                            "which is not there, and no script makes it: scripts/make_scenes.py makes backscatter.tif, ")

    def test_a_folder_that_cannot_be_written(self):
        """One sentence and exit code 2. A file or /proc in place of the folder stops root, too."""
        file = self.clone / "file"
        file.touch()
        for words, sentence in ((("seafloor", "--out", file), f"{file}: cannot write seafloor.glb here: File exists"),
                                (("bathymetry", "--out", "/proc/none"), "/proc/none: cannot write bathymetry.tif here: "),
                                (("--for", file / "own.yaml"), f"{file / 'own.yaml'}: Not a directory")):
            self.assert_refused(self.run_script("make_scenes.py", *words), f"error: {sentence}")
