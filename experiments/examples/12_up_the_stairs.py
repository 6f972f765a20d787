"""12: up stairs of your own; heights follow from the ground."""
import halfstep as hs

scene = hs.Scene({"name": "flight", "surfaces": [
    {"name": "flight", "stairs": {"at": {"x_m": 0.14}, "rise_m": 0.1, "run_m": 0.28, "width_m": 2,
                                  "count": 2}}]})
config = hs.load_config("plan_stairs_10cm", goal__x_m=0.56)
plan = hs.Experiment(config, scene=scene).plan()
print(f"{plan.status}: {plan.sentence}")
for i in range(plan.footsteps.rows):
    step = plan.footsteps.row(i)
    print(f"  {step['foot']:5s} {step['x_m']:6.3f} {step['y_m']:6.3f} {step['z_m']:5.2f}")
result = plan.experiment.smooth("dichotomy", tolerance_s=0.02)
waist = result.walk.sample(period=0.05)["waist_z_m"]
print(f"{plan.experiment.planned.duration:.1f} -> {result.duration:.1f} s, "
      f"{result.certify().status}; the waist rises by {waist[-1] - waist[0]:.2f} m")
