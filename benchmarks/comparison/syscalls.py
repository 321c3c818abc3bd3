# SPDX-License-Identifier: Apache-2.0
"""System calls per cycle of master and slaves, as the difference of two runs of the same length
with many and with few cycles.

What happens before and after the cycles falls out, and so does what happens so many times a second
whatever the period is.
"""
import collections
import json
import re
import subprocess
import tempfile
from pathlib import Path

CALL = re.compile(r"^(\w+)\(")
CHILD = re.compile(r"^(?:clone3?|v?fork)\((.*)\)?.* = (\d+)$")


def trace(command, folder):
    """\return figures of the run, and calls by name of master and slaves (all threads together)"""
    run = subprocess.run(
        ["timeout", "-s", "KILL", "120", "strace", "-ff", "-qq", "-o", f"{folder}/trace", *command],
        capture_output=True,
        text=True,
    )
    figures = json.loads(next(line for line in run.stdout.splitlines() if line.startswith("{")))
    calls, threads, processes = {}, collections.defaultdict(list), {}
    for path in Path(folder).glob("trace.*"):
        task = path.suffix[1:]
        calls[task] = collections.Counter()
        for line in path.read_text(errors="replace").splitlines():
            call = CALL.match(line)
            if call:
                calls[task][call.group(1)] += 1
            child = CHILD.match(line)
            if child and "CLONE_THREAD" in child.group(1):
                threads[task].append(child.group(2))
            elif child:
                processes[child.group(2)] = task
    slaves = set(processes)
    master = next(
        task for task in calls if task not in slaves and not any(task in family for family in threads.values())
    )
    return figures, with_threads(calls, threads, [master]), with_threads(calls, threads, slaves)


def with_threads(calls, threads, tasks):
    """Sum over \a tasks and their threads."""
    total, left = collections.Counter(), list(tasks)
    while left:
        task = left.pop()
        total += calls.get(task, collections.Counter())
        left += threads[task]
    return total


def per_cycle(bench, transport, slaves, cpu):
    """Calls of the master, and of one slave, per cycle: {call: number}."""
    runs = []
    for period_us in (20000, 5000):
        command = ["taskset", "-c", str(cpu), str(bench)]
        command += f"--transport {transport} --slaves {slaves} --period-us {period_us} --seconds 4 --warmup 0".split()
        with tempfile.TemporaryDirectory() as folder:
            runs.append(trace(command, folder))
    (few, few_master, few_slaves), (many, many_master, many_slaves) = runs
    cycles = many["all_cycles"] - few["all_cycles"]
    return difference(many_master, few_master, cycles), difference(many_slaves, few_slaves, cycles * slaves)


def difference(many, few, cycles):
    rates = {name: (many[name] - few[name]) / cycles for name in many}
    return {
        name: round(rate, 3) for name, rate in sorted(rates.items(), key=lambda item: -item[1]) if abs(rate) >= 0.005
    }
