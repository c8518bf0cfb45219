#!/usr/bin/env python3
"""tests/cluster/check_cluster.py - a picture as an array of Slurm: check_cluster.py BUILD_DIR

Four tasks take its parts; one is killed in the middle of it, and requeued. What merge makes of
them must be the bytes of one run. The Slurm is the one that answers here; if none does, one is
started on this machine by ../shared/cluster/slurm-local.sh, and that is said. Without either the
check fails, and says so.
"""
# SPDX-License-Identifier: MIT

import glob
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, SHARED, Checks, Program

LOCAL = os.path.join(SHARED, "cluster", "slurm-local.sh")
PARTS, KILLED = 4, 2
PICTURE = ["chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "240x160", "--samples",
           "1024", "--noise", "--mosaic", "rggb"]
LIMIT = 180  # s
# A task that fails is queued again; its worker's number is there for who wants to kill it.
TASK = """#!/bin/sh
#SBATCH --array=1-%d
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=log-%%a
i=$SLURM_ARRAY_TASK_ID
echo "begun, restarts: ${SLURM_RESTART_COUNT:-0}"
lenscalc render %s --part $i/%d --resume -o part-$i.part &
echo $! > worker-$i.new && mv worker-$i.new worker-$i
wait $!
status=$?
echo "status $status"
[ $status -eq 0 ] || scontrol requeue $SLURM_JOB_ID
"""


def answers(environment):
    return shutil.which("sinfo") is not None and subprocess.run(
        ["sinfo"], env=environment, capture_output=True, timeout=60).returncode == 0


def start_local(folder, environment):
    """A Slurm of this machine alone, in the environment; false: there is none."""
    if not os.path.exists(LOCAL):
        print(f"no Slurm answers here (sinfo), and there is no {LOCAL} to start one")
        return False
    print(f"no Slurm answers here: {LOCAL} starts one on this machine")
    subprocess.run([os.path.join(ROOT, "tests", "deps"), "slurm-wlm", "munge"], check=True)
    with open(os.path.join(folder, "slurm.log"), "w") as log:  # no pipe that daemons keep open
        subprocess.run(["sh", LOCAL, "start", os.path.join(folder, "slurm")], stdout=log,
                       stderr=log, check=True)
    with open(os.path.join(folder, "slurm.log")) as log:
        lines = [line.strip() for line in log if line.startswith("SLURM_CONF=")]
    environment["SLURM_CONF"] = lines[-1].partition("=")[2]
    end = time.time() + 60
    while not answers(environment) and time.time() < end:
        time.sleep(0.5)
    return answers(environment)


def wait_for(condition):
    end = time.time() + LIMIT
    while not condition() and time.time() < end:
        time.sleep(0.1)
    return condition()


def run_array(checks, folder, environment):
    def read(name):
        path = os.path.join(folder, name)
        return open(path).read() if os.path.exists(path) else ""

    def slurm(*words):
        return subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True,
                              timeout=60)

    with open(os.path.join(folder, "task.sh"), "w") as file:
        file.write(TASK % (PARTS, " ".join(PICTURE), PARTS))
    result = slurm("sbatch", "--parsable", "--export=ALL", "task.sh")
    job = result.stdout.strip()
    if not checks.check(result.returncode == 0 and job, f"sbatch: {result.stderr}"):
        return
    worker = f"worker-{KILLED}"
    if checks.check(wait_for(lambda: read(worker)), f"task {KILLED} does not begin"):
        time.sleep(0.5)
        os.kill(int(read(worker)), signal.SIGKILL)
        checks.check(not read(f"part-{KILLED}.part"), "the killed task was done already")

    def is_requeued():
        # a task that is requeued waits for a while, unless it is told not to
        slurm("scontrol", "update", f"JobId={job}_{KILLED}", "StartTime=now")
        return "restarts: 1" in read(f"log-{KILLED}")
    checks.check(wait_for(is_requeued), f"task {KILLED} is not run again: {read(f'log-{KILLED}')}")
    checks.check(wait_for(lambda: not slurm("squeue", "-h", "-j", job).stdout.strip()),
                 "the array does not end")
    log = read(f"log-{KILLED}")
    checks.check("status 137" in log and log.rstrip().endswith("status 0"), f"its log: {log}")
    logs = [read(f"log-{i}") for i in range(1, PARTS + 1)]
    checks.check(all("status 0" in log for log in logs), f"logs: {logs}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    environment = program.environment()
    with tempfile.TemporaryDirectory(prefix="lenscalc-cluster-") as folder:
        is_own = not answers(environment)
        try:
            if checks.check(not is_own or start_local(folder, environment), "no Slurm"):
                run_array(checks, folder, environment)
                parts = sorted(glob.glob(os.path.join(folder, "*.part")), reverse=True)
                merged = os.path.join(folder, "merged.png")
                whole = os.path.join(folder, "whole.png")
                result = program.run("merge", *parts, "-o", merged)
                checks.check(result.returncode == 0, f"merge: {result.stderr.decode()}")
                program.run("render", *PICTURE, "-o", whole, "--threads", "0")
                with open(merged, "rb") as one, open(whole, "rb") as other:
                    checks.check(one.read() == other.read(), "not the bytes of one run")
        finally:
            if is_own and os.path.exists(os.path.join(folder, "slurm")):
                subprocess.run(["sh", LOCAL, "stop", os.path.join(folder, "slurm")], check=False)
                time.sleep(1)  # the daemons write into the folder until they have ended
    checks.finish()


if __name__ == "__main__":
    main()
