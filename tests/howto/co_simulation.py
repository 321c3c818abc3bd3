#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the simulation of docs/howto/turn-the-clock.md and its controller as the page says: it
prints the length that the page promises. A simulation without a controller ends, too, and says what
is missing.

usage: co_simulation.py SIMULATION CONTROLLER PAGE
"""
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "typed"))
from typed import Broken, in_own_network, require  # noqa: E402

LONGEST_RUN = 60.0  # [s]
PORT = "50000"  # in a network of its own


def finish(process):
    try:
        out, err = process.communicate(timeout=LONGEST_RUN)
    finally:
        process.kill()
    return process.returncode, out, err


def start(*command):
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def run_both(simulation, controller, promised):
    node = start(controller, "--master", f"tcp://localhost:{PORT}", "--stay")
    try:
        code, out, said = finish(start(simulation, PORT))
        require(code == 0, f"the simulation ends with {code}: {said}")
        require(out == f"{promised}\n", f"the simulation prints '{out}', and the page promises '{promised}'")
    finally:
        node.terminate()
        code, _, said = finish(node)
    require(code == 0, f"the controller ends with {code}: {said}")


def run_alone(simulation):
    code, _, said = finish(start(simulation, PORT))
    require(code == 1 and "Controller" in said, f"without a controller the simulation ends with {code}: {said}")


def main():
    simulation, controller, page = sys.argv[1:]
    in_own_network()
    promised = re.search(r"The simulation prints `([^`]+)`", Path(page).read_text())[1]
    run_both(simulation, controller, promised)
    run_alone(simulation)


if __name__ == "__main__":
    try:
        main()
    except Broken as broken:
        sys.exit(f"the co-simulation breaks: {broken}")
