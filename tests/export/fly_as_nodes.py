#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Model and autopilot of the kite, exported as FMUs and run as nodes by qtplc_fmu, fly as the nodes
from which they are made: the digest of all values of all cycles is equal.

usage: fly_as_nodes.py AWE_SIL AWE_MASTER QTPLC_FMU MODEL_FMU AUTOPILOT_FMU
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

LONGEST_RUN = 100.0  # [s]
DURATION = "30"  # [s]


def report_of(folder, *command):
    """A command that flies, and the file that it writes about its flight."""
    file = folder / "flight.json"
    return [*command, "--lockstep", "--duration", DURATION, "--report", file], file


def check(process, name):
    said, _ = process.communicate(timeout=LONGEST_RUN)
    if process.returncode != 0:
        sys.exit(f"{name} ends with {process.returncode}:\n{said}")


def port_of(master):
    for line in master.stdout:
        if " port " in line:
            return line.split(" port ")[1].split()[0]
    sys.exit(f"awe_master ends with {master.wait()} before it listens")


def start(command):
    return subprocess.Popen(
        [str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )


def digest(file):
    flight = json.loads(file.read_text())
    return flight["image_digest"], flight["cycles"]


def fly_plant(folder, sil):
    # An exported controller answers a step later: docs/delays.md.
    command, file = report_of(folder, sil, "--same-cycle", "--dead-time", "1")
    check(start(command), "awe_sil")
    return digest(file)


def fly_fmus(folder, master, program, fmus):
    command, file = report_of(folder, master, "--port", "0", "--start-with", ",".join(fmus))
    processes = {"awe_master": start(command)}
    try:
        address = f"localhost:{port_of(processes['awe_master'])}"
        for name, fmu in fmus.items():
            processes[name] = start([program, "node", fmu, "--name", name, "--same-cycle", "--master", address])
        for name, process in processes.items():
            check(process, name)
    finally:
        for process in processes.values():
            process.kill()
    return digest(file)


def main():
    sil, master, program, model, autopilot = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        expected = fly_plant(folder, sil)
        flown = fly_fmus(folder, master, program, {"Model": model, "Autopilot": autopilot})
    if flown != expected:
        sys.exit(f"digest and cycles of the FMUs are {flown}, those of the nodes {expected}")
    print(f"digest {expected[0]} of {expected[1]} cycles in both")


if __name__ == "__main__":
    main()
