"""01: a walk from footsteps. A walk is a function of time; half-steps may overlap in it."""
import halfstep as hs

experiment = hs.Experiment({
    "robot": "hrp2", "scene": None,
    "footsteps": [{"foot": "left", "x_m": 0.15, "y_m": 0.105},
                  {"foot": "right", "x_m": 0.15, "y_m": -0.105}]})
isolated = experiment.planned
overlapped = experiment.walk(overlaps=[0.5, 0.5, 0.5])  # [s], one at each junction
print(f"isolated:   {isolated.duration:.2f} s")
print(f"overlapped: {overlapped.duration:.2f} s")

table = overlapped.sample(period=0.005)  # named columns of NumPy arrays
print(f"ZMP from y = {table['zmp_y_m'].min():.3f} to {table['zmp_y_m'].max():.3f} m, "
      f"CoM at most {table['com_vx_m_s'].max():.2f} m/s")
print("at 1 s the support is", overlapped.at(1.0)["support"])
