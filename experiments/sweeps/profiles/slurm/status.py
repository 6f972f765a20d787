#!/usr/bin/python3
"""Says of a Slurm job whether it is running, a success or failed, for Snakemake's --cluster-status.

Asks the controller (scontrol), so that no accounting is needed. A job that it has forgotten, some
minutes after its end, counts as failed: it is done again, and finds its cases done.
"""

import re
import subprocess
import sys
import time

UNDER_WAY = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "STOPPED", "REQUEUED",
             "REQUEUE_HOLD", "RESIZING", "SIGNALING", "STAGE_OUT"}


def state_of(job: str) -> str:
    """The state by the controller; "" when it does not know the job."""
    for _ in range(5):
        told = subprocess.run(["scontrol", "--oneliner", "show", "job", job], check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        found = re.search(r"\bJobState=(\w+)", told.stdout)
        if found:
            return found.group(1)
        if "Invalid job id" in told.stderr:
            return ""
        time.sleep(2)  # the controller is busy, or starts anew
    return "PENDING"  # nobody knows: ask again later


if __name__ == "__main__":
    state = state_of(sys.argv[1].split(";")[0])
    print("success" if state == "COMPLETED" else "running" if state in UNDER_WAY else "failed")
