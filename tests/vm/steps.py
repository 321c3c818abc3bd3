# SPDX-License-Identifier: Apache-2.0
"""What all steps of the virtual machine need: programs with an end, and conditions that are waited
for."""
import os
import signal
import subprocess
import time

PROGRAMS = os.environ.get("QTPLC_PROGRAMS", "build/release/bin")


class Skipped(Exception):
    """Why a step could not be run."""


def command(*words, seconds=60, text=None, environment=None):
    """Runs a program to its end. \\return what it printed; raises when it failed or took too
    long"""
    words = [str(word) for word in words]
    result = subprocess.run(
        words,
        input=text,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=seconds,
        env={**os.environ, **(environment or {})},
    )
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(words)}: exit code {result.returncode}\n{result.stdout[-4000:]}")
    return result.stdout


def wait_until(condition, what, seconds=30.0, pause=0.002):
    """\\return how long it took [s]"""
    start = time.monotonic()
    while not condition():
        if time.monotonic() - start > seconds:
            raise RuntimeError(f"{what}: not within {seconds} s")
        time.sleep(pause)
    return time.monotonic() - start


def program(name):
    """Path of a program of the build; it is a reason to skip a step that there is none."""
    path = os.path.join(PROGRAMS, name)
    if not os.path.exists(path):
        raise Skipped(f"{name} is not built")
    return path


class Process:
    """A program that runs beside the test, and is gone when the block is left. Its output is in a
    file."""

    def __init__(self, *words, environment=None):
        self.words = [str(word) for word in words]
        self.log = f"/run/{os.path.basename(self.words[0])}-{id(self)}.log"
        self.environment = {**os.environ, **(environment or {})}

    def __enter__(self):
        with open(self.log, "w") as log:
            self.process = subprocess.Popen(
                self.words, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, env=self.environment
            )
        return self

    def __exit__(self, kind, error, trace):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        if error is not None and not isinstance(error, Skipped):
            print(f"--- output of {' '.join(self.words)}:\n{self.output()[-2000:]}", flush=True)

    def output(self):
        with open(self.log, errors="replace") as log:
            return log.read()

    def wait_for(self, text, seconds=60.0):
        def is_there():
            if text in self.output():
                return True
            if self.process.poll() is not None and text not in self.output():
                raise RuntimeError(f"{self.words[0]} ended with {self.process.returncode} before it said '{text}'")
            return False

        return wait_until(is_there, f"'{text}' of {self.words[0]}", seconds)

    def send(self, number):
        self.process.send_signal(number)

    def kill(self):
        self.send(signal.SIGKILL)

    def wait(self, seconds=30):
        return self.process.wait(seconds)
