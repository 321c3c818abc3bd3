#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills recorders and masters at random (SIGKILL), and stops a recorder for a while: no cycle is
missing in the recordings.

usage: tst_kills.py FOLDER_OF_PROGRAMS KILLS
"""
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PATIENCE = 60  # [s] far more than a loaded machine needs
NO_END = "the end of the phase is not in the file"


class Plant:
    """Flights and recorders whose rings are in a folder of their own."""

    def __init__(self, programs, folder, rings):
        self.programs, self.folder = programs, folder
        self.environment = {"PATH": "/usr/bin:/bin", "QTPLC_RING_DIR": rings}

    def start(self, program, *arguments):
        return subprocess.Popen(
            [self.programs / program, *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env=self.environment,
        )

    def record(self, name):
        """A recorder that has begun; the flight may still be starting."""
        file, end = self.folder / name, time.monotonic() + PATIENCE
        while time.monotonic() < end:
            recorder = self.start("qtplc", "record", file)
            if recorder.stdout.readline().startswith("recording "):
                return recorder, file
            recorder.wait()
        sys.exit("no recorder has begun")

    def verify(self, file):
        said = subprocess.run([self.programs / "qtplc", "verify", file, "--json"], stdout=subprocess.PIPE, text=True)
        return json.loads(said.stdout)


def kill(process):
    process.kill()
    process.communicate()


def recorders_are_killed(plant, kills):
    flight = plant.start("awe_sil", "--scale", 10, "--duration", 100000)
    known = -1  # cycle up to which all are in a file
    for number in range(kills):
        recorder, file = plant.record(f"recorder-{number}.mcap")
        time.sleep(random.uniform(0, 0.25))
        kill(recorder)
        subprocess.run([plant.programs / "qtplc", "recover", file], stdout=subprocess.DEVNULL, check=True)
        facts = plant.verify(file)
        if facts["cycles"] == 0:
            continue
        before = facts["gaps"][0]["last"] if facts["gaps"] else -1
        assert before <= known or known < 0, f"cycles {known + 1} to {before} are in no file"
        assert facts["finished"] and facts["problems"] == [NO_END], facts
        known = facts["lastCycle"]
    kill(flight)
    assert known > 0, "nothing was recorded"


def masters_are_killed(plant, kills):
    for number in range(kills):
        flight = plant.start("awe_sil", "--scale", 10, "--duration", 100000)
        recorder, file = plant.record(f"master-{number}.mcap")
        time.sleep(random.uniform(0, 0.25))
        kill(flight)
        recorder.communicate(timeout=PATIENCE)
        facts = plant.verify(file)
        assert facts["finished"] and facts["problems"] == [NO_END], facts
        assert all(gap["first"] == 0 for gap in facts["gaps"]), facts


def a_stopped_recorder_loses_nothing(plant):
    file, report = plant.folder / "stopped.mcap", plant.folder / "stopped.json"
    flight = plant.start("awe_sil", "--duration", 2000, "--record", file, "--report", report)
    end = time.monotonic() + PATIENCE
    while not file.exists() and time.monotonic() < end:
        time.sleep(0.001)
    found = subprocess.run(["pgrep", "-f", f"qtplc record {file}"], stdout=subprocess.PIPE, text=True).stdout.split()
    if found:
        recorder = int(found[0])
        subprocess.run(["kill", "-STOP", str(recorder)])
        time.sleep(2)
        subprocess.run(["kill", "-CONT", str(recorder)])
    assert flight.wait(PATIENCE) == 0
    facts = plant.verify(file)
    assert facts["complete"] and facts["cycles"] == 200000, facts
    assert facts["digest"] == json.loads(report.read_text())["image_digest"]


def main():
    random.seed(1)
    programs, kills = Path(sys.argv[1]), int(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory(dir="/dev/shm") as rings:
        plant = Plant(programs, Path(folder), rings)
        a_stopped_recorder_loses_nothing(plant)
        masters_are_killed(plant, kills)
        for ring in Path(rings).iterdir():
            ring.unlink()
        recorders_are_killed(plant, kills)
    print(f"{kills} recorders and {kills} masters were killed: no cycle is missing")


if __name__ == "__main__":
    main()
