#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Nodes whose address names no transport: they use UDP, also on a bad network, and TCP where the kernel drops UDP in one direction.

usage: fallback.py FOLDER_OF_PROGRAMS        exit code 77: skipped, with the reason (not root, or no namespaces here)
"""
import sys
from pathlib import Path

from netns import LOSS, SKIPPED, Network, Plant, must, reason_to_skip, show

SIDES = ("to the master", "to the nodes")


def drop_udp(network, side, is_dropped):
    """Drop all datagrams that arrive at one side over the wire."""
    drop = 'iifname != "lo" meta l4proto udp drop\n' if is_dropped else ""
    rules = f"table inet blocked\ndelete table inet blocked\ntable inet blocked {{\nchain arrive {{\ntype filter hook input priority 0;\n{drop}}}\n}}\n"
    must("ip", "netns", "exec", network.names[side], "nft", "-f", "-", text=rules)


def transports(plant):
    return {name: (node["transport"], node.get("fallback", False)) for name, node in plant.nodes().items() if node["transport"] != "inprocess"}


def check_fallback(plant, side):
    assert set(transports(plant).values()) == {("tcp", True)}, transports(plant)
    assert plant.ask("state").stdout.count("tcp (fallback)") == 2, plant.ask("state").stdout
    assert plant.events().count("UDP does not get through") == 2, plant.events()
    heard = "reached the master: 0)" in plant.events()
    assert heard == (side == 0), f"the event names the wrong direction\n{plant.events()}"
    show(f"UDP blocked {SIDES[side]}", plant.fly(2))


def check_udp(plant, network):
    assert set(transports(plant).values()) == {("udp", False)}, transports(plant)
    network.lose(LOSS)
    counted = plant.fly(15)
    network.lose(0)
    show("10 % loss in each direction", counted)
    assert counted["rejected"] == 0


def main():
    reason = reason_to_skip()
    if reason:
        print(f"SKIPPED: {reason}")
        return SKIPPED
    network = Network()
    programs = []
    try:
        for blocked in (0, 1, None):
            for side in (0, 1):
                drop_udp(network, side, side == blocked)
            plant = Plant(Path(sys.argv[1]), network, scheme="", programs=programs)
            if blocked is None:
                check_udp(plant, network)
            else:
                check_fallback(plant, blocked)
            plant.close()
            programs.clear()
    finally:
        for program in programs:
            program.kill()
        network.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
