#!/bin/sh
# Runs every figure and claim of the source paper and rewrites the table of
# notebooks-data/reproduction.md. Builds what is needed (log: build/reproduce.log). Exit status 1: a
# claim does not hold. JOBS: how many compilers at once (2). Minutes; Ctrl-C leaves the table as it
# was.
set -eu
cd "$(dirname "$0")/../.."

experiments/install_dependencies.sh python3
echo "Building (log: build/reproduce.log)" >&2
mkdir -p build
build() {
  cmake --build --preset release -j "${JOBS:-2}" --target "$@" >>build/reproduce.log 2>&1
}
if ! { cmake --preset release -DHALFSTEP_BENCHMARKS=ON >build/reproduce.log 2>&1 && build halfstep; }
then
  tail -n 40 build/reproduce.log >&2
  exit 1
fi
build planner_study soundness_study swept_volume_benchmark ||
  echo "The studies cannot be built; their rows stay open" >&2
exec python3 experiments/paper/reproduce.py
