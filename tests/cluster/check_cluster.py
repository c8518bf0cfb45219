#!/usr/bin/env python3
"""tests/cluster/check_cluster.py - arrays of Slurm: check_cluster.py BUILD_DIR

A picture, a search for lenses, and trials of a lens as it may be made. Four tasks take the parts of
each; one is killed in the middle of it, and requeued. What merge makes of them must be the bytes of
one run. So must what GNU parallel makes of the parts of a search, and of trials. The Slurm is the
one that answers here; if none does, one is started on this machine by
../shared/cluster/slurm-local.sh, and that is said. Without either the check fails, and says so.
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
PICTURE = ["render", "chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "240x160", "--samples",
           "1024", "--noise", "--mosaic", "rggb"]
SEARCH = ["optimize", "double-gauss", "--vary", "R1..R11", "--goals", "poly,efl=100", "--rays",
          "200", "--global", "120", "--spread", "0.6", "--seed", "1", "--keep", "2", "--csv"]
TRIALS = ["tolerance", "double-gauss", "--grade", "precision", "--trials", "400000", "--seed", "1",
          "--limit", "57um", "--save", "worst:2", "--csv"]
# what is asked, how a task goes on where it was, and how the files of the answer end
CASES = {"picture": (PICTURE, "--resume", [".png"]),
         "search": (SEARCH, "--state state-$i", ["-1.lens", "-2.lens"]),
         "trials": (TRIALS, "", ["-1.lens", "-2.lens"])}
BY_PARALLEL = ["search", "trials"]
LIMIT = 180  # s
# A task that fails is queued again; its worker's number is there for who wants to kill it.
TASK = """#!/bin/sh
#SBATCH --array=1-%d
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=log-%%a
i=$SLURM_ARRAY_TASK_ID
echo "begun, restarts: ${SLURM_RESTART_COUNT:-0}"
lenscalc %s --part $i/%d %s -o part-$i.part &
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


def run_array(checks, folder, environment, asked, resuming):
    def read(name):
        path = os.path.join(folder, name)
        return open(path).read() if os.path.exists(path) else ""

    def slurm(*words):
        return subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True,
                              timeout=60)

    with open(os.path.join(folder, "task.sh"), "w") as file:
        file.write(TASK % (PARTS, " ".join(asked), PARTS, resuming))
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


def compare(checks, program, folder, asked, endings):
    """What merge makes of the parts there beside one run, to the bit."""
    parts = sorted(glob.glob(os.path.join(folder, "*.part")), reverse=True)
    name = "file." + endings[0].rpartition(".")[2]
    made = [os.path.join(folder, how + name) for how in ("merged-", "whole-")]
    merged = program.run("merge", *parts, "-o", made[0])
    checks.check(merged.returncode == 0, f"merge: {merged.stderr.decode()}")
    whole = program.run(*asked, "-o", made[1], "--threads", "0")
    checks.check(merged.stdout == whole.stdout, f"rows: {merged.stdout!r}, {whole.stdout!r}")
    for ending in endings:
        names = [os.path.splitext(path)[0] + ending for path in made]
        with open(names[0], "rb") as one, open(names[1], "rb") as other:
            checks.check(one.read() == other.read(), f"{ending}: not the bytes of one run")


def run_parallel(checks, folder, environment, asked, resuming):
    """The parts by GNU parallel."""
    words = ["parallel", "-j", "2", "lenscalc", *asked, "--part", f"{{}}/{PARTS}",
             *resuming.replace("$i", "{}").split(), "-o", "part-{}.part", ":::",
             *map(str, range(1, PARTS + 1))]
    result = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True,
                            check=False)
    checks.check(result.returncode == 0, f"parallel: {result.stderr}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    environment = program.environment()
    with tempfile.TemporaryDirectory(prefix="lenscalc-cluster-") as folder:
        is_own = not answers(environment)
        try:
            is_there = not is_own or start_local(folder, environment)
            checks.check(is_there, "no Slurm")
            for name, (asked, resuming, endings) in CASES.items():
                place = os.path.join(folder, name)
                os.mkdir(place)
                if is_there:
                    run_array(checks, place, environment, asked, resuming)
                    compare(checks, program, place, asked, endings)
            for name in BY_PARALLEL:
                asked, resuming, endings = CASES[name]
                place = os.path.join(folder, "parallel-" + name)
                os.mkdir(place)
                run_parallel(checks, place, environment, asked, resuming)
                compare(checks, program, place, asked, endings)
        finally:
            if is_own and os.path.exists(os.path.join(folder, "slurm")):
                subprocess.run(["sh", LOCAL, "stop", os.path.join(folder, "slurm")], check=False)
                time.sleep(1)  # the daemons write into the folder until they have ended
    checks.finish()


if __name__ == "__main__":
    main()
