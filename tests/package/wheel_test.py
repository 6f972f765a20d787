#!/usr/bin/env python3
"""Tests the wheel that `pip install .` builds, of what is built already.   wheel_test.py BUILD SOURCE"""
import base64
import csv
import hashlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

BUILD, SOURCE = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / "experiments/python"))
import halfstep_wheel as backend  # noqa: E402


def install(build, stage, arguments):
    for component in ("runtime", "python"):
        subprocess.run(["cmake", "--install", BUILD, "--prefix", stage, "--component", component],
                       check=True, stdout=subprocess.DEVNULL)


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        place = pathlib.Path(cls.folder.name)
        backend.installed = install
        cls.wheel = zipfile.ZipFile(place / backend.build_wheel(str(place)))
        cls.name = f"halfstep-{backend.version()}"
        cls.prefix = place / "environment"
        cls.packages = cls.prefix / "lib/python3/site-packages"
        # As pip unpacks it.
        for info in cls.wheel.infolist():
            path = pathlib.PurePosixPath(info.filename)
            data = pathlib.PurePosixPath(f"{cls.name}.data")
            file = cls.packages / path
            if path.is_relative_to(data / "data"):
                file = cls.prefix / path.relative_to(data / "data")
            elif path.is_relative_to(data / "scripts"):
                file = cls.prefix / "bin" / path.name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(cls.wheel.read(info))
            file.chmod(info.external_attr >> 16 or 0o644)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def told_by(self, *words, **environment):
        return subprocess.run([str(word) for word in words], check=True, capture_output=True,
                              text=True, cwd=self.prefix,
                              env={"PATH": "/usr/bin:/bin", **environment}).stdout

    def test_the_command_and_the_module_find_the_shipped_data(self):
        self.assertIn("hrp2", self.told_by(self.prefix / "bin/halfstep", "list", "robots"))
        told = self.told_by(sys.executable, "-c",
                            "import halfstep as hs; print(hs.__file__, 'bar_8cm' in hs.configs(), "
                            "hs.Experiment('fig3_two_half_steps').smooth().duration < 4)",
                            PYTHONPATH=str(self.packages), PYTHONDONTWRITEBYTECODE="1")
        self.assertEqual(told.split(), [str(self.packages / "halfstep/__init__.py"), "True", "True"])

    def test_every_file_is_recorded_with_its_sum(self):
        record = self.wheel.read(f"{self.name}.dist-info/RECORD").decode()
        rows = list(csv.reader(io.StringIO(record)))
        self.assertEqual({row[0] for row in rows}, set(self.wheel.namelist()))
        for name, digest, size in rows[:-1]:
            content = self.wheel.read(name)
            told = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            self.assertEqual((digest, size), (f"sha256={told}", str(len(content))), name)

    def test_it_says_which_python_it_is_for(self):
        about = self.wheel.read(f"{self.name}.dist-info/WHEEL").decode()
        self.assertIn(f"Tag: cp{sys.version_info.major}{sys.version_info.minor}-", about)
        self.assertIn(f"\nVersion: {backend.version()}\n",
                      self.wheel.read(f"{self.name}.dist-info/METADATA").decode())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
