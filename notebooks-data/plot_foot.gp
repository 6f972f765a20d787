# Height of the moving sole over the way ahead and along time, raw and smoothed, with the obstacles
# that it steps over.
#   halfstep run experiments/configs/fig5_box.yaml
#   gnuplot -e "run='runs/fig5_box'" notebooks-data/plot_foot.gp
# Variables (-e "a=1; b='x'"), all with defaults:
#   run          run folder
#   method       folder of the smoothed walk in it (default: dichotomy, else another one)
#   out          PNG file written (default: foot.png in the run folder)
#   foot         right or left
#   facts        run_facts.py, which reads the obstacles of the run (python3)
if (!exists("run")) run = "runs/fig5_box"
if (!exists("facts")) facts = "notebooks-data/run_facts.py"
ask = "python3 '" . facts . "' '" . run . "' "
if (!exists("method")) method = system(ask . "method")
if (!exists("out")) out = run . "/foot.png"
if (!exists("foot")) foot = "right"

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
stats raw using (100*column(ahead)) name "X" nooutput
stats raw using (100*column(height)) name "Z" nooutput
side = X_max > X_min ? 0.04*(X_max - X_min) : 5
set xrange [X_min - side:X_max + side]
set yrange [0:1.08*Z_max]
outlines = "< " . ask . "outlines " . foot . " " . method
has_outlines = strlen(system(ask . "outlines " . foot . " " . method)) > 0
set datafile nocolumnheaders
if (!has_outlines) outlines = "< echo 1e9,1e9"
plot outlines using 1:2 with filledcurves closed fillstyle solid 0.6 noborder \
         linecolor rgb "#000000" notitle, \
     raw using (100*column(ahead)):(100*column(height)) with lines linetype 1 title "raw", \
     smooth using (100*column(ahead)):(100*column(height)) with lines linetype 2 title method
set xrange [*:*]
unset offsets
unset key
set xlabel "t  [s]"
plot raw using (column("t_s")):(100*column(height)) with lines linetype 1, \
     smooth using (column("t_s")):(100*column(height)) with lines linetype 2
unset multiplot
