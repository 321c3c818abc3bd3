#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""qtplc_plot_bench as its users see it: figures that fit together, and bad calls. Speeds are not
judged here: docs/control-center-figures.md.

usage: tst_plot_bench.py PROGRAM
"""
import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
KEYS = {
    "plots",
    "curves",
    "points",
    "channels",
    "fps",
    "line_width",
    "noise",
    "mode",
    "columns",
    "frames",
    "drawn_plots",
    "cpu_percent",
    "frame_p50_ms",
    "frame_p99_ms",
    "append_ns",
    "range_ns",
    "bytes_per_sample",
    "store_mb",
    "resident_mb",
}


def run(*arguments):
    return subprocess.run(
        [PROGRAM, *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
    )


class Bench(unittest.TestCase):
    def figures(self, *arguments):
        result = run("--seconds", "0.4", "--points", "20000", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(result.stdout.strip().splitlines()), 1)
        figures = json.loads(result.stdout)
        self.assertEqual(set(figures), KEYS)
        self.assertLessEqual(figures["frame_p50_ms"], figures["frame_p99_ms"])
        self.assertGreater(figures["cpu_percent"], 0)
        return figures

    def test_every_frame_draws_every_plot(self):
        figures = self.figures("--plots", "3", "--curves", "2", "--fps", "50")
        self.assertEqual((figures["frames"], figures["drawn_plots"], figures["channels"]), (20, 60, 6))

    def test_new_columns_draw_as_often_as_there_are_new_ones(self):
        figures = self.figures(
            "--plots", "2", "--mode", "new-column", "--points", "100000"
        )  # columns of more than 100 ms
        new_columns = 400 / (100000 / figures["columns"])
        self.assertAlmostEqual(figures["drawn_plots"] / 2, new_columns, delta=1)

    def test_samples_are_as_small_as_promised(self):
        self.assertLessEqual(self.figures("--plots", "8", "--curves", "4")["bytes_per_sample"], 5.0)

    def test_four_hundred_signals_for_ten_minutes_fit(self):
        figures = self.figures("--plots", "1", "--channels", "420", "--points", "60000")
        self.assertLessEqual(figures["bytes_per_sample"], 5.0)
        self.assertGreater(figures["store_mb"], 420 * 60000 * 4e-6)
        if not os.environ.get("ASAN_OPTIONS"):
            self.assertLessEqual(figures["store_mb"], 150.0)

    def test_a_picture_is_as_large_as_the_window(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "plots.png")
            self.figures("--picture", path)
            with open(path, "rb") as file:
                header = file.read(24)
            self.assertEqual(struct.unpack(">II", header[16:24]), (1366, 768))

    def test_a_picture_that_cannot_be_written_is_told(self):
        result = run("--seconds", "0.1", "--points", "1000", "--picture", "/nonexistent/plots.png")
        self.assertEqual(result.returncode, 1)
        self.assertIn("/nonexistent/plots.png", result.stderr)

    def test_help_tells_the_options(self):
        result = run("--help")
        self.assertEqual(result.returncode, 0)
        for option in ("--plots", "--curves", "--points", "--fps", "--seconds", "--mode"):
            self.assertIn(option, result.stdout)

    def test_bad_calls_are_refused_in_one_sentence(self):
        for arguments, text in (
            (["--plots", "0"], "1 ... 64"),
            (["--points", "x"], "--points x"),
            (["--curves", "1.5"], "whole number"),
            (["--mode", "sometimes"], "new-column"),
            (["--channels", "3"], "use 32 or more"),
            (["--seconds", "0"], "0.01 ..."),
            (["--nonsense"], "nonsense"),
            (["plot"], "options only"),
        ):
            with self.subTest(arguments=arguments):
                result = run(*arguments)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(text, result.stderr)


if __name__ == "__main__":
    unittest.main()
