#!/usr/bin/env python3
"""Stands in for Slurm in tests: acts as sbatch, squeue, scancel or scontrol, by the name under which it is called.

Supports the options that Skein uses: --array with %N, --dependency=afterany, --job-name, --output, --open-mode,
--requeue, --signal, --time, --exclude, --parsable. Its state is in the folder STAND_IN_SLURM, with the files `nodes`
(names, one per line) and `limits` (the greatest size of an array). A file `time is over` ends the next task that has a
time limit, as if the limit were reached. Each job has a process of its own that runs its tasks, one on each node at a
time.
Unknown options are errors, as with the real Slurm.
"""
import fcntl
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

STATE = Path(os.environ["STAND_IN_SLURM"])
KNOWN = {"parsable", "requeue", "signal", "array", "job-name", "output", "open-mode", "dependency", "exclude", "time",
         "partition", "account", "chdir"}


class Locked:
    """Exclusive access to the state of all jobs; it is written at the end."""

    def __enter__(self):
        self.file = open(STATE / "lock", "w")
        fcntl.flock(self.file, fcntl.LOCK_EX)
        path = STATE / "jobs.json"
        self.jobs = json.loads(path.read_text()) if path.exists() else {}
        return self.jobs

    def __exit__(self, kind, value, trace):
        (STATE / "jobs.json.new").write_text(json.dumps(self.jobs))
        (STATE / "jobs.json.new").rename(STATE / "jobs.json")
        self.file.close()


def sbatch(words):
    options, script = {}, None
    for word in words:
        if not word.startswith("--"):
            script = word
            continue
        name, _, value = word[2:].partition("=")
        if name not in KNOWN:
            sys.exit(f"sbatch: unrecognized option '--{name}'")
        options[name] = value
    match = re.fullmatch(r"0-(\d+)(?:%(\d+))?", options.get("array", "0-0"))
    limit = int((STATE / "limits").read_text()) if (STATE / "limits").exists() else 1001
    if not match or int(match[1]) >= limit:
        sys.exit("sbatch: error: Batch job submission failed: Invalid job array specification")
    with Locked() as jobs:
        number = str(len(jobs) + 1)
        jobs[number] = {"options": options, "text": Path(script).read_text(),
                        "tasks": ["PENDING"] * (int(match[1]) + 1),
                        "nodes": [""] * (int(match[1]) + 1), "pids": {}, "cancelled": False}
        with open(STATE / "calls", "a") as calls:
            calls.write(" ".join(words) + "\n")
    subprocess.Popen([sys.executable, __file__, "--serve", number], start_new_session=True,
                     stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    print(number)


def is_over(job):
    return all(state in ("DONE", "CANCELLED") for state in job["tasks"])


def may_begin(jobs, job):
    after = job["options"].get("dependency", "").removeprefix("afterany:")
    return all(is_over(jobs[other]) for other in after.split(":") if other in jobs)


def seconds(text):
    value = 0
    for part in text.split(":"):
        value = 60 * value + int(part)
    return value if ":" in text else 60 * value


def start_task(number, job, task, node):
    options = job["options"]
    environment = dict(os.environ, SLURM_JOB_ID=number, SLURMD_NODENAME=node, SLURM_ARRAY_TASK_ID=str(task))
    if "array" not in options:
        del environment["SLURM_ARRAY_TASK_ID"]
    script = STATE / f"script-{number}"
    script.write_text(job["text"])
    log = open(options["output"], "a")
    return subprocess.Popen(["/bin/sh", str(script)], env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                            start_new_session=True)


def serve(number):
    """Runs the tasks of a job until all have ended."""
    running, over = {}, STATE / "time is over"
    while True:
        with Locked() as jobs:
            job = jobs[number]
            most = re.search(r"%(\d+)", job["options"].get("array", ""))
            limit = seconds(job["options"]["time"]) if "time" in job["options"] else None
            for task, (process, begun, told) in list(running.items()):
                if job["cancelled"]:
                    os.killpg(process.pid, signal.SIGKILL)
                if limit is not None and not told and (time.monotonic() - begun > limit or over.exists()):
                    process.send_signal(signal.SIGTERM)  # only to the batch shell, as --signal=B asks
                    running[task] = (process, begun, True)
                    over.unlink(missing_ok=True)
                if process.poll() is None:
                    continue
                # SIGKILL means that the node died: its task goes back into the queue, as --requeue asks.
                lost = process.returncode == -signal.SIGKILL and "requeue" in job["options"] and not job["cancelled"]
                job["tasks"][task] = "PENDING" if lost else "DONE"
                del running[task], job["pids"][str(task)]
            if job["cancelled"]:
                job["tasks"] = ["CANCELLED" if state == "PENDING" else state for state in job["tasks"]]
            busy = {one["nodes"][task] for one in jobs.values() for task, state in enumerate(one["tasks"])
                    if state == "RUNNING"}
            excluded = job["options"].get("exclude", "").split(",")
            free = [node for node in (STATE / "nodes").read_text().split() if node not in busy and node not in excluded]
            while (free and "PENDING" in job["tasks"] and may_begin(jobs, job)
                   and (most is None or len(running) < int(most[1]))):
                task, node = job["tasks"].index("PENDING"), free.pop(0)
                process = start_task(number, job, task, node)
                running[task] = (process, time.monotonic(), False)
                job["tasks"][task], job["nodes"][task], job["pids"][str(task)] = "RUNNING", node, process.pid
            if is_over(job):
                return
        time.sleep(0.02)


def squeue(words):
    if "--noheader" not in words or "--array" not in words:
        sys.exit("squeue: the stand-in knows --noheader --array --format alone")
    with Locked() as jobs:
        nodes = set((STATE / "nodes").read_text().split())
        for number, job in jobs.items():
            excluded = set(job["options"].get("exclude", "").split(","))
            waits_for = "Resources" if nodes - excluded else "ReqNodeNotAvail, UnavailableNodes"
            for task, state in enumerate(job["tasks"]):
                if state in ("PENDING", "RUNNING"):
                    index = task if "array" in job["options"] else "N/A"
                    reason = waits_for if state == "PENDING" else "None"
                    print(f"{number}|{job['options']['job-name']}|{index}|{state}|{job['nodes'][task]}|{reason}")


def scancel(words):
    with Locked() as jobs:
        jobs[words[0]]["cancelled"] = True


def scontrol(words):
    limit = int((STATE / "limits").read_text()) if (STATE / "limits").exists() else 1001
    print(f"Configuration data\nMaxArraySize            = {limit}\nMaxJobCount             = 10000")


if sys.argv[1:2] == ["--serve"]:
    serve(sys.argv[2])
else:
    {"sbatch": sbatch, "squeue": squeue, "scancel": scancel, "scontrol": scontrol}[Path(sys.argv[0]).name](sys.argv[1:])
