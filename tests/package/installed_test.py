#!/usr/bin/env python3
"""Tests an installed copy: the command without the source tree, find_package, pkg-config, and
halfstep as a subproject.

  installed_test.py BUILD SOURCE [--all-examples]   (every example against the copy, not only one)
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD, SOURCE = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
ALL_EXAMPLES = "--all-examples" in sys.argv
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}  # as after `env -i`


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          env=ENVIRONMENT | options.pop("env", {}), **options)
    assert done.returncode == 0, f"{command}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def compile_commands(build, source):
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    return [entry["command"] for entry in commands if entry["file"].endswith(source)]


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = pathlib.Path(tempfile.mkdtemp())
        cls.prefix = cls.place / "usr"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        cls.halfstep = cls.prefix / "bin" / "halfstep"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.place)

    def test_the_command_finds_its_own_data(self):
        self.assertIn("hrp2", run(self.halfstep, "list", "robots", cwd=self.place))
        configs = self.prefix / "share/halfstep/configs"
        run(self.halfstep, "run", configs / "fig3_two_half_steps.yaml", "--out",
            self.place / "run", "--quiet", cwd=self.place)
        run(self.halfstep, "verify", self.place / "run", cwd=self.place)
        config = (self.place / "run/config.yaml").read_text(encoding="utf-8")
        self.assertIn("robot: inputs/robot/hrp2.yaml", config)
        manifest = (self.place / "run/manifest.json").read_text(encoding="utf-8")
        self.assertNotIn(str(SOURCE), manifest)

    def test_headers_are_below_one_folder(self):
        self.assertEqual([path.name for path in (self.prefix / "include").iterdir()], ["halfstep"])
        self.assertTrue((self.prefix / "include/halfstep/smoothing/walk/splice.h").exists())

    def test_pkg_config(self):
        found = run("pkg-config", "--cflags", "--libs", "--static", "halfstep",
                    env={"PKG_CONFIG_PATH": str(next(self.prefix.rglob("pkgconfig")))})
        self.assertIn("-lhalfstep_smoothing", found)
        self.assertIn("-lfcl", found)
        self.assertNotIn("-std", found)  # which one is the user's

    def test_the_python_module(self):
        packages = list(self.prefix.rglob("dist-packages"))
        if not packages:
            self.skipTest("built without the Python module")
        told = run("/usr/bin/python3", "-c", "import halfstep as hs; "
                   "print(hs.__file__, hs.Experiment('fig3_two_half_steps').smooth().duration)",
                   cwd=self.place, env={"PYTHONPATH": str(packages[0])})
        file, duration = told.split()
        self.assertTrue(file.startswith(str(self.prefix)), file)
        self.assertLess(float(duration), 4.0)

    def test_find_package(self):
        build = self.place / "examples"
        run("cmake", "-S", SOURCE / "experiments/examples", "-B", build, "-G", "Ninja",
            "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1",
            f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
            f"-DCMAKE_DISABLE_PRECOMPILE_HEADERS={not ALL_EXAMPLES}")  # for one it costs time
        name = "01_walk_from_footsteps"
        run("cmake", "--build", build, "-j", "2", *([] if ALL_EXAMPLES else ["--target", name]))
        self.assertIn("overlapped:", run(build / name, cwd=self.place,
                                         env={"HALFSTEP_DATA": str(self.prefix / "share/halfstep")}))
        command = compile_commands(build, name + ".cc")[0]
        for flag in ["-Wall", "-Wconversion", "-fsanitize", str(SOURCE / "wpg")]:
            self.assertNotIn(flag, command)


class Subproject(unittest.TestCase):
    def test_brings_neither_tests_nor_flags(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "mine.cc").write_text("int main() {}\n", encoding="utf-8")
            (place / "CMakeLists.txt").write_text(f"""
                cmake_minimum_required(VERSION 3.25)
                project(mine LANGUAGES CXX)
                add_subdirectory({SOURCE} halfstep)
                add_executable(mine mine.cc)
                target_link_libraries(mine PRIVATE halfstep::smoothing)
                """, encoding="utf-8")
            build = place / "build"
            run("cmake", "-S", place, "-B", build, "-G", "Ninja",
                "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
            command = compile_commands(build, "mine.cc")[0]
            for flag in ["-Wall", "-Wconversion", "-fsanitize", "-D_FORTIFY_SOURCE", "-O2"]:
                self.assertNotIn(flag, command)
            targets = run("ninja", "-C", build, "-t", "targets", "all")
            for target in ["wpg_tests", "live_study", "node_modules"]:
                self.assertNotIn(target, targets)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
