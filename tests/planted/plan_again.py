#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sees that qtplc_simulate with a planted defect writes a plan that fails again.

plan_again.py PROGRAM OPTION...   PROGRAM fails with these options
"""
import subprocess
import sys
import tempfile
from pathlib import Path


def run(*command):
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 1:
        sys.exit(f"exit code {result.returncode} and not 1: {' '.join(command)}\n{result.stdout}")
    return result.stdout


def check(what, expected, output):
    if expected not in output:
        sys.exit(f"{what}: '{expected}' is missing in\n{output}")


def main(program, *options):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "plan"
        first = run(program, *options, "--write-plan", str(file))
        plan = file.read_text()
        check("the first run prints the plan", plan, first)
        check("and how to run it", f"again: qtplc_simulate --plan {file} --report\n", first)
        violation, digest = (line.removeprefix("# ") for line in plan.splitlines()[:2])
        again = run(program, "--plan", str(file), "--report")
        check("the plan fails in the same way", f"plan {file}: {violation}\n", again)
        check("with the same traffic", f"\n{digest}\n", again)
        check("and is the shortest one", plan, again)


if __name__ == "__main__":
    main(*sys.argv[1:])
