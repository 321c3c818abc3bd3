#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""simulink_step as its users see it: figures that fit together, and bad calls.

usage: tst_simulink_step.py PROGRAM
"""
import unittest

from rounds import Rounds


class SimulinkStep(Rounds, unittest.TestCase):
    def test_both_have_computed(self):
        figures = self.figures_of("2")
        self.assertGreater(figures["function_ns"], 0.0)
        self.assertGreater(figures["node_ns"], 0.0)
        self.assertAlmostEqual(figures["difference_ns"], figures["node_ns"] - figures["function_ns"], delta=0.11)


if __name__ == "__main__":
    unittest.main()
