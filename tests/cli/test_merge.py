"""sonarsim merge, and the render that completes what it copied: the dataset of a single run, to the byte; and what
`sonarsim status` says of a job."""
import fcntl
import shutil

from sandbox import ALL_FILES, VARIED, Sandbox, digest, path_csv, with_disk


class Merge(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", ALL_FILES.replace("output: {", "  head: {kind: scanning, range_max_m: 6, range_bins: 16}\n"
                                                     "output: {xtf: true, mosaic: true, labels: true, "))
        self.write("path.csv", path_csv(5))
        self.whole = self.render_whole()
        for k in "123":
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}", "-j" + k)

    def merge_refused(self, *folders, words):
        self.assert_refused(self.run_sonarsim("merge", *folders), *words)

    def assert_merges(self, *folders, rendered=0):
        """The parts stay as they are, and `rendered` pings are in none of them."""
        before = [digest(self.folder / part) for part in folders[:-1]]
        merged = self.reported("merge", *folders)
        self.assertEqual([digest(self.folder / part) for part in folders[:-1]], before)
        self.assertEqual((merged["missing"], merged["pings"] + merged["skipped"]), (rendered, 25 - rendered))
        completed = self.reported("render", "mission.yaml", "--out", folders[-1])
        self.assertEqual((completed["pings"], completed["complete"]), (rendered, True))
        self.assertEqual(digest(self.folder / folders[-1]), self.whole)
        self.succeeds("verify", folders[-1])
        return merged

    def test_in_any_order_without_the_inputs_and_again(self):
        for name in ("box.gltf", "path.csv"):
            (self.folder / name).rename(self.folder / f"away.{name}")
        self.succeeds("merge", "part3", "part1", "part2", "all")
        for name in ("box.gltf", "path.csv"):
            (self.folder / f"away.{name}").rename(self.folder / name)
        self.assertEqual(self.assert_merges("part1", "part2", "part3", "all")["pings"], 0)
        self.assertIs(self.assert_merges("part1", "all", "part1", "copy")["complete"], True)

    def test_render_renders_what_is_missing(self):
        self.assert_merges("part1", "part3", "two", rendered=8)
        # Another size than the journal lists, and a record that is not as the journal lists it.
        next((self.folder / "part2/fls/fan").iterdir()).write_bytes(b"")
        path = self.folder / "part2/sss/waterfall.npy"
        data = path.read_bytes()
        path.write_bytes(data[:128] + bytes(len(data) - 128))
        self.succeeds("merge", "part1", "part2", "part3", "all")
        self.assertGreater(self.reported("render", "mission.yaml", "--out", "all")["pings"], 0)
        self.assertEqual(digest(self.folder / "all"), self.whole)

    def test_damage_on_the_way_is_found_by_verify(self):
        path = next((self.folder / "part2/fls/polar").iterdir())
        data = path.read_bytes()
        path.write_bytes(data[:-1] + bytes([data[-1] ^ 1]))
        self.succeeds("merge", "part1", "part2", "part3", "out")
        self.assert_renders()
        self.assert_verify_finds(f"fls/polar/{path.name}: its bytes differ")

    def test_foreign_parts(self):
        self.assert_renders("--shard", "2/3", "--out", "seed", "--seed", "8")
        self.merge_refused("part1", "seed", "part3", "all", words=("seed", "another mission"))
        for old, new, words in (('"program_version": "', '"program_version": "0', "another version"),
                                ('"arithmetic": "', '"arithmetic": "x', "a build"),
                                ('"inputs_hash": "', '"inputs_hash": "0', "other scene, material or trajectory files")):
            with self.subTest(words=words):
                shutil.copytree(self.folder / "part2", self.folder / "other")
                self.edit("other/dataset.json", old, new)
                self.merge_refused("part1", "other", "part3", "all", words=("other", words))
                shutil.rmtree(self.folder / "other")
        self.assertFalse((self.folder / "all").exists())

    def test_nothing_outside_is_touched(self):
        self.write("victim/file", "mine")
        self.succeeds("merge", "part1", "all")
        shutil.rmtree(self.folder / "all/fls")
        (self.folder / "all/fls").symlink_to(self.folder / "victim")
        self.merge_refused("part2", "all", words=("is a symbolic link",))
        (self.folder / "all/fls").unlink()
        waterfall = self.folder / "all/sss/waterfall.npy"
        waterfall.unlink()
        waterfall.symlink_to(self.folder / "victim/file")
        self.merge_refused("part3", "all", words=("waterfall.npy", "is a symbolic link"))
        self.assertEqual([(p.name, p.read_text()) for p in (self.folder / "victim").iterdir()], [("file", "mine")])

    def test_mistakes(self):
        self.write("taken/thesis.txt", "years of work")
        for folders, *words in ((("part1", "part2", "part3", "part1"), "part1", "one of the parts"),
                                (("part1", "none", "all"), "none", "there is no such folder"), (("part1",), ""),
                                (("part1", "part2", "part3", "taken"), "taken", "not a sonarsim dataset")):
            self.merge_refused(*folders, words=words)
        shutil.rmtree(self.folder / "part2/sss")
        self.merge_refused("part1", "part2", "part3", "all", words=("part2/sss/", "No such file"))

    def test_links_in_a_part_are_not_followed(self):
        self.assert_renders("--out", "done")
        self.write("secret/word", "swordfish")
        for part, files in (("part1", "mission.resolved.yaml dataset.json journal.d fls/polar sss sss/waterfall.npy FAN"),
                            ("done", "mission.resolved.yaml trajectory.tum SHA256SUMS journal.txt fls fls/polar/000001.npy "
                                     "sounder/echogram.npy mbes/bathymetry.tif")):
            for name in files.replace("FAN", str(next((self.folder / "part1").glob("fls/fan/*"))).split("part1/")[1]).split():
                with self.subTest(part=part, name=name):
                    path, kept = self.folder / part / name, self.folder / "kept"
                    path.rename(kept)
                    # Without the link there would be nothing to say: it names what was there.
                    path.symlink_to(kept)
                    self.merge_refused(part, "all", words=(f"{part}/{name}: is a symbolic link",))
                    if kept.is_file():
                        path.unlink()
                        path.symlink_to(self.folder / "secret/word")
                        self.run_sonarsim("merge", part, "all", code=2)
                    path.unlink()
                    kept.rename(path)
                    for copied in (self.folder / "all").rglob("*"):
                        self.assertNotIn(b"swordfish", copied.read_bytes() if copied.is_file() else b"")
                    shutil.rmtree(self.folder / "all", ignore_errors=True)
        self.succeeds("merge", "part1", "done", "all")
        self.assertEqual(digest(self.folder / "all"), self.whole)

    def test_what_a_kill_left_is_removed(self):
        left = [f"all/{name}.0123456789abcdef.part" for name in (".dataset.json", "..dataset.json.0123456789abcdef.part",
                                                                 ".SHA256SUMS", "fls/.x", "fls/polar/.000001.npy")]
        self.assert_renders("--out", "done")
        for parts in (("part1", "part2"), ("part1", "done"), ("done",)):    # the last is a merge that is done already
            with self.subTest(parts=parts):
                for name in left:
                    self.write(name, "half")
                if parts == ("part1", "part2"):
                    shutil.rmtree(self.folder / "all/fls")      # of no dataset yet
                self.write("all/journal.d/1-of-1.txt", "torn")
                self.succeeds("merge", *parts, "all")
                self.assertEqual(list((self.folder / "all").rglob("*.part")), [])
        self.assertEqual(digest(self.folder / "all"), self.whole)

    def test_a_full_disk_is_named_and_not_the_source(self):
        self.assert_renders("--out", "done")
        for parts in (("part1", "part2", "part3"), ("done",)):
            self.succeeds("merge", *parts, "out", env=with_disk(self, "none"))
            calls = (self.folder / "calls").read_text().splitlines()
            shutil.rmtree(self.out)
            for number in range(1, len(calls), max(1, len(calls) // 25)):
                with self.subTest(parts=parts, call=calls[number - 1]):
                    result = self.run_sonarsim("merge", *parts, "out", env=with_disk(self, "full", number), code=1)
                    self.assertRegex(result.stderr, r"^error: [^\n]*\bout\b[^\n]*: No space left on device\n$")
                    shutil.rmtree(self.out, ignore_errors=True)


class Status(Sandbox):
    def status(self, *folders):
        return self.reported("status", *folders)

    def test_shards_one_after_the_other(self):
        self.assert_renders("--shard", "2/3")
        self.assertEqual(self.status("out"), {"mission": "box", "state": "incomplete", "pings": {"done": 2, "all": 6}})
        # Another shard in a folder of its own: both together are reported.
        self.assert_renders("--shard", "1/3", "--out", "other")
        self.assertEqual(self.status("out", "other")["pings"], {"done": 4, "all": 6})
        self.assertIn("pings       4 of 6 (66.7 %)\n", self.succeeds("status", "out", "other").stdout)
        self.assert_renders()
        self.assertEqual(self.status("out")["state"], "complete")
        self.assert_renders("--seed", "8", "--out", "seed")
        for folders, words in (((".",), "is not a dataset"), (("out", "seed"), "of another mission")):
            self.assert_refused(self.run_sonarsim("status", *folders), words)

    def test_before_its_first_ping(self):
        part = self.out / "journal.d" / "1-of-1.txt"
        part.parent.mkdir(parents=True)
        with open(part, "w") as journal:
            fcntl.flock(journal, fcntl.LOCK_EX)
            self.assert_refused(self.run_sonarsim("status", "out"), "a job has begun here")
        self.assert_refused(self.run_sonarsim("status", "out"), "is not a dataset")

    def test_while_it_runs(self):
        self.write("path.csv", path_csv(200_000))
        with self.start("render", "mission.yaml", "-q", "--checkpoint", "0.05", "--set", "output.fan=false", "--set",
                        "output.image=false", "-j1") as process:
            try:
                self.wait_for(lambda: (self.out / "dataset.json").exists() and self.status("out")["pings"]["done"], process)
                self.assertEqual(self.status("out")["state"], "running")
            finally:
                process.terminate()
        self.assertEqual(self.status("out")["state"], "incomplete")

    def test_variants(self):
        self.add(VARIED)
        for shard, folders, state, done in (("1/2", ["out"], "incomplete", 2), ("2/2", ["out", "part2"], "complete", 3)):
            self.assert_renders("--shard", shard, "--out", folders[-1])
            reported = self.status(*folders)
            self.assertEqual((reported["state"], reported["variants"], reported["pings"]),
                             (state, {"done": done, "all": 3}, {"done": 6 * done, "all": 18}))
        self.assert_renders("--seed", "8", "--out", "other")
        self.assert_refused(self.run_sonarsim("status", "out", "other"), "holds variants of another mission")
        self.assert_refused(self.run_sonarsim("status", "out", "other/variant_0000"), "no variants.json")
