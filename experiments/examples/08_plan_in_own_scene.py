"""08: a plan in a scene of your own."""
import halfstep as hs

scene = hs.Scene({
    "name": "crate", "obstacles": [
        {"name": "crate", "box": {"size_m": [0.2, 0.3, 0.3]}, "pose": {"xyz": [0.5, 0.1, 0.15]}},
        {"name": "cable", "cylinder": {"radius_m": 0.01, "length_m": 2.0},
         "pose": {"xyz": [0.9, 0, 0.05], "rpy_deg": [90, 0, 0]}}]})
config = hs.load_config("plan_bar_5cm", goal__x_m=1.2, step_set__spacing_m=0.1,
                        step_set__x_min_m=0, step_set__yaws_rad=[0])  # few: baked in seconds
plan = hs.Experiment(config, scene=scene).plan(progress=lambda what, done: None)
print(f"{plan.status}: {plan.sentence}")
for i in range(plan.footsteps.rows):
    step = plan.footsteps.row(i)
    print(f"  {step['foot']:5s} {step['x_m']:6.3f} {step['y_m']:6.3f} {step['yaw_rad']:6.3f}")
result = plan.experiment.smooth("dichotomy", tolerance_s=0.02)
print(f"{plan.experiment.planned.duration:.1f} -> {result.duration:.1f} s, "
      f"{result.certify().status}")
