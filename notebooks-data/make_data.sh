#!/bin/sh
# Makes the CSV sets of this folder anew:  notebooks-data/make_data.sh [SET]...
# Sets: fig4 fig5 sweep methods drawn_walks certificate planners; all by default. Runs take minutes.
# And typical_forms, only when it is asked for: what is measured is where searches begin.
# HALFSTEP: the command (build/release/experiments/halfstep). The sets `planners` and `certificate`
# also need planner_study and motion_bounds_study, built beside it with -DHALFSTEP_BENCHMARKS=ON.
set -eu
cd "$(dirname "$0")/.."
halfstep="${HALFSTEP:-build/release/experiments/halfstep}"
studies="${STUDIES:-build/release/tests}"
configs=experiments/configs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

run() {  # CONFIG OPTION...: a run folder in $work/run
  config=$1
  shift
  "$halfstep" run "$configs/$config.yaml" --quiet --overwrite --out "$work/run" "$@"
}

# FILE COLUMN...: those columns, numbers to six digits, without the header; `value=text` is a
# column of that text.
pick() {
  file=$1
  shift
  awk -F, -v wanted="$*" '
    BEGIN { n = split(wanted, column, " ") }
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { line = ""
      for (i = 1; i <= n; ++i) {
        cell = column[i] in at ? $(at[column[i]]) : substr(column[i], index(column[i], "=") + 1)
        if (cell ~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/) cell = sprintf("%.6g", cell)
        line = line (i > 1 ? "," : "") cell
      }
      print line }' "$file"
}

header() {  # COLUMN...
  echo "$*" | tr ' ' ','
}

keep() {  # SET/FILE: $work/table, which is whole by now
  mkdir -p "notebooks-data/$(dirname "$1")"
  mv "$work/table" "notebooks-data/$1"
  echo "notebooks-data/$1: $(($(wc -l <"notebooks-data/$1") - 1)) rows"
}

make_fig4() {  # The curved walk, raw and smoothed.
  run fig4_raw_sequence --set 'smoothing.methods=[dichotomy]' --set output.period_s=0.02
  { header footstep foot x_m y_m yaw_rad
    pick "$work/run/footsteps.csv" footstep foot x_m y_m yaw_rad; } >"$work/table"
  keep fig4/footsteps.csv
  { header method t_s support com_x_m com_y_m zmp_x_m zmp_y_m
    for method in raw dichotomy; do
      pick "$work/run/$method/trajectory.csv" "method=$method" t_s support com_x_m com_y_m zmp_x_m zmp_y_m
    done; } >"$work/table"
  keep fig4/walks.csv
}

make_fig5() {  # The foot over the box; and how low it gets at any overlap, without the box.
  run fig5_box --set 'smoothing.methods=[dichotomy]' --set output.period_s=0.01
  { header method t_s right_foot_x_m right_foot_z_m clearance_m
    for method in raw dichotomy; do
      pick "$work/run/$method/trajectory.csv" "method=$method" t_s right_foot_x_m right_foot_z_m clearance_m
    done; } >"$work/table"
  keep fig5/foot.csv
  { header overlap_s apex_m
    for cap in 0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1; do
      run fig3_two_half_steps --set 'smoothing.methods=[dichotomy]' \
        --set smoothing.margins.floor_m=0 --set "smoothing.dichotomy.up_down_cap=$cap"
      pick "$work/run/dichotomy/overlaps.csv" overlap_s | tr '\n' ,
      pick "$work/run/dichotomy/trajectory.csv" right_foot_z_m | sort -g | tail -n 1
    done; } >"$work/table"
  keep fig5/apex.csv
}

make_sweep() {  # 200 cases of the box, by overlaps alone and with durations.
  columns="method status certified duration_s speedup wall_s"
  { header smoothing.limits.foot_speed_m_s smoothing.margins.clearance_m $columns
    for speed in $(seq 0.9 0.025 1.375); do
      for clearance in $(seq 0 0.0007 0.0063); do
        run fig5_box --set "smoothing.limits.foot_speed_m_s=$speed" \
          --set "smoothing.margins.clearance_m=$clearance" --set output.period_s=0.1 \
          --set 'smoothing.methods=[dichotomy, halfstep/barrier]' \
          --set smoothing.optimizer.durations=true --set smoothing.optimizer.least_duration=0.2 \
          --set smoothing.optimizer.effort=2 2>"$work/said" || {
            grep -qE 'plan is not feasible|: (not_run|invalid_input|failed): ' "$work/said" || { cat "$work/said" >&2; exit 1; }; }
        pick "$work/run/summary.csv" "v=$speed" "c=$clearance" $columns
      done
    done; } >"$work/table"
  keep sweep/runs.csv
}

make_methods() {  # Eight methods on six scenarios, over overlaps, heights and durations.
  runs=""
  for scenario in fig3_two_half_steps fig4_raw_sequence fig5_box bar_5cm bar_8cm bar_10cm; do
    "$halfstep" run "$configs/$scenario.yaml" --quiet --out "$work/$scenario" --set output.period_s=0.1 \
      --set 'smoothing.methods=[dichotomy, dichotomy/published, dichotomy/uniform, ipopt, nlopt/ccsaq,
             nlopt/slsqp, halfstep/barrier, halfstep/sqp]' \
      --set smoothing.optimizer.heights=true --set smoothing.optimizer.durations=true \
      --set smoothing.optimizer.effort=5 || [ $? -eq 1 ]  # 1: a method failed
    runs="$runs $work/$scenario"
  done
  "$halfstep" compare $runs --quiet --out "$work/comparison"
  columns="scenario objective half_steps method variables status certified duration_s gap_to_best wall_s"
  { header $columns; pick "$work/comparison/comparison.csv" $columns; } >"$work/table"
  keep methods/comparison.csv
  columns="gap work method variables objective ratio fraction"
  { header $columns; pick "$work/comparison/performance_profile.csv" $columns; } >"$work/table"
  keep methods/performance_profile.csv
  columns="scenario objective method variables wall_s effort duration_s gap_to_best"
  { header $columns; pick "$work/comparison/anytime.csv" $columns; } >"$work/table"
  keep methods/anytime.csv
}

