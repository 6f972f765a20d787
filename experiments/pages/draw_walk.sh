#!/bin/sh
# The moving pictures of the project's README, of halfstep/sqp as it is by default:
#   experiments/pages/draw_walk.sh                    bar_8cm, notebooks-data/over_the_cable.gif
#   experiments/pages/draw_walk.sh CONFIG OUT.gif WIDTH
#                                                     stairs_15cm notebooks-data/up_the_stairs.gif 340
# Needs build/release, chromium, chromium-driver, nodejs, python3-pil.
set -eu
cd "$(dirname "$0")/../.."
config=${1:-bar_8cm}
out=${2:-notebooks-data/over_the_cable.gif}
width=${3:-440}
rate=12.5
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/experiments/halfstep run "experiments/configs/$config.yaml" \
  --set 'smoothing.methods=[halfstep/sqp]' --out "$folder/run" --quiet
mkdir "$folder/pictures"
node experiments/pages/draw_walk.mjs "$folder/run/report.html" "$folder/pictures" $rate \
  halfstep/sqp camera=corner
python3=/usr/bin/python3
$python3 experiments/pages/make_gif.py "$folder/pictures" $rate "$width" "$out"
