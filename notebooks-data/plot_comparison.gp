# Performance profiles and anytime curves of a comparison.
#   halfstep compare RUN... --out runs/comparison
#   gnuplot -e "comparison='runs/comparison'" notebooks-data/plot_comparison.gp
# Variables (-e "a='x'; b='y'"), all with defaults:
#   comparison   folder that `halfstep compare --out` wrote
#   scenario     of the anytime curves (default: the first of comparison.csv)
#   work         of the profiles: effort (reproducible) or wall_s
#   out          PNG file written (default: comparison.png in that folder)
if (!exists("comparison")) comparison = "runs/comparison"
if (!exists("work")) work = "effort"
if (!exists("out")) out = comparison . "/comparison.png"
profile = comparison . "/performance_profile.csv"
anytime = comparison . "/anytime.csv"

# METHOD,VARIABLES of each curve of the objective `fastest`: words without blanks, as the program makes sure.
curves = system("tail -n +2 '" . comparison . "/means.csv' | grep ',fastest,' | cut -d, -f1,2 | tr '\n' ' '")
comma(c) = strstrt(c, ",")
method(c) = c[1:comma(c) - 1]
variables(c) = c[comma(c) + 1:*]
# "+heights+durations" as the symbols of the text: η, T.
marks(v) = (strstrt(v, "overlaps") ? " Δ" : "") . (strstrt(v, "heights") ? " η" : "") \
    . (strstrt(v, "durations") ? " T" : "")
label(c) = method(c) . marks(variables(c))

set datafile separator comma
set datafile columnheaders
set datafile missing NaN
if (!exists("scenario")) {
  scenario = system("sed -n 2p '" . comparison . "/comparison.csv' | cut -d, -f1")
}

mine(c) = strcol("method") eq method(c) && strcol("variables") eq variables(c)
ratio(c, gap) = mine(c) && strcol("objective") eq "fastest" && strcol("gap") eq gap && strcol("work") eq work ? column("ratio") : NaN
here(c) = mine(c) && strcol("scenario") eq scenario && strcol("objective") eq "fastest"
spent(c, what, least) = here(c) ? (column(what) > least ? column(what) : least) : NaN

rows = ceil(words(curves) / 3.0)
set terminal pngcairo size 1440,900 + 30 * rows font "sans,17" linewidth 1.6 background "white"
set output out
top = 1.0 - 0.032 * rows - 0.07

# Colours that colour-blind readers can tell apart (after Okabe and Ito); the lines differ in dash.
array colour[7] = ["#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
array dash[4] = ["1", "(8,4)", "(2,3)", "(10,3,2,3)"]
do for [i = 1:28] {
  # Thinner and thinner: where curves coincide, the ones below show.
  eval sprintf("set linetype %d linecolor rgb '%s' linewidth %g dashtype %s", i, \
      colour[(i - 1) % 7 + 1], i < 7 ? 4.6 - 0.5 * i : 1.6, dash[(i - 1) % 4 + 1])
}
set multiplot
# A panel without axes holds the key of all others.
set lmargin at screen 0.03
set rmargin at screen 0.99
set tmargin at screen 0.995
set bmargin at screen 0.9
set key at screen 0.52,0.995 center top horizontal nobox samplen 4 width 3 maxrows rows Left \
    reverse noenhanced
unset border
unset tics
set xrange [0.1:1]
set yrange [0:1]
plot for [i = 1:words(curves)] NaN with lines linetype i title label(word(curves, i))
unset key

set border 3
set grid ytics linecolor rgb "#dddddd" linewidth 0.6
set xtics scale 0.5 nomirror out
set ytics scale 0.5 nomirror out
set format x "%g"
set logscale x
middle = 0.5 * top + 0.03
set yrange [0:1.04]
set ytics 0.25
set xtics (1, 1.5, 2, 3, 5, 10, 20, 50, 100, 200, 500, 1000, 1e4, 1e5, 1e6)
gaps = "0.05 0.01 inf"
titles = "'within 5 % of the best' 'within 1 % of the best' 'ended, certified'"
set tmargin at screen top
set bmargin at screen middle + 0.085
set xlabel work eq "wall_s" ? "wall time / least wall time of any method" \
    : "effort / least effort of any method" offset 0,0.5
do for [panel = 1:3] {
  gap = word(gaps, panel)
  set lmargin at screen 0.075 + (panel - 1) * 0.315
  set rmargin at screen 0.075 + (panel - 1) * 0.315 + 0.265
  set title word(titles, panel) offset 0,-0.6
  if (panel == 1) { set ylabel "fraction of scenarios solved" offset 1.2,0 } else { unset ylabel }
  set xrange [*:*]
  set yrange [*:*]
  stats profile using (strcol("gap") eq gap && strcol("work") eq work ? column("ratio") : NaN) \
      name "R" nooutput
  set xrange [1:(R_max > 1.5 ? R_max : 1.5)]
  set yrange [0:1.04]
  plot for [i = 1:words(curves)] profile using (ratio(word(curves, i), gap)):(column("fraction")) \
      with steps linetype i notitle
}

set tmargin at screen middle - 0.06
set bmargin at screen 0.09
set yrange [*:*]
set ytics autofreq
set xtics autofreq
set title sprintf("%s: best walk so far", scenario) offset 0,-0.6 noenhanced
do for [panel = 1:2] {
  what = panel == 1 ? "wall_s" : "effort"
  least = 0.01
  set lmargin at screen 0.075 + (panel - 1) * 0.475
  set rmargin at screen 0.075 + (panel - 1) * 0.475 + 0.42
  set xrange [least:*]
  set xlabel panel == 1 ? "wall time  [s]" : "effort" offset 0,0.5
  if (panel == 1) { set ylabel "duration of the walk  [s]" offset 0.6,0 } else { unset ylabel }
  plot for [i = 1:words(curves)] anytime using (spent(word(curves, i), what, least)): \
      (column("duration_s")) with steps linetype i notitle
}
unset multiplot
