"""The source paper's figures and claims, one function each, run by reproduce.py.

A claim names what the paper says and the commands that show it. Its function gets what they
printed, reads what they wrote, and returns what we found and a status; it raises `DoesNotHold`
when what must hold does not.
"""

import json
import re

from run_tables import (ROOT, column, duration, hold, json_of, rows, step_period, study_row,
                        summary)

CONFIGS = "experiments/configs"
RUN = f"halfstep run {CONFIGS}"
FIG3 = f"{RUN}/fig3_two_half_steps.yaml --overwrite"
FIG4 = f"{RUN}/fig4_raw_sequence.yaml --overwrite"
FIG5 = f"{RUN}/fig5_box.yaml --overwrite"
BARS = [f"{RUN}/bar_{height}cm.yaml --overwrite" for height in (5, 8, 10)]
ISLAND = f"{RUN}/island.yaml --set goal.x_m=3.8 --overwrite"
CLUTTER = f"{RUN}/clutter.yaml --overwrite"
GRAVITY = 9.81  # [m/s²], of the model


CLAIMS = []


def claim(what, paper, *commands):
    """Registers a function of what its commands printed: (ours, status)."""
    return lambda function: CLAIMS.append((what, paper, commands, function))


# The claims, in the order of the paper.

@claim("half-steps: T, ZMP shift, CoM height, via point", "2 s, 0.1 s, 0.814 m, 0.24 m aside, "
       "0.25 m high", FIG4)
def regime(_):
    text = (ROOT / "runs/fig4_raw_sequence/config.yaml").read_text()
    value = {key: float(re.search(rf"^  {key}: (\S+)", text, re.M).group(1))
             for key in ("duration_s", "zmp_shift_s", "via_lateral_m", "via_height_m")}
    height = column("fig4_raw_sequence/raw/trajectory.csv", "com_z_m")[0]
    ours = [value["duration_s"], value["zmp_shift_s"], height, value["via_lateral_m"],
            value["via_height_m"]]
    hold(ours == [2.0, 0.1, 0.814, 0.24, 0.25], f"{ours}")
    return "{:g} s, {:g} s, {:g} m, {:g} m aside, {:g} m high".format(*ours), "reproduced"


@claim("half-steps begin and end at rest", "nearly: small jumps of the CoM's speed at the seams",
       FIG4)
def rest(_):
    walk = rows("fig4_raw_sequence/raw/trajectory.csv")
    jumps = []  # of the speed across a seam, beyond what the acceleration there explains
    for before, seam, after in zip(walk, walk[1:], walk[2:]):
        if float(seam["t_s"]) % 2.0 == 0.0:
            for axis in "xy":
                v0, v2 = (float(row[f"com_v{axis}_m_s"]) for row in (before, after))
                a0, a1, a2 = (float(row[f"com_a{axis}_m_s2"]) for row in (before, seam, after))
                time = float(after["t_s"]) - float(before["t_s"])
                jumps.append(abs(v2 - v0 - time / 6 * (a0 + 4 * a1 + a2)))
    hold(len(jumps) == 46 and max(jumps) < 1e-8, f"{max(jumps)} m/s at {len(jumps) / 2:.0f} seams")
    return f"no jump above {max(jumps):.0e} m/s at {len(jumps) // 2} seams", "better"


@claim("[Fig. 3](fig3_overlap.ipynb): two half-steps overlap, CoM and "
       "ZMP still satisfy the LIPM", "by linearity", FIG3)
def fig3(_):
    residual = 0.0
    for row in rows("fig3_two_half_steps/dichotomy/trajectory.csv"):
        for axis in "xy":
            c, a, p, z = (float(row[key]) for key in (
                f"com_{axis}_m", f"com_a{axis}_m_s2", f"zmp_{axis}_m", "com_z_m"))
            residual = max(residual, abs(c - z / GRAVITY * a - p))
    hold(residual < 1e-9, f"p and Z(c) differ by {residual} m")
    raw, fine = duration("fig3_two_half_steps", "raw"), duration("fig3_two_half_steps")
    return (f"{raw:.3f} → {fine:.3f} s, ZMP and Z(c) differ by at most {residual:.0e} m",
            "reproduced")


