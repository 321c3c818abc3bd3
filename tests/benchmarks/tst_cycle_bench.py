#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""qtplc_cycle_bench as its users see it: figures that fit together, and bad calls.

usage: tst_cycle_bench.py PROGRAM
"""
import json
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop(1)
KEYS = {f"rtt_{key}_us" for key in ("p50", "p99", "p999", "max")} | {
    "peer",
    "variant",
    "slaves",
    "in",
    "out",
    "period_us",
    "policy",
    "cycles",
    "all_cycles",
    "seconds",
    "cycles_per_s",
    "errors",
    "overruns",
    "cpu_master_us",
    "cpu_slave_us",
    "cpu_total_us",
    "ctx_master",
    "ctx_slave",
    "bytes_per_cycle",
    "packets_per_cycle",
    "threads_master",
    "threads_slave",
    "rss_slave_kb",
    "registration_s",
    "start_s",
}
PACED_KEYS = KEYS | {f"late_{key}_us" for key in ("p50", "p99", "p999", "max")} | {"drift_us"}


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


class Bench(unittest.TestCase):
    def figures(self, *arguments):
        result = run("--seconds", "0.3", "--warmup", "0.1", *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(len(result.stdout.strip().splitlines()), 1)
        return json.loads(result.stdout)

    def test_every_transport_gives_right_answers(self):
        for transport in ("udp", "udp-multicast", "tcp", "local", "inprocess"):
            for slaves in (1, 3):
                with self.subTest(transport=transport, slaves=slaves):
                    figures = self.figures("--transport", transport, "--slaves", str(slaves))
                    self.assertEqual(set(figures), KEYS)
                    self.assertEqual(
                        (figures["variant"], figures["slaves"], figures["errors"], figures["overruns"]),
                        (transport, slaves, 0, 0),
                    )
                    self.assertGreater(figures["cycles"], 20)
                    self.assertGreaterEqual(figures["all_cycles"], figures["cycles"])
                    self.assertGreater(figures["rtt_p50_us"], 0)
                    self.assertLessEqual(figures["rtt_p50_us"], figures["rtt_p99_us"])
                    self.assertLessEqual(figures["rtt_p99_us"], figures["rtt_max_us"])

    def test_sealed_frames_give_right_answers(self):
        for transport in ("udp", "tcp"):
            with self.subTest(transport=transport):
                figures = self.figures("--transport", transport, "--slaves", "3", "--sealed")
                self.assertEqual(
                    (figures["variant"], figures["errors"], figures["overruns"]), (f"{transport} sealed", 0, 0)
                )
                self.assertGreater(figures["cycles"], 20)

    def test_a_paced_run_keeps_its_grid(self):
        figures = self.figures("--period-us", "5000", "--slaves", "2")
        self.assertEqual(set(figures), PACED_KEYS)
        self.assertAlmostEqual(
            figures["cycles"] + figures["overruns"], figures["seconds"] / 0.005, delta=0.3 * figures["seconds"] / 0.005
        )
        self.assertLess(abs(figures["drift_us"]), 5000)
        self.assertLessEqual(figures["late_p50_us"], figures["late_max_us"])

    def test_a_period_that_nobody_keeps_is_seen_in_the_overruns(self):
        figures = self.figures("--period-us", "10", "--slaves", "2")
        self.assertGreater(figures["overruns"], figures["seconds"] * 1e5 * 0.3)

    def test_other_sizes(self):
        figures = self.figures("--in", "1", "--out", "1000")
        self.assertEqual((figures["in"], figures["out"], figures["errors"]), (1, 1000, 0))

    def test_bad_calls_are_refused_in_one_sentence(self):
        for arguments, text in (
            (["--transport", "pigeon"], "use one of"),
            (["--slaves", "0"], "1 ... 250"),
            (["--sealed", "--transport", "local"], "not sealed"),
            (["--period-us", "9"], "use 10 or more"),
            (["--period-us", "-1"], "0 ... 10000000"),
            (["--seconds", "x"], "--seconds"),
            (["--nonsense"], "nonsense"),
        ):
            with self.subTest(arguments=arguments):
                result = run(*arguments)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(text, result.stderr)


if __name__ == "__main__":
    unittest.main()
