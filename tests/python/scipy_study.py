#!/usr/bin/env python3
"""SciPy's trust-constr on bar_8cm over overlaps, heights and durations, beside halfstep/sqp, and
what Python costs.   PYTHONPATH=build/release/python python3 tests/python/scipy_study.py [ROUNDS]"""
import sys
import time
import warnings

import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, minimize

import halfstep as hs


def solve(experiment, rounds):
    program = hs.OverlapProgram(experiment, heights=True, durations=True)
    x, best, evaluations = program.x0, None, 0
    for _ in range(rounds):
        rows = NonlinearConstraint(program.constraints, program.constraint_lower,
                                   program.constraint_upper, jac=program.jacobian)
        found = minimize(program.cost, x, jac=program.gradient, method="trust-constr",
                         constraints=[rows], bounds=Bounds(program.lower, program.upper),
                         options={"maxiter": 60, "initial_tr_radius": 0.1})
        evaluations += found.constr_nfev[0]
        x = np.clip(found.x, program.lower, program.upper)
        proved = program.refine(x).proved
        if proved and (best is None or program.cost(x) < best.duration):
            best = program.walk(x)
    return best, evaluations


def per_evaluation(experiment, count=200):
    """Milliseconds of processor time that rows and Jacobian take in C++ and from Python."""
    program = hs.OverlapProgram(experiment, heights=True, durations=True)
    x = 0.9 * program.x0 + 0.1 * program.upper
    points = x - 1e-9 * np.arange(1, count + 1)[:, None]  # none is the one before
    ratios = []
    for _ in range(5):
        begin = time.process_time()
        program._program.cpp_seconds(x, count)
        middle = time.process_time()
        for point in points:
            program.jacobian(point)
            program.constraints(point)
        end = time.process_time()
        ratios.append((middle - begin, end - middle))
    cpp, python = np.median(ratios, axis=0) * 1000 / count
    return cpp, python


def main():
    warnings.simplefilter("ignore")
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 12
    experiment = hs.Experiment("bar_8cm")
    for method in ("dichotomy", "halfstep/sqp"):
        options = {} if method == "dichotomy" else {"heights": True, "durations": True,
                                                    "effort": 2}
        begin = time.process_time()
        result = experiment.smooth(method, **options)
        print(f"{method:13s} {result.duration:.3f} s, {result.certify().status}, "
              f"{time.process_time() - begin:.1f} s of processor time")
    begin = time.process_time()
    walk, evaluations = solve(experiment, rounds)
    print(f"trust-constr  {walk.duration:.3f} s, {walk.certify().status}, "
          f"{time.process_time() - begin:.1f} s, {evaluations} evaluations")
    cpp, python = per_evaluation(experiment)
    print(f"rows and Jacobian: {cpp:.2f} ms in C++, {python:.2f} ms from Python, "
          f"{python / cpp:.2f} times")
    times = np.linspace(0, walk.duration, 100_000)
    for joints in (False, True):
        begin = time.process_time()
        walk.sample(times=times, joints=joints)
        print(f"100000 instants {'with' if joints else 'without'} joints: "
              f"{time.process_time() - begin:.3f} s")


if __name__ == "__main__":
    main()
