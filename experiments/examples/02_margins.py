"""02: margins: how far a walk is inside of each limit, and which way leads further in."""
import numpy as np

import halfstep as hs

experiment = hs.Experiment("fig5_box")  # a box lies in the way
walk = experiment.walk(overlaps=[0.6])
margins = walk.margins(period=0.01)
for name in list(margins)[1:]:
    least = int(np.argmin(margins[name]))
    print(f"{name:20s} least {margins[name][least]:8.3f} at {margins['t_s'][least]:.2f} s")

t = margins["t_s"][np.argmin(margins["clearance_m"])]
near = walk.margin_gradients(t)
row = near.families.index("clearance")
for (family, index), slope in zip(near.parameters, near.gradient[row]):
    print(f"clearance changes by {slope:+.4f} m per unit of {family} {index + 1}")
