#!/bin/sh
# One folder of pages that opens without a network: index.html, the READMEs, the C++ reference, the
# Python reference, the examples.   experiments/pages/build.sh [OUT]   (build/pages)
# Needs doxygen, cmark and python3 with Debian's packages. The Python reference is of the module in
# build/release/python, and is left out where that is not built.
set -eu
cd "$(dirname "$0")/../.."
out=${1:-build/pages}
for program in doxygen cmark-gfm; do
  command -v $program >/dev/null || {
    echo "build.sh: needs $program: apt-get install doxygen cmark-gfm" >&2
    exit 1
  }
done
mkdir -p "$(dirname "$out")"
exec /usr/bin/python3 experiments/pages/make_pages.py "$out"
