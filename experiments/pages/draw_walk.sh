#!/bin/sh
# The moving picture of the project's README: bar_8cm by halfstep/sqp over overlaps, heights and
# durations.   experiments/pages/draw_walk.sh [OUT.gif]   (notebooks-data/over_the_cable.gif)
# Needs build/release, chromium, chromium-driver, nodejs, python3-pil.
set -eu
cd "$(dirname "$0")/../.."
out=${1:-notebooks-data/over_the_cable.gif}
rate=12.5
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/experiments/halfstep run experiments/configs/bar_8cm.yaml \
  --set 'smoothing.methods=[halfstep/sqp]' --set smoothing.optimizer.heights=true \
  --set smoothing.optimizer.durations=true --out "$folder/run" --quiet
mkdir "$folder/pictures"
node experiments/pages/draw_walk.mjs "$folder/run/report.html" "$folder/pictures" $rate \
  halfstep/sqp camera=corner
python3=/usr/bin/python3
$python3 experiments/pages/make_gif.py "$folder/pictures" $rate 440 "$out"
