#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Both ends of a wire that is cut without a word notice it, though neither has anything to say, and
nodes are registered anew.

usage: half_open.py FOLDER_OF_PROGRAMS
exit code 77: skipped, with the reason (not root, or no namespaces here)
"""
import sys
import time

from netns import MASTER, Plant, must, run

PORT = 50000
ESTABLISHED = "01"
NODES = {"Model", "Autopilot"}
LONGEST = 6 + 2  # [s] until a loss is noticed, and as a busy machine needs


def connections(network, side):
    """How many control connections the kernel of one side takes for good."""
    table = must("ip", "netns", "exec", network.names[side], "cat", "/proc/net/tcp").splitlines()[1:]
    rows = [line.split() for line in table]
    return sum(row[3] == ESTABLISHED and f":{PORT:04X}" in (row[1][8:], row[2][8:]) for row in rows)


def noticed(plant, network):
    """The nodes are gone for the master, and the master is for the node that is left."""
    return not NODES & set(plant.nodes()) and connections(network, 1) == 0


def check(folder, network):
    plant = Plant(folder, network)
    assert plant.ask("stop").returncode == 0
    time.sleep(2)
    assert NODES <= set(plant.nodes()), "silence alone has cost a node its place"
    network.wire.loss = 1.0
    begin = time.monotonic()
    autopilot = plant.programs.pop()  # its board has no power: nobody hears of its end
    autopilot.kill()
    autopilot.wait()
    plant.wait(lambda: noticed(plant, network), "both ends notice the loss")
    duration = time.monotonic() - begin
    assert duration < LONGEST, f"the loss was noticed after {duration:.1f} s only"
    print(f"noticed after {duration:.1f} s", flush=True)
    network.wire.mend()
    plant.start(1, "awe_autopilot", "--master", f"udp://{MASTER}:{PORT}")
    plant.wait(lambda: NODES <= set(plant.nodes()), "both nodes are there again")
    started = plant.ask("start")
    assert started.returncode == 0, started.stderr
    print("both nodes fly again", flush=True)
    plant.close()


if __name__ == "__main__":
    sys.exit(run(check))
