"""08: a plan in a scene of your own."""
import halfstep as hs

scene = hs.Scene({
    "name": "hall", "no_step": [
        {"name": "hole", "polygon_m": [[0.1, 0], [0.15, 0], [0.15, 0.3], [0.1, 0.3]]}],
    "obstacles": [{"name": "crate", "box": {"size_m": [0.2, 0.2, 0.3]},
                   "pose": {"xyz": [0.2, 0.6, 0.15]}}]})
config = hs.load_config(
    "plan_bar_8cm", planner__name="astar", planner__unimproved_nodes=0,
    step_set__x_min_m=0, step_set__x_max_m=0.25, step_set__y_min_m=-0.26,
    step_set__y_max_m=-0.16, step_set__yaws_rad=[0])  # few places: baked in seconds
plan = hs.Experiment(config, scene=scene).plan()
print(f"{plan.status}: {plan.sentence}")
for i in range(plan.footsteps.rows):
    step = plan.footsteps.row(i)
    print(f"  {step['foot']:5s} {step['x_m']:6.3f} {step['y_m']:6.3f} {step['yaw_rad']:6.3f}")
result = plan.experiment.smooth("dichotomy", tolerance_s=0.02)
print(f"{plan.experiment.planned.duration:.1f} -> {result.duration:.1f} s, "
      f"{result.certify().status}")
