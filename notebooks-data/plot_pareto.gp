# Seconds against centimetres: the safest walks of a range of durations.
# Run: gnuplot -e "run='runs/pareto'; method='halfstep_barrier'" notebooks-data/plot_pareto.gp
# Reads run/method/pareto.csv (by default of the first method that has one), writes pareto.png
# beside it. `facts`: run_facts.py, which finds that method (python3).
if (!exists("run")) run = "runs/pareto"
if (!exists("facts")) facts = "notebooks-data/run_facts.py"
if (!exists("method")) method = system("python3 '" . facts . "' '" . run . "' pareto")
table = run."/".method."/pareto.csv"
set terminal pngcairo size 1000,640 font "DejaVu Sans,15" linewidth 1.6
set output run."/".method."/pareto.png"
set datafile separator ","
set key outside top center horizontal samplen 2
set border 3
set tics nomirror out
set grid ytics lc rgb "#dddddd" dt 1
set xlabel "duration of the walk, at most  [s]"
set ylabel "least margin  [cm]"
set y2label "least slack, proved  [of each margin's scale]"
set y2tics nomirror out
set border 11
set yrange [0:*]
set y2range [0:*]
# A margin beyond the horizon, 30 cm, is not told apart.
seen(x) = x < 0.2999 ? 100 * x : NaN
plot table using "duration_s":(seen(column("zmp_m"))) with linespoints lc rgb "#0072b2" pt 7 title "ZMP inside the polygon", \
     table using "duration_s":(seen(column("self_clearance_m"))) with linespoints lc rgb "#e69f00" pt 5 title "own bodies", \
     table using "duration_s":(seen(column("clearance_m"))) with linespoints lc rgb "#d55e00" pt 9 title "obstacles", \
     table using "duration_s":"least_slack" axes x1y2 with lines lc rgb "#000000" dt 2 title "least slack"
