#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does what docs/howto tells its reader with the weather station: the model writes the wind; the
vane is wired, and its values take the place of those of the model; it falls silent, is unplugged
and comes back; its node is killed and comes back. Nobody stops the plant.
"""
import argparse
import os
import pty
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

LONGEST_WAIT = 20.0  # [s]


def require(condition, text):
    if not condition:
        sys.exit(f"the flow of the howtos breaks: {text}")


def await_that(condition, text):
    end = time.monotonic() + LONGEST_WAIT
    while not condition():
        require(time.monotonic() < end, text)
        time.sleep(0.02)


class Vane:
    """A wind vane at the other end of a line: says its angle ten times a second, unless it is
    silent."""

    def __init__(self):
        self.descriptor, line = pty.openpty()
        self.device, self.angle, self.ends = os.ttyname(line), 123.5, False
        self.line = line  # held open: a pseudo terminal that nobody has open says that it is gone
        self.thread = threading.Thread(target=self.talk)
        self.thread.start()

    def talk(self):
        while not self.ends:
            if self.angle is not None:
                os.write(self.descriptor, f"{self.angle}\n".encode())
            time.sleep(0.1)

    def end(self):
        self.ends = True
        self.thread.join()


class Plant:
    def __init__(self, options, folder):
        self.options, self.folder, self.programs = options, folder, {}
        signals = folder / "signals.ini"
        signals.write_text(options.winch_signals.read_text() + (options.code / "weather_signals.ini").read_text())
        self.start("master", "--signals", str(signals), "--port", "0", "--profile", "plant")
        self.address = "localhost:" + self.await_text("master", "out", "port ").split("port ")[1].split()[0]

    def start(self, name, *arguments):
        with open(self.folder / f"{name}.out", "w") as out, open(self.folder / f"{name}.err", "w") as err:
            self.programs[name] = subprocess.Popen([getattr(self.options, name), *arguments], stdout=out, stderr=err)

    def start_node(self, name, *arguments):
        self.start(name, *arguments, "--master", self.address)
        self.await_text(name, "err", "registered at")

    def await_text(self, name, kind, text):
        path = self.folder / f"{name}.{kind}"
        await_that(lambda: text in path.read_text(), f"{name} never says '{text}', but: {path.read_text()}")
        await_that(lambda: path.read_text().endswith("\n"), f"{name} ends in the middle of a line")
        return path.read_text()

    def qtplc(self, *arguments):
        run = subprocess.run(
            [self.options.qtplc, "--master", self.address, *arguments],
            capture_output=True,
            text=True,
            timeout=LONGEST_WAIT,
        )
        require(run.returncode == 0, f"qtplc {' '.join(arguments)} gives {run.returncode}: {run.stderr}")
        return run.stdout

    def value(self, signal):
        return float(self.qtplc("get", signal, "--plain"))

    def await_vane(self, angle):
        await_that(lambda: self.value("windDirection") == angle, f"windDirection is never {angle}")

    def await_model(self):
        await_that(
            lambda: 180.0 < self.value("windDirection") < 200.0 or self.value("windDirection") == 180.0,
            "windDirection is never that of the model",
        )

    def kill(self, name):
        self.programs[name].kill()
        self.programs.pop(name).wait(LONGEST_WAIT)

    def end(self):
        for program in self.programs.values():
            program.terminate()
        for program in self.programs.values():
            try:
                program.wait(LONGEST_WAIT)
            except subprocess.TimeoutExpired:
                program.kill()


def fly(plant, vane, folder, code):
    configuration = folder / "weather.ini"
    configuration.write_text((code / "weather.ini").read_text().replace("/dev/ttyUSB0", vane.device))
    plant.start_node("model")
    plant.qtplc("start")
    plant.await_model()

    plant.start_node("weather", str(configuration))
    plant.await_vane(123.5)
    vane.angle = 90.0
    plant.await_vane(90.0)
    require(plant.value("weatherLines") >= 1.0, "weatherLines counts nothing")
    vane.angle = None
    plant.await_model()
    vane.angle = 91.0
    plant.await_vane(91.0)
    plant.kill("weather")
    plant.await_model()
    plant.start_node("weather", str(configuration))
    plant.await_vane(91.0)
    require("Real time" in plant.qtplc("state"), "the plant has stopped")
    plant.qtplc("stop")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("master", "weather", "model", "qtplc"):
        parser.add_argument("--" + name, required=True)
    for name in ("winch-signals", "code"):
        parser.add_argument("--" + name, required=True, type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        vane = Vane()
        plant = Plant(options, Path(folder))
        try:
            fly(plant, vane, Path(folder), options.code)
        finally:
            plant.end()
            vane.end()
    print("the flow of the howtos works")


if __name__ == "__main__":
    main()
