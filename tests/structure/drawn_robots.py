#!/usr/bin/env python3
"""Every shipped robot's URDF and bodies are, byte for byte, what its table draws."""

import filecmp
import importlib
import os
import pathlib
import sys
import tempfile

ROBOTS = pathlib.Path(__file__).resolve().parents[2] / "wpg" / "robots"
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROBOTS))


def files(folder, name):
    return {f"{name}.urdf"} | {f"{name}/{file}" for file in os.listdir(folder / name)}


def main():
    from draw_robot import draw
    names = sorted(path.stem for path in ROBOTS.glob("*.yaml"))
    wrong = [] if names else ["no robots"]
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        for name in names:
            draw(importlib.import_module(f"draw_{name}").TABLE, place)
            drawn, shipped = files(place, name), files(ROBOTS, name)
            wrong += sorted(drawn ^ shipped)
            wrong += [file for file in sorted(drawn & shipped)
                      if not filecmp.cmp(place / file, ROBOTS / file, shallow=False)]
    print("\n".join(f"{file}: not as drawn" for file in wrong))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
