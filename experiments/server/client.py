#!/usr/bin/env python3
"""Measures for an episode, and prints the walk to come: the beginning of a client of your own.

    halfstep live CONFIG --set live.sensing.source=client --serve /tmp/walk.sock
    client.py /tmp/walk.sock bar=0.75,2,0.02 box=1,1,0.3

tells halfstep again and again, once a sensing period, that the obstacles `bar` and `box` of the
scene are at these places [m], and nothing else is there. Put your motion capture in place of
`measure`, and your controller in place of `execute`. Messages: README.md beside this file.
"""
import json
import socket
import sys
import threading
import time


def measure(places):
    """What is there now; a message may also hold `goal` and `areas`."""
    return {
        "type": "measured",
        "age_s": 0.0,
        "obstacles": [{"name": name, "xyz_m": xyz} for name, xyz in places.items()],
    }


def execute(motion, columns):
    """Takes the motion until `motion_s` from now, in place of what it had from now on."""
    rows, x, y = motion["rows"], columns.index("com_x_m"), columns.index("com_y_m")
    print(f"walk {motion['walk']}: {len(rows)} rows from {motion['from_s']:.3f} s on, "
          f"the CoM goes to {rows[-1][x]:.3f}, {rows[-1][y]:.3f} m", flush=True)


def main():
    path = sys.argv[1]
    places = {}
    for argument in sys.argv[2:]:
        name, xyz = argument.rsplit("=", 1)
        places[name] = [float(number) for number in xyz.split(",")]
    with socket.socket(socket.AF_UNIX) as line:
        line.connect(path)
        received = line.makefile("r", encoding="utf-8")

        def say(message):
            line.sendall((json.dumps(message) + "\n").encode())

        hello = json.loads(received.readline())
        say({"type": "subscribe", "state_period_s": 0.1, "motion_s": 2.0})
        over = threading.Event()

        def keep_measuring():
            while not over.is_set():
                say(measure(places))
                time.sleep(hello["sensing_period_s"])

        threading.Thread(target=keep_measuring, daemon=True).start()
        duration = float("inf")
        for text in received:
            message = json.loads(text)
            if message["type"] == "walk":
                duration = message["duration_s"]
            elif message["type"] == "motion":
                execute(message, hello["columns"])
            elif message["type"] == "state" and message["t_s"] > duration and not over.is_set():
                over.set()  # it has come to the end of its walk
                say({"type": "end"})
            elif message["type"] == "error":
                print(message["text"], file=sys.stderr)
            elif message["type"] == "end":
                print(f"{message['ending']}; the record is in {message['folder']}")
                return 0 if message["ending"] in ("arrived", "ended") else 1
    return 1


if __name__ == "__main__":
    sys.exit(main())
