#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The arithmetic, the tables and the picture of benchmarks/compare_cycles, with figures that are
known.

usage: tst_comparison.py FOLDER
"""
import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from collections import Counter
from pathlib import Path

FOLDER = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(FOLDER))
from comparison import machine, picture, programs, report, syscalls, wakeup  # noqa: E402
from comparison.reach import ONE_CORE, Reach  # noqa: E402
from comparison.runs import Configuration, Results, Runner, missed_share  # noqa: E402


def run_of(name, p50, noisy=False, slaves=1, **more):
    return {
        "name": name,
        "mode": ONE_CORE,
        "slaves": slaves,
        "noisy": noisy,
        "period_us": 0,
        "rtt_p50_us": p50,
        "rtt_p99_us": 2 * p50,
        "cpu_total_us": p50 + 1,
        "bytes_per_cycle": 228.0 * slaves,
        "cycles": 100,
        "seconds": 1.0,
        "overruns": 0,
        **more,
    }


class Arithmetic(unittest.TestCase):
    def test_best_median_and_ratio(self):
        results = Results([run_of("a", 3), run_of("a", 1), run_of("a", 8), run_of("b", 2), run_of("b", 4)])
        self.assertEqual(results.best(ONE_CORE, 1, "a", "rtt_p50_us"), 1)
        self.assertEqual(results.median(ONE_CORE, 1, "a", "rtt_p50_us"), 3)
        self.assertEqual(results.ratio(ONE_CORE, 1, "a", "b", "rtt_p50_us"), 0.5)
        self.assertEqual(results.ratio(ONE_CORE, 1, "a", "b", "rtt_p50_us", "median"), 1)
        self.assertIsNone(results.ratio(ONE_CORE, 1, "a", "nobody", "rtt_p50_us"))
        self.assertIsNone(results.best(ONE_CORE, 2, "a", "rtt_p50_us"))

    def test_missed_cycles_count_once_each_whoever_counts(self):
        due = {"seconds": 1.0, "period_us": 1000}
        self.assertEqual(missed_share({**due, "cycles": 1000, "overruns": 0}), 0)
        self.assertEqual(missed_share({**due, "cycles": 999, "overruns": 0}), 0)  # the border of the measured time
        self.assertEqual(missed_share({**due, "cycles": 1000, "overruns": 10}), 0.01)
        self.assertEqual(
            missed_share({**due, "cycles": 502, "overruns": 10}), 0.496
        )  # it left them out and counted little
        self.assertEqual(missed_share({**due, "cycles": 0, "overruns": 0}), 1)

    def test_quantiles_of_a_histogram(self):
        self.assertEqual(wakeup.quantile([(0, 0), (5, 98), (70, 2)], 0.5), 5.5)
        self.assertEqual(wakeup.quantile([(5, 98), (70, 2)], 0.99), 70.5)
        with self.assertRaises(ValueError):
            wakeup.quantile([], 0.5)

    def test_system_calls_are_those_between_the_runs(self):
        few, many = Counter(send=110, open=7), Counter(send=310, open=7)
        self.assertEqual(syscalls.difference(many, few, 100), {"send": 2.0})

    def test_reach_tells_met_from_missed(self):
        reach = Reach(Results([run_of("qtplc/udp", 11), run_of("udp/blocking", 10), run_of("zmq/router", 20)]))
        reach.one_core()
        met = {row.what.split(": ")[1]: row.met for row in reach.rows}
        self.assertEqual(met["qtplc/udp, p50, x udp/blocking"], True)
        self.assertEqual(met["qtplc/udp, p50, x zmq/router"], False)
        self.assertFalse(any("tcp" in row.what for row in reach.rows))  # not measured: not judged


class Runs(unittest.TestCase):
    def test_a_program_that_fails_is_told_and_others_go_on(self):
        runner = Runner(quiet=1000, seconds=0.1)
        runner.namespace = ()
        good = programs.Program("good", ("sh", "-c", "echo '" + json.dumps({"cycles": 1}) + "'", "sh"), 10)
        bad = programs.Program("bad", ("sh", "-c", "echo reason >&2; exit 1", "sh"), 10)
        runner.rounds([good, bad], Configuration(ONE_CORE, 3), 2)
        self.assertEqual([result["name"] for result in runner.results], ["good", "good"])
        self.assertEqual(runner.failures, {"bad": "reason"})
        self.assertIsNone(runner.run(good, Configuration(ONE_CORE, 11)))  # more slaves than it can

    def test_the_command_ends_for_certain_and_is_pinned(self):
        runner = Runner(quiet=1, seconds=1)
        runner.namespace = ()
        line = runner.command(programs.Program("p", ("p",), 1), Configuration("m", 4, 1000, "fifo", 1), 2)
        self.assertEqual(line[:9], ["timeout", "-s", "KILL", "42", "taskset", "-c", "1", "chrt", "-f"])
        self.assertEqual(line[line.index("--slaves") + 1], "4")


class Output(unittest.TestCase):
    def test_picture_is_xml_with_a_bar_for_each_figure(self):
        drawing = picture.draw(
            "a < b",
            "s",
            [("1", {"qtplc/udp": 11.0, "udp/blocking": 10.0}), ("10", {"qtplc/udp": 99.0})],
            "udp/blocking",
        )
        tags = [element.tag.split("}")[1] for element in xml.fromstring(drawing).iter()]
        self.assertEqual(tags.count("rect"), 1 + 3)
        self.assertEqual(tags.count("line"), 1)  # no reference, no line

    def test_kept_runs_give_the_tables_again(self):
        kept = {
            "machine": "m",
            "load": "1",
            "quiet": 0.25,
            "failures": {},
            "runs": [run_of("qtplc/udp", 11), run_of("udp/blocking", 10, noisy=True)],
        }
        with tempfile.TemporaryDirectory() as folder:
            file, drawing = Path(folder) / "runs.json", Path(folder) / "p.svg"
            file.write_text(json.dumps(kept))
            script = [
                sys.executable,
                "-B",
                str(FOLDER / "compare_cycles"),
                "--from",
                str(file),
                str(file),
                "--svg",
                str(drawing),
            ]
            run = subprocess.run(script, capture_output=True, text=True, timeout=60)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertIn("| **qtplc/udp** | 11.0 (11.0) | 22.0 | 12.0 | 1.10 |", run.stdout)
            self.assertIn("2 of 4 runs were noisy", run.stdout)
            self.assertIn("qtplc/udp", drawing.read_text())

    def test_bad_calls(self):
        for arguments in (["--parts", "lunch"], ["--slaves", "0"], ["--rounds", "0"], ["--from", "/nowhere"]):
            run = subprocess.run(
                [sys.executable, "-B", str(FOLDER / "compare_cycles"), *arguments],
                capture_output=True,
                text=True,
                timeout=60,
            )
            self.assertEqual(run.returncode, 2, run.stderr)
        run = subprocess.run(
            [sys.executable, "-B", str(FOLDER / "compare_cycles"), "--bin", "/nowhere"],
            capture_output=True,
            text=True,
            timeout=60,
        )
        self.assertIn("remedy", run.stderr)
        self.assertEqual(run.returncode, 2)

    def test_the_machine_has_a_description_without_its_name(self):
        self.assertIn("Linux", machine.description())
        self.assertEqual(report.show(None), "-")


if __name__ == "__main__":
    unittest.main()
