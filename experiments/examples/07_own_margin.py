"""07: a margin of your own, as rows that you add to the program for SciPy: the CoM's speed.

Halfstep's certificate says nothing of it: it holds at the times that are looked at. In C++ a margin
can be registered with a bound of its change, and is proved like the others (07_own_margin.cc)."""
import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, minimize

import halfstep as hs

LIMIT = 0.22  # [m/s]
experiment = hs.Experiment("fig3_two_half_steps")
program = hs.OverlapProgram(experiment, durations=True)
fractions = np.linspace(0.02, 0.98, 40)


def room(x):
    """LIMIT - |CoM's speed|, at 40 times of the walk."""
    walk = program.walk(x.clip(program.lower, program.upper))
    table = walk.sample(times=fractions * walk.duration, joints=False)
    return LIMIT - np.hypot(table["com_vx_m_s"], table["com_vy_m_s"])


rows = [NonlinearConstraint(program.constraints, program.constraint_lower, np.inf,
                            jac=lambda x: program.jacobian(x).toarray()),
        NonlinearConstraint(room, 0.0, np.inf)]
for name, constraints in (("without", rows[:1]), ("with", rows)):
    x = minimize(program.cost, program.x0, jac=program.gradient, method="SLSQP",
                 bounds=Bounds(program.lower, program.upper), constraints=constraints,
                 options={"maxiter": 40}).x.clip(program.lower, program.upper)
    print(f"{name}: {program.cost(x):.3f} s, CoM at most {LIMIT - room(x).min():.3f} m/s, "
          f"{program.walk(x).certify().status}")
