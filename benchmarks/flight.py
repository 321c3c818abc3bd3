# SPDX-License-Identifier: Apache-2.0
"""A flight in real time with the programs of the example, for benchmarks that look at its
master."""
import json
import re
import signal
import subprocess
import time
from pathlib import Path


class Flight:
    def __init__(self, programs, priority=None):
        """priority: of the cycles under SCHED_FIFO; None: none"""
        self.programs, self.processes = programs, []
        self.scheduling = [] if priority is None else [f"--priority={priority}"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            if process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.terminate()
        for process in self.processes:
            try:
                process.wait(timeout=5)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def start(self, program, *arguments):
        log = subprocess.PIPE if program == "awe_master" else subprocess.DEVNULL
        process = subprocess.Popen(
            [str(self.programs / program), *arguments], stdout=subprocess.DEVNULL, stderr=log, text=True
        )
        self.processes.append(process)
        return process

    def tell(self, command, *arguments):
        run = subprocess.run(
            [str(self.programs / "qtplc"), command, *arguments, "--master", self.address],
            capture_output=True,
            text=True,
            timeout=30,
        )
        if run.returncode:
            raise SystemExit(f"qtplc {command}: {run.stderr}")
        return run.stdout

    def begin(self):
        master = self.start("awe_master", "--real-time", "--port=0", *self.scheduling)
        for line in master.stderr:
            port = re.search(r"port (\d+)", line)
            if port:
                break
        else:
            raise SystemExit("awe_master did not start")
        self.port, self.address = port[1], f"127.0.0.1:{port[1]}"
        for node in ("awe_model", "awe_autopilot"):
            self.start(node, "--master", f"udp://{self.address}", *self.scheduling)
        return master

    def nodes(self):
        return json.loads(self.tell("state", "--json"))["nodes"]

    def wait_for(self, count):
        end = time.monotonic() + 20
        while len(self.nodes()) < count:
            if time.monotonic() > end:
                raise SystemExit(f"{count} nodes did not come")
            time.sleep(0.1)


def resident(process):
    return 4 * int(Path(f"/proc/{process.pid}/statm").read_text().split()[1])
