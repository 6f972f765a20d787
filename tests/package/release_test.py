#!/usr/bin/env python3
"""Fails when a file tells another version than CMake's, or the conda recipe lacks its form.

release_test.py. What needs PyYAML is left out where it is missing.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# File, and where its version stands.
VERSIONS = [("CITATION.cff", r"^version: (\S+)$"),
            ("README.md", r"^  version = \{(\S+)\},$"),
            ("CHANGELOG.md", r"^## (\d\S+) – "),
            ("experiments/package/conda/recipe.yaml", r"^  version: (\d\S+)$"),
            ("experiments/about/build_info.h", r'kVersion;\s+///< "(\S+)"')]
# The same without the last number.
SERIES = [("experiments/examples/CMakeLists.txt", r"find_package\(halfstep (\S+) CONFIG"),
          ("experiments/pages/cpp.md", r"find_package\(halfstep (\S+) CONFIG"),
          ("experiments/package/README.md", r"find_package\(halfstep (\S+)\)")]


def first(text, pattern):
    found = re.search(pattern, text, re.MULTILINE)
    return found[1] if found else None


def wrong_versions(read):
    """A line for each file that tells another version; `read` gives a file's text."""
    version = first(read("CMakeLists.txt"), r"^project\(halfstep VERSION (\S+)")
    wanted = [(*place, version) for place in VERSIONS]
    wanted += [(*place, version.rpartition(".")[0]) for place in SERIES]
    told = [f"{name}: {first(read(name), pattern)} in place of {value}"
            for name, pattern, value in wanted if first(read(name), pattern) != value]
    released = first(read("CHANGELOG.md"), r"^## \d\S+ – (\S+)$")
    if first(read("CITATION.cff"), r"^date-released: (\S+)$") != released:
        told.append(f"CITATION.cff: date-released is not the changelog's {released}")
    return told


def wrong_form(text):
    """What a recipe lacks: fields, or dependencies that CMake requires."""
    import yaml  # pylint: disable=import-outside-toplevel
    recipe = yaml.safe_load(text)
    fields = ["schema_version", "context.version", "package.name", "package.version", "source.path",
              "build.number", "build.script", "requirements.build", "requirements.host", "tests",
              "about.summary", "about.license", "about.license_file"]
    told = []
    for field in fields:
        at = recipe
        for part in field.split("."):
            at = at.get(part) if isinstance(at, dict) else None
        if at in (None, "", []):
            told.append(f"recipe.yaml: no {field}")
    host = " ".join(recipe.get("requirements", {}).get("host", []))
    told += [f"recipe.yaml: {name} is not among host requirements"
             for name in ("eigen", "fcl", "octomap", "urdfdom", "tinyxml", "libpng", "yaml-cpp", "qhull",
                          "sleef", "cli11", "nlohmann_json", "boost", "openssl") if name not in host]
    if not (ROOT / str(recipe.get("about", {}).get("license_file"))).is_file():
        told.append("recipe.yaml: its license_file is not there")
    return told


def main():
    def read(name):
        return (ROOT / name).read_text(encoding="utf-8")

    told = wrong_versions(read)
    # It can fail: each file with another version is told.
    for name, _ in VERSIONS + SERIES:
        other = wrong_versions(lambda file, name=name: (
            re.sub(r"\b0\.\d+(\.\d+)?\b", "9.9.9", read(file)) if file == name else read(file)))
        if not any(line.startswith(name) for line in other):
            told.append(f"{name}: another version was not told")
    recipe = read("experiments/package/conda/recipe.yaml")
    try:
        told += wrong_form(recipe)
        if not wrong_form(recipe.replace("license_file: LICENSE", "license_file: NONE")):
            told.append("recipe.yaml: a missing file was not told")
    except ImportError:
        print("no PyYAML: the recipe's form is left out")
    print("\n".join(told) or f"{len(VERSIONS) + len(SERIES)} files tell the same version")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main())
