#!/bin/sh
# Builds and tests everything but the benchmarks.
#   tests/run.sh           release, without a few slow tests and with a tenth of what others draw;
#                          what .ci/run does
#   tests/run.sh --all     all of release, and debug with AddressSanitizer and UBSan, which leaves out a few slow
#                          tests, a look for types that have two definitions (-flto -Wodr), and a
#                          quick look by every fuzz target: before a change lands
# JOBS: how many compilers at once (2), and one test more at once, since some wait for a clock.
set -eu
cd "$(dirname "$0")/.."
jobs="${JOBS:-2}"
case "${1:-}" in
  "") presets=release ;;
  --all) presets="release debug" ;;
  *)
    echo "tests/run.sh: $1: unknown (valid: nothing, --all)" >&2
    exit 2
    ;;
esac

experiments/install_dependencies.sh
# For the tests of notebooks, replay and other locales, with --all of the report and the lemmas:
# without them they are skipped.
of_all="chromium chromium-driver coq"
[ "$presets" != release ] || of_all=
experiments/install_dependencies.sh $of_all doxygen libmujoco-dev python3-nbconvert \
  python3-ipykernel python3-pandas python3-matplotlib locales ||
  echo "Report, lemmas, notebooks, replay or locales will not be tested" >&2
mkdir -p build

# Runs a command; its output goes to a log, and to the screen only when it fails.
quietly() {
  log=$1
  shift
  if ! "$@" >"$log" 2>&1; then
    echo "Failed: $*" >&2
    tail -n "${LINES_SHOWN:-200}" "$log" >&2
    exit 1
  fi
}

# A run syncs its files seventy times, for which tests would wait longer than for all that it
# computes: they write to memory where there is enough of it and programs may be run from there.
in_memory=$(mktemp -d /dev/shm/halfstep_tests_XXXXXX 2>/dev/null || true)
if [ -n "$in_memory" ]; then
  trap 'rm -rf "$in_memory"' EXIT
  trap 'exit 130' INT TERM
  cp /bin/true "$in_memory/true"
  if [ "$(df -k "$in_memory" | awk 'END {print $4}')" -gt 4000000 ] && "$in_memory/true"; then
    export TMPDIR="$in_memory"
  fi
fi

# Tests that run the whole command many times, or many walks: with sanitizers they take minutes.
release_only='InterruptedRun|StoppedRun|KilledRun|CsvSchema|SweepCommand|CsvPhysics.Hrp2'
release_only="$release_only|OutsideOfACheckedWindow|ThePriceIsWhat|InterruptedCertification"
release_only="$release_only|EveryPointOfAPareto|SafestWithinLess|AcceptsEveryMethodOfAWalk"
release_only="$release_only|StoppedCommand|FaultyCommand|LiveCommand|ServedEpisode"
release_only="$release_only|FormsScenario.MoreFamilies|SlabsToTriangles|HostileFiles|HardenedBinary|PidNamespaces"
release_only="$release_only|CertificateRows.HoldInside|Ground.AShin|FarVerticesOfAMeshNeither"
release_only="$release_only|FewOfAllForgeries|OracleTest.NoAnswer"
release_only="$release_only|Verify/Checks|Verify/Tampered|Verify/Periods|Verify/Forged"
release_only="$release_only|StoppedScene|StoppedBar|StopBranches.AreChecked|Verify.ToleranceIs|Verify.MethodWithout"
release_only="$release_only|Horizon.WhatIsRefused|Horizon.ProvesStop|FindWhatOneFinds/barrier"
release_only="$release_only|OneCharacter|GeneratedRobotPhysics|FindsKnownOptima/nlopt_auglag"
release_only="$release_only|walks.stand|EveryValue|ATouchIsToldByEverything"

# What .ci/run has no time for: on two cores a build from nothing takes about 17 minutes.
all_only='^$'
if [ "$presets" = release ]; then
  export HALFSTEP_FEW_DRAWS=1
  # Of the three bars, which differ in height, 8 cm stays, and of walks over levels one.
  all_only='walks.stand/(bar_10cm|bar_5cm|bison|clutter|crossing|cylinders|fence|fig4|fig5|island|plan_|platform|random_room|stones|wren)'
  all_only="$all_only|walks.stand/stairs_(10cm_down|15cm)"
  all_only="$all_only|(ReportPage|SweepPage|LivePage).InABrowser"
  all_only="$all_only|^lemmas.hold$|^EveryValue$|^VerifyStudy$|examples.in_cpp"
fi

for preset in $presets; do
  start=$(date +%s)
  quietly "build/$preset-configure.log" cmake --preset "$preset" -DHALFSTEP_BENCHMARKS=OFF \
    -DHALFSTEP_TESTING=ON
  quietly "build/$preset-build.log" cmake --build --preset "$preset" -j "$jobs"
  built=$(date +%s)
  except="$all_only"
  [ "$preset" = release ] || except="$release_only"
  quietly "build/$preset-test.log" ctest --preset "$preset" -j $((jobs + 1)) -E "$except" -LE slurm
  echo "$preset: $(grep 'tests passed' "build/$preset-test.log"); built in $((built - start)) s," \
    "tested in $(($(date +%s) - built)) s"
  # Tests that this machine cannot do: whole ones, and those within a suite.
  grep -A 1000 "did not run" "build/$preset-test.log" || true
  grep -h "^\[  SKIPPED \] [A-Z][^ ]*$" "build/$preset/Testing/Temporary/LastTest.log" | sort -u || true
done

if [ "${1:-}" = --all ]; then
  start=$(date +%s)
  quietly build/odr-configure.log cmake --preset odr
  quietly build/odr-build.log cmake --build --preset odr -j "$jobs"
  echo "one definition of each type in the whole program, in $(($(date +%s) - start)) s"
  start=$(date +%s)
  quietly build/fuzz-test.log tests/fuzz/run.sh --short
  echo "fuzz targets: $(tail -n 1 build/fuzz-test.log), nothing found, in $(($(date +%s) - start)) s"
fi
