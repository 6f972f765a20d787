"""Reads motions as other programs do, by NumPy and the standard library.

usage: read_motion.py arrays NPZ FOLDER     writes each array as raw float64, names a line each
       read_motion.py lafan1 CSV NPZ        compares root and joints, to the bit
       read_motion.py json JSON NPZ         compares everything, to the bit
       read_motion.py footsteps CSV YAML    compares places, to the bit
"""
import csv
import json
import pathlib
import sys

import numpy


def motion(path):
    with numpy.load(path, allow_pickle=False) as archive:
        arrays = {name: archive[name] for name in archive.files}
    frames, joints = arrays["joint_pos"].shape
    bodies = arrays["body_pos_w"].shape[1]
    assert arrays["fps"].shape == (1,) and arrays["fps"].dtype == numpy.int64
    assert arrays["joint_vel"].shape == (frames, joints)
    assert arrays["body_quat_w"].shape == (frames, bodies, 4)
    for name in ("body_pos_w", "body_lin_vel_w", "body_ang_vel_w"):
        assert arrays[name].shape == (frames, bodies, 3) and arrays[name].dtype == numpy.float64
    assert len(arrays["joint_names"]) == joints and len(arrays["body_names"]) == bodies
    quaternions = arrays["body_quat_w"]
    assert abs((quaternions**2).sum(axis=2) - 1).max() < 1e-12
    assert (quaternions[0, :, 0] >= 0).all()
    assert ((quaternions[1:] * quaternions[:-1]).sum(axis=2) > 0).all(), "a sign jumps"
    return arrays


def arrays(npz, folder):
    for name, array in motion(npz).items():
        path = pathlib.Path(folder) / name
        if array.dtype.kind == "U":
            path.write_text("".join(text + "\n" for text in array), encoding="utf-8")
        else:
            array.astype(numpy.float64).tofile(path)


def lafan1(table, npz):
    expected = motion(npz)
    with open(table, newline="", encoding="utf-8") as file:
        rows = numpy.array([[float(cell) for cell in row] for row in csv.reader(file)])
    assert rows.shape == (len(expected["joint_pos"]), 7 + expected["joint_pos"].shape[1])
    assert (rows[:, :3] == expected["body_pos_w"][:, 0]).all()
    assert (rows[:, [6, 3, 4, 5]] == expected["body_quat_w"][:, 0]).all()
    assert (numpy.sort(rows[:, 7:]) == numpy.sort(expected["joint_pos"])).all()


def of_json(path, npz):
    expected = motion(npz)
    with open(path, encoding="utf-8") as file:
        read = json.load(file)
    assert read["fps"] == expected["fps"][0]
    for name in ("joint_names", "body_names"):
        assert read[name] == list(expected[name])
    frames = read["frames"]
    for of_frame, name in (("joint_pos", "joint_pos"), ("joint_vel", "joint_vel"),
                           ("body_pos", "body_pos_w"), ("body_quat", "body_quat_w"),
                           ("body_lin_vel", "body_lin_vel_w"), ("body_ang_vel", "body_ang_vel_w")):
        assert of_frame in read["units"]
        assert (numpy.array([frame[of_frame] for frame in frames]) == expected[name]).all(), name
    assert {frame["support"] for frame in frames} == {"left", "right", "both"}


def footsteps(table, targets):
    import yaml
    with open(table, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["footstep"] != "0"]
    with open(targets, encoding="utf-8") as file:
        read = yaml.safe_load(file)["footsteps"]
    assert len(read) == len(rows)
    for target, row in zip(read, rows):
        pose = target["pose"]
        assert [pose["x"], pose["y"], pose["theta"]] == [
            float(row[name]) for name in ("x_m", "y_m", "yaw_rad")]
        assert target["leg"] == {"right": 0, "left": 1}[row["foot"]]


{"arrays": arrays, "lafan1": lafan1, "json": of_json, "footsteps": footsteps}[sys.argv[1]](
    *sys.argv[2:])
