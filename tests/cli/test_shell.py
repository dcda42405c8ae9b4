"""Texts for shells, for man and for users of --help and --version: all of it from the same texts."""
import json
import re
import shutil
import subprocess
import unittest

from sandbox import SONARSIM, Sandbox


def lines_of(*arguments):
    return subprocess.run([SONARSIM, *arguments], text=True, capture_output=True, timeout=60,
                          check=True).stdout


COMMANDS = re.findall(r"^  ([a-z-]+)  ", lines_of("--help").split("Subcommands:")[1], re.MULTILINE)

COMPLETE = """
complete_line() {
    COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _sonarsim; echo "${COMPREPLY[@]}"
}
complete_line sonarsim ''
complete_line sonarsim rend
complete_line sonarsim render --over
complete_line sonarsim render --log-level w
complete_line sonarsim completion ''
complete_line sonarsim render mission
"""


class Shell(Sandbox):
    def need(self, program):
        if shutil.which(program) is None:
            self.skipTest(f"{program} is not installed")

    def test_bash(self):
        result = subprocess.run(["bash", "-c", lines_of("completion", "bash") + COMPLETE],
                                cwd=self.folder, text=True, capture_output=True, check=False)
        self.assertEqual(result.stderr, "")
        first, *others = result.stdout.splitlines()
        self.assertGreaterEqual(len(COMMANDS), 8)
        self.assertEqual(set(COMMANDS) - set(first.split()), set())
        self.assertEqual(others, ["render", "--overwrite", "warning", "bash fish zsh",
                                  "mission.yaml"])

    def test_zsh_and_fish(self):
        for shell in ("zsh", "fish"):
            with self.subTest(shell):
                text = lines_of("completion", shell)
                for command in COMMANDS:
                    self.assertIn(command, text)
                self.need(shell)
                result = subprocess.run([shell, "-n", "/dev/stdin"], input=text, text=True,
                                        capture_output=True, check=False)
                self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_fish_completes(self):
        self.need("fish")
        result = subprocess.run(["fish", "-c", lines_of("completion", "fish") +
                                 "complete -C 'sonarsim rend'"],
                                text=True, capture_output=True, check=False)
        self.assertTrue(result.stdout.startswith("render\t"), result.stdout + result.stderr)

    def test_man(self):
        page = lines_of("man")
        self.assertTrue(page.startswith(".TH SONARSIM 1"))
        for command in COMMANDS:
            self.assertIn(f"\n.SS \"sonarsim {command}".replace("-", "\\-"), page)
        self.assertIn("\\fB\\-\\-overwrite\\fR", page)
        self.need("man")
        result = subprocess.run(["man", "--warnings", "-l", "-"], input=page, text=True,
                                capture_output=True, check=False)
        self.assertEqual(result.stderr, "")
        self.assertIn("EXIT STATUS", result.stdout)

    def test_examples_name_commands_and_options_that_there_are(self):
        for line in re.findall(r"^  sonarsim (.*)$", lines_of("--help"), re.MULTILINE):
            self.assertIn(line.split()[0], COMMANDS)
        for command in COMMANDS:
            page = lines_of(command, "--help")
            for line in re.findall(r"^  sonarsim (.*)$", page, re.MULTILINE):
                self.assertEqual(line.split()[0], command)
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


if __name__ == "__main__":
    unittest.main()
