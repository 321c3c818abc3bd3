#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/vm.md of what the virtual machine has said.

usage: report.py FOLDER SECONDS   FOLDER  build/vm; SECONDS  how long all of it took
"""
import datetime
import json
import sys
from pathlib import Path


def rows(cells):
    return "\n".join("| " + " | ".join(str(cell).replace("|", "\\|").replace("\n", " ") for cell in row) + " |" for row in cells)


def main():
    folder, seconds = Path(sys.argv[1]), int(sys.argv[2])
    host = [line.split("\t") for line in (folder / "steps").read_text().splitlines()]
    file = folder / "results/report.json"
    if not file.exists():
        print("# The virtual machine\n\nThe last run gave no result: `scripts/test-vm`.")
        return 1
    report = json.loads(file.read_text())
    results = [step["result"] for step in report["steps"]]
    verdict = "passed" if "FAILED" not in results else f"FAILED: {results.count('FAILED')} of {len(results)} steps"
    print(f"""# The virtual machine

`scripts/test-vm` boots Debian's kernel with PREEMPT_RT in QEMU, on processors that are emulated, with the devices that the kernel has for tests: CAN (`vcan`), GPIO (`gpio-sim`), I2C (`i2c-stub`), SPI (`spidev` on a bus without wires,
`tests/vm/spi_loop`). The hardware library, and a master with nodes under `SCHED_FIFO`, are tested with them. It needs root and Debian 12 on x86-64, no rights to virtualisation and no CAN, GPIO or I2C of the computer. It is a job of its own: how long it takes depends on the computer that emulates, three minutes to more than fifteen.
`scripts/test-vm --run COMMAND` runs a command of yours there.

Times are for function only: a program emulates these processors. This page is written by the script.

| last run | |
|---|---|
| date | {datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC |
| kernel | {report['kernel']}, `{report['version']}` |
| result | {verdict}{f", {results.count('skipped')} skipped" if "skipped" in results else ""} |
| time, from the first command to the last | {seconds} s |

## In the machine

It was up {report['booted']:.0f} s after its start.

| | s | | |
|---|---|---|---|
{rows((step['result'], step['seconds'], step['name'], step['detail']) for step in report['steps'])}

## Before that

What is there already takes no time: packages, downloads and builds are kept.

| s | |
|---|---|
{rows(host)}""")
    return 0


if __name__ == "__main__":
    sys.exit(main())
