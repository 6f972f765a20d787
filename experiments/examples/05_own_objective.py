"""05: an objective of your own for SciPy: the duration, and how high the feet are lifted."""
import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, minimize

import halfstep as hs

experiment = hs.Experiment(hs.load_config("bar_8cm", smoothing__profile="limit"))
program = hs.OverlapProgram(experiment, heights=True)
rows = NonlinearConstraint(program.constraints, program.constraint_lower, np.inf,
                           jac=lambda x: program.jacobian(x).toarray())
heights = np.array([name.startswith("height_scale") for name in program.names], dtype=float)
lower = np.maximum(program.lower, 0.2 * heights)  # no foot lower than a fifth of what is planned

for weight in (0.0, 2.0):  # [s per planned height]
    x = np.clip(program.to_x(experiment.smooth(tolerance_s=0.05).walk), 0.0, program.upper)
    best = None
    for _ in range(5):
        x = minimize(lambda x: program.cost(x) + weight * heights @ x, x,
                     jac=lambda x: program.gradient(x) + weight * heights, method="SLSQP",
                     bounds=Bounds(lower, program.upper), constraints=[rows],
                     options={"maxiter": 10}).x.clip(lower, program.upper)
        if program.refine(x).proved:
            best = program.walk(x)
    print(f"weight {weight}: " + ("nothing proved" if best is None else
          f"{best.duration:.2f} s, lifted to {best.parameters['height_scales'].mean():.2f} of the "
          f"planned heights, {best.certify().status}"))
