#!/usr/bin/env python3
"""Manual pages and completions of shells: complete, accepted by the programs that read them, and right.

usage: test_manuals.py PATH_OF_POWERCELL [unittest options]
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from tool import ToolTest, run

# Completes the words given as arguments, of which the last is incomplete, one candidate a line. Bash itself would
# split words at '=' and ':'.
IN_BASH = """
compopt() { echo "compopt $*" >&2; }
source "$FILE"
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_powercell
((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}"
"""


class Manuals(ToolTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.share = pathlib.Path(folder.name) / "new" / "share"
        done = run("manuals", cls.share, "--date", "2026-11-26")
        assert done.returncode == 0, done.stderr
        cls.bash = cls.share / "bash-completion/completions/powercell"
        cls.zsh = cls.share / "zsh/site-functions/_powercell"
        cls.fish = cls.share / "fish/vendor_completions.d/powercell.fish"

    def page(self, command):
        return self.share / "man/man1" / (f"powercell-{command}.1" if command else "powercell.1")

    def need(self, program):
        if not shutil.which(program):
            self.skipTest(f"{program} is not installed")

    # -- Manual pages

    def shown(self, command):
        """A page as text, with the blanks between words made equal."""
        done = subprocess.run(["groff", "-man", "-Tascii", "-ww", "-rLL=200n", "-P-c", "-P-b", "-P-u", self.page(command)],
                              text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return " ".join(done.stdout.split())

    def test_each_command_has_a_page(self):
        pages = sorted(path.name for path in (self.share / "man/man1").iterdir())
        self.assertEqual(pages, sorted(self.page(command).name for command in ["", *self.commands()]))

    def test_pages_show_every_option_and_its_text(self):
        self.need("groff")
        for command in self.commands():
            with self.subTest(command):
                text = self.shown(command)
                for option in self.options(command):
                    self.assertIn(option.title, text)
                    # Lines are broken behind hyphens and slashes too.
                    self.assertIn(re.sub(r"\s", "", option.text), re.sub(r"\s", "", text))

    def test_pages_show_the_rest_of_help(self):
        self.need("groff")
        for command in ["", *self.commands()]:
            with self.subTest(command):
                text = re.sub(r"\s", "", self.shown(command))
                help_text = self.good(*[command] if command else [], "--help").stdout
                for line in help_text.split("\nExamples:\n")[1].splitlines():
                    if line not in ("Environment:",):
                        self.assertIn(re.sub(r"\s", "", line), text)

    def test_pages_have_no_fault(self):
        for program in (["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z"], ["mandoc", "-T", "lint", "-W", "warning"]):
            if not shutil.which(program[0]):
                continue
            for command in ["", *self.commands()]:
                with self.subTest(program=program[0], command=command):
                    done = subprocess.run([*program, self.page(command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                          text=True, errors="replace", env={**os.environ, "MANROFFSEQ": ""})
                    told = done.stdout if program[0] == "mandoc" else ""
                    self.assertEqual((done.returncode, done.stderr, told), (0, "", ""))

    # -- Bash

    def complete(self, *words, files=(), code=0):
        folder = self.folder / "here"
        folder.mkdir(exist_ok=True)
        for name in files:
            if name.endswith("/"):
                (folder / name).mkdir(exist_ok=True)
            else:
                (folder / name).write_text("")
        done = subprocess.run(["bash", "-c", IN_BASH, "bash", "powercell", *words], cwd=folder, text=True,
                              capture_output=True, env={**os.environ, "FILE": str(self.bash)})
        self.assertEqual(done.returncode, code, done.stderr)
        self.options_of_completion = done.stderr.split("\n")[:-1]
        return sorted(done.stdout.splitlines())

    def test_bash_completes_commands(self):
        commands = self.commands()
        self.assertEqual(self.complete(""), sorted(commands))
        self.assertEqual(self.complete("dia"), ["diagram"])
        self.assertEqual(self.complete("d"), ["demo", "devices", "diagram"])
        self.assertEqual(self.complete("--v"), ["--version"])
        self.assertEqual(self.complete("help", "tr"), ["transport", "treemap"])
        self.assertEqual(self.complete("no-such", "x"), [])

    def test_bash_completes_every_option(self):
        for command in self.commands():
            names = {name for option in self.options(command) for name in option.names}
            with self.subTest(command):
                self.assertEqual(self.complete(command, "-"), sorted(names))
                for begin in ("--d", "--no", "--s"):
                    self.assertEqual(self.complete(command, begin), sorted(n for n in names if n.startswith(begin)))

    def test_bash_completes_words_that_options_take(self):
        begin = ("diagram", "--quiet")
        self.assertEqual(self.complete(*begin, "--precision", ""), ["auto", "double", "float"])
        self.assertEqual(self.complete(*begin, "--precision", "d"), ["double"])
        self.assertEqual(self.complete(*begin, "--precision", "=", "f"), ["float"])
        self.assertEqual(self.complete(*begin, "--precision", "="), ["auto", "double", "float"])
        self.assertEqual(self.complete("sample", "--mode", "q"), ["quantise"])
        self.assertEqual(self.complete("remesh", "a.off", "--method", ""), ["fpo", "transport"])
        self.assertEqual(self.complete("diagram", "--threads", ""), [])
        for command in self.commands():
            for option in self.options(command):
                if "|" in option.value and option.value.islower():
                    with self.subTest(command=command, option=option.title):
                        self.assertEqual(self.complete(command, option.names[-1], ""), sorted(option.value.split("|")))

    def test_bash_completes_files(self):
        files = ("seeds.csv", "square name.off", "shapes/", "other")
        self.assertEqual(self.complete("diagram", "--table", "", files=files), sorted(n.rstrip("/") for n in files))
        self.assertEqual(self.complete("diagram", "-o", "se"), ["seeds.csv"])
        self.assertIn("compopt -o filenames", self.options_of_completion)
        self.assertEqual(self.complete("diagram", "--domain", "s"), ["seeds.csv", "shapes", "sphere", "square", "square name.off"])
        self.assertEqual(self.complete("diagram", "--domain", "cu"), ["cube"])
        self.assertEqual(self.complete("demo", "-o", ""), ["shapes"])
        self.assertEqual(self.complete("treemap", "s"), ["seeds.csv", "shapes", "square name.off"])
        self.assertEqual(self.complete("remesh", "s"), ["seeds.csv", "shapes", "sphere", "square name.off"])
        # What needs more behind it gets no blank.
        self.assertEqual(self.complete("diagram", "--seeds", "rand"), ["random:"])
        self.assertIn("compopt -o nospace", self.options_of_completion)

    # -- Other shells

    def test_zsh(self):
        text = self.zsh.read_text()
        for command in self.commands():
            branch = text.split(f"\n      {command})\n")[1].split("\n        ;;\n")[0]
            for option in self.options(command):
                for name in option.names:
                    self.assertRegex(branch, rf"'\*?{name}[=+\[]")
        self.need("zsh")
        done = subprocess.run(["zsh", "-n", self.zsh], text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        # The function itself, with a stand-in that shows what it would tell the completion system.
        script = ("_arguments() { print -rl -- $@; [[ $1 != -C ]] || state=arguments }\n"
                  "for command in $*; do words=($command ''); source $FILE; done\n")
        done = subprocess.run(["zsh", "-f", "-c", script, "zsh", *self.commands()], text=True, capture_output=True,
                              env={**os.environ, "FILE": str(self.zsh)})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("--version[Show the version]", done.stdout)
        told = done.stdout.split("-C\n")[1:]
        for command, lines in zip(self.commands(), told):
            for option in self.options(command):
                for name in option.names:
                    self.assertRegex(lines, rf"(?m)^\*?{name}[=+]?\[\S")

    def test_fish(self):
        text = self.fish.read_text()
        for command in self.commands():
            lines = [line for line in text.splitlines() if f"'__fish_seen_subcommand_from {command}'" in line]
            for option in self.options(command):
                for name in option.names:
                    switch = f" -l {name[2:]} " if name.startswith("--") else f" -s {name[1:]} "
                    self.assertTrue([line for line in lines if switch in line], name)
        self.need("fish")

        def candidates(line):
            done = subprocess.run(["fish", "--no-config", "-c", 'source $FILE; complete -C "$LINE"'], text=True,
                                  capture_output=True, cwd=self.folder, env={**os.environ, "FILE": str(self.fish), "LINE": line})
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return sorted(row.split("\t")[0] for row in done.stdout.splitlines())

        self.assertEqual(candidates("powercell dia"), ["diagram"])
        self.assertEqual(candidates("powercell "), sorted(self.commands()))
        self.assertEqual(candidates("powercell diagram --precision "), ["auto", "double", "float"])
        self.write("table.csv", "")
        self.assertEqual(candidates("powercell diagram --table t"), ["table.csv"])
        names = {name for option in self.options("sample") for name in option.names if name.startswith("--m")}
        self.assertEqual(candidates("powercell sample --m"), sorted(names))

    def test_wrong_arguments(self):
        self.bad(2, "'today' is not a date", "manuals", "x", "--date", "today")
        self.write("taken", "")
        self.bad(1, "cannot be created", "manuals", "taken", "--date", "2026-11-26")


if __name__ == "__main__":
    unittest.main(verbosity=1)
