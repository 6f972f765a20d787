"""09: a sweep, and its plot: how much a demanded clearance costs."""
import os
import tempfile

import halfstep as hs

clearances = [0.002, 0.005, 0.01, 0.015, 0.02]  # [m]
durations = []
for clearance in clearances:
    config = hs.load_config("fig5_box", smoothing__margins__clearance_m=clearance)
    durations.append(hs.Experiment(config).smooth("dichotomy").duration)
    print(f"{1000 * clearance:4.0f} mm  {durations[-1]:.3f} s")

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    print("no plot: matplotlib is not installed")
else:
    pyplot.plot([1000 * c for c in clearances], durations, "o-")
    pyplot.xlabel("demanded clearance [mm]")
    pyplot.ylabel("duration of the walk [s]")
    path = os.path.join(tempfile.gettempdir(), "halfstep_clearance.png")
    pyplot.savefig(path, dpi=120)
    print("plotted:", os.path.basename(path))
