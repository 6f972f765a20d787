# Places of the swing foot of a half-step set beside the left support foot, with the yaws of each.
#   halfstep list half-steps experiments/configs/island.yaml > half_steps.csv
#   gnuplot -e "set='half_steps.csv'" notebooks-data/plot_half_steps.gp
# Variables (-e "a=1; b='x'"), all with defaults:
#   set          table of `halfstep list half-steps`
#   out          PNG file written
#   sole_length, sole_width   of the soles [m] (default: HRP-2's)
if (!exists("set")) set = "half_steps.csv"
if (!exists("out")) out = "half_steps.png"
if (!exists("sole_length")) sole_length = 0.2172
if (!exists("sole_width")) sole_width = 0.137

set datafile separator comma
set datafile columnheaders
stats set using (column("x_m")) name "X" nooutput

tick = 0.036  # length of a yaw tick [m]
# Ahead (x) is up and the left (y) is left, as one looks down on the robot.
across(y) = -y

set terminal pngcairo size 1150,1300 font "sans,19" linewidth 1.6 background "white"
set output out
set size ratio -1
set xrange [-0.12:0.42]
set yrange [-0.35:0.37]
set xtics 0.1 scale 0.5 nomirror out
set ytics 0.1 scale 0.5 nomirror out
set grid linecolor rgb "#e4e4e4" linewidth 0.6
set border 3
set xlabel "to the right, −y_S  [m]" offset 0,0.3
set ylabel "ahead, x_S  [m]" offset 1,0
set title sprintf("%.0f places of the right sole's centre; a tick points where its toes do", X_records) \
    offset 0,1.6
set key at graph 0.5,1.045 center horizontal samplen 1.6 width 1 maxrows 1
set tmargin 5

# The support sole.
set object 1 rectangle center 0,0 size sole_width,sole_length \
    fillstyle solid 0.25 noborder fillcolor rgb "#0072b2"
set arrow 1 from 0,0 to 0,0.6*sole_length filled size 0.012,20 linecolor rgb "#0072b2"
set label 1 "left sole,\nsupports" at 0,-0.5*sole_length-0.022 center textcolor rgb "#0072b2"

# Colours that colour-blind readers can tell apart (after Okabe and Ito); the direction tells too.
array yaws[5] = [0.5, 0.25, 0.0, -0.25, -0.5]
array colours[5] = ["#d55e00", "#e69f00", "#000000", "#56b4e9", "#0072b2"]
plot for [k = 1:5] set \
       using (across(column("y_m"))):(abs(column("yaw_rad") - yaws[k]) < 1e-6 ? column("x_m") : NaN)\
:(-tick * sin(column("yaw_rad"))):(tick * cos(column("yaw_rad"))) \
       with vectors nohead linewidth 2 linecolor rgb colours[k] \
       title yaws[k] == 0 ? "0 rad" : sprintf("%+.2f", yaws[k]), \
     set using (across(column("y_m"))):(column("x_m")) with points pointtype 7 pointsize 0.7 \
       linecolor rgb "#000000" notitle