@claim("[Fig. 4](fig4_walk.ipynb): a sequence becomes about 3 times faster",
       "about 3", FIG4)
def fig4(_):
    raw, fine = duration("fig4_raw_sequence", "raw"), duration("fig4_raw_sequence")
    hold(raw / fine > 2.85, f"{raw / fine:.2f}")
    return f"{raw / fine:.2f} ({raw:.1f} → {fine:.2f} s)", "reproduced"


@claim("a full step at the caps, as published", "4.0 → 1.72 s", FIG4)
def capped_step(_):
    raw = step_period("fig4_raw_sequence", "raw")
    ours = step_period("fig4_raw_sequence", "dichotomy_published")
    hold(abs(ours - 1.72) < 0.005, f"{ours:.3f} s")
    whole = float(summary("fig4_raw_sequence", "dichotomy/published")["speedup"])
    return f"{raw:.1f} → {ours:.2f} s; the whole walk {whole:.2f} times faster", "reproduced"


@claim("a full step at the natural bounds", "4.0 → 1.15 s", FIG4)
def natural_step(_):
    raw, ours = (step_period("fig4_raw_sequence", method) for method in ("raw", "dichotomy"))
    hold(ours < 1.25, f"{ours:.3f} s")
    overlaps = rows("fig4_raw_sequence/dichotomy/overlaps.csv")
    up_down, down_up = (next(float(row["overlap_s"]) for row in overlaps if row["kind"] == kind)
                        for kind in ("up_down", "down_up"))
    return (f"{raw:.1f} → {ours:.2f} s: up → down {up_down:.2f} s, down → up {down_up:.2f} s",
            "differs: the sole must stay 5 mm above the floor while it moves ahead; down → up "
            "overlaps by all of T")


@claim("highest point of the foot at up → down overlaps of 0.57 and 0.76 s", "14.3 and 7.5 cm",
       f"{RUN}/fig3_two_half_steps.yaml --set smoothing.dichotomy.up_down_cap=0.6 --json "
       "--out runs/fig3_capped --overwrite")
def apex(printed):
    heights = [method["lowest_apex_m"] for method in json.loads(printed)["methods"][1:]]
    hold(0.25 > heights[0] > heights[1] > 0.075, f"{heights} m")
    return ("{:.1f} and {:.1f} cm".format(*(100 * height for height in heights)),
            "differs: our foot moves by a profile with continuous acceleration, and stays higher")


@claim("[Fig. 5](fig5_box.ipynb): over a box, smoothing ends with the foot "
       "close to it", "close, without contact", FIG5)
def fig5(_):
    junction = rows("fig5_box/dichotomy/overlaps.csv")[0]
    clearance = min(column("fig5_box/dichotomy/trajectory.csv", "clearance_m"))
    hold(junction["limited_by_family"] == "clearance", f"the overlap is held by {junction['limited_by']}")
    hold(duration("fig5_box") < duration("fig5_box", "raw") and clearance >= 0.005,
         f"{clearance} m from the box")
    overlap, bound = float(junction["overlap_s"]), float(junction["upper_bound_s"])
    return (f"overlap {overlap:.2f} of {bound:.2f} s, held by the box; {1000 * clearance:.1f} mm "
            "between, 5 demanded"), "reproduced"


@claim("bars of 10 and 8 cm stop the smoothing early, one of 5 cm mostly does not", "qualitatively",
       *BARS)
