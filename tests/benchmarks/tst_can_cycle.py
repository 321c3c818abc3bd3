#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""qtplc_can_cycle as its users see it: no frame is lost or changes its place, and bad calls.

usage: tst_can_cycle.py PROGRAM
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)


def run(*arguments):
    with tempfile.TemporaryDirectory() as folder:
        return subprocess.run(
            [PROGRAM, *arguments],
            capture_output=True,
            text=True,
            timeout=120,
            env=dict(os.environ, QTPLC_FAKE_DEVICES=folder),
        )


class CanCycle(unittest.TestCase):
    def test_no_frame_is_lost_or_changes_its_place(self):
        result = run("--seconds", "0.4", "--round", "0.2", "--period-us", "2000", "--frames", "70")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        figures = json.loads(result.stdout)
        self.assertEqual([figures[name] for name in ("lost", "reordered", "wrong_ages", "unsent")], [0, 0, 0, 0])
        self.assertGreater(figures["frames_in"], 700)
        self.assertGreater(figures["frames_out"], 700)
        self.assertGreater(figures["judged_ages"], 700)
        self.assertGreater(figures["without_can_cycles"], 10)
        self.assertLessEqual(figures["age_p50_us"], figures["age_max_us"])

    def test_a_bus_that_is_none_is_named(self):
        result = run("--device", "fake:")
        self.assertEqual(result.returncode, 1)
        self.assertIn("'fake:' does not name a fake bus", result.stderr)


if __name__ == "__main__":
    unittest.main()
