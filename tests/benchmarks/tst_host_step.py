#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""host_step as its users see it: figures that fit together, and bad calls.

usage: tst_host_step.py PROGRAM
"""
import json
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop(1)


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


class HostStep(unittest.TestCase):
    def test_all_programs_of_others_have_computed(self):
        result = run("1")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        figures = json.loads(result.stdout)
        self.assertEqual(len(figures), 7)
        for name, microseconds in figures.items():
            with self.subTest(name):
                self.assertGreater(microseconds, 0.0)
        self.assertAlmostEqual(figures["fmu_above_us"], figures["fmu_node_us"] - figures["fmu_us"], delta=0.0002)

    def test_a_wrong_number_of_rounds_is_refused(self):
        for rounds in ("many", "0", "2x"):
            with self.subTest(rounds):
                result = run(rounds)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(f"'{rounds}' rounds", result.stderr)


if __name__ == "__main__":
    unittest.main()