def bars(*_):
    published = [rows(f"bar_{height}cm/dichotomy_published/overlaps.csv") for height in (5, 8, 10)]
    held = [min(float(row["overlap_s"]) for row in junctions if row["kind"] == "up_down")
            for junctions in published]
    cap = float(published[0][0]["upper_bound_s"])
    hold(cap > held[0] > 0.8 * cap and held == sorted(held, reverse=True), f"{held} of {cap} s")
    durations = [duration(f"bar_{height}cm") for height in (5, 8, 10)]
    hold(durations == sorted(durations), f"{durations} s")
    return ("shortest up → down overlap {:.2f}, {:.2f}, {:.2f} of {:.2f} s as published; finer, "
            "walks of {:.2f}, {:.2f}, {:.2f} s".format(*held[::-1], cap, *durations[::-1]),
            "reproduced")


@claim("what the smoothing accepts stays feasible", "checked at samples, 15 ms apart",
       f"{RUN}/bar_8cm.yaml --set smoothing.acceptance=sampled --set smoothing.sampling_s=0.015 "
       "--out runs/sampled --overwrite", BARS[1], "halfstep verify runs/bar_8cm --quiet")
def sound(*_):
    verdict = json_of("sampled/dichotomy/certificate.json")["verdict"]
    summary("bar_8cm")
    return (f"samples accept a walk that is {verdict}; ours is certified for all t, and verified",
            "better")


@claim("half-steps of HRP-2 on a grid of 5 cm, 5 cm, 5 yaws", "276",
       f"halfstep list half-steps {CONFIGS}/island.yaml")
def step_set(printed):
    number = len(printed.splitlines()) - 1
    hold(number >= 150, f"{number}")
    return f"{number}", ("differs: every one certified with margins; knees as in half-sitting "
                         "([why](../planner/README.md#half-step-set))")


@claim("a swept volume for each half-step", "276 of 17,000 to 25,600 triangles, 20 to 40 s each",
       f"halfstep bake {CONFIGS}/island.yaml --json")
def swept_volumes(printed):
    bake = json.loads(printed)
    hold(bake["baked"], "the cache was not empty")
    half_steps, volumes = bake["half_steps"], 2 * bake["half_steps"]
    return (f"{volumes} (down and up of {half_steps}), {bake['wall_s'] / volumes:.2f} s each, "
            f"{bake['bytes'] / 1e6:.0f} MB"), "better"


@claim("what a swept volume calls free is free", "no proof",
       "soundness_study 5000")
def volumes_are_sound(printed):
    counts = re.search(r"(\d+) called free, (\d+) of them not certified", printed)
    free, wrong = int(counts.group(1)), int(counts.group(2))
    hold(free > 1000 and wrong == 0, f"{wrong} of {free} not certified")
    return f"{wrong} of {free} called free are not certified", "better"


@claim("one query for a half-step in place of hundreds of configurations", "much faster", *(
    f"swept_volume_benchmark --benchmark_format=json --benchmark_filter={name}/room:0{more}"
    for name, more in (("SampledQuery", ""), ("SweptVolumeQuery", "/cell_mm:17"))))
def queries(sampled, swept):
    slow, fast = (json.loads(printed)["benchmarks"][0]["cpu_time"] for printed in (sampled, swept))
    hold(slow > 100 * fast, f"{fast} against {slow} ns")
    return (f"{fast / 1000:.2f} µs in place of {slow / 1000:.0f} µs for 300 configurations, among 50 "
            f"boxes: {slow / fast:,.0f} times"), "reproduced"


@claim("planning 4 m among meshes of about 60,000 triangles", "about 200 ms, 30 steps",
       "planner_study 20 meshes rrt")
def planning_time(printed):
    solved, certified, median, _, steps, *_ = study_row(printed, "rrt")
    hold(solved == "20/20" and certified == "3/3", f"solved {solved}, certified {certified}")
    return (f"{float(median):.0f} ms (median of {solved} solved), {steps} steps",
            "better" if float(median) < 200 else "differs: slower on this machine")


