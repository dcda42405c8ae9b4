"""sonarsim merge --different: whole datasets of different missions side by side, their ids apart."""
import itertools
import json
import shutil
import subprocess
import unittest

from sandbox import Sandbox, box_gltf, digest


class Collection(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("other.gltf", box_gltf((1.0, 1.0, 1.0)).replace('"walls"', '"hull"'))
        for name, arguments in (("a", ("--seed", "1")),
                                ("b", ("--seed", "2", "--set", "name=pool", "--set",
                                       "scene.file=other.gltf")),
                                ("c", ("--seed", "2", "--set", "output.pack=tar"))):
            self.assert_renders(*arguments, "--set", "output.labels=true", "--out", name)

    def collect(self, *folders):
        return self.run_sonarsim("merge", "--different", *folders)

    def test_side_by_side_in_any_order(self):
        parts = {name: digest(self.folder / name) for name in "abc"}
        found = []
        for order in itertools.permutations("abc"):
            out = "-".join(order)
            result = self.collect(*order, out)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("seed 2 (", result.stderr)
            self.assertNotIn("seed 1", result.stderr)
            found.append(digest(self.folder / out))
        self.assertTrue(all(one == found[0] for one in found))
        self.assertEqual({name: digest(self.folder / name) for name in "abc"}, parts)
        out = self.folder / "a-b-c"
        reported = json.loads((out / "collection.json").read_text())
        self.assertIs(reported["complete"], True)
        folders = [dataset["folder"] for dataset in reported["datasets"]]
        self.assertEqual(sorted(folders), ["box", "box-2", "pool"])
        self.assertEqual(digest(out / "pool"), parts["b"])
        self.assertEqual({json.dumps(digest(out / f)) for f in ("box", "box-2")},
                         {json.dumps(parts["a"]), json.dumps(parts["c"])})
        # Each has one instance, of a class that is named after the material.
        self.assertEqual([d["instance_id_offset"] for d in reported["datasets"]], [0, 1, 2])
        names = {c["id"]: c["name"] for c in reported["classes"]}
        self.assertEqual(sorted(names), list(range(1, len(names) + 1)))
        for dataset in reported["datasets"]:
            own = json.loads((out / dataset["folder"] / "dataset.json").read_text())["labels"]
            for one in own["classes"]:
                self.assertEqual(names[dataset["class_ids"][str(one["id"])]], one["name"])
        self.assertEqual(subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=out,
                                        check=False).returncode, 0)

    def test_background_is_no_category(self):
        own = json.loads((self.folder / "a/dataset.json").read_text())["labels"]["classes"][0]["name"]
        for seed in "45":
            self.assert_renders("--seed", seed, "--set", "output.labels=[coco]", "--set",
                                f"labels.background=[{own}]", "--out", seed)
        self.assertEqual(self.collect("4", "5", "both").returncode, 0)
        coco = json.loads((self.folder / "both/labels/coco.json").read_text())
        self.assertEqual(coco["categories"], [])
        self.assertNotIn("W33", self.run_sonarsim("status", "both").stderr)

    def test_again_and_verify(self):
        self.collect("a", "b", "all")
        whole = digest(self.folder / "all")
        (self.folder / "all/pool/fls/polar/000001.npy").unlink()
        result = self.run_sonarsim("verify", "all")
        self.assertEqual(result.returncode, 1)
        self.assertIn("fls/polar/000001.npy: is missing", result.stderr)
        result = self.run_sonarsim("merge", "--different", "a", "b", "all", "--json")
        self.assertEqual(json.loads(result.stdout)["files"], 1)
        self.assertEqual(digest(self.folder / "all"), whole)
        self.assertEqual(self.run_sonarsim("verify", "all").returncode, 0)

    def test_temporary_files_of_a_killed_run_go(self):
        """Those of a run that was killed before its first whole file, and those of one killed later."""
        ending = ".0123456789abcdef.part"
        self.write(f"all/.collection.json{ending}", "{")
        self.assertEqual(self.collect("a", "b", "all").returncode, 0)
        whole = digest(self.folder / "all")
        for name in (".SHA256SUMS", "labels/.coco.json", "pool/.dataset.json", "pool/fls/polar/.000001.npy"):
            self.write(f"all/{name}{ending}", "{")
        result = self.collect("a", "b", "all")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder / "all"), whole)

    def test_a_missing_file_is_told_before_anything_is_written(self):
        (self.folder / "b/fls/polar/000001.npy").unlink()
        self.assert_refused(self.collect("a", "b", "all"), "b/fls/polar/000001.npy", "is missing")
        self.assertFalse((self.folder / "all").exists())

    def test_another_dataset_in_the_place_of_one(self):
        """Whole by itself, and not what was collected."""
        self.collect("a", "b", "all")
        shutil.rmtree(self.folder / "all/pool")
        shutil.copytree(self.folder / "a", self.folder / "all/pool")
        result = self.run_sonarsim("verify", "all")
        self.assertEqual(result.returncode, 1)
        self.assertIn("pool/SHA256SUMS: differs from SHA256SUMS of the collection",
                      result.stderr)
        (self.folder / "all/SHA256SUMS").unlink()
        result = self.run_sonarsim("verify", "all")
        self.assertEqual(result.returncode, 1)
        self.assertIn("SHA256SUMS: is missing", result.stderr)

    def test_not_without_saying_so(self):
        self.assert_refused(self.run_sonarsim("merge", "a", "b", "all"), "another mission",
                            "--different")
        self.assertFalse((self.folder / "all").exists())

    def test_mistakes(self):
        self.assert_refused(self.collect("a", "a", "all"), "is the same dataset as a")
        self.assert_refused(self.collect("a", "none", "all"), "none", "is no dataset")
        self.assert_renders("--shard", "1/2", "--out", "half")
        self.assert_refused(self.collect("a", "half", "all"), "half", "is not complete")
        self.write("taken/thesis.txt", "years of work")
        self.assert_refused(self.collect("a", "b", "taken"), "taken", "is not empty")
        self.collect("a", "b", "all")
        self.assert_refused(self.collect("a", "c", "all"), "all", "other datasets")
        path = self.folder / "b/fls/polar/000000.npy"
        path.write_bytes(path.read_bytes()[:-1] + b"x")
        self.assert_refused(self.collect("a", "b", "more"), "b/fls/polar/000000.npy", "SHA256SUMS")
        shutil.rmtree(self.folder / "more")


if __name__ == "__main__":
    unittest.main()
