#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/test-vm runs in its virtual machine: makes the devices, tests with them, and writes
/run/vm/report.json.

usage: guest.py [--prepare-only]
"""
import json
import platform
import sys
import time
import traceback
from pathlib import Path

import devices
import hardware
import plant
from steps import Skipped

REPORT = Path("/run/vm/report.json")


def steps(bench):
    """Name and function of each step. A function returns what is worth reading, or None; it raises
    when something is wrong."""
    yield "kernel with PREEMPT_RT", devices.kernel_is_real_time
    yield "CAN of the kernel: vcan, classic and FD", bench.make_can
    yield "GPIO of the kernel: gpio-sim", bench.make_gpio
    yield "I2C of the kernel: i2c-stub", bench.make_i2c
    yield "hwmon and IIO of the kernel: LM75 and ADS1015 at i2c-stub", bench.make_sysfs
    yield "SPI of the kernel: spidev on a bus without wires", bench.make_spi
    yield "SPI: the kernel's own spi-loopback-test", bench.test_spi
    yield from hardware.steps(bench)
    yield from plant.steps(bench)


def run(name, function):
    start = time.monotonic()
    try:
        result, detail = "passed", function()
    except Skipped as reason:
        result, detail = "skipped", str(reason)
    except Exception as error:  # whatever it was, the others are run
        result, detail = "FAILED", str(error) or type(error).__name__
        traceback.print_exc(file=sys.stdout)
    step = {"name": name, "result": result, "seconds": round(time.monotonic() - start, 1), "detail": detail or ""}
    print(f"{step['seconds']:7.1f} s  {result:7}  {name}{': ' + step['detail'] if detail else ''}", flush=True)
    return step


def main():
    with open("/proc/uptime") as uptime:
        booted = float(uptime.read().split()[0])
    print(f"{booted:7.1f} s  the machine is up", flush=True)
    bench = devices.Bench()
    if "--prepare-only" in sys.argv:
        for function in (bench.make_can, bench.make_gpio, bench.make_i2c, bench.make_sysfs, bench.make_spi):
            function()
        return 0
    done = [run(name, function) for name, function in steps(bench)]
    REPORT.write_text(
        json.dumps(
            {"kernel": platform.release(), "version": platform.version(), "booted": booted, "steps": done}, indent=1
        )
    )
    failed = [step for step in done if step["result"] == "FAILED"]
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