make_certificate() {  # What a proof rests on along one walk; bounds against the truth.
  run bar_8cm --set 'smoothing.methods=[dichotomy]' --set output.period_s=0.1
  columns="begin_s end_s family margin bound demanded"
  { header $columns
    pick "$work/run/dichotomy/certificate.csv" $columns | grep -v ',inf,'; } >"$work/table"
  keep certificate/bar_8cm.csv
  "$studies/motion_bounds_study" 1000 >"$work/bounds"
  { header robot interval_ms at quantity number q05 q25 q50 q75 q95 largest
    awk '
      / intervals bounded$/ { split($0, part, ", "); robot = part[1]; ms = part[2] + 0
        at = part[3]; sub(/:.*/, "", at) }
      /^bound . true sup/ || NF == 0 || / intervals bounded$/ { table = /true sup/ ? 1 : 0; next }
      table { name = $1; for (i = 2; i <= NF - 7; ++i) name = name " " $i
        gsub(/,/, "", name)
        printf "%s,%g,%s,%s", robot, ms, at, name
        for (i = NF - 6; i <= NF; ++i) printf ",%s", $i
        print "" }' "$work/bounds"; } >"$work/table"
  keep certificate/tightness.csv
}

make_typical_forms() {  # What steps of fast walks look like, by class.
  "$halfstep" draw walks --count 60 --seed 1 --out "$work/walks"
  runs=""
  for walk in "$work"/walks/walk_??.yaml "$configs"/bar_5cm.yaml "$configs"/bar_8cm.yaml \
      "$configs"/bar_10cm.yaml "$configs"/island.yaml "$configs"/cylinders.yaml \
      "$configs"/clutter.yaml "$configs"/crossing.yaml "$configs"/fence.yaml \
      "$configs"/fig4_raw_sequence.yaml; do
    name=$(basename "$walk" .yaml)
    "$halfstep" run "$walk" --quiet --out "$work/forms/$name" \
      --set 'smoothing.methods=[halfstep/sqp]' --set output.period_s=0.1
    runs="$runs $work/forms/$name"
  done
  python3 notebooks-data/typical_forms.py $runs >"$work/table"
  keep drawn_walks/typical_forms.csv
}

make_drawn_walks() {  # Sixty drawn walks. The bound is D/(1 + gap_lipm) of any method's walk.
  "$halfstep" draw walks --count 60 --seed 1 --out "$work/walks"
  "$halfstep" sweep "$work/walks/walks.yaml" --quiet --out "$work/walks_sweep"
  sed 's/"[^"]*"/quoted/g' "$work/walks_sweep/runs.csv" >"$work/runs"  # they hold commas
  for walk in "$work"/walks/walk_??.yaml; do  # over every family
    "$halfstep" run "$walk" --quiet --overwrite --out "$work/run" \
      --set 'smoothing.methods=[halfstep/sqp]' --set smoothing.threads=1
    pick "$work/run/summary.csv" "config=$(basename "$walk")" method duration_s gap= |
      sed -n 's|halfstep/sqp|every|p'
  done >"$work/every"
  { header walk raw_s dichotomy_s uniform_s sqp_s every_s bound_s
    { cat "$work/every"; pick "$work/runs" config method duration_s gap_lipm; } | awk -F, '
      { sub(/walk_0*/, "", $1); sub(/\.yaml/, "", $1); s[$1, $2] = $3; bound[$1] = $4 ? $3 / (1 + $4) : bound[$1] }
      $2 == "halfstep/sqp" { walk[++n] = $1 }
      END { for (i = 1; i <= n; ++i) { w = walk[i]
        printf "%s,%s,%s,%s,%s,%s,%.6g\n", w, s[w, "raw"], s[w, "dichotomy"],
               s[w, "dichotomy/uniform"], s[w, "halfstep/sqp"], s[w, "every"], bound[w] } }'; } >"$work/table"
  keep drawn_walks/durations.csv
}

make_planners() {  # Twenty problems of each kind, four planners.
  "$studies/planner_study" 20 island clutter fence cylinders random_room >"$work/plans"
  { header scenario planner solved runs median_ms p95_ms footsteps nodes queries
    awk 'NR > 1 { split($3, solved, "/")
      print $1 "," $2 "," solved[1] "," solved[2] "," $5 "," $6 "," $7 "," $8 "," $9 }' "$work/plans"
  } >"$work/table"
  keep planners/plans.csv
}

for set in ${*:-fig4 fig5 sweep methods drawn_walks certificate planners}; do
  case $set in
    fig4 | fig5 | sweep | methods | typical_forms | drawn_walks | certificate | planners)
      "make_$set" ;;
    *) echo "$0: no set $set" >&2; exit 2 ;;
  esac
done
