#!/usr/bin/env python3
"""Fails where the command or the Python module holds the path of the source folder, as the messages
of checks would without -ffile-prefix-map.   builder_paths.py BUILD SOURCE"""
import pathlib
import re
import sys


def main():
    build, source = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    binaries = [build / "experiments" / "halfstep", *build.glob("python/halfstep/_halfstep*.so")]
    pattern = re.compile(re.escape(str(source).encode()) + rb"/[ -~]*")
    wrong = 0
    for binary in binaries:
        found = sorted(set(pattern.findall(binary.read_bytes())))
        wrong += len(found)
        for text in found[:10]:
            print(f"{binary}: {text.decode()}")
        if len(found) > 10:
            print(f"{binary}: and {len(found) - 10} more")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
