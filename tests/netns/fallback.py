#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Nodes whose address names no transport: they use UDP, also on a bad network, and TCP where the
kernel drops UDP in one direction.

usage: fallback.py FOLDER_OF_PROGRAMS
exit code 77: skipped, with the reason (not root, or no namespaces here)
"""
import sys

from netns import LOSS, Plant, drop_rules, run, show

SIDES = ("to the master", "to the nodes")


def transports(plant):
    return {
        name: (node["transport"], node.get("fallback", False))
        for name, node in plant.nodes().items()
        if node["transport"] != "inprocess"
    }


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


def check(folder, network):
    for blocked in (0, 1, None):
        for side in (0, 1):
            network.filter(side, drop_rules("firewall", "meta l4proto udp" if side == blocked else ""))
        plant = Plant(folder, network, scheme="")
        if blocked is None:
            check_udp(plant, network)
        else:
            check_fallback(plant, blocked)
        plant.close()


if __name__ == "__main__":
    sys.exit(run(check))
