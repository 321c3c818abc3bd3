#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Recorders on another computer: here a process that sees no ring but by the network. The file has
every cycle, also when recorders are killed, and over TLS; a second recorder is told who the first
one is, and an observer may not record.

usage: tst_remote.py FOLDER_OF_PROGRAMS
"""
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PATIENCE = 120  # [s] far more than a loaded machine needs


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(is_true, what):
    end = time.monotonic() + PATIENCE
    while not is_true():
        assert time.monotonic() < end, what
        time.sleep(0.02)


class Computers:
    """That of the master, and another one, whose rings are in folders of their own."""

    def __init__(self, programs, folder, rings):
        self.programs, self.folder, self.port = programs, folder, free_port()
        self.address = f"127.0.0.1:{self.port}"
        self.rings = [Path(rings, name) for name in ("master", "ground")]
        self.options = []  # of tools, for a secured plant
        self.children = []
        for place in self.rings:
            place.mkdir()

    def start(self, computer, program, *arguments):
        child = subprocess.Popen(
            [self.programs / program, *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, "QTPLC_RING_DIR": str(self.rings[computer]), "HOME": str(self.folder)},
        )
        self.children.append(child)
        return child

    def run(self, *arguments):
        call = [self.programs / "qtplc", *map(str, arguments), "--master", self.address, *self.options]
        return subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def state(self):
        answer = self.run("state", "--json")
        return json.loads(answer.stdout) if answer.returncode == 0 else {}

    def record(self, target):
        return self.start(1, "qtplc", "record", target, "--master", self.address, *self.options)

    def recorder(self):
        return self.state().get("recorder", {})

    def verify(self, target):
        said = subprocess.run([self.programs / "qtplc", "verify", target, "--json"], stdout=subprocess.PIPE, text=True)
        return json.loads(said.stdout), said.returncode

    def end(self):
        for child in self.children:
            if child.poll() is None:
                child.kill()
            child.wait()
            child.stdout.close()


def whole_flight_is_in_the_file(plant, name):
    file = plant.folder / name
    recorder = plant.record(file)
    time.sleep(0.5)  # it waits for the phase; not needed for its cycles
    assert plant.run("start", "--cycles", 300).returncode == 0
    said = recorder.communicate(timeout=PATIENCE)[0]
    assert recorder.returncode == 0 and " 0 missing" in said, said
    facts, code = plant.verify(file)
    assert code == 0 and 0 < facts["cycles"] <= 300, facts  # some may be skipped
    assert facts["digest"] == plant.state()["digest"], (facts, plant.state())
    wait_for(lambda: not list(plant.rings[0].iterdir()), "the ring of the master is deleted")
    assert not list(plant.rings[1].iterdir()), "a copy is left"


def killed_recorders_are_continued(plant):
    target = plant.folder / "flights"
    recorder = plant.record(f"{target}/")
    assert plant.run("start", "--cycles", 1000).returncode == 0
    wait_for(lambda: plant.recorder().get("state") == "Recording", "cycles are recorded")
    wait_for(lambda: f":{target}/" in plant.recorder().get("file", ""), "the master knows the file")
    second = plant.record(plant.folder / "second.mcap")
    said = second.communicate(timeout=PATIENCE)[0]
    assert second.returncode == 1 and "records this plant already" in said, said
    for _ in range(3):
        time.sleep(0.5)
        recorder.kill()
        recorder.communicate()
        recorder = plant.record(f"{target}/")
    wait_for(lambda: plant.state()["state"] == "Off", "the phase ends")
    wait_for(lambda: not list(plant.rings[0].iterdir()), "all is recorded")
    recorder.send_signal(signal.SIGTERM)
    said = recorder.communicate(timeout=PATIENCE)[0]
    assert recorder.returncode == 0, said
    facts, code = plant.verify(target)
    assert code == 0, facts
    assert not list(plant.rings[1].iterdir()), "a copy is left"


def master_that_ends_is_recorded_as_far_as_it_came(plant, master):
    file = plant.folder / "ended.mcap"
    recorder = plant.record(file)
    assert plant.run("start").returncode == 0
    wait_for(lambda: plant.recorder().get("state") == "Recording", "cycles are recorded")
    time.sleep(1)
    master.send_signal(signal.SIGTERM)
    said = recorder.communicate(timeout=PATIENCE)[0]
    assert recorder.returncode in (0, 1) and "cycles in" in said, said  # the end of the phase may have come
    assert plant.verify(file)[0]["cycles"] > 0
    assert not list(plant.rings[1].iterdir()), "a copy is left"


def lockstep_flights_are_recorded_to_their_end(plant):
    """Their master ends with them."""
    file = plant.folder / "lockstep.mcap"
    clock = ["--lockstep", "--duration", 30, "--start-with", "Model,Autopilot"]
    master = plant.start(0, "awe_master", "--port", plant.port, *clock)
    wait_for(lambda: plant.state().get("state"), "the master listens")
    recorder = plant.record(file)
    time.sleep(0.5)  # it waits for the phase; not needed for its cycles
    for node in ("awe_model", "awe_autopilot"):
        plant.start(0, node, "--master", f"udp://{plant.address}")
    said = recorder.communicate(timeout=PATIENCE)[0]
    assert recorder.returncode == 0 and "3000 cycles" in said and " 0 missing" in said, said
    assert master.wait(timeout=PATIENCE) == 0
    facts, code = plant.verify(file)
    assert code == 0 and facts["cycles"] == 3000, facts


def only_operators_record_secured_plants(plant):
    for ring in plant.rings[0].iterdir():
        ring.unlink()  # of masters that have ended
    keys = plant.folder / "keys.ini"
    for name, role in (("anna", "Operator"), ("screen", "Observer")):
        copy = plant.folder / f"{name}.ini"
        call = [plant.programs / "qtplc", "keys", "new", name, "--role", role, "--keys", keys, "--copy", copy]
        subprocess.run(call, check=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    plant.start(0, "awe_master", "--port", plant.port, "--duration", 0, "--security", "psk", "--keys", keys)
    plant.options = ["--security", "psk", "--keys", plant.folder / "screen.ini"]
    wait_for(lambda: plant.state().get("state"), "the master listens")
    observer = plant.record(plant.folder / "never.mcap")
    said = observer.communicate(timeout=PATIENCE)[0]
    assert observer.returncode == 1 and "role Observer may not send GetRecords" in said, said
    assert "recorder" not in plant.state() or plant.recorder().get("state") == "None", plant.state()
    plant.options[-1] = plant.folder / "anna.ini"
    whole_flight_is_in_the_file(plant, "secured.mcap")


def main(programs):
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory(dir="/dev/shm") as rings:
        plant = Computers(Path(programs), Path(folder), rings)
        try:
            master = plant.start(0, "awe_master", "--port", plant.port, "--duration", 0)
            wait_for(lambda: plant.state().get("state"), "the master listens")
            whole_flight_is_in_the_file(plant, "flight.mcap")
            killed_recorders_are_continued(plant)
            master_that_ends_is_recorded_as_far_as_it_came(plant, master)
            lockstep_flights_are_recorded_to_their_end(plant)
            only_operators_record_secured_plants(plant)
        finally:
            plant.end()


if __name__ == "__main__":
    main(sys.argv[1])
