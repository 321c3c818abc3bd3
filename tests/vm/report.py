#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/vm.md from the results of the virtual machine.

usage: report.py FOLDER SECONDS   FOLDER  build/vm; SECONDS  duration of the whole run
"""
import datetime
import json
import sys
from pathlib import Path


def rows(cells):
    return "\n".join(
        "| " + " | ".join(str(cell).replace("|", "\\|").replace("\n", " ") for cell in row) + " |" for row in cells
    )


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
    print(
        f"""# The virtual machine

`scripts/test-vm` boots the kernel of Debian with PREEMPT_RT in QEMU, on emulated processors, with
the test devices of the kernel: CAN (`vcan`), GPIO (`gpio-sim`), I2C (`i2c-stub`, with chips for its
drivers `lm75` and `ti-ads1015`), SPI (`spidev` on a bus without wires, `tests/vm/spi_loop`). It
tests the hardware library with these devices, and a master with nodes under `SCHED_FIFO`. It needs
root and Debian 12 on x86-64, but no rights for virtualisation and no CAN, GPIO or I2C of the
computer. It is a separate job: it takes three minutes to more than fifteen, depending on the
computer that emulates. `scripts/test-vm --run COMMAND` runs your command there.

The times do not show performance, because the processors are emulated. The script writes this page.

| last run | |
|---|---|
| date | {datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC |
| kernel | {report['kernel']}, `{report['version']}` |
| result | {verdict}{f", {results.count('skipped')} skipped" if "skipped" in results else ""} |
| time, from the first command to the last | {seconds} s |

## In the machine

It was ready {report['booted']:.0f} s after its start.

| | s | | |
|---|---|---|---|
{rows((step['result'], step['seconds'], step['name'], step['detail']) for step in report['steps'])}

## Before that

Packages, downloads and builds are kept, so a repeated run needs little time for them.

| s | |
|---|---|
{rows(host)}"""
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
