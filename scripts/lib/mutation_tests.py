#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs functions of Qt Test programs up to the first that fails, and decides which to run first.
docs/design/mutation.md says how. Used by mutate.py."""
import os
import re
import select
import signal
import subprocess
import threading
import time
from dataclasses import dataclass, field

FAILURE = re.compile(r"^(?:FAIL!|XPASS|QFATAL)\s*: \w+::(\w+)\(", re.M)
PASSED = re.compile(r"^PASS\s*: \w+::(\w+)\(", re.M)
LONGEST_ADDED = 10.0  # [s] given to functions beside five times their own duration
CPU_ADDED = 2  # [s] of a processor, likewise
BORDERS = (0.1, 0.3, 1.0, 3.0, 10.0, 30.0)  # [s] functions that take about as long run in one process


@dataclass
class Outcome:
    how: str  # passed, failed, time-out
    failed: str = ""  # the function, if it is known
    passed: tuple = ()
    cpu: float = 0.0  # [s]
    seconds: float = 0.0


class Program:
    def __init__(self, name, path, lock):
        self.name, self.path, self.lock = name, path, lock

    def functions(self):
        listed = subprocess.run(
            [self.path, "-functions"], env=environment(), stdin=subprocess.DEVNULL, capture_output=True, text=True
        )
        return re.findall(r"^(\w+)\(\)$", listed.stdout, re.M)

    def run(self, functions, seconds, cpu, **variables):
        """Ends the program, and what it has started, at the first function that fails."""
        begin = time.monotonic()
        command = ["sh", "-c", 'ulimit -c 0; ulimit -t "$0"; exec "$@"', str(int(cpu) + 1), str(self.path), *functions]
        test = subprocess.Popen(
            command,
            env=environment(**variables),
            cwd=self.path.parent,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            how, text = followed(test, begin + seconds)
        finally:
            try:
                os.killpg(test.pid, signal.SIGKILL)  # the session is ours
            except ProcessLookupError:
                pass
            _, status, usage = os.wait4(test.pid, 0)
            test.returncode = os.waitstatus_to_exitcode(status)
            test.stdout.close()
        failure = FAILURE.search(text)
        if how == "ended":
            how = "passed" if test.returncode == 0 else "failed"
        return Outcome(
            how,
            failure.group(1) if failure else "",
            tuple(PASSED.findall(text)),
            usage.ru_utime + usage.ru_stime,
            time.monotonic() - begin,
        )


def environment(**variables):
    return {**os.environ, "QT_QPA_PLATFORM": "offscreen", **variables}


def followed(test, end):
    """How the program ended, and what it wrote: ended, failed or time-out."""
    process, text = os.pidfd_open(test.pid), ""
    sources = [test.stdout, process]
    try:
        while True:
            ready = select.select(sources, [], [], max(end - time.monotonic(), 0))[0]
            if not ready:
                return "time-out", text
            if test.stdout in ready:
                part = os.read(test.stdout.fileno(), 1 << 16)
                text += part.decode(errors="replace")
                if not part:
                    sources.remove(test.stdout)
                if FAILURE.search(text):
                    return "failed", text
            elif process in ready:
                return "ended", text
    finally:
        os.close(process)


@dataclass
class Function:
    """A function of a test as it is without a mutation."""

    program: Program
    name: str
    seconds: float
    cpu: float
    reached: bytes  # one byte for each mutant
    tried: int = 0
    killed: int = 0

    def __post_init__(self):
        self.guess = min(0.5, 30 / (1 + sum(map(bool, self.reached))))  # one that reaches few places tests these places

    def chance(self):
        return (self.killed + 10 * self.guess) / (self.tried + 10)


@dataclass
class Verdict:
    killer: str = ""
    how: str = "survived"
    cpu: float = 0.0  # [s]
    unsteady: list = field(default_factory=list)


class Batch:
    """Functions of one program, in one process."""

    def __init__(self, functions):
        self.program, self.functions = functions[0].program, functions

    def worth(self):
        """Time for each mutant that it kills."""
        lives = 1.0
        for function in self.functions:
            lives *= 1 - function.chance()
        return (0.1 + sum(f.seconds + f.cpu for f in self.functions)) / (1 - lives)

    def run(self, functions, **variables):
        seconds = 5 * sum(f.seconds for f in functions) + LONGEST_ADDED
        cpu = 5 * sum(f.cpu for f in functions) + CPU_ADDED
        return self.program.run([f.name for f in functions], seconds, cpu, **variables)

    def judge(self, verdict, **variables):
        """Adds to the verdict. What fails twice kills, if it passes without the mutant now;
        else it is unsteady, and the others go on."""
        rest = self.functions
        while rest and not verdict.killer:
            outcome = self.run(rest, **variables)
            verdict.cpu += outcome.cpu
            if outcome.how == "passed":
                break
            names = [f.name for f in rest]
            known = outcome.failed in names  # others may have passed behind it, before the program was ended
            first = (
                names.index(outcome.failed)
                if known
                else max((names.index(name) for name in outcome.passed if name in names), default=0)
            )
            suspects = rest[first : first + 1] if known else rest[first:]
            again = self.run(suspects, **variables)
            verdict.cpu += again.cpu
            if again.how != "passed" and self.run(suspects, QTPLC_MUTANT="0").how == "passed":
                verdict.killer, verdict.how = (
                    f"{self.program.name} {again.failed or outcome.failed or names[first]}",
                    again.how,
                )
            else:
                verdict.unsteady.append(f"{self.program.name} {names[first]}")
                rest = rest[first + 1 :] if known else []
        for function in self.functions:
            function.tried += 1
            function.killed += verdict.killer == f"{self.program.name} {function.name}"


def batches(functions):
    """What is worth most comes first."""
    groups = {}
    for function in sorted(functions, key=lambda f: f.seconds):
        border = sum(function.seconds > b for b in BORDERS)
        groups.setdefault((function.program.name, border), []).append(function)
    return sorted(map(Batch, groups.values()), key=Batch.worth)


class Locks:
    """No test program runs twice at the same time, nor beside one with the same RESOURCE_LOCK."""

    def __init__(self):
        self.changed, self.held = threading.Condition(), set()

    def take_first(self, batches):
        """The first whose lock is free."""
        with self.changed:
            while True:
                for batch in batches:
                    if batch.program.lock not in self.held:
                        self.held.add(batch.program.lock)
                        return batch
                self.changed.wait()

    def give_back(self, batch):
        with self.changed:
            self.held.remove(batch.program.lock)
            self.changed.notify_all()
