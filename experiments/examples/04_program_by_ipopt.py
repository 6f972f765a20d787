"""04: overlaps, foot heights and durations together, as one nonlinear program."""
import halfstep as hs

experiment = hs.Experiment("fig5_box")
why_not = hs.solvers()["ipopt"]
method = "halfstep/sqp" if why_not else "ipopt"
result = experiment.smooth(method, heights=True, durations=True, rounds=2)
print(f"{method}: {result.duration:.3f} s, {'certified' if result.certify() else 'not proved'}, "
      f"the dichotomy {experiment.smooth('dichotomy').duration:.3f} s")
for name, values in result.parameters.items():
    print(f"{name:15s}", values.round(3))

# The same program by SciPy: all that a solver needs is here.
program = hs.OverlapProgram(experiment, heights=True, durations=True)
x = program.to_x(result.walk)
print(f"{program}: cost {program.cost(x):.3f} s, least row {program.constraints(x).min():.3f}, "
      f"Jacobian {program.jacobian(x).shape}")
