# SPDX-License-Identifier: Apache-2.0
"""A benchmark that takes its number of rounds as the argument, and prints JSON."""
import json
import subprocess
import sys

PROGRAM = sys.argv.pop(1)


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


class Rounds:
    """For its test, before unittest.TestCase."""

    def figures_of(self, rounds):
        result = run(rounds)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout)

    def test_a_wrong_number_of_rounds_is_refused(self):
        for rounds in ("many", "0", "2x"):
            with self.subTest(rounds):
                result = run(rounds)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(f"'{rounds}' rounds", result.stderr)
