"""The program's own texts: --help, --version, the keys and their schema, and the commands in Python
that it starts. What the schema refuses the program refuses."""
import json
import os
import pathlib
import re
import subprocess
import textwrap
import unittest

from sandbox import MISSION, ROOT, SONARSIM, Sandbox

try:
    import jsonschema
    import yaml
except ImportError:     # Debian has python3-jsonschema and python3-yaml
    jsonschema = yaml = None


def lines_of(*arguments):
    return subprocess.run([SONARSIM, *arguments], text=True, capture_output=True, timeout=60, check=True).stdout


HELP = lines_of("--help")
GROUPS = {head: re.findall(r"^  ([a-z-]+)  ", HELP.split(f"\n{head}:\n")[1].split("\n\n")[0], re.MULTILINE)
          for head in ("Make", "Look", "Check", "Use", "Learn")}
PYTHON_COMMANDS = ["export", "gallery", "compare", "calibrate", "import-holoocean", "import-poses"]
COMMANDS = [command for group in GROUPS.values() for command in group if command not in PYTHON_COMMANDS]


class Texts(Sandbox):
    maxDiff = None

    def test_examples_name_commands_and_options_that_there_are(self):
        for command in COMMANDS:
            page = lines_of(command, "--help")
            for name, rest in re.findall(r"^  sonarsim (\S+)(.*)$", page, re.MULTILINE):
                self.assertIn(name, COMMANDS)
                for option in re.findall(r" (--[a-z-]+)", rest) if name == command else ():
                    self.assertIn(option, page.split("Examples:")[0])

    def test_version_names_the_build(self):
        self.assertRegex(lines_of("--version"), r"\Asonarsim \d+\.\d+\.\d+\nbuilt by \w+ [\d.]+ with .*; arithmetic \S+; ")

    def test_texts_for_a_terminal(self):
        self.assertLessEqual(max(map(len, lines_of("preset").splitlines())), 80)
        self.assertIn("gemini_720is", lines_of("preset"))
        names = re.findall(r"^\| `(\w+)`", lines_of("keys", "noise"), re.MULTILINE)
        self.assertIn("add_sigma", names)
        self.assertNotIn("waypoints", names)
        self.assert_refused(self.run_sonarsim("keys", "nose"), "no key has 'nose' in its path")

    def test_the_pages_show_the_tables_of_the_program(self):
        for page, table, command in (("mission.md", "keys", [SONARSIM, "keys"]), ("warnings.md", "warnings", [SONARSIM, "warnings"]),
                                     ("calibrated.md", "presets", [ROOT / "scripts/preset_table.sh", SONARSIM])):
            marks = rf"<!-- begin {table} -->\n\n(.*)\n<!-- end {table} -->"
            found = re.search(marks, (ROOT / "docs" / page).read_text(), re.DOTALL)
            printed = subprocess.run(command, text=True, capture_output=True, timeout=60, check=True).stdout
            self.assertEqual(found.group(1), printed, "run ./scripts/write_keys.sh")

    def test_what_is_misspelt_is_named(self):
        for arguments, message in (([], ""), (["render"], ""), (["render", "mission.yaml", "-j", "0"], ""),
                (["render", "mission.yaml", "--seed", "-1"], ""), (["render", "mission.yaml", "--shard", "3/2"], ""),
                (["render", "mission.yaml", "--shard", "0/2"], ""), (["render", "mission.yaml", "--log-level", "loud"], ""),
                (["render", "mission.yaml", "--set", "seed"], "--set"),
                (["render", "mission.yaml", "--out", ""], "--out: the folder's name is empty"),
                (["render", "mission.yaml", "--checkpoint", "nan"], "--checkpoint: nan is not from 0.01 to 3600"),
                (["render", "mission.yaml", "--set", "sensors.fls.noise.add_sgma=0.2"],
                 "--set sensors.fls.noise.add_sgma=0.2: unknown key 'add_sgma' (did you mean 'add_sigma'?)"),
                (["mission.yaml"], "a subcommand must come first, as in: sonarsim render mission.yaml"),
                (["rendr", "mission.yaml"], "unknown subcommand 'rendr' (did you mean 'render'?)"),
                (["--quiet"], "unknown option '--quiet'"),
                (["render", "mission.yaml", "--overwite"], "unknown option '--overwite' (did you mean '--overwrite'?)"),
                (["inspect", "box.gltf", "box.gltf"], "one argument too many: 'box.gltf'"),
                (["inspect", "none.glb"], "none.glb"), (["render", "out"], "out: cannot open"),
                (["render", "mission.yaml", "--out", "path.csv/out"], f"{self.folder}/path.csv/out: cannot make"),
                (["render", "mission.yaml", "--out", "/proc/none/out"], "/proc/none/out: cannot make")):
            with self.subTest(arguments=arguments):
                result = self.run_sonarsim(*arguments, code=2)
                self.assertTrue(any(line.startswith("error: " + message) for line in result.stderr.splitlines()), result.stderr)
                self.assertFalse(self.out.exists())


