#!/usr/bin/env python3
"""The manual page and the completion are what the program says.   manual_test.py HALFSTEP FOLDER"""
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

HALFSTEP, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
PAGE = (FOLDER / "halfstep.1").read_text(encoding="utf-8")
COMPLETION = FOLDER / "halfstep"


def told(*arguments):
    return subprocess.run(arguments, check=True, capture_output=True, text=True).stdout


def commands():
    listed = told(HALFSTEP, "--help").split("Subcommands:")[1]
    return re.findall(r"^  ([a-z-]+)", listed, re.M)


def options(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", text))


def completed(*words):
    """What bash offers for the last of the words."""
    script = (f'source "{COMPLETION}"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _halfstep; '
              'printf "%s\\n" "${COMPREPLY[@]}"')
    return told("bash", "-c", script, "bash", HALFSTEP, *words).split()


class Manual(unittest.TestCase):
    def test_it_has_every_command_and_option_and_no_other(self):
        plain = re.sub(r"\\f[A-Z]", "", PAGE).replace("\\-", "-")
        known = options(told(HALFSTEP, "--help"))
        for command in commands():
            self.assertIn(f'\n.SS "{command}', plain)
            known |= options(told(HALFSTEP, command, "--help"))
        self.assertEqual(options(plain), known)

    def test_no_line_of_text_is_a_request(self):
        known = {"TH", "SH", "SS", "TP", "PP", "EX", "EE", "B", "I"}
        found = set(re.findall(r"^[.']([^ \n]*)", PAGE, re.M)) - {'\\"'}
        self.assertEqual(found - known, set())

    @unittest.skipUnless(shutil.which("groff"), "groff is not there")
    def test_groff_has_nothing_to_say(self):
        done = subprocess.run(["groff", "-ww", "-K", "utf8", "-T", "utf8", "-P", "-cbou", "-man", FOLDER / "halfstep.1"],
                              capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        self.assertIn("\nEXIT STATUS\n", done.stdout)

    def test_commands_options_choices_and_names_are_completed(self):
        self.assertEqual(completed("repl"), ["replay"])
        self.assertEqual(completed("replay", "runs/none", "--contr"), ["--controller"])
        self.assertEqual(completed("replay", "--engine", ""), ["mujoco"] + completed("x", ""))
        self.assertEqual(completed("run", "bar_8cm_f"), ["bar_8cm_forms"])
        self.assertEqual(completed("init", "x", "--robot", "bis"), ["bison"])
        self.assertEqual(completed("smooth", "x", "--method", "dichotomy/r"),
                         ["dichotomy/right_to_left"])
        self.assertEqual(completed("nonsense", "--"), [])

    @unittest.skipUnless(shutil.which("fish"), "fish is not there")
    def test_fish_completes_the_same(self):
        def offered(line):
            script = f'function halfstep; "{HALFSTEP}" $argv; end; source "{FOLDER}/halfstep.fish"; complete -C "{line}"'
            return [one.split("\t")[0] for one in told("fish", "--no-config", "-c", script).splitlines()]
        self.assertEqual(offered("halfstep repl"), ["replay"])
        self.assertEqual(offered("halfstep replay runs/none --contr"), ["--controller"])
        self.assertEqual(offered("halfstep run bar_8cm_f"), ["bar_8cm_forms"])
        self.assertEqual(offered("halfstep init x --robot bis"), ["bison"])
        self.assertEqual(offered("halfstep list plann"), ["planners"])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not there")
    def test_zsh_reads_its_own(self):
        """What zsh would be given to choose from; its line editor is not asked."""
        script = """
            _describe() { print -l $commands }; _files() {}
            _arguments() { print -l -- "$@" }; compadd() { print -l -- "${@:2}" }
            halfstep() { "$HALFSTEP" "$@" }; words=("${@:2}"); CURRENT=$#words
            source "$1" """

        def offered(*words):
            return told("zsh", "-f", "-c", "HALFSTEP=$0" + script, HALFSTEP, FOLDER / "_halfstep",
                        "halfstep", *words).splitlines()
        self.assertEqual({line.split(":")[0] for line in offered("")}, set(commands()) | {"--help", "--version"})
        known = set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", told(HALFSTEP, "replay", "--help"), re.M))
        self.assertEqual(options("\n".join(line.split("[")[0] for line in offered("replay", ""))), known)
        self.assertTrue(any(line.startswith("*:configs:") for line in offered("run", "")))

    def test_it_says_its_name_and_not_its_place(self):
        self.assertIn("\nUsage: halfstep run [OPTIONS] CONFIG\n", told(HALFSTEP, "run", "-h"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
