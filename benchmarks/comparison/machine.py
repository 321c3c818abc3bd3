# SPDX-License-Identifier: Apache-2.0
"""The machine on which is measured: what it is, what it is allowed, and what others do on it."""
import os
import platform
import resource
import shutil
import subprocess
import time
from pathlib import Path

# Loopback alone: exact byte counts, multicast, nothing from outside.
NAMESPACE = (
    "unshare",
    "-n",
    "sh",
    "-c",
    'ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo; exec "$@"',
    "sh",
)


def busy_seconds():
    """CPU time of the whole machine (stolen time included), and of our own children that have
    ended."""
    fields = Path("/proc/stat").read_text().splitlines()[0].split()
    user, nice, system, _idle, _wait, irq, softirq, steal = (int(field) for field in fields[1:9])
    own = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK"), own.ru_utime + own.ru_stime


class Foreign:
    """CPUs that others used since it was made."""

    def __init__(self):
        self.before, self.start = busy_seconds(), time.monotonic()

    def cpus(self):
        after, wall = busy_seconds(), max(time.monotonic() - self.start, 1e-3)
        return max(0.0, (after[0] - self.before[0]) - (after[1] - self.before[1])) / wall


def succeeds(*command):
    try:
        return subprocess.run(command, capture_output=True, timeout=10).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


def can_fifo():
    return succeeds("timeout", "-s", "KILL", "5", "chrt", "-f", "49", "true")


def namespace():
    return NAMESPACE if succeeds(*NAMESPACE, "true") else ()


def is_there(program):
    return shutil.which(program) is not None


def description():
    """One line: processor, cores, kernel, scheduling. Names no host."""
    model = next(
        (
            line.split(":", 1)[1].strip()
            for line in Path("/proc/cpuinfo").read_text().splitlines()
            if line.startswith("model name")
        ),
        platform.machine(),
    )
    virtual = "virtual, " if succeeds("grep", "-qw", "hypervisor", "/proc/cpuinfo") else ""
    preempt = "PREEMPT_RT" if "PREEMPT_RT" in platform.version() else "not PREEMPT_RT"
    return f"{model} ({virtual}{os.cpu_count()} CPUs), Linux {platform.release().split('-')[0]} ({preempt})"