class Python(Sandbox):
    """SONARSIM_PYTHON names a program that stands in for the interpreter."""

    def run_tool(self, script, *arguments, code, **variables):
        python = self.write("python", "#!/bin/sh\n" + script)
        python.chmod(0o755)
        return self.run_sonarsim(*arguments, code=code, env={**os.environ, "SONARSIM_PYTHON": str(python), **variables})

    def test_options_and_exit_codes_pass_through(self):
        result = self.run_tool('for word; do echo "<$word>"; done; echo "$PYTHONPATH"; exit 7\n', "import-holoocean",
                               "--help", "two words", "--", "-q", code=7, PYTHONPATH="/elsewhere")
        *words, folders = result.stdout.splitlines()
        self.assertEqual(words, ["<-m>", "<sonarsim.import_holoocean>", "<--help>", "<two words>", "<-->", "<-q>"])
        package, other = folders.split(":")
        self.assertTrue((pathlib.Path(package) / "sonarsim/command.py").is_file())
        self.assertEqual(other, "/elsewhere")
        self.run_tool("kill -TERM $$\n", "export", code=-15)

    def test_a_module_of_the_current_folder_is_not_taken(self):
        self.write("json.py", "raise SystemExit('the wrong module')\n")
        result = self.succeeds("import-holoocean", "--help")
        self.assertEqual(result.stderr, "")
        self.assertIn("usage: sonarsim import-holoocean", result.stdout)

    def test_what_is_missing_is_named_in_one_sentence(self):
        result = self.run_sonarsim("export", env={**os.environ, "SONARSIM_PYTHON": "/nowhere/python3"})
        self.assert_refused(result, "cannot run /nowhere/python3: No such file or directory; install python3")
        need = "from sonarsim.command import need; need('export', 'json', 'PIL', 'nothing')"
        result = self.run_tool(f'exec /usr/bin/python3 -SIc "import sys; sys.path.append(\'${{PYTHONPATH%%:*}}\'); {need}"\n',
                               "export", code=2)
        self.assertRegex(result.stderr, r"\Asonarsim export: install python3-pil nothing \(.*SONARSIM_PYTHON.*\)\n\Z")


# A text that stands in the small mission, what it becomes, and the key at which it is wrong.
WRONG = (("seed: 7", "sead: 7", "sead"), ("seed: 7", "seed: -1", "seed"),
    ("seed: 7", "seed: 7\nengine: cubes", "engine"), ("seed: 7", "seed: 7\nwater: 997", "water"),
    ("seed: 7", "seed: 7\nclasses: {nodes: a, class: b}", "classes"), ("  materials: materials.csv\n", "", "scene"),
    ("  materials: materials.csv\n", "  materials: materials.csv\n  objects: [{name: hull}]\n", "objects"),
    ("  file: path.csv", "  file: path.csv\n  speed_m_s: 1", "trajectory"), ("    kind: imaging\n", "", "fls"),
    ("kind: imaging", "kind: sidescan", "azimuth_bins"), ("kind: imaging", "kind: imaging\n    model: calibrated", "noise"),
    ("kind: imaging", "kind: imaging\n    mount: {rpy_deg: [0, 0]}", "rpy_deg"),
    ("range_max_m: 6", "range_max_m: 0", "range_max_m"), ("range_bins: 48", "range_bins: 48.5", "range_bins"),
    ("range_bins: 48", "range_bins: 8193", "range_bins"), ("  fls:", "  fore ward:", "fore ward"),
    ("image: true", "image: 1", "image"), ("image: true", "labels: [share, share]", "labels"), )


@unittest.skipIf(jsonschema is None, "needs jsonschema and yaml")
class Schema(Sandbox):
    """`sonarsim keys --json`."""

    @classmethod
    def setUpClass(cls):
        class Loader(yaml.SafeLoader):
            """Numbers as YAML 1.2 has them: 3e6 is one, which PyYAML takes for text."""

        number = re.compile(r"[-+]?(\.[0-9]+|[0-9]+\.?[0-9]*)[eE][-+]?[0-9]+$")
        Loader.add_implicit_resolver("tag:yaml.org,2002:float", number, list("-+.0123456789"))
        cls.loader, cls.schema = Loader, json.loads(lines_of("keys", "--json"))

    def faults(self, text):
        """Every place and message of the schema's complaint, in one text; "" where it has none."""
        checked = jsonschema.Draft202012Validator(self.schema).iter_errors(yaml.load(text, self.loader))
        lines, waiting = [], list(checked)
        while waiting:
            error = waiting.pop()
            lines.append(f"{'.'.join(map(str, error.absolute_path))}: {error.message}")
            waiting += error.context
        return "\n".join(lines)

    def test_examples_validate(self):
        jsonschema.Draft202012Validator.check_schema(self.schema)
        texts = {path: path.read_text() for path in (*(ROOT / "configs").glob("*.yaml"), ROOT / "tests/four_sonars.yaml")}
        self.assertGreater(len(texts), 15)
        start = MISSION[:MISSION.index("    kind")]
        texts |= {path: start + textwrap.indent(path.read_text(), "    ") for path in (ROOT / "configs/sensors").glob("*.yaml")}
        for path, text in texts.items():
            with self.subTest(path=path):
                self.assertEqual(self.faults(text), "")

    def test_what_the_schema_refuses_the_program_refuses(self):
        self.write("mine.yaml", "kind: imaging\nrange_bins: 48\n")
        for right, wrong, key in WRONG:
            with self.subTest(wrong=wrong):
                self.assertIn(right, MISSION)
                text = MISSION.replace(right, wrong)
                self.assertIn(key, self.faults(text))
                self.write("wrong.yaml", text)
                self.run_sonarsim("validate", "wrong.yaml", code=2)
        # What only looks wrong is right.
        for right, other in (("name: box", "name: 7"), ("seed: 7", "seed: 18446744073709551615"),
                             ("range_max_m: 6", "range_max_m: 6e0"), ("image: true", "labels: true"),
                             ("seed: 7", "seed: 7\nwater: {sound_speed_m_s: auto}"),
                             ("    kind: imaging\n", "    preset: mine.yaml\n")):
            with self.subTest(other=other):
                text = MISSION.replace(right, other)
                self.assertEqual(self.faults(text), "")
                self.write("other.yaml", text)
                self.succeeds("validate", "other.yaml")
