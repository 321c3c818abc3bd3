#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What runs.py has to notice."""
import sys
import unittest
from pathlib import Path

import runs

SOURCE = Path(sys.argv.pop())
FILTERS = runs.filters_of(SOURCE)
PAGE = (
    "| `long_flight` | hours of flight | 2026-01-31 | passed | 99 s |\n| `all of it` | | 2026-01-31 | FAILED | 1 s |\n"
)


class Runs(unittest.TestCase):
    def labels(self, nightly=(), **tests):
        return runs.check_labels(tests, FILTERS, dict.fromkeys(nightly, ()))

    def test_tests_with_and_without_labels_run_once(self):
        self.assertEqual(self.labels(tst_A=set(), tst_B={"programs"}, tst_C={"tsan"}, tst_D={"optimised"}), [])

    def test_each_label_of_the_release_build_is_known_to_both_presets(self):
        line = next(
            l for l in (SOURCE / "cmake/QtPlcTestRuns.cmake").read_text().splitlines() if "RELEASE_LABELS " in l
        )
        for label in line.strip("set()").split()[1:]:
            self.assertEqual([FILTERS[preset]({label}) for preset in runs.CHANGE], [True, False], label)

    def test_a_test_that_no_preset_takes_is_an_error(self):
        filters = {"change-release": lambda labels: False, "change-asan": lambda labels: "x" not in labels}
        self.assertIn("runs nowhere", runs.check_labels({"tst_A": {"x"}}, filters, {})[0])

    def test_a_test_that_runs_twice_is_an_error(self):
        filters = dict.fromkeys(runs.CHANGE, lambda labels: True)
        self.assertIn("runs twice", runs.check_labels({"tst_A": set()}, filters, {})[0])

    def test_a_nightly_test_needs_its_row_and_a_row_its_test(self):
        self.assertIn("no row", self.labels(tst_A={"nightly"})[0])
        self.assertEqual(self.labels(["tst_A"], tst_A={"nightly"}), [])
        self.assertIn("no nightly test", self.labels(["tst_A"], tst_A=set())[0])

    def test_a_test_that_did_not_run_is_an_error(self):
        self.assertEqual(len(runs.check_ran({"tst_A", "tst_B", "tst_C"}, {"tst_A"}, ["tst_B"])), 1)

    def test_a_result_is_written_into_its_row(self):
        self.assertEqual(sorted(runs.nightly_of(PAGE)), ["all of it", "long_flight"])
        page = runs.record(PAGE, "all of it", "passed", 12, "2026-02-01")
        self.assertEqual(runs.nightly_of(page)["all of it"][1:], ("2026-02-01", "passed", "12 s"))
        self.assertEqual(runs.nightly_of(page)["long_flight"], runs.nightly_of(PAGE)["long_flight"])
        self.assertRaises(SystemExit, runs.record, PAGE, "another", "passed", 12, "2026-02-01")


if __name__ == "__main__":
    unittest.main()
