#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills recorders and masters at random (SIGKILL), and stops a recorder for a while: no cycle is
missing in the recordings. A recorder that starts again in the same folder finishes them.

usage: tst_kills.py FOLDER_OF_PROGRAMS KILLS [CYCLES]
       CYCLES of the flight whose recorder is stopped for five seconds, default 200000
"""
import json
import random
import signal
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
        self.programs, self.folder, self.rings = programs, folder, Path(rings)
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

    def finish(self, folder):
        """Records what is left in rings."""
        recorder = self.start("qtplc", "record", f"{folder}/")
        recorder.stdout.readline()
        end = time.monotonic() + PATIENCE
        while list(self.rings.iterdir()) and time.monotonic() < end:
            time.sleep(0.01)
        recorder.send_signal(signal.SIGTERM)
        recorder.communicate(timeout=PATIENCE)
        assert not list(self.rings.iterdir()), "rings are left"

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


def a_stopped_recorder_loses_nothing(plant, cycles):
    report = plant.folder / "stopped.json"
    flight = plant.start("awe_sil", "--duration", cycles / 100, "--report", report)
    recorder, file = plant.record("stopped.mcap")
    recorder.send_signal(signal.SIGSTOP)
    time.sleep(5)
    recorder.send_signal(signal.SIGCONT)
    assert flight.wait(PATIENCE + cycles / 1000) == 0
    recorder.communicate(timeout=PATIENCE)
    facts = plant.verify(file)
    assert facts["problems"] == [] and facts["lastCycle"] == cycles - 1, facts
    assert all(gap["first"] == 0 for gap in facts["gaps"]), facts  # what was before the recorder
    assert facts["digest"] == json.loads(report.read_text())["image_digest"]


def master_of(file):
    return file.name.split("_phase")[0].split("_")[-1]


def files_follow_each_other(plant, folder):
    """All files of a folder are finished, and those of a master have each cycle once."""
    following, cycles = {}, 0
    for file in sorted(folder.iterdir()):
        if file.name.startswith("."):
            continue
        assert file.suffix == ".mcap", f"{file} is not finished"
        facts, master = plant.verify(file), master_of(file)
        assert facts["finished"] and facts["problems"] in ([], [NO_END]), facts
        assert all(gap["first"] == 0 for gap in facts["gaps"]), facts
        assert following.setdefault(master, facts["from"]) == facts["from"], f"{file}: {facts}"
        following[master] = facts["next"]
        cycles += facts["cycles"]
    assert cycles > 0, "nothing was recorded"
    return len(following)


def recorders_of_a_folder_are_killed(plant, kills):
    folder = plant.folder / "recorders"
    flight = plant.start("awe_sil", "--scale", 10, "--duration", 100000)
    for _ in range(kills):
        recorder = plant.start("qtplc", "record", f"{folder}/")
        recorder.stdout.readline()
        time.sleep(random.uniform(0, 0.5))
        kill(recorder)
    kill(flight)
    plant.finish(folder)
    assert files_follow_each_other(plant, folder) == 1


def masters_that_record_are_killed(plant, kills):
    folder = plant.folder / "masters"
    for number in range(kills):
        flight = plant.start("awe_sil", "--scale", 10, "--duration", 100000, "--record", f"{folder}/")
        end = time.monotonic() + PATIENCE
        while len({master_of(file) for file in folder.glob("*_phase1*")}) <= number and time.monotonic() < end:
            time.sleep(0.001)
        time.sleep(random.uniform(0, 0.25))
        kill(flight)
        plant.finish(folder)
    assert files_follow_each_other(plant, folder) == kills


def main():
    random.seed(1)
    programs, kills = Path(sys.argv[1]), int(sys.argv[2])
    cycles = int(sys.argv[3]) if len(sys.argv) > 3 else 200000
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory(dir="/dev/shm") as rings:
        plant = Plant(programs, Path(folder), rings)
        a_stopped_recorder_loses_nothing(plant, cycles)
        masters_are_killed(plant, kills)
        for ring in Path(rings).iterdir():
            ring.unlink()
        recorders_are_killed(plant, kills)
        for ring in Path(rings).iterdir():
            ring.unlink()
        recorders_of_a_folder_are_killed(plant, kills)
        masters_that_record_are_killed(plant, kills)
    print(f"{kills} recorders and {kills} masters were killed: no cycle is missing")


if __name__ == "__main__":
    main()
