#!/bin/sh
# Builds the fuzz targets and runs them one after the other; prints a table of executions.
#   tests/fuzz/run.sh --short               20,000 inputs each, at most 2 s: a quick look
#   tests/fuzz/run.sh [SECONDS [TARGET…]]   each, or those named, for so long (600)
# What was found lies in build/fuzz/found, what was learnt in build/fuzz/corpus, and the next run
# goes on from there. Exit status 1 when something was found. JOBS: compilers at once (2).
set -eu
cd "$(dirname "$0")/../.."

runs=-1
seconds=600
if [ "${1:-}" = --short ]; then
  runs=20000
  seconds=2
  shift
elif [ $# -gt 0 ]; then
  seconds=$1
  shift
fi
all="config csv mesh message octomap points robot robot_model run_folder scene scenery swept_volume sweep urdf verify yaml"
[ $# -gt 0 ] || set -- $all

# The fixtures of the tests are inputs as well.
fixtures_of() {
  case $1 in
    config) echo experiments/configs tests/fixtures/config ;;
    mesh) echo tests/fixtures/mesh wpg/robots/hrp2 ;;
    robot | urdf) echo tests/fixtures/robot ;;
    scene) echo experiments/scenes tests/fixtures/scene ;;
    scenery) echo tests/fixtures/scenery ;;
    sweep) echo experiments/sweeps tests/fixtures/sweep ;;
  esac
}
# Longer inputs are cut [bytes].
longest() {
  case $1 in
    robot_model) echo 16384 ;;
    verify) echo 32768 ;;
    run_folder | urdf) echo 8192 ;;
    *) echo 4096 ;;
  esac
}

experiments/install_dependencies.sh clang libclang-rt-14-dev
mkdir -p build
[ -f build/fuzz/build.ninja ] || cmake --preset fuzz >build/fuzz-configure.log 2>&1 ||
  { cat build/fuzz-configure.log >&2; exit 1; }
for target in "$@"; do targets="${targets:-} ${target}_fuzz"; done
cmake --build --preset fuzz -j "${JOBS:-2}" --target $targets >build/fuzz-build.log 2>&1 ||
  { tail -n 100 build/fuzz-build.log >&2; exit 1; }
mkdir -p build/fuzz/found build/fuzz/corpus

status=0
sum=0
printf '| target | executions | a second | found |\n|---|---|---|---|\n'
for target in "$@"; do
  learnt=build/fuzz/corpus/$target log=build/fuzz/$target.log
  mkdir -p "$learnt"
  found=nothing
  build/fuzz/tests/fuzz/${target}_fuzz -max_total_time="$seconds" -runs="$runs" \
    -max_len="$(longest "$target")" -dict="tests/fuzz/$target.dict" -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$target-" \
    "$learnt" $(ls -d "tests/fuzz/corpus/$target" 2>/dev/null) $(fixtures_of "$target") \
    >"$log" 2>&1 || {
    status=1
    found=$(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)
    [ -n "$found" ] || found="it did not run: $log"
  }
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  sum=$((sum + ${executions:-0}))
  echo "| $target | ${executions:-0} | ${rate:-0} | $found |"
done
echo "$sum executions"
exit $status
