#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A master says what its recorder does: in its state, and as an alarm with an end. What happens
around a mark is kept, also when nobody records, and survives a kill of the master.

usage: tst_recorder_states.py FOLDER_OF_PROGRAMS
"""
import ctypes
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PATIENCE = 120  # [s] far more than a loaded machine needs
SKIPPED = 77
DISK = 6 << 20  # [byte]


class Plant:
    """A master without nodes at 100 Hz, whose rings are in a folder of their own."""

    def __init__(self, programs, folder, rings):
        self.programs, self.folder, self.rings = programs, folder, Path(rings)
        self.environment = {**os.environ, "QTPLC_RING_DIR": rings, "HOME": str(folder)}
        self.children = []
        self.port = None

    def start(self, program, *arguments):
        child = subprocess.Popen(
            [self.programs / program, *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=self.environment,
        )
        self.children.append(child)
        return child

    def said(self, *arguments):
        """As JSON; empty if there is no answer."""
        call = [self.programs / "qtplc", *arguments, "--master", f"127.0.0.1:{self.port}", "--json"]
        answer = subprocess.run(call, stdout=subprocess.PIPE, text=True, env=self.environment)
        return answer.stdout if answer.returncode == 0 else ""

    def ask(self, *arguments):
        return json.loads(self.said(*arguments) or "{}")

    def begin(self, scale=1):
        """A phase whose cycles run, so many times as fast as real time."""
        self.port = free_port()
        master = self.start("awe_master", "--port", self.port, "--scale", scale, "--duration", 0)
        wait_for(lambda: self.ask("state").get("state"), "the master listens")
        subprocess.run(
            [self.programs / "qtplc", "start", "--master", f"127.0.0.1:{self.port}"], env=self.environment, check=True
        )
        wait_for(lambda: self.recorder().get("state"), "cycles run")
        return master

    def recorder(self):
        return self.ask("state").get("recorder", {})

    def wait_for_state(self, state):
        wait_for(lambda: self.recorder().get("state") == state, f"the recorder is {state}", self.recorder)

    def alarms(self):
        """Of the recorder: whether each event is the begin of the alarm."""
        events = [json.loads(line) for line in self.said("events").splitlines()]
        return [event.get("active", False) for event in events if event.get("alarm") == "recorder"]

    def end(self):
        for child in self.children:
            if child.poll() is None:
                child.kill()
            child.wait()
            child.stdout.close()
        self.children = []


def free_port():
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(condition, what, seen=lambda: ""):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            sys.exit(f"in {PATIENCE} s it was not true that {what} {seen()}")
        time.sleep(0.05)


def a_full_disk_is_an_alarm_until_there_is_room(plant, disk):
    master = plant.begin(10)  # the recorder has reserved a megabyte before the disk is full
    plant.wait_for_state("None")
    recorder = plant.start("qtplc", "record", f"{disk}/", "--free-gib", 0)
    plant.wait_for_state("Recording")
    ballast = disk / "ballast"
    with open(ballast, "wb", buffering=0) as file:
        try:
            while True:
                file.write(bytes(4096))
        except OSError:
            pass
    plant.wait_for_state("DiskFull")
    assert "No space left" in plant.recorder()["error"], plant.recorder()
    wait_for(lambda: plant.alarms() == [True], "a full disk is an alarm", plant.alarms)
    ballast.unlink()
    plant.wait_for_state("Recording")
    wait_for(lambda: plant.alarms() == [True, False], "the alarm has an end", plant.alarms)
    assert plant.recorder()["missing"] == 0, plant.recorder()

    recorder.send_signal(signal.SIGSTOP)  # as if the disk stalled
    plant.wait_for_state("Stalled")
    recorder.send_signal(signal.SIGCONT)
    plant.wait_for_state("Recording")
    recorder.kill()
    plant.wait_for_state("Gone")
    recorder = plant.start("qtplc", "record", f"{disk}/", "--free-gib", 0)
    plant.wait_for_state("Recording")
    recorder.send_signal(signal.SIGTERM)
    plant.wait_for_state("None")
    wait_for(lambda: plant.alarms() == [True, False] * 3, "each alarm has an end", plant.alarms)
    assert master.poll() is None
    plant.end()


def a_mark_is_kept_when_nobody_records(plant):
    master = plant.begin()
    wait_for(lambda: int(plant.ask("state")["cycle"], 16) > 100, "a second is over")
    subprocess.run([plant.programs / "qtplc", "record", "mark"], env=plant.environment, check=True)
    wait_for(lambda: list(plant.rings.glob("*-part1")), "a part of the ring is kept")
    master.kill()
    master.communicate()
    for ring in plant.rings.iterdir():
        if not ring.name.endswith("-part1"):
            ring.unlink()
    folder = plant.folder / "kept"
    recorder = plant.start("qtplc", "record", f"{folder}/")
    wait_for(lambda: not list(plant.rings.iterdir()), "the part is in a file")
    recorder.send_signal(signal.SIGTERM)
    text, _ = recorder.communicate(timeout=PATIENCE)
    assert "the master has ended" not in text, text
    (file,) = folder.glob("*.mcap")
    assert file.name.endswith("_marked.mcap"), file
    said = subprocess.run([plant.programs / "qtplc", "verify", file, "--json"], stdout=subprocess.PIPE, text=True)
    facts = json.loads(said.stdout)
    assert facts["finished"] and facts["cycles"] > 1000, facts  # 10 s behind the mark, and what was before
    assert facts["problems"] == ["the end of the phase is not in the file"], facts
    plant.end()


def main():
    programs = Path(sys.argv[1])
    libc = ctypes.CDLL(None, use_errno=True)
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory(dir="/dev/shm") as rings:
        plant = Plant(programs, Path(folder), rings)
        try:
            a_mark_is_kept_when_nobody_records(plant)
            disk = Path(folder) / "disk"
            disk.mkdir()
            if libc.mount(b"tmpfs", str(disk).encode(), b"tmpfs", 0, f"size={DISK}".encode()) != 0:
                print("a small disk needs root: a full one was not tried")
                sys.exit(SKIPPED)
            try:
                a_full_disk_is_an_alarm_until_there_is_room(plant, disk)
            finally:
                plant.end()
                libc.umount2(str(disk).encode(), 2)
        finally:
            plant.end()
    print("the master says what its recorder does")


if __name__ == "__main__":
    main()
