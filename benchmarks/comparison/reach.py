# SPDX-License-Identifier: Apache-2.0
"""What is to be reached, and what was: a row for each figure that was measured."""
from dataclasses import asdict, dataclass

from .programs import REFERENCE, SECOND

ONE_CORE, FIFO = "one core, back to back", "1 kHz, SCHED_FIFO"


@dataclass
class Row:
    what: str
    bound: str
    reach: float
    seen: float
    digits: int = 3

    @property
    def met(self):
        return self.seen <= self.reach if self.bound == "<=" else self.seen >= self.reach

    def as_dict(self):
        return {**asdict(self), "met": self.met}


class Reach:
    def __init__(self, results):
        self.results, self.rows = results, []

    def expect(self, what, bound, reach, seen, digits=3):
        if seen is not None:
            self.rows.append(Row(what, bound, reach, seen, digits))

    def ratio(self, mode, slaves, name, other, key, reach):
        label = {"rtt_p50_us": "p50", "rtt_p99_us": "p99", "cpu_total_us": "CPU"}[key]
        seen = self.results.ratio(mode, slaves, name, other, key)
        self.expect(f"{mode}, N = {slaves}: {name}, {label}, x {other}", "<=", reach, seen)

    # ---- groups ----
    def one_core(self):
        for slaves, floor, zmq in ((1, 1.20, 0.30), (10, 1.10, 0.36), (32, 1.00, 0.36)):
            for key in ("rtt_p50_us", "cpu_total_us"):
                self.ratio(ONE_CORE, slaves, "qtplc/udp", REFERENCE, key, floor)
                self.ratio(ONE_CORE, slaves, "qtplc/udp", SECOND, key, zmq)
        for slaves, name, reach in (
            (10, "udp-multicast", 0.80),
            (32, "udp-multicast", 0.75),
            (1, "tcp", 1.45),
            (10, "tcp", 1.40),
            (1, "local", 0.60),
            (10, "local", 0.60),
        ):
            self.ratio(ONE_CORE, slaves, f"qtplc/{name}", REFERENCE, "rtt_p50_us", reach)

    def in_process(self):
        few, many = (self.results.best(ONE_CORE, n, "qtplc/inprocess", "rtt_p50_us") for n in (1, 32))
        if few is not None and many is not None:
            self.expect("node in the master's process: per node and cycle [ns]", "<=", 300, (many - few) * 1e3 / 31, 0)

    def paced(self):
        for key in ("rtt_p50_us", "rtt_p99_us", "cpu_total_us"):
            self.ratio(FIFO, 10, "qtplc/udp", "udp/mmsg", key, 1.15)
            self.ratio(FIFO, 10, "qtplc/udp", SECOND, key, 0.45)
        missed = self.results.missed(FIFO, 32, "qtplc/udp")
        self.expect(
            f"{FIFO}, N = 32: qtplc/udp, missed cycles [%]", "<=", 0.5, None if missed is None else 100 * missed
        )

    def slave(self):
        self.expect(
            "UDP, 3 -> 32 floats: bytes per slave and cycle on the wire",
            "<=",
            228,
            whole_bytes(self.results.median(ONE_CORE, 10, "qtplc/udp", "bytes_per_cycle"), 10),
            0,
        )
        memory = self.results.median(ONE_CORE, 1, "qtplc/udp", "rss_slave_kb")
        self.expect("slave: resident memory [MB]", "<=", 9, None if memory is None else memory / 1000, 1)
        self.expect("slave: threads", "<=", 2, self.results.median(ONE_CORE, 1, "qtplc/udp", "threads_slave"), 0)

    def wake_up(self, period_us, policy, figures):
        """figures: as wakeup.measure() gives them."""
        for ours, other in (("qtplc", "timer_jitter"), ("qtplc, processors awake", "cyclictest")):
            for place, label in enumerate(("p50", "p99")):
                if ours in figures and other in figures and figures[other][place] > 0:
                    ratio = figures[ours][place] / figures[other][place]
                    self.expect(
                        f"wake-up, {period_us / 1000:g} ms, SCHED_{policy.upper()}: {ours}, {label}, x {other}",
                        "<=",
                        1.1,
                        ratio,
                    )

    def rates(self, rates):
        """rates: program -> highest rate [Hz]."""
        for other, reach in (("udp/mmsg", 0.9), (SECOND, 2.0)):
            if rates.get(other) and "qtplc/udp" in rates:
                self.expect(
                    f"highest rate, SCHED_FIFO, N = 10: qtplc/udp, x {other}",
                    ">=",
                    reach,
                    rates["qtplc/udp"] / rates[other],
                )

    def system_calls(self, master, slave):
        self.expect("system calls per cycle: master of 10 UDP slaves", "<=", 5, round(sum(master.values()), 1), 1)
        self.expect("system calls per cycle: slave", "<=", 2, round(sum(slave.values()), 1), 1)

    def drift(self, minutes, drift_us):
        self.expect(f"drift of t_k - t0 - k * period in {minutes:g} min at 1 kHz [µs]", "<=", 100, abs(drift_us), 0)


def whole_bytes(per_cycle, slaves):
    """Per slave; the fraction is what the control connection has said meanwhile."""
    return None if per_cycle is None else round(per_cycle / slaves)
