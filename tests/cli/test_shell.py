"""Texts of --help and --version, former commands, and the commands in Python that the program starts."""
import json
import os
import pathlib
import re
import subprocess
import unittest

from sandbox import SONARSIM, Sandbox


def lines_of(*arguments):
    return subprocess.run([SONARSIM, *arguments], text=True, capture_output=True, timeout=60, check=True).stdout


HELP = lines_of("--help")
COMMANDS, PYTHON_COMMANDS = (re.findall(r"^  ([a-z-]+)  ", HELP.split(f"\n{head}:\n")[1].split("\n\n")[0], re.MULTILINE)
                             for head in ("Subcommands", "Subcommands in Python"))


class Shell(Sandbox):
    def test_commands(self):
        self.assertEqual(sorted(COMMANDS), ["inspect", "keys", "merge", "preset", "preview", "render", "report", "status",
                                            "validate", "verify"])
        self.assertEqual(PYTHON_COMMANDS, ["export", "gallery", "compare", "calibrate", "import-holoocean"])

    def test_former_commands_say_what_stands_in_for_them(self):
        for command, instead in (("schema", "sonarsim keys --json"), ("materials", "sonarsim inspect FILE.csv"),
                                 ("man", "--help"), ("completion", "--help"), ("contact-sheet", "montage")):
            result = self.run_sonarsim(command)
            self.assertEqual(result.returncode, 2)
            self.assertIn(instead, result.stderr)

    def test_examples_name_commands_and_options_that_there_are(self):
        for line in re.findall(r"^  sonarsim (.*)$", HELP, re.MULTILINE):
            self.assertIn(line.split()[0], COMMANDS)
        for command in COMMANDS:
            page = lines_of(command, "--help")
            for line in re.findall(r"^  sonarsim (.*)$", page, re.MULTILINE):
                self.assertIn(line.split()[0], COMMANDS)
                if line.split()[0] != command:
                    continue
                for option in re.findall(r" (--[a-z-]+)", line):
                    self.assertIn(option, page.split("Examples:")[0])

    def test_version_tells_the_build(self):
        self.assertRegex(lines_of("--version"),
                         r"\Asonarsim \d+\.\d+\.\d+\nbuilt by \w+ [\d.]+ with .*; arithmetic \S+; ")

    def test_a_fault_in_json_has_its_place(self):
        self.edit("mission.yaml", "range_max_m", "range_mx_m")
        result = self.run_sonarsim("render", "mission.yaml", "--json")
        self.assertEqual(result.returncode, 2)
        fault = json.loads(result.stderr.splitlines()[-1])
        self.assertEqual((fault["file"], fault["line"], fault["column"]), ("mission.yaml", 13, 5))
        self.assertTrue(fault["message"].startswith("mission.yaml:13:5: unknown key"))


class Python(Sandbox):
    """SONARSIM_PYTHON names a program that stands in for the interpreter."""

    def run_tool(self, script, *arguments, **variables):
        python = self.write("python", "#!/bin/sh\n" + script)
        python.chmod(0o755)
        return self.run_sonarsim(*arguments, env={**os.environ, "SONARSIM_PYTHON": str(python), **variables})

    def test_options_and_exit_codes_pass_through(self):
        result = self.run_tool('for word; do echo "<$word>"; done; echo "$PYTHONPATH"; exit 7\n', "import-holoocean",
                               "--help", "two words", "--", "-q", PYTHONPATH="/elsewhere")
        self.assertEqual(result.returncode, 7)
        *words, folders = result.stdout.splitlines()
        self.assertEqual(words, ["<-m>", "<sonarsim.import_holoocean>", "<--help>", "<two words>", "<-->", "<-q>"])
        package, other = folders.split(":")
        self.assertTrue((pathlib.Path(package) / "sonarsim/command.py").is_file())
        self.assertEqual(other, "/elsewhere")
        self.assertEqual(self.run_tool("kill -TERM $$\n", "export").returncode, -15)

    def test_a_module_of_the_current_folder_is_not_taken(self):
        self.write("json.py", "raise SystemExit('the wrong module')\n")
        result = self.run_sonarsim("import-holoocean", "--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("usage: sonarsim import-holoocean", result.stdout)

    def test_what_is_missing_is_said_in_one_sentence(self):
        result = self.run_sonarsim("export", env={**os.environ, "SONARSIM_PYTHON": "/nowhere/python3"})
        self.assertEqual(result.returncode, 2)
        self.assertIn("cannot run /nowhere/python3: No such file or directory; install python3", result.stderr)
        need = "from sonarsim.command import need; need('export', 'json', 'PIL', 'nothing')"
        result = self.run_tool(f'exec /usr/bin/python3 -SIc "import sys; sys.path.append(\'${{PYTHONPATH%%:*}}\'); {need}"\n',
                               "export")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"\Asonarsim export: install python3-pil nothing \(.*SONARSIM_PYTHON.*\)\n\Z")


if __name__ == "__main__":
    unittest.main()
