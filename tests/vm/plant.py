# SPDX-License-Identifier: Apache-2.0
"""Master and nodes under real-time priorities, and what becomes of a GPIO line when something
fails."""
import json
import re
import signal
import subprocess
import threading
import time
from pathlib import Path

from steps import Process, Skipped, program, wait_until

PERIOD = 0.020  # [s]; the processors of this machine are programs of another one
WATCHDOG = 0.300  # [s]
# What programs of an emulated processor need beside it to notice, to run and to be seen.
SLACK = 0.250  # [s]
LAMP = 5  # line
PRIORITY = ("chrt", "-f", "49")


def steps(bench):
    yield "qtplc doctor", doctor
    yield "master, model and autopilot under SCHED_FIFO 49", fly
    for name, action in (
        ("kill -9 of the master", kill_master),
        ("the master hangs (SIGSTOP)", stop_master),
        ("SIGTERM to the master", end_master),
        ("exception in the code of the node that switches", throw_in_switch),
        ("kill -9 of the node that switches", kill_switch),
        ("exception in the code of the hardware node", throw_in_lamp),
        ("SIGTERM to the hardware node", end_lamp),
    ):
        yield f"GPIO line is safe after: {name}", lambda action=action: lamp_is_safe(bench, action)
    yield "GPIO line after kill -9 of the hardware node", lambda: lamp_after_kill(bench)


def doctor():
    """It may find something to cure; what it says of this kernel has to be right."""
    result = subprocess.run([program("qtplc"), "doctor", "--json"], capture_output=True, text=True, timeout=120)
    assert result.returncode in (0, 1), f"exit code {result.returncode}: {result.stderr}"
    findings = json.loads(result.stdout)["findings"]
    kernel = next(finding["found"] for finding in findings if "kernel" in finding["subject"])
    assert "PREEMPT_RT" in kernel, f"kernel: {kernel}"
    to_cure = [finding["subject"] for finding in findings if finding["verdict"] == "to cure"]
    return f"{kernel}; to cure: {', '.join(to_cure) or 'nothing'}"


def fly():
    """Half as fast as the real clock: a cycle each 20 ms."""
    report = Path("/run/flight.json")
    with Process(
        *PRIORITY,
        program("awe_master"),
        "--port",
        "0",
        "--scale",
        "0.5",
        "--duration",
        "5",
        "--start-with",
        "Model,Autopilot",
        "--report",
        report,
    ) as master:
        master.wait_for("port ")
        place = "localhost:" + re.search(r"port (\d+)", master.output())[1]
        with Process(*PRIORITY, program("awe_model"), "--master", f"udp://{place}"), Process(
            *PRIORITY, program("awe_autopilot"), "--master", f"udp://{place}"
        ):
            code = master.wait(90)
        assert code == 0, f"exit code {code}\n{master.output()}"
    return f"{len(report.read_text())} byte of report"


# ---- the lamp ----


class LampPlant:
    """Master, a node that switches the lamp on, and the hardware node with the lamp; it is on."""

    def __init__(self, bench):
        self.bench = bench
        if not bench.gpio:
            raise Skipped("there is no GPIO")

    def __enter__(self):
        plant = program("vm_plant")
        file = Path("/run/lamp.ini")
        file.write_text(
            f"[node]\nname = Lamp\n[board]\ndriver = gpio\ndevice = {self.bench.gpio}\n"
            f"output.lamp = {LAMP}\n[board.write]\nlamp = lamp\n[board.safe]\nlamp = 0\n"
        )
        # Who lets the line go leaves it to its pull: a line that is safe because of that is seen as
        # high.
        self.bench.set_input(LAMP, True)
        self.processes = []
        try:
            self.master = self.start(*PRIORITY, plant, "master", round(PERIOD * 1000))
            self.master.wait_for("port ")
            port = re.search(r"port (\d+)", self.master.output())[1]
            self.lamp = self.start(*PRIORITY, plant, "lamp", port, file, round(WATCHDOG * 1000))
            self.lamp.wait_for("registered")
            wait_until(lambda: self.level() == 0, "the lamp is taken, and dark")
            self.switch = self.start(*PRIORITY, plant, "switch", port)
            wait_until(lambda: self.level() == 1, "the lamp is switched on")
        except BaseException:
            self.__exit__(RuntimeError, RuntimeError("the plant does not run"), None)
            raise
        return self

    def start(self, *words):
        process = Process(*words)
        process.__enter__()
        self.processes.append(process)
        return process

    def __exit__(self, *what):
        for process in reversed(self.processes):
            process.__exit__(*what)
        self.bench.set_input(LAMP, False)

    def level(self):
        return self.bench.output(LAMP)


def kill_master(plant):
    plant.master.kill()


def stop_master(plant):
    plant.master.send(signal.SIGSTOP)


def end_master(plant):
    plant.master.send(signal.SIGTERM)


def throw_in_switch(plant):
    plant.switch.send(signal.SIGUSR1)


def kill_switch(plant):
    plant.switch.kill()


def throw_in_lamp(plant):
    plant.lamp.send(signal.SIGUSR1)


def end_lamp(plant):
    plant.lamp.send(signal.SIGTERM)


class Stalls(threading.Thread):
    """How long the computer below did not let this machine run: its programs can do nothing about
    that."""

    LOOK = 0.010  # [s]
    USUAL = 0.050  # [s] that a look may come late here

    def __init__(self):
        super().__init__(daemon=True)
        self.seconds = 0.0
        self.is_over = False

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.is_over = True
        self.join()

    def run(self):
        while not self.is_over:
            begin = time.monotonic()
            time.sleep(self.LOOK)
            late = time.monotonic() - begin - self.LOOK
            self.seconds += late if late > self.USUAL else 0.0


def lamp_is_safe(bench, action):
    with LampPlant(bench) as plant, bench.gpio_record() as record, Stalls() as stalls:
        start = time.monotonic()
        action(plant)
        wait_until(lambda: (record.low_since(LAMP) or 0) > start, "the kernel has set the line low", 5)
        time.sleep(WATCHDOG)  # it has to stay low
        low = record.low_since(LAMP)
        assert low, "the line is high again"
        fall = low - start
        assert (
            fall <= WATCHDOG + PERIOD + SLACK + stalls.seconds
        ), f"the line was low after {fall * 1e3:.0f} ms, and the watchdog is {WATCHDOG * 1e3:.0f} ms"
        assert action is end_lamp or plant.level() == 0, "the line is high again"
        return f"low after {fall * 1e3:.0f} ms" + (
            f", of which the machine stood still up to {stalls.seconds * 1e3:.0f} ms" if stalls.seconds else ""
        )


def lamp_after_kill(bench):
    """Nobody can write a safe value any more: the line falls back to its pull, which is what the
    wiring has to be safe with."""
    with LampPlant(bench) as plant:
        plant.lamp.kill()
        plant.lamp.wait()
        bench.set_input(LAMP, False)
        wait_until(lambda: plant.level() == 0, "the line follows its pull", 5)
        return "the kernel lets the line go: it follows its pull"
