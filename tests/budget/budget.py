#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares what a cycle costs with what it may cost, in numbers that do not depend on the machine.

Exit code 0: within the budget; 1: something costs more; 2: it could not be counted; 77: a tool is
missing, and the rest is within the budget.

A count may exceed its budget by the tolerance of the file; a count with the budget 0 may not exceed
it at all. What is promised is no budget: --write does not change it.
"""
import argparse
import json
import os
import shlex
import sys
from pathlib import Path

from measure import Failed, Runs, Skipped

SKIPPED = 77  # exit code, as CTest is told
MILLION = 1_000_000
NETWORK_CYCLES = 20_000
PACED = {"period_us": 1000, "lengths": (300, 900)}
INTERRUPTIONS = 0.1  # a cycle: now and then a timer ends a wait, so that stop is noticed
TRIES = 5  # a loaded machine makes threads wake up more often: the cheapest try counts
FEW = {"lengths": (300, 900)}


def groups(runs, build):
    """Name of the group: the functions that count, under the names of their budgets."""

    def calls(*case, **more):
        return lambda: {"": sum(runs.system_calls(*case, **more).values())}

    def instructions(*case):
        return lambda: {"": runs.instructions(*case)["instructions"]}

    return {
        "costs": {
            "inprocess": lambda: runs.costs("inprocess", MILLION),
            "steps": lambda: runs.costs("steps", MILLION),
            **{kind: (lambda kind=kind: runs.costs(kind, NETWORK_CYCLES)) for kind in ("udp", "tcp", "local")},
        },
        "bytes": {"udp frame": runs.frames},
        "system calls": {
            "steps": calls("master", "steps", 1),
            "slave, udp": calls("slave", "udp", 1),
            "slave, tcp": calls("slave", "tcp", 1),
            "slave, local": calls("slave", "local", 1),
            "slave, udp at 1 kHz": calls("slave", "udp", 1, **PACED),
            "master, udp": calls("master", "udp", 1),
            "master, local": calls("master", "local", 1),
            "master of 10, udp": calls("master", "udp", 10),
            "master of 10, udp at 1 kHz": calls("master", "udp", 10, **PACED),
            "master of 10, tcp": calls("master", "tcp", 10, **FEW),
            "master of 10, local": calls("master", "local", 10, **FEW),
        },
        "instructions": {
            f"{build}: inprocess": instructions("master", "inprocess", 1),
            f"{build}: steps": instructions("master", "steps", 1),
            f"{build}: inprocess, 10 nodes": instructions("master", "inprocess", 10),
            f"{build}: master, udp": instructions("master", "udp", 1),
            f"{build}: slave, udp": instructions("slave", "udp", 1),
        },
    }


def take_turns():
    """Puts this process and its children on one core, where none of them interrupts another: how
    often each waits depends less on what else the machine does."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))


class Check:
    def __init__(self, path, budget, write):
        self.path, self.budget, self.write = path, budget, write
        self.exceeded, self.skipped = [], []

    def group(self, name, counters, only):
        for case, counter in counters.items():
            if only and name not in only and f"{name}, {case}" not in only:
                continue
            known = self.budget.setdefault(name, {})
            try:
                if not self.write and not any(key == case or key.startswith(case + " ") for key in known):
                    raise Skipped(self.unknown(name))
                for what, seen in self.cheapest(name, case, counter).items():
                    self.compare(name, f"{case} {what}".strip(), seen)
            except Skipped as reason:
                self.skipped.append(f"{name}, {case}: {reason}")
                print(f"SKIPPED {self.skipped[-1]}", flush=True)

    def unknown(self, group):
        remedy = f"remedy: {shlex.join(sys.argv)} --write"
        if group != "instructions":
            return f"there is no budget for it; {remedy}"
        builds = sorted({key.split(":")[0] for key in self.budget[group]})
        return f"this build is not judged, but {', '.join(builds)}; if users get it, {remedy}"

    def cheapest(self, group, case, counter):
        seen = counter()
        for _ in range(TRIES - 1):
            if all(value <= self.allowed(group, f"{case} {what}".strip()) for what, value in seen.items()):
                break
            again = counter()
            seen = {what: min(value, again[what]) for what, value in seen.items()}
        return seen

    def allowed(self, group, name):
        budget = self.budget[group].get(name, 0)
        if group == "bytes":
            return budget
        promised = self.budget["promised"].get(group, {}).get(name, budget * (1 + self.budget["tolerance"]))
        return min(budget * (1 + self.budget["tolerance"]), promised) + (
            INTERRUPTIONS if group == "system calls" else 0
        )

    def compare(self, group, name, seen):
        seen = round(seen, 2)
        if self.write:
            self.budget[group][name] = round(seen)
        budget, allowed = self.budget[group].get(name, 0), self.allowed(group, name)
        print(
            f"{'ok     ' if seen <= allowed else 'EXCEEDS'} {group}, {name}: {seen:g}, "
            f"budget {budget:g}, allowed {allowed:g}",
            flush=True,
        )
        if seen > allowed:
            self.exceeded.append(
                f"{group}, {name}: a cycle costs {seen:g}; the budget is {budget:g}, "
                f"and more than {allowed:g} is too much"
            )

    def result(self):
        if self.write:
            self.path.write_text(json.dumps(self.budget, indent=2) + "\n")
            print(f"written: {self.path}")
        for text in self.exceeded:
            print(f"BUDGET EXCEEDED: {text}")
        if self.exceeded:
            print(
                "Remedy: make it cheaper. If it is meant to cost that, renew the budget and say in the commit why: "
                f"{shlex.join(sys.argv)} --write"
            )
            return 1
        return SKIPPED if self.skipped else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, required=True, help="budget_cycles of the build to be judged")
    parser.add_argument(
        "--build", default="unknown", help="compiler and optimisation of that build: instructions depend on it"
    )
    parser.add_argument(
        "--only",
        action="append",
        help="a group (costs, bytes, system calls, instructions), or one case of it: 'costs, udp'",
    )
    parser.add_argument("--write", action="store_true", help="make what is seen the budget")
    parser.add_argument(
        "--plant",
        default="",
        help="an extra cost that has to be found: allocation, lock, page-fault, system-call, instructions",
    )
    arguments = parser.parse_args()
    path = Path(__file__).resolve().with_name("budget.json")
    check = Check(path, json.loads(path.read_text()), arguments.write)
    if arguments.write and arguments.plant:
        parser.error("--write keeps what is seen, and --plant makes it wrong: use one of them")
    everything = groups(Runs(arguments.program, arguments.plant), arguments.build)
    names = {*everything, *(f"{group}, {case}" for group, cases in everything.items() for case in cases)}
    unknown = set(arguments.only or ()) - names
    if unknown or not os.access(arguments.program, os.X_OK):
        parser.error(
            f"no group {unknown}; there are {'; '.join(sorted(names))}"
            if unknown
            else f"{arguments.program} is no program; build budget_cycles"
        )
    take_turns()
    try:
        for name, counters in everything.items():
            check.group(name, counters, arguments.only)
    except Failed as reason:
        print(f"budget: could not count: {reason}")
        return 2
    return check.result()


if __name__ == "__main__":
    sys.exit(main())
