#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""simulink_step as its users see it: figures that fit together, and bad calls.

usage: tst_simulink_step.py PROGRAM
"""
import json
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop(1)


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


class SimulinkStep(unittest.TestCase):
    def test_both_have_computed(self):
        result = run("2")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        figures = json.loads(result.stdout)
        self.assertGreater(figures["function_ns"], 0.0)
        self.assertGreater(figures["node_ns"], 0.0)
        self.assertAlmostEqual(figures["difference_ns"], figures["node_ns"] - figures["function_ns"], delta=0.11)

    def test_a_wrong_number_of_rounds_is_refused(self):
        for rounds in ("many", "0", "2x"):
            with self.subTest(rounds):
                result = run(rounds)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(f"'{rounds}' rounds", result.stderr)


if __name__ == "__main__":
    unittest.main()