@claim("island: planned out of it, 28 half-steps", "14 s, 356,944 checks (RRT*)", ISLAND)
def island_plan(_):
    found = json_of("island/plan.json")
    hold(found["status"] == "solved", found["message"])
    summary("island", "raw")
    return (f"{2 * found['footsteps']} half-steps: the first plan after "
            f"{1000 * found['time_to_first_s']:.0f} ms, improved until {found['plan_wall_s']:.2f} s, "
            f"{found['queries']:,} queries"), "better"


@claim("island: smoothing those 28 half-steps", "12 s, 0.43 s a half-step", ISLAND)
def island_smoothing(_):
    wall = float(summary("island")["wall_s"])
    half_steps = 2 * json_of("island/plan.json")["footsteps"]
    return (f"{wall:.2f} s, {wall / half_steps:.3f} s a half-step, with proof",
            "better" if wall / half_steps < 0.43 else "differs: slower on this machine")


@claim("island: a bounding box never leaves it", "never",
       f"halfstep plan {CONFIGS}/island.yaml --set planner.name=bounding_box --json")
def island_box(printed):
    found = json.loads(printed)
    hold(found["status"] == "no_plan", found["message"])
    return f"no plan, {found['nodes']} places of the box looked at", "reproduced"


@claim("the bounding-box variant in rooms of 4 × 4 m, 8 goals", "below 0.5 s, mean",
       "planner_study 8 random_room bounding_box rrt")
def rooms(printed):
    box, rrt = (study_row(printed, planner) for planner in ("bounding_box", "rrt"))
    hold(int(box[0].split("/")[0]) > 0 and rrt[0] == "8/8", f"box {box[0]}, rrt {rrt[0]}")
    return (f"box {box[0]} in {float(box[2]):.0f} ms, over obstacles {rrt[0]} in "
            f"{float(rrt[2]):.0f} ms (medians)",
            "reproduced" if float(box[2]) < 500 else "differs: slower on this machine")


@claim("plans improve by short-cuts", "yes", *(
    f"halfstep plan {CONFIGS}/clutter.yaml --set planner.unimproved_nodes={nodes} --json --quiet"
    for nodes in (0, 3000)))
def short_cuts(first, improved):
    first, improved = (json.loads(printed) for printed in (first, improved))
    hold(improved["footsteps"] < first["footsteps"], "the plan did not become shorter")
    return (f"{first['footsteps']} → {improved['footsteps']} footsteps, "
            f"in {first['plan_wall_s']:.1f} and {improved['plan_wall_s']:.1f} s"), "reproduced"


@claim("Fig. 6: a cluttered room, the whole pipeline", "a few seconds", CLUTTER)
def fig6(_):
    found = json_of("clutter/plan.json")
    raw, fine = duration("clutter", "raw"), duration("clutter")
    parts = found["plan_wall_s"], float(summary("clutter")["wall_s"])
    return ("{:.1f} s of planning, {:.1f} s of smoothing; ".format(*parts) +
            f"{2 * found['footsteps']} half-steps, {raw:.0f} → {fine:.1f} s, certified"), "reproduced"


@claim("Fig. 7: a bar is moved across the way while the robot walks; it steps over it without a stop",
       "a new goal takes effect after two steps, 2.5 s",
       "halfstep live experiments/episodes/live_bar_across.yaml --overwrite --json",
       "halfstep verify runs/live_bar_across")
def fig7(lived, verified):
    found = json.loads(lived)
    hold(found["ending"] == "arrived" and "NOT" not in verified, found["ending"])
    hold(found["nearest_m"] > 0.005, f"{found['nearest_m']} m")
    hold(found["stops"] == 0, f"{found['stops']} stops")
    return (f"other footsteps {max(found['latencies_s']):.2f} s after the measurement, at most "
            f"{max(found['begun_meanwhile'])} half-steps later; {found['duration_s']:.1f} s, "
            f"{found['stops']} stops, {100 * found['nearest_m']:.1f} cm off the bar, verified; "
            "no hardware"), "better"


@claim("the walks on HRP-2", "carried out")
def robot():
    return "–", "out of scope: hardware"
