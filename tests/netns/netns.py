#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Flies a real master and real nodes in two network namespaces, on a wire that the kernel and a
program make bad: losses, delays, another order, cuts.

usage: netns.py FOLDER_OF_PROGRAMS
exit code 77: skipped, with the reason (not root, or no namespaces here)
"""
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from impairment import Wire, open_tun

SKIPPED = 77
PATIENCE = 20  # [s]
MASTER, NODES = "10.81.80.1", "10.81.80.2"
LOSS = 0.1


def command(*words, text=None):
    return subprocess.run([str(word) for word in words], input=text, capture_output=True, text=True, timeout=PATIENCE)


def must(*words, text=None):
    result = command(*words, text=text)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, words))}: {result.stderr.strip()}")
    return result.stdout


def reason_to_skip():
    if os.geteuid() != 0:
        return "only root may make network namespaces"
    for program in ("ip", "nft"):
        if not shutil.which(program):
            return f"{program} is missing; scripts/setup --tests installs it"
    name = f"qtplc-{os.getpid()}-try"
    if command("ip", "netns", "add", name).returncode != 0:
        return "this system allows no network namespaces"
    try:
        if not os.path.exists("/dev/net/tun"):
            return "there is no /dev/net/tun"
        rules = command("ip", "netns", "exec", name, "nft", "-f", "-", text=loss_rules(LOSS))
        return "" if rules.returncode == 0 else f"nft cannot lose packets here: {rules.stderr.strip().splitlines()[0]}"
    finally:
        command("ip", "netns", "delete", name)


def drop_rules(table, packets):
    """Drop such packets that arrive over the wire: one that is dropped on its way out would be an
    error of the sender, and who asks the master beside it wants an answer. None: drop nothing."""
    drop = f'iifname != "lo" {packets} drop\n' if packets else ""
    return (
        f"table inet {table}\ndelete table inet {table}\ntable inet {table} {{\n"
        f"chain arrive {{\ntype filter hook input priority 0;\n{drop}}}\n}}\n"
    )


def loss_rules(share):
    return drop_rules("loss", f"numgen random mod 1000 < {round(1000 * share)}" if share > 0 else "")


class Network:
    """Two namespaces with a wire between them."""

    def __init__(self):
        self.names = [f"qtplc-{os.getpid()}-{side}" for side in ("master", "nodes")]
        self.tuns, self.programs = [], []
        for name, address in zip(self.names, (MASTER, NODES)):
            must("ip", "netns", "add", name)
            interface = f"qp{os.getpid() % 100000}{len(self.tuns)}"
            self.tuns.append(open_tun(interface))
            must("ip", "link", "set", interface, "netns", name)
            must("ip", "-n", name, "address", "add", f"{address}/24", "dev", interface)
            must("ip", "-n", name, "link", "set", interface, "up")
            must("ip", "-n", name, "link", "set", "lo", "up")
        self.wire = Wire(*self.tuns, seed=7)
        self.wire.start()

    def filter(self, side, rules):
        must("ip", "netns", "exec", self.names[side], "nft", "-f", "-", text=rules)

    def lose(self, share):
        for side in (0, 1):
            self.filter(side, loss_rules(share))

    def close(self):
        for program in self.programs:
            program.kill()
        self.wire.stop()
        for tun in self.tuns:
            os.close(tun)
        for name in self.names:
            command("ip", "netns", "delete", name)


class Plant:
    def __init__(self, folder, network, scheme="udp://"):
        self.folder, self.network, self.programs = folder, network, network.programs
        self.start(
            0, "awe_master", "--listen", MASTER, "--port", "50000", "--insecure-network", "--profile", "simulation"
        )
        self.wait(lambda: self.ask("state").returncode == 0, "the master listens")
        for node in ("awe_model", "awe_autopilot"):
            self.start(1, node, "--master", f"{scheme}{MASTER}:50000")
        self.wait(lambda: {"Model", "Autopilot"} <= set(self.nodes()), "both nodes are there")
        started = self.ask("start")
        assert started.returncode == 0, started.stderr

    def inside(self, side):
        return ["ip", "netns", "exec", self.network.names[side]]

    def start(self, side, program, *options):
        words = [*self.inside(side), str(self.folder / program), *options]
        self.programs.append(subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    def ask(self, *words):
        return command(*self.inside(0), self.folder / "qtplc", f"--master={MASTER}:50000", *words)

    def state(self):
        result = self.ask("state", "--json")
        assert result.returncode == 0, f"no answer of the master: {result.stderr.strip()}"
        return json.loads(result.stdout)

    def nodes(self):
        return {node["name"]: node for node in self.state()["nodes"]}

    def events(self):
        return "\n".join(self.ask("events").stdout.splitlines()[-20:])

    def wait(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                raise AssertionError(f"in vain: {what}")
            time.sleep(0.05)

    def fly(self, seconds):
        """What has been counted of the autopilot and of all meanwhile."""
        before, node = self.state(), self.nodes()["Autopilot"]
        time.sleep(seconds)
        after, nodes = self.state(), self.nodes()
        assert after["state"] == "RealTime", f"{after['state']}\n{self.events()}"
        assert {"Model", "Autopilot"} <= set(nodes), f"a node has left: {', '.join(nodes)}\n{self.events()}"
        counted = {key: nodes["Autopilot"][key] - node[key] for key in ("lateAnswers", "duplicates", "rejected")}
        counted["cycles"] = after["counters"]["cycles"] - before["counters"]["cycles"]
        assert counted["cycles"] > 0.5 * seconds / 0.01, f"hardly a cycle: {counted}"
        return counted

    def close(self):
        for program in reversed(self.programs):
            program.terminate()
        codes = [program.wait(timeout=PATIENCE) for program in reversed(self.programs)]
        self.programs.clear()
        assert codes == [0] * len(codes), f"ended with {codes}"


def late_share(counted):
    return counted["lateAnswers"] / counted["cycles"]


def show(name, counted):
    print(
        f"{name:32} {counted['cycles']:5.0f} cycles, {100 * late_share(counted):5.1f} % without an answer in time, "
        f"{counted['duplicates']:.0f} came twice or late, {counted['rejected']:.0f} rejected",
        flush=True,
    )


def run(check):
    """Calls check(folder, network) in a network of its own, and ends what it leaves behind.
    \\return exit code"""
    reason = reason_to_skip()
    if reason:
        print(f"SKIPPED: {reason}")
        return SKIPPED
    network = Network()
    try:
        check(Path(sys.argv[1]), network)
    finally:
        network.close()
    return 0


def check(folder, network):
    plant = Plant(folder, network)
    wire = network.wire
    clean = plant.fly(2)
    show("as the wire is", clean)
    noise = late_share(clean)  # of a busy machine

    network.lose(LOSS)
    counted = plant.fly(5)
    network.lose(0)
    show("10 % loss in each direction", counted)
    expected = 1 - (1 - LOSS) ** 2
    # Chance alone gives 19 %; with TCP it would be twice as much, and a busy machine is late by
    # itself.
    assert expected - 0.09 < late_share(counted) < expected + 0.15 + noise, "not what chance says"
    assert counted["rejected"] == 0

    wire.delay, wire.jitter, wire.duplicate = 0.002, 0.001, 0.2
    counted = plant.fly(3)
    wire.mend()
    show("2 ... 3 ms delay, 20 % copies", counted)
    assert counted["duplicates"] > 5 and counted["rejected"] == 0

    wire.reorder, wire.jitter = 0.2, 0.012
    counted = plant.fly(3)
    wire.mend()
    show("mixed order, 12 ms jitter", counted)
    assert counted["duplicates"] > 5 and counted["rejected"] == 0 and counted["lateAnswers"] > 5

    wire.loss = 1.0
    time.sleep(0.6)  # a simulation holds the states of the kite as long as it takes; a plant would end the flight
    wire.mend()
    plant.wait(lambda: late_share(plant.fly(0.5)) < 0.5, "answers come again after a cut of 0.6 s")
    print("cut for 0.6 s                    answers come again", flush=True)
    wire.mend()
    plant.close()


if __name__ == "__main__":
    sys.exit(run(check))
