#!/bin/sh
# Builds halfstep, runs the shipped scenarios into runs/, prints one table and draws one figure.
# JOBS: how many compilers at once (2).
set -eu
cd "$(dirname "$0")/.."

echo "Installs the Debian packages that are missing, builds into build/ (about 10 minutes on two"
echo "cores), runs six scenarios into runs/. It asks for nothing."
experiments/install_dependencies.sh

echo "Building (log: build/quickstart.log)"
mkdir -p build
# The preset as it is: tests/run.sh builds the rest in the same tree.
if ! { cmake --preset release &&
       cmake --build --preset release --target halfstep -j "${JOBS:-2}"; } >build/quickstart.log 2>&1
then
  tail -n 40 build/quickstart.log >&2
  exit 1
fi

# Of what each run prints, the table: its header once, its rows under the scenario's name.
header=1
for scenario in fig3_two_half_steps fig4_raw_sequence fig5_box bar_5cm bar_8cm bar_10cm; do
  build/release/experiments/halfstep run "experiments/configs/$scenario.yaml" \
    --out "runs/$scenario" --overwrite >"build/$scenario.txt"
  awk -v scenario="$scenario" -v header="$header" '
    /^method / { table = 1; if (header) printf "\n%-20s %s\n", "scenario", $0; next }
    table && /^$/ { exit }
    table { printf "%-20s %s\n", scenario, $0; scenario = "" }' "build/$scenario.txt"
  header=0
done

build/release/experiments/halfstep plot runs/fig4_raw_sequence runs/fig4_raw_sequence.pdf \
  --what walk,zmp --method raw,dichotomy --overwrite --quiet
printf '\nResults: runs/<scenario>/, in a browser: runs/<scenario>/report.html.\n'
printf 'Figure: runs/fig4_raw_sequence.pdf\n'
