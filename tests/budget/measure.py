# SPDX-License-Identifier: Apache-2.0
"""Runs a master and its slaves for a fixed number of cycles, and counts what they cost. Used by
budget.py."""
import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

PATIENCE = 100  # [s] for one run, far more than it takes
LENGTHS = (1000, 3000)  # cycles of the two runs whose difference is taken
IN_PROCESS = ("inprocess", "steps")  # steps: the program turns the clock
UDP_OVER_IP = 28  # [byte] headers of a datagram on the wire


class Skipped(Exception):
    """What is needed to count is not there."""


class Failed(Exception):
    """A run that gave no figures."""


def needed(tool, *trial):
    """Makes sure that a tool is there and may do its work."""
    if not shutil.which(tool):
        raise Skipped(f"{tool} is not installed; remedy: scripts/setup --tests")
    run = subprocess.run([tool, *trial], capture_output=True, text=True)
    if run.returncode != 0:
        raise Skipped(f"{tool} may not trace here: {run.stderr.strip().splitlines()[-1:]}")


class Runs:
    def __init__(self, program, plant):
        self.program, self.plant = str(program), plant

    # ---- processes ----
    def run(self, transport, slaves, cycles, period_us=0, master_under=(), slave_under=()):
        """One phase. Returns what the master and the first slave say; slave_under is for the first
        slave."""
        processes = []
        plant = [f"--plant={self.plant}"] if self.plant else []

        def start(under, *arguments):
            processes.append(
                subprocess.Popen(
                    [*under, self.program, f"--cycles={cycles}", *arguments], stdout=subprocess.PIPE, text=True
                )
            )
            return processes[-1]

        try:
            in_process = plant if transport in IN_PROCESS else []
            master = start(
                master_under, f"--transport={transport}", f"--slaves={slaves}", f"--period-us={period_us}", *in_process
            )
            port = json.loads(master.stdout.readline() or "{}").get("port")
            if port is None:
                raise Failed("the master did not start")
            address = f"local://{port}" if transport == "local" else f"{transport}://127.0.0.1:{port}"
            for i in range(0 if transport in IN_PROCESS else slaves):
                start(slave_under if i == 0 else (), f"--master={address}", f"--index={i}", *plant)
            answers = [json.loads(process.communicate(timeout=PATIENCE)[0] or "{}") for process in processes]
        except subprocess.TimeoutExpired as error:
            raise Failed(f"{' '.join(map(str, error.cmd))} did not end within {PATIENCE} s") from error
        finally:
            for process in processes:
                if process.poll() is None:
                    process.kill()
                    process.wait()
        if any(process.returncode for process in processes) or not answers[0]:
            raise Failed(
                f"{transport} with {slaves} slaves: exit codes {[process.returncode for process in processes]}"
            )
        return answers[0], answers[-1] if slaves == 1 or transport in IN_PROCESS else answers[1]

    def difference(self, what, lengths=LENGTHS):
        """Figures per cycle: what(cycles) for two lengths, so that start and end cancel out."""
        short, long = (what(cycles) for cycles in lengths)
        return {key: (long.get(key, 0) - short.get(key, 0)) / (lengths[1] - lengths[0]) for key in {*short, *long}}

    # ---- costs of the cycle threads ----
    def costs(self, transport, cycles):
        master, slave = self.run(transport, 1, cycles)
        if "allocations" not in master or "allocations" not in slave:
            raise Failed(f"{transport}: the phase of {cycles} cycles ended too early")
        names = ("allocations", "locks", "page_faults")
        if transport in IN_PROCESS:
            return {name: master[name] for name in names}
        return {f"{who} {name}": costs[name] for who, costs in (("master", master), ("slave", slave)) for name in names}

    # ---- system calls ----
    def system_calls(self, who, transport, slaves, period_us=0, lengths=LENGTHS):
        """System calls per cycle of the whole process, by name."""
        needed("strace", "-qq", "-o", "/dev/null", "true")

        def count(cycles):
            with tempfile.TemporaryDirectory() as folder:
                table = Path(folder) / "table"
                under = {f"{who}_under": ("strace", "-f", "-qq", "-c", "-U", "name,calls", "-o", str(table))}
                self.run(transport, slaves, cycles, period_us, **under)
                rows = (line.split() for line in table.read_text().splitlines())
                return {row[0]: int(row[1]) for row in rows if len(row) == 2 and row[1].isdigit() and row[0] != "total"}

        return self.difference(count, lengths)

    # ---- bytes ----
    def frames(self):
        """Bytes of the frames of a slave with 3 inputs and 32 outputs, and of both on the wire, as
        its system calls show them."""
        needed("strace", "-qq", "-o", "/dev/null", "true")
        cycles = 200
        with tempfile.TemporaryDirectory() as folder:
            trace = Path(folder) / "trace"
            self.run(
                "udp",
                1,
                cycles,
                slave_under=("strace", "-f", "-qq", "-yy", "-s0", "-e", "trace=%network", "-o", str(trace)),
            )
            calls = re.findall(r"(recv|send)\w*\(\d+<UDP:[^\n]*\) = (\d+)$", trace.read_text(), flags=re.M)
        sizes = {kind: [int(size) for name, size in calls if name == kind] for kind in ("recv", "send")}
        if not all(len(seen) >= cycles for seen in sizes.values()):
            raise Failed(f"{len(sizes['recv'])} requests and {len(sizes['send'])} answers in {cycles} cycles")
        request, answer = (sum(seen) / len(seen) for seen in sizes.values())
        return {"request": request, "answer": answer, "both on the wire": request + answer + 2 * UDP_OVER_IP}

    # ---- instructions ----
    def instructions(self, who, transport, slaves, lengths=LENGTHS):
        """Instructions per cycle of the whole process, outside of the kernel."""
        needed("valgrind", "--tool=none", "-q", "true")

        def count(cycles):
            with tempfile.TemporaryDirectory() as folder:
                result, log = Path(folder) / "callgrind", Path(folder) / "log"
                under = ("valgrind", "--tool=callgrind", f"--callgrind-out-file={result}", f"--log-file={log}")
                self.run(transport, slaves, cycles, **{f"{who}_under": under})
                totals = (
                    re.findall(r"^(?:totals|summary): (\d+)", result.read_text(), flags=re.M)
                    if result.is_file()
                    else []
                )
                if not totals:
                    raise Failed(f"callgrind gave no total: {log.read_text()}")
                return {"instructions": int(totals[-1])}

        return self.difference(count, lengths)
