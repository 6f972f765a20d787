"""10: a robot of your own: a file beside its URDF (`halfstep robot URDF` writes one).

Here it is the shipped robot wren with smaller soles."""
import os
import shutil
import tempfile

import halfstep as hs

with tempfile.TemporaryDirectory() as folder:
    robots = os.path.dirname(hs.robots()["wren"])
    shutil.copytree(robots, os.path.join(folder, "robots"))
    path = os.path.join(folder, "robots", "mine.yaml")
    with open(hs.robots()["wren"]) as shipped, open(path, "w") as mine:
        text = shipped.read().replace("name: wren", "name: mine")
        mine.write(text.replace("sole_size_m: [0.104, 0.066]", "sole_size_m: [0.1, 0.062]"))
    robot = hs.Robot(path)
    print(robot, "with", robot.joints.rows, "leg joints and soles of", robot.sole_size, "m")

    config = hs.load_config("wren_six_steps")
    config["robot"] = path
    experiment = hs.Experiment(config)
    result = experiment.smooth("dichotomy", tolerance_s=0.02)
    print(f"{experiment.planned.duration:.2f} -> {result.duration:.2f} s, "
          f"{result.certify().status}")
