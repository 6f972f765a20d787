#!/usr/bin/env python3
"""Controls the simulated robot of an episode: the beginning of a controller of your own.

    halfstep live CONFIG --in-physics --controller client --serve /tmp/walk.sock --servos 3000,150
    controller.py /tmp/walk.sock 1.0

Every 5 ms of the simulation, which waits for the answer, halfstep tells what the robot measured and
what is planned, and takes angles and speeds of the joints. Here the plan is commanded, and joints
that lag behind it are pulled by GAIN times that (0: nothing is fed back). Put your controller in
place of `command`. Messages: README.md beside this file.
"""
import json
import socket
import sys


def command(measured, then, planned, gain):
    """Angles and speeds of the legs' joints (left, right; six each) for planned["t_s"]."""
    angles = [[wanted + gain * (was_wanted - is_) for wanted, was_wanted, is_ in zip(*leg)]
              for leg in zip(planned["q_rad"], then["q_rad"], measured["q_rad"])]
    return angles, planned["speeds_rad_s"]


def main():
    path, gain = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1.0
    with socket.socket(socket.AF_UNIX) as line:
        line.connect(path)
        received = line.makefile("r", encoding="utf-8")

        def say(message):
            line.sendall((json.dumps(message) + "\n").encode())

        say({"type": "control"})
        for text in received:
            message = json.loads(text)
            if message["type"] == "controlled":
                print(f"controls {message['robot']} on servos of {message['servos'][0]} N m/rad",
                      flush=True)
            elif message["type"] == "control":
                angles, speeds = command(message["measured"], message["then"], message["next"],
                                         gain)
                say({"type": "command", "n": message["n"], "q_rad": angles,
                     "speeds_rad_s": speeds})
            elif message["type"] == "event" and message["event"] not in ("measured", "begins"):
                print(f"{message['t_s']:.3f} s: {message['event']} {message['text']}")
            elif message["type"] == "error":
                print(message["text"], file=sys.stderr)
            elif message["type"] == "end":
                print(f"{message['ending']}; the record is in {message['folder']}")
                return 0 if message["ending"] in ("arrived", "ended") else 1
    return 1


if __name__ == "__main__":
    sys.exit(main())
