# SPDX-License-Identifier: Apache-2.0
"""How late a cycle begins, beside cyclictest and a bare clock_nanosleep loop."""
import json
import os
import random
import re
import statistics
import subprocess
from pathlib import Path

from . import machine

LONGEST = 20000  # [us] last bin of cyclictest


def limited(command, seconds, policy):
    line = ["timeout", "-s", "KILL", str(int(seconds) + 30)]
    if policy == "fifo":
        line += ["chrt", "-f", "49"]
    return subprocess.run(line + command, capture_output=True, text=True).stdout


def of_bench(bench, period_us, seconds, policy, *options):
    output = limited(
        [str(bench), "--transport", "inprocess", "--period-us", str(period_us), "--seconds", f"{seconds:g}", *options],
        seconds,
        policy,
    )
    result = json.loads(output)
    return result["late_p50_us"], result["late_p99_us"]


def of_timer(timer, period_us, seconds, policy):
    output = limited(
        [str(timer), "--variant", "nanosleep", "--period-us", str(period_us), "--seconds", f"{seconds:g}"],
        seconds,
        policy,
    )
    result = json.loads(output)
    return result["late_p50_us"], result["late_p99_us"]


def of_cyclictest(period_us, seconds, policy):
    scheduling = ["-p49"] if policy == "fifo" else ["--policy=other"]
    loops = str(int(seconds * 1e6 / period_us))
    output = limited(
        ["cyclictest", "-q", "-m", "-t1", *scheduling, "-i", str(period_us), "-l", loops, "-h", str(LONGEST)],
        seconds,
        policy,
    )
    bins = [(int(us), int(count)) for us, count in re.findall(r"^(\d{6}) (\d{6,})$", output, re.MULTILINE)]
    return quantile(bins, 0.5), quantile(bins, 0.99)


def quantile(bins, q):
    wanted, seen = q * sum(count for _, count in bins), 0
    for us, count in bins:
        seen += count
        if seen >= wanted:
            return float(us) + 0.5  # whole microseconds, cut off
    raise ValueError("cyclictest gave no histogram")


def measure(bench, peers, period_us, policy, seconds, rounds):
    """Name -> (best p50, best p99, median p50, median p99) [us]."""
    ways = {"qtplc": lambda: of_bench(bench, period_us, seconds, policy)}
    if machine.is_there("cyclictest"):
        # It keeps the processors awake while it runs: compared with a master that does so, too.
        ways["cyclictest"] = lambda: of_cyclictest(period_us, seconds, policy)
        ways["qtplc, processors awake"] = lambda: of_bench(bench, period_us, seconds, policy, "--idle-latency-us", "0")
    timer = Path(peers, "timer_jitter") if peers else None
    if timer and os.access(timer, os.X_OK):
        ways["timer_jitter"] = lambda: of_timer(timer, period_us, seconds, policy)
    seen = {name: [] for name in ways}
    for _ in range(rounds):
        for name in random.sample(list(ways), len(ways)):
            try:
                seen[name].append(ways[name]())
            except (ValueError, KeyError):
                continue  # it gave no figures; the others did
    return {
        name: tuple(how(v[i] for v in values) for how in (min, statistics.median) for i in (0, 1))
        for name, values in seen.items()
        if values
    }
