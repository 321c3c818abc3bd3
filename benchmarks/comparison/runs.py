# SPDX-License-Identifier: Apache-2.0
"""Runs programs in rounds, in random order, and finds medians and best rounds."""
import json
import random
import statistics
import subprocess
import sys
from dataclasses import dataclass

from . import machine


@dataclass(frozen=True)
class Configuration:
    """How a program is run. cpu: all processes on this one; None: as the scheduler likes."""

    mode: str
    slaves: int
    period_us: int = 0
    policy: str = "other"
    cpu: object = 0


class Runner:
    def __init__(self, quiet, seconds):
        self.quiet, self.seconds = quiet, seconds
        self.namespace = machine.namespace()
        self.results = []
        self.failures = {}

    def command(self, program, configuration, seconds):
        line = ["timeout", "-s", "KILL", str(int(seconds) + 40)]  # a real-time process that runs away is ended
        if configuration.cpu is not None:
            line += ["taskset", "-c", str(configuration.cpu)]
        if configuration.policy == "fifo":
            line += ["chrt", "-f", "49"]
        line += [*self.namespace, *program.command]
        line += f"--slaves {configuration.slaves} --in 3 --out 32 --period-us {configuration.period_us}".split()
        return line + ["--seconds", f"{seconds:g}", "--warmup", "0.2"]

    def run(self, program, configuration, seconds=None):
        """The figures of one run; None when the program gave none."""
        if configuration.slaves > program.most:
            return None
        if program.name in self.failures and "not available" in self.failures[program.name]:
            return None
        foreign = machine.Foreign()
        run = subprocess.run(
            self.command(program, configuration, seconds or self.seconds), capture_output=True, text=True
        )
        lines = [line for line in run.stdout.splitlines() if line.startswith("{")]
        if not lines:
            self.failures[program.name] = run.stderr.strip()[-200:] or f"exit code {run.returncode}"
            return None
        result = {
            **json.loads(lines[-1]),
            "name": program.name,
            "mode": configuration.mode,
            "cpu": configuration.cpu,
            "foreign_cpus": round(foreign.cpus(), 2),
        }
        result["noisy"] = result["foreign_cpus"] > self.quiet
        self.results.append(result)
        return result

    def rounds(self, programs, configuration, count):
        """All programs in each round, so that what the machine does to one it does to all."""
        for number in range(count):
            progress(f"{configuration.mode}, {configuration.slaves} slaves, round {number + 1} of {count}")
            for program in random.sample(programs, len(programs)):
                self.run(program, configuration)


def progress(text):
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


class Results:
    """The figures of all runs, to be asked for by mode, number of slaves and program."""

    def __init__(self, results):
        self.all = results

    def of(self, mode, slaves, name):
        return [r for r in self.all if (r["mode"], r["slaves"], r["name"]) == (mode, slaves, name)]

    def names(self, mode, slaves):
        return list(dict.fromkeys(r["name"] for r in self.all if (r["mode"], r["slaves"]) == (mode, slaves)))

    def best(self, mode, slaves, name, key):
        """The smallest value of all rounds: what the program needs when nobody is in its way."""
        values = [r[key] for r in self.of(mode, slaves, name) if key in r]
        return min(values) if values else None

    def median(self, mode, slaves, name, key):
        values = [r[key] for r in self.of(mode, slaves, name) if key in r]
        return statistics.median(values) if values else None

    def missed(self, mode, slaves, name, how=statistics.median):
        values = [missed_share(r) for r in self.of(mode, slaves, name)]
        return how(values) if values else None

    def ratio(self, mode, slaves, name, other, key, how="best"):
        figure = getattr(self, how)
        ours, theirs = figure(mode, slaves, name, key), figure(mode, slaves, other, key)
        return ours / theirs if ours is not None and theirs else None

    def noisy(self):
        return sum(1 for r in self.all if r["noisy"])


def missed_share(result):
    """Share of the periods that were left out or not complete in time: some programs count a long
    one once, and leave it at that."""
    due = max(1.0, result["seconds"] * 1e6 / result["period_us"])
    return max(result["overruns"], due - result["cycles"] - 2, 0.0) / due if result["cycles"] else 1.0
