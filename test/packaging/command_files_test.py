# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual page and the completions say what the program says: command_files_test.py PROGRAM WRITER"""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, WRITER = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
COMMANDS = ["mesh", "evaluate", "sample", "view", "annotate", "register", "symmetries"]


def help_of(command):
    return subprocess.run([PROGRAM, command, "--help"], check=True, capture_output=True, text=True).stdout


class CommandFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.place.name)
        subprocess.run([sys.executable, "-B", WRITER, PROGRAM, cls.folder], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def completed(self, *words):
        """What bash proposes for the last of the words."""
        script = ('source "$0"; COMP_WORDS=(equiaffine "$@"); COMP_CWORD=$#; _equiaffine; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-euc", script, self.folder / "equiaffine.bash", *words], check=True,
                              capture_output=True, text=True)
        return done.stdout.split()

    def test_the_page_has_all_words_of_the_help(self):
        page = gzip.decompress((self.folder / "equiaffine.1.gz").read_bytes()).decode()
        self.assertTrue(page.startswith(".TH EQUIAFFINE 1 "))
        plain = " ".join(re.sub(r"\\f[BIR]", "", line).replace("\\-", "-").replace("\\&", "").replace("\\e", "\\").replace(", -", ",-")
                         for line in page.splitlines())
        for command in COMMANDS:
            for word in help_of(command).split():
                self.assertIn(word.rstrip(":"), plain)

    def test_an_example_stays_as_it_is(self):
        page = gzip.decompress((self.folder / "equiaffine.1.gz").read_bytes()).decode().replace("\\-", "-").replace("\\e", "\\")
        self.assertIn(".nf\nequiaffine mesh --function", page)
        self.assertIn('''\n      --box -3 3 -3 3 -1 1 --resolution 128 -o torus.ply --html torus.html\n''', page)
        self.assertEqual(page.count(".nf\n"), page.count(".fi\n"))

    def test_bash_completes_commands(self):
        self.assertEqual(self.completed(""), [*COMMANDS, "-h", "--help", "--version"])
        self.assertEqual(self.completed("sy"), ["symmetries"])

    def test_bash_completes_every_option_of_a_command(self):
        for command in COMMANDS:
            options = re.findall(r"^  (-\S+)", help_of(command), re.MULTILINE)
            self.assertGreater(len(options), 5)
            self.assertEqual(self.completed(command, "-"), [name for names in options for name in names.split(",")])

    def test_bash_completes_the_values_of_an_option(self):
        self.assertEqual(self.completed("mesh", "--method", ""), ["marching-cubes", "delaunay", "remesh"])
        self.assertEqual(self.completed("annotate", "--scale", "a"), ["auto"])
        self.assertEqual(self.completed("sample", "--type", "f"), ["float"])
        for command in COMMANDS:
            for names, words in re.findall(r"^  (-\S+) (\S+\|\S+)", help_of(command), re.MULTILINE):
                choices = [word for word in words.split("|") if re.fullmatch("[a-z0-9-]+", word)]
                self.assertEqual(self.completed(command, names.split(",")[0], ""), choices)
        self.assertEqual(self.completed("mesh", "--volume", ""), [])  # files, which bash proposes where we do not

    def test_the_shells_can_read_the_others(self):
        for shell, name in (("zsh", "_equiaffine"), ("fish", "equiaffine.fish")):
            if shutil.which(shell):
                subprocess.run([shell, "-n", self.folder / name], check=True)
        fish = (self.folder / "equiaffine.fish").read_text()
        self.assertIn("-l method -x -a 'marching-cubes delaunay remesh'", fish)
        self.assertIn("-n __fish_use_subcommand -l version", fish)
        zsh = (self.folder / "_equiaffine").read_text()
        self.assertIn("'*--method[", zsh)
        self.assertIn("'--version:show the version'", zsh)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=0)
