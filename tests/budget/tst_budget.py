#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants costs in the step of a slave, and checks that budget.py finds each of them and says what
to do. Of a build without a budget it says that it is skipped.

usage: tst_budget.py PROGRAM BUILD
"""
import re
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
PLANTED = {  # cost: where it has to be found, and what the sentence has to name
    "allocation": ("costs, udp", "costs, udp slave allocations"),
    "lock": ("costs, local", "costs, local slave locks"),
    "page-fault": ("costs, udp", "costs, udp slave page_faults"),
    "system-call": ("system calls, slave, udp", "system calls, slave, udp"),
    "instructions": ("instructions, {build}: slave, udp", "instructions, {build}: slave, udp"),
}


def budget(program, build, *arguments):
    command = [sys.executable, "-B", str(Path(__file__).with_name("budget.py")), "--program", program, "--build", build]
    return subprocess.run([*command, *arguments], capture_output=True, text=True)


def judge(program, build, planted):
    case, text = (value.format(build=build) for value in PLANTED[planted])
    run = budget(program, build, "--plant", planted, "--only", case)
    if run.returncode == SKIPPED:
        return SKIPPED, run.stdout
    found = (
        run.returncode == 1
        and re.search(rf"BUDGET EXCEEDED: {re.escape(text)}: a cycle costs [1-9].*the budget is \d", run.stdout)
        and "--write" in run.stdout
    )
    return 0 if found else 1, run.stdout + run.stderr


def skips_debug_builds(program):
    run = budget(program, "GNU 12 Debug x86_64", "--only", "instructions")
    says = (
        "SKIPPED instructions, GNU 12 Debug x86_64: inprocess: this build is not judged, but GNU 12 -O2 x86_64"
        in run.stdout
    )
    print("skipped: a Debug build" if says else f"NOT SKIPPED: a Debug build\n{run.stdout}{run.stderr}")
    return run.returncode == SKIPPED and says


def main():
    codes = [0 if skips_debug_builds(sys.argv[1]) else 1]
    for planted in PLANTED:
        code, output = judge(sys.argv[1], sys.argv[2], planted)
        codes.append(code)
        print(
            {0: f"found: {planted}", 1: f"NOT FOUND: {planted}\n{output}", SKIPPED: f"SKIPPED {planted}: {output}"}[
                code
            ],
            flush=True,
        )
    return 1 if 1 in codes else max(codes)


if __name__ == "__main__":
    sys.exit(main())
