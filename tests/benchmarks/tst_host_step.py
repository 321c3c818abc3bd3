#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""host_step as its users see it: figures that fit together, and bad calls.

usage: tst_host_step.py PROGRAM
"""
import unittest

from rounds import Rounds


class HostStep(Rounds, unittest.TestCase):
    def test_all_programs_of_others_have_computed(self):
        figures = self.figures_of("1")
        self.assertEqual(len(figures), 7)
        for name, microseconds in figures.items():
            with self.subTest(name):
                self.assertGreater(microseconds, 0.0)
        self.assertAlmostEqual(figures["fmu_above_us"], figures["fmu_node_us"] - figures["fmu_us"], delta=0.0002)


if __name__ == "__main__":
    unittest.main()
