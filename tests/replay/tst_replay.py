#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Records flights of the example, and lets each of its nodes compute them again with qtplc replay:
the program itself, as its own process.

usage: tst_replay.py FOLDER_OF_PROGRAMS [CYCLES] [--speed]

--speed  prints how often faster than real time each node was, the median of five
"""
import json
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PATIENCE = 240  # [s] of each program
TURBULENCE = ["--turbulence", "0.1"]


class Programs:
    def __init__(self, folder, work):
        self.folder, self.work = Path(folder), Path(work)

    def call(self, *command, code=0):
        run = subprocess.run(
            [str(self.folder / command[0]), *map(str, command[1:])],
            cwd=self.work,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
        )
        if run.returncode != code:
            sys.exit(f"{command} ends with {run.returncode}, not {code}:\n{run.stdout}{run.stderr}")
        return run.stdout

    def replay(self, file, node, *more, code=0):
        command = str(self.folder / node[0]) + " " + " ".join(node[1:])
        text = self.call("qtplc", "replay", file, "--node", command, "--compare", "--json", *more, code=code)
        return json.loads(text) if code < 2 else None


def require(condition, text):
    if not condition:
        sys.exit(text)


def lockstep(programs, cycles, measures):
    """Nodes of the process of the master fly, and their programs compute it again."""
    programs.call("awe_sil", "--duration", cycles / 100, *TURBULENCE, "--seed", 7, "--record", "lockstep.mcap")
    nodes = {"Model": ["awe_compact_model", *TURBULENCE, "--seed", "7"], "Autopilot": ["awe_autopilot"]}
    for name, node in nodes.items():
        result = programs.replay("lockstep.mcap", node, "--name", name)
        require(result["differences"] == 0, f"{name} differs: {result.get('first')}")
        require(result["compared"] >= cycles - 1, f"{name}: {result}")
        if measures:
            runs = [programs.replay("lockstep.mcap", node, "--name", name) for _ in range(5)]
            speeds = [run["simulated"] / run["elapsed"] for run in runs]
            print(f"{name}: {statistics.median(speeds):.0f} x real time, median of {len(speeds)}")
    other = programs.replay("lockstep.mcap", ["awe_compact_model", *TURBULENCE, "--seed", "8"], code=1)
    require(other["first"].get("cycle", 0) <= 1, f"another seed: {other}")
    other = programs.replay("lockstep.mcap", ["awe_autopilot", "--gains", "tuned"], code=1)
    require(other["first"]["cycle"] == 0, f"other gains: {other}")


def children_of(parent):
    """Processes that one has started, and what they are called."""
    found = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, rest = stat.read_text().split("(", 1)[1].rsplit(")", 1)
        except (OSError, IndexError):
            continue
        if int(rest.split()[1]) == parent:
            found[int(stat.parent.name)] = name
    return found


def real_time(programs, cycles):
    """Nodes are processes that stand still now and then: answers are late, requests left out."""
    scale = 5
    flight = subprocess.Popen(
        [programs.folder / "awe_sil", "--processes", "--transport", "udp", "--scale", str(scale), "--seed", "7"]
        + [*TURBULENCE, "--duration", str(cycles / 100), "--record", "real_time.mcap"],
        cwd=programs.work,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    stalls = 0
    while flight.poll() is None:
        time.sleep(0.3)
        for child, name in children_of(flight.pid).items():
            if name in ("awe_compact_mod", "awe_compact_model", "awe_model", "awe_autopilot"):
                stall(child)
                stalls += 1
    require(flight.returncode == 0, f"awe_sil ends with {flight.returncode}: {flight.stdout.read()}")
    require(stalls > 4, f"{stalls} stalls")
    models = {"Model": ["awe_compact_model", *TURBULENCE, "--seed", "7"], "Autopilot": ["awe_autopilot"]}
    for name, node in models.items():
        result = programs.replay("real_time.mcap", node, "--name", name)
        require(result["differences"] == 0, f"{name} in real time: {result}")
        require(result["compared"] > cycles / 2, f"{name} in real time: {result}")
        print(f"{name} in real time: {result['cycles']} of {cycles} cycles computed, {result['compared']} compared")


def folder(programs):
    """A recorder of a folder begins a file every four seconds: all of them are one recording."""
    with tempfile.TemporaryDirectory(dir="/dev/shm") as rings:
        environment = dict(os.environ, QTPLC_RING_DIR=rings)
        command = [programs.folder / "qtplc", "record", "segments/", "--segment-hours", "0.001", "--free-gib", "0"]
        recorder = subprocess.Popen(command, cwd=programs.work, stdout=subprocess.DEVNULL, env=environment)
        flight = [programs.folder / "awe_sil", "--scale", "5", "--duration", "50", *TURBULENCE, "--seed", "7"]
        subprocess.run(
            flight, cwd=programs.work, stdout=subprocess.DEVNULL, env=environment, timeout=PATIENCE, check=True
        )
        end = time.monotonic() + PATIENCE
        while os.listdir(rings) and time.monotonic() < end:  # a recorder deletes the ring that it has read
            time.sleep(0.05)
        recorder.send_signal(signal.SIGTERM)
        recorder.wait(PATIENCE)
    verified = json.loads(programs.call("qtplc", "verify", "segments", "--json"))
    files = verified["phases"][0]["files"]
    require(verified["complete"] and len(files) >= 2, f"files of a phase: {verified}")
    for recording in ("segments", files[-1]):
        result = programs.replay(recording, ["awe_autopilot"], "--name", "Autopilot")
        require(result["differences"] == 0 and result["compared"] > 1000, f"{recording}: {result}")
        require(result["cycles"] <= verified["phases"][0]["cycles"], f"{recording}: {result}")
    (programs.work / files[0]).unlink()
    programs.call("qtplc", "verify", "segments")  # it may have been deleted
    programs.replay("segments", ["awe_autopilot"], "--name", "Autopilot", code=2)
    print(f"{len(files)} files of a phase are one recording")


def stall(process):
    try:
        os.kill(process, signal.SIGSTOP)
        time.sleep(0.02)
        os.kill(process, signal.SIGCONT)
    except ProcessLookupError:
        pass  # the flight has ended


if __name__ == "__main__":
    cycles = int(sys.argv[2]) if len(sys.argv) > 2 and sys.argv[2].isdigit() else 3000
    with tempfile.TemporaryDirectory() as work:
        lockstep(Programs(sys.argv[1], work), cycles, "--speed" in sys.argv)
        real_time(Programs(sys.argv[1], work), cycles)
        folder(Programs(sys.argv[1], work))
    print("each node has computed the same bits again")
