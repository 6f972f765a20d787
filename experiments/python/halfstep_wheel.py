"""Builds the wheel for `pip install .` (a PEP 517 backend): CMake builds and installs into a folder, which
becomes a wheel. It needs the packages of experiments/install_dependencies.sh and nothing from an index.

The wheel holds the module, the command `halfstep` and the shipped data, and links this machine's
libraries, so it is for this distribution alone. --config-settings: build-dir=FOLDER (build/wheel),
cmake-args=-DNAME=VALUE, separated by spaces.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = pathlib.PurePosixPath("lib/python3/dist-packages")  # where experiments/package installs it


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(halfstep VERSION (\S+)", text, re.M).group(1)


def metadata():
    readme = (ROOT / "experiments/python/README.md").read_text(encoding="utf-8")
    return ("Metadata-Version: 2.1\nName: halfstep\nVersion: " + version() + "\n"
            "Summary: Plans and smooths humanoid walks made of half-steps, certified for all times\n"
            "License: BSD-3-Clause\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
            "Description-Content-Type: text/markdown\n\n" + readme)


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def run(*words):
    # Without pip's own path, in which NumPy is not seen.
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    subprocess.run([str(word) for word in words], check=True, env=environment)


def installed(build, stage, arguments):
    """Builds what a user of Python needs, and installs it below `stage`."""
    run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=8", "-DHALFSTEP_TESTING=OFF",
        "-DHALFSTEP_BENCHMARKS=OFF", "-DHALFSTEP_INSTALL=ON", "-DHALFSTEP_WITH_PYTHON=ON",
        f"-DPython_EXECUTABLE={sys.executable}", *arguments)
    run("cmake", "--build", build, "-j", os.environ.get("JOBS", "2"), "--target", "halfstep",
        "halfstep_python")
    for component in ("runtime", "python"):
        run("cmake", "--install", build, "--prefix", stage, "--component", component, "--strip")


def place(path, data):
    """Where a file of the installed prefix goes within the wheel; None: nowhere."""
    path = pathlib.PurePosixPath(path)
    if path.is_relative_to(PACKAGE):
        return str(path.relative_to(PACKAGE))
    if path.parts[0] == "bin":
        return f"{data}/scripts/{path.name}"
    if path.parts[0] == "share":
        return f"{data}/data/{path}"
    return None


def write(wheel, name, content, mode, record):
    info = zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0))
    info.external_attr = (0o100000 | mode) << 16
    info.compress_type = zipfile.ZIP_DEFLATED
    wheel.writestr(info, content)
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    record.append(f"{name},sha256={digest},{len(content)}")


def about():
    """Files of the folder `.dist-info`, but the record."""
    return {"METADATA": metadata(),
            "WHEEL": f"Wheel-Version: 1.0\nGenerator: halfstep\nRoot-Is-Purelib: false\nTag: {tag()}\n"}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"halfstep-{version()}.dist-info"
    folder.mkdir()
    for name, text in about().items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    name = f"halfstep-{version()}"
    file = f"{name}-{tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        stage = pathlib.Path(folder)
        installed(ROOT / settings.get("build-dir", "build/wheel"), stage,
                  settings.get("cmake-args", "").split())
        record = []
        with zipfile.ZipFile(pathlib.Path(wheel_directory) / file, "w") as wheel:
            for path in sorted(stage.rglob("*")):
                goes = place(path.relative_to(stage), f"{name}.data")
                if goes and path.is_file():
                    write(wheel, goes, path.read_bytes(), path.stat().st_mode & 0o777, record)
            for key, text in about().items():
                write(wheel, f"{name}.dist-info/{key}", text.encode(), 0o644, record)
            record.append(f"{name}.dist-info/RECORD,,")
            wheel.writestr(f"{name}.dist-info/RECORD", "\n".join(record) + "\n")
    return file


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("halfstep's source is its repository: pip install a clone of it")
