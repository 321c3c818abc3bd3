#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does what docs/tutorial tells its reader: a master, two nodes, start, look, stop, and one by hand without the second node."""
import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

LONGEST_WAIT = 20.0  # [s]


def require(condition, text):
    if not condition:
        sys.exit(f"the flow of the tutorial breaks: {text}")


class Plant:
    """The programs of the tutorial; all that still run are ended at the end."""

    def __init__(self, options):
        self.options, self.programs, self.logs = options, [], tempfile.TemporaryDirectory()

    def __enter__(self):
        self.start("master", "--signals", self.options.signals, "--port", "0")
        line = self.await_text("master", "out", "port ")
        self.address = "localhost:" + line.split("port ")[1].split()[0]
        return self

    def __exit__(self, failure, *_):
        for program in reversed(self.programs):
            program.terminate()
        codes = [program.wait(LONGEST_WAIT) for program in self.programs]
        require(failure or codes == [0] * len(codes), f"exit codes {codes} after SIGTERM")

    def start(self, name, *arguments):
        out, err = (open(Path(self.logs.name) / f"{name}.{kind}", "w") for kind in ("out", "err"))
        self.programs.append(subprocess.Popen([getattr(self.options, name), *arguments], stdout=out, stderr=err))
        out.close(), err.close()
        return self.programs[-1]

    def start_node(self, name):
        program = self.start(name, "--master", self.address)
        self.await_text(name, "err", "registered at")
        return program

    def await_text(self, name, kind, text):
        end = time.monotonic() + LONGEST_WAIT
        while time.monotonic() < end:
            seen = (Path(self.logs.name) / f"{name}.{kind}").read_text()
            if text in seen and seen.endswith("\n"):
                return seen
            time.sleep(0.01)
        sys.exit(f"the flow of the tutorial breaks: {name} never says '{text}', but: {seen}")

    def qtplc(self, *arguments):
        run = subprocess.run([self.options.qtplc, "--master", self.address, *arguments], capture_output=True, text=True, timeout=LONGEST_WAIT)
        require(run.returncode == 0, f"qtplc {' '.join(arguments)} gives {run.returncode}: {run.stderr}")
        return run.stdout

    def value(self, signal):
        row = next(line for line in self.qtplc("list").splitlines() if line.startswith(signal + " "))
        return float(row.split()[3])

    def await_value(self, signal, condition, text):
        end = time.monotonic() + LONGEST_WAIT
        while not condition(self.value(signal)):
            require(time.monotonic() < end, f"{signal} {text} never comes, it is {self.value(signal)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("master", "winch", "operator", "qtplc", "signals"):
        parser.add_argument("--" + name, required=True)
    with Plant(parser.parse_args()) as plant:
        plant.start_node("winch")
        operator = plant.start_node("operator")
        state = plant.qtplc("state")
        require("Winch" in state and "Operator" in state, f"qtplc state does not name both nodes: {state}")
        require("Operator" in next(line for line in plant.qtplc("list").splitlines() if line.startswith("tetherSpeed")), "tetherSpeed has no writer")

        plant.qtplc("start")
        plant.await_value("tetherLength", lambda length: length >= 309.0, ">= 309")
        plant.await_value("tetherSpeed", lambda speed: speed < 0.0, "< 0")
        echo = plant.qtplc("echo", "tetherLength", "--count", "3")
        require(len(echo.strip().splitlines()) >= 3, f"qtplc echo shows no three lines: {echo}")
        plant.qtplc("stop")

        operator.terminate()
        operator.wait(LONGEST_WAIT)
        plant.programs.remove(operator)
        require(operator.returncode == 0, f"the operator ends with {operator.returncode}")
        plant.qtplc("start")
        plant.qtplc("set", "tetherSpeed", "5")
        plant.await_value("tetherLength", lambda length: length >= 305.0, ">= 305, by hand")
        plant.qtplc("stop")
    print("the flow of the tutorial works")


if __name__ == "__main__":
    main()
