#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the units of systemd: systemd-analyze finds nothing wrong with them, their sandbox is as
tight as it was, and every program takes the options that its service gives it.

The return code is 77 where systemd-analyze is missing: the rest was checked then.
"""
import argparse
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# Classes of devices that come with a module: systemd allows none that the kernel does not know when
# the service starts.
MODULES = {
    "char-i2c": "i2c_dev",
    "char-spi": "spidev",
    "char-iio": "industrialio",
    "char-ttyUSB": "usbserial",
    "char-ttyACM": "cdc_acm",
}
NO_CYCLE = {"qtplc-recorder.service"}  # these have no cycle, and ordinary scheduling
MOST_EXPOSED = 35  # tenths, as systemd-analyze security counts; "OK" begins at 50, "MEDIUM" above it
errors = []


def lines_of(path, key):
    return re.findall(rf"^{key}=(.*)$", path.read_text(), flags=re.M)


def environment(defaults, unit):
    """What the unit's files of the environment say."""
    values = {}
    for name in lines_of(unit, "EnvironmentFile"):
        path = defaults / (Path(name.lstrip("-")).name + ".default")
        if path.is_file():
            values.update(re.findall(r'^(\w+)="(.*)"$', path.read_text(), flags=re.M))
        elif not name.startswith("-"):
            errors.append(f"{unit.name}: there is no {path} for EnvironmentFile={name}")
    return values


def check_options(unit, programs, defaults):
    """A program that is asked for help reads its options before, and refuses those that it does not
    know."""
    values = environment(defaults, unit)
    for command in lines_of(unit, "ExecStart"):
        unknown = set(re.findall(r"\$(\w+)", command)) - set(values)
        if unknown:
            errors.append(f"{unit.name}: {', '.join(unknown)} is in no file of the environment")
        words = shlex.split(re.sub(r"\$(\w+)", lambda name: values.get(name[1], ""), command))
        program = programs / Path(words[0]).name
        if not program.is_file():
            print(f"{unit.name}: {program.name} is not part of this build")
            continue
        run = subprocess.run([program, *words[1:], "--help"], capture_output=True, text=True, timeout=60)
        if run.returncode != 0:
            errors.append(f"{unit.name}: {' '.join(words)} gives {run.returncode}: {run.stderr.strip()}")


def check_real_time(unit):
    """What the cycle needs, and the watchdog."""
    for key, wanted in {
        "Type": "notify",
        "LimitRTPRIO": "99",
        "LimitMEMLOCK": "infinity",
        "CPUSchedulingPolicy": "fifo",
        "NoNewPrivileges": "yes",
        "ProtectSystem": "strict",
        "PrivateTmp": "yes",
        "DevicePolicy": "closed",
    }.items():
        if lines_of(unit, key) != [wanted]:
            errors.append(f"{unit.name}: {key} is {lines_of(unit, key)}, not {wanted}")
    for key in ("WatchdogSec", "Restart", "RestrictAddressFamilies"):
        if len(lines_of(unit, key)) != 1:
            errors.append(f"{unit.name}: {key} is missing")


def check_modules(unit):
    """What brings the devices of a service is loaded before it starts, also where the computer has
    not been started since it was installed."""
    for device in lines_of(unit, "DeviceAllow"):
        module = MODULES.get(device.split()[0])
        for key in ("Wants", "After"):
            if module and f"modprobe@{module}.service" not in " ".join(lines_of(unit, key)).split():
                errors.append(f"{unit.name}: {key} has no modprobe@{module}.service, which DeviceAllow={device} needs")


def verify(units):
    return subprocess.run(
        ["systemd-analyze", "verify", "--man=no", *units], capture_output=True, text=True, timeout=120
    )


def check_with_systemd(options, folder):
    """The units as systemd reads them; their programs are those of the build."""
    units = []
    for unit in sorted(options.units.iterdir()):
        copy = folder / unit.name
        text = unit.read_text()
        for key in ("ExecStart", "ExecStopPost"):
            text = text.replace(f"{key}={options.installed}/", f"{key}={options.programs}/")
        copy.write_text(
            text if (options.programs / "qtplc_hardware").is_file() else text.replace("/qtplc_hardware ", "/qtplc ")
        )
        units.append(copy)
    run = verify(units)
    if run.returncode != 0 or any(unit.name in run.stderr for unit in units):
        errors.append(f"systemd-analyze verify: {run.stderr.strip()}")
    for unit in units:
        if unit.suffix == ".service":
            run = subprocess.run(
                ["systemd-analyze", "security", "--offline=yes", f"--threshold={MOST_EXPOSED}", "--no-pager", unit],
                capture_output=True,
                text=True,
                timeout=120,
            )
            if run.returncode != 0:
                errors.append(
                    f"systemd-analyze security: {unit.name}: "
                    f"{run.stdout.strip().splitlines()[-1:]} {run.stderr.strip()}"
                )
    broken = folder / "broken.service"
    broken.write_text(
        (folder / "qtplc-awe-master.service")
        .read_text()
        .replace("CPUSchedulingPolicy=fifo", "CPUSchedulingPolicy=fifth")
    )
    if "broken.service" not in verify([broken]).stderr:
        errors.append("systemd-analyze verify finds nothing in a unit that is wrong")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("units", "defaults", "programs"):
        parser.add_argument("--" + name, required=True, type=Path)
    parser.add_argument("--installed", required=True, help="folder of the programs in the units")
    options = parser.parse_args()
    services = sorted(options.units.glob("*.service"))
    for unit in services:
        check_options(unit, options.programs, options.defaults)
        if unit.name not in NO_CYCLE:
            check_real_time(unit)
        check_modules(unit)
    has_systemd = shutil.which("systemd-analyze") is not None
    if has_systemd:
        with tempfile.TemporaryDirectory() as folder:
            check_with_systemd(options, Path(folder))
    print("\n".join(errors) or f"{len(services)} services are in order")
    if errors or not services:
        return 1
    if not has_systemd:
        print("skipped: systemd-analyze is missing (Debian: systemd)")
        return 77
    return 0


if __name__ == "__main__":
    sys.exit(main())
