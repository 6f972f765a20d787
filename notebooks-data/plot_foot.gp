# Height of the moving sole over the way ahead and along time, raw and smoothed, with the obstacle
# that it steps over.
#   halfstep run experiments/configs/fig5_box.yaml
#   gnuplot -e "run='runs/fig5_box'" notebooks-data/plot_foot.gp
# Variables (-e "a=1; b='x'"), all with defaults:
#   run          run folder
#   method       folder of the smoothed walk in it
#   out          PNG file written (default: foot.png in the run folder)
#   foot         right or left
#   box_x, box_length, box_height   obstacle across the way [m] (default: that of scenes/box.yaml)
if (!exists("run")) run = "runs/fig5_box"
if (!exists("method")) method = "dichotomy"
if (!exists("out")) out = run . "/foot.png"
if (!exists("foot")) foot = "right"
if (!exists("box_x")) box_x = 0.137
if (!exists("box_length")) box_length = 0.018
if (!exists("box_height")) box_height = 0.08

raw = run . "/raw/trajectory.csv"
smooth = run . "/" . method . "/trajectory.csv"
set datafile separator comma
set datafile columnheaders

set terminal pngcairo size 1440,640 font "sans,17" linewidth 1.8 background "white"
set output out
# Colours that colour-blind readers can tell apart (after Okabe and Ito); the lines differ in dash.
set linetype 1 linecolor rgb "#0072b2"                                # raw
set linetype 2 linecolor rgb "#d55e00" linewidth 1.4 dashtype (8, 4)  # smoothed
set border 3
set xtics scale 0.5 nomirror out
set ytics scale 0.5 nomirror out
set grid ytics linecolor rgb "#dddddd" linewidth 0.6
set ylabel "height of the sole  [cm]" offset 1,0
set yrange [0:*]

ahead = foot . "_foot_x_m"
height = foot . "_foot_z_m"
set multiplot layout 1,2 margins 0.06,0.985,0.13,0.87 spacing 0.075
set key at screen 0.52,0.985 center top horizontal nobox samplen 3 width 2 maxrows 1 Left reverse
set offsets graph 0.04, graph 0.04, 0, 0
set xlabel "x of the sole's centre  [cm]" offset 0,0.3
set object 1 rectangle from 100*(box_x - box_length/2),0 to 100*(box_x + box_length/2),100*box_height \
    fillstyle solid 0.6 noborder fillcolor rgb "#000000"
plot raw using (100*column(ahead)):(100*column(height)) with lines linetype 1 title "raw", \
     smooth using (100*column(ahead)):(100*column(height)) with lines linetype 2 title method
unset object 1
unset offsets
unset key
set xlabel "t  [s]"
plot raw using (column("t_s")):(100*column(height)) with lines linetype 1, \
     smooth using (column("t_s")):(100*column(height)) with lines linetype 2
unset multiplot
