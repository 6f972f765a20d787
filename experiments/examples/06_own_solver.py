"""06: a solver of your own. What it proposes is certified before it counts."""
import numpy as np

import halfstep as hs


def descend(problem, x):
    """Steps against the slope of cost + 20 * (what rows miss) squared, back into the box."""
    for k in range(60):
        missing = np.maximum(problem.constraint_lower - problem.constraints(x), 0.0)
        slope = problem.gradient(x) - 40.0 * problem.jacobian(x).T @ missing
        x = np.clip(x - 0.05 / (1 + 0.1 * k) * slope / abs(slope).max(), problem.lower,
                    problem.upper)
    return x


hs.register_solver("mine/descent", descend)  # now a method beside halfstep/sqp, in YAML, too
# Under the profile `limit` also a simple solver gains.
experiment = hs.Experiment(hs.load_config("bar_8cm", smoothing__profile="limit"))
print(f"dichotomy    {experiment.smooth('dichotomy').duration:.3f} s")
result = experiment.smooth("mine/descent", heights=True, durations=True, rounds=2)
print(f"mine/descent {result.duration:.3f} s, {result.certify().status}")
