# Lateral CoM and ZMP of a run, raw above smoothed, over the same stretch of time.
#   gnuplot -e "run='runs/fig4_raw_sequence'" notebooks-data/plot_walk.gp
# Variables (-e "a=1; b='x'"), all with defaults:
#   run          run folder
#   method       folder of the smoothed walk in it (default: dichotomy, else another one)
#   out          PNG file written (default: walk.png in the run folder)
#   span         length of the time axis [s] (default: the smoothed walk's duration)
#   sole_length, sole_width   of the soles [m] (default: those of the run's robot)
#   facts        run_facts.py, which reads what is left to it (python3)
if (!exists("run")) run = "runs/fig4_raw_sequence"
if (!exists("facts")) facts = "notebooks-data/run_facts.py"
ask = "python3 '" . facts . "' '" . run . "' "
if (!exists("method")) method = system(ask . "method")
if (!exists("out")) out = run . "/walk.png"
if (!exists("sole_length")) sole_length = real(word(system(ask . "sole"), 1))
if (!exists("sole_width")) sole_width = real(word(system(ask . "sole"), 2))

raw = run . "/raw/trajectory.csv"
smooth = run . "/" . method . "/trajectory.csv"
set datafile separator comma
set datafile columnheaders

stats raw using (column("t_s")) name "R" nooutput
stats smooth using (column("t_s")) name "S" nooutput
if (!exists("span")) span = S_max

# Half the extent of a sole along the world's y axis [m].
half(yaw) = 0.5 * (sole_length * abs(sin(yaw)) + sole_width * abs(cos(yaw)))
# y of the sole's edge on a side (-1, +1) while the foot is on the floor, else undefined [m].
edge(foot, other, side) = strcol("support") eq other ? NaN \
    : column(foot . "_foot_y_m") + side * half(column(foot . "_foot_yaw_rad"))

# One scale for both panels: that of the soles, which the ZMP does not leave.
low(t) = t > span ? NaN : edge("right", "", -1) < edge("left", "", -1) ? edge("right", "", -1) \
    : edge("left", "", -1)
high(t) = t > span ? NaN : edge("left", "", 1) > edge("right", "", 1) ? edge("left", "", 1) \
    : edge("right", "", 1)
stats smooth using (low(column("t_s"))) name "L" nooutput
stats smooth using (high(column("t_s"))) name "H" nooutput
stats raw using (low(column("t_s"))) name "RL" nooutput
stats raw using (high(column("t_s"))) name "RH" nooutput
bottom = (L_min < RL_min ? L_min : RL_min) - 0.02
top = (H_max > RH_max ? H_max : RH_max) + 0.02

set terminal pngcairo size 1440,1000 font "sans,19" linewidth 1.6 background "white"
set output out

# Colours that colour-blind readers can tell apart (after Okabe and Ito); the lines differ in dash.
set style fill transparent solid 0.25 noborder
set linetype 1 linecolor rgb "#0072b2"                                # left sole
set linetype 2 linecolor rgb "#e69f00"                                # right sole
set linetype 3 linecolor rgb "#000000" linewidth 1.8                  # CoM
set linetype 4 linecolor rgb "#d55e00" linewidth 1.4 dashtype (8, 4)  # ZMP

set xrange [0:span]
set yrange [bottom:top]
set xtics scale 0.5 nomirror out
set ytics 0.2 scale 0.5 nomirror out
set mytics 2
set grid ytics linecolor rgb "#dddddd" linewidth 0.6
set border 3
set ylabel "y, to the left  [m]" offset 1.2,0

set multiplot layout 2,1 margins 0.085,0.98,0.085,0.885 spacing 0.11

do for [panel = 0:1] {
  file = panel == 0 ? raw : smooth
  if (panel == 0) {
    set title sprintf("raw, Δ = 0: %.1f of %.1f s", span < R_max ? span : R_max, R_max) \
        offset 0,-0.7 noenhanced
    set key at screen 0.54,0.985 center top horizontal nobox samplen 2.5 width 2 maxrows 1 Left reverse
    unset xlabel
  } else {
    set title sprintf("smoothed, %s: %.1f s", method, S_max) offset 0,-0.7 noenhanced
    unset key
    set xlabel "t  [s]" offset 0,0.4
  }
  plot file every 4 using (column("t_s")):(edge("left", "right", -1)):(edge("left", "right", 1)) \
         with filledcurves linetype 1 title "left sole on the floor", \
       file every 4 using (column("t_s")):(edge("right", "left", -1)):(edge("right", "left", 1)) \
         with filledcurves linetype 2 title "right sole on the floor", \
       file every 2 using (column("t_s")):(column("com_y_m")) with lines linetype 3 title "CoM", \
       file every 2 using (column("t_s")):(column("zmp_y_m")) with lines linetype 4 title "ZMP"
}
unset multiplot
