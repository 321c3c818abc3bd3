#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the scripts with slow programs in the place of cmake and apt-get, and looks at what a person
sees while he waits: at least every 2 s a line that says which step of how many it is, how far it
is, and how long it takes. A log has plain lines, a terminal one line that is written again and
again.

usage: progress.py FOLDER_OF_SCRIPTS
"""
import os
import pty
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

LONGEST_GAP = 2.0  # [s]
ATTEMPTS = 3  # on a machine that has stopped for a second, the next attempt tells
STARTS = 3  # programs that a script starts for a line

SLOW_CMAKE = """#!/bin/sh
case "$*" in
    *--build*) for i in 1 2 3; do echo "[$i/4] Building CXX object $i"; sleep 0.3; done
        sleep 3; echo "[4/4] Linking" ;;
    *) echo "-- The CXX compiler identification is GNU" ;;
esac
"""
BROKEN_CMAKE = """#!/bin/sh
case "$*" in *--build*) echo "[1/4] Building CXX object 1"; echo "winch.cpp:7: error: expected ';'"; exit 3 ;; esac
"""
# Like the real one, it closes the descriptor of its status for the script of a package, which ends
# at an echo that fails.
SLOW_APT = """#!/bin/bash
[[ "$*" =~ APT::Status-Fd=([0-9]+) ]]
status=${BASH_REMATCH[1]}
case "$*" in
    *" update"*) echo "dlstatus:1:50.0000:Retrieving file 1 of 2" >&$status ;;
    *)
        echo "dlstatus:1:20.0000:Retrieving file 1 of 5" >&$status
        sleep 2.5
        echo "pmstatus:cmake:60.0000:Unpacking cmake" >&$status
        sleep 2.5
        (eval "exec $status>&-"; exec bash -c 'set -e; echo "Updating symlinks"') || exit 100
        ;;
esac
"""
# Nothing is installed.
NO_PACKAGE = "#!/bin/sh\necho not-installed\n"
# sudo [--option]... COMMAND
SUDO = '#!/bin/sh\nwhile [ "${1#-}" != "$1" ]; do shift; done\nexec "$@"\n'
PROGRAM = """#!/bin/sh
[ "$1" != --help ] || exit 0
[ -z "$QTPLC_PROGRESS" ] || { echo "progress: 900 of 1800"; sleep 2.5; }
echo flown
"""
GREETING = """#!/usr/bin/env bash
. "$(dirname "$0")/lib/progress"
log=mine start=mine text=mine output=mine status=mine mode=mine
greet() { echo "$log $start $text $output $status $mode"; }
step --show "Greet" greet
"""

LINE = re.compile(r"^(\[\d+/\d+\] [A-Z].*): (.+), (?:\d+ min )?\d+ s$")


class Pace:
    """How long this machine takes to start a small program, at the worst."""

    def __init__(self):
        self.slowest = 0.0
        self.has_ended = threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while not self.has_ended.wait(0.2):
            begin = time.monotonic()
            subprocess.run(["true"], check=True)
            self.slowest = max(self.slowest, time.monotonic() - begin)

    def end(self):
        self.has_ended.set()
        self.thread.join()
        return self.slowest


class Shown:
    """What a command wrote, piece by piece, with the time of each piece."""

    def __init__(self, command, folder, terminal):
        environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}
        for name in ("DISPLAY", "WAYLAND_DISPLAY", "PROGRESS_FD", "PROGRESS_INSIDE"):
            environment.pop(name, None)
        reader, writer = pty.openpty() if terminal else os.pipe()
        self.pieces = []
        program = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=writer, stderr=writer, env=environment)
        os.close(writer)
        begin = time.monotonic()
        pace = Pace()
        while True:
            try:
                piece = os.read(reader, 65536)
            except OSError:  # what a terminal says at its end
                break
            if not piece:
                break
            self.pieces.append((time.monotonic() - begin, piece.decode()))
        os.close(reader)
        self.seconds = time.monotonic() - begin
        self.slowest_start = pace.end()
        self.code = program.wait()
        self.text = "".join(text for _, text in self.pieces)

    def longest_gap(self):
        """Without what the machine itself took at that time."""
        times = [0.0, *(when for when, _ in self.pieces), self.seconds]
        return max(after - before for before, after in zip(times, times[1:])) - STARTS * self.slowest_start


class Progress(unittest.TestCase):
    scripts = None

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        shutil.copytree(self.scripts, self.folder / "scripts")
        self.program("bin/dpkg-query", "#!/bin/sh\necho installed\n")
        self.program("bin/apt-get", SLOW_APT)
        self.program("bin/sudo", SUDO)
        self.program("bin/cmake", SLOW_CMAKE)
        self.program("build/release/bin/awe_sil", PROGRAM)

    def program(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def run_script(self, *command, terminal=False):
        for _ in range(ATTEMPTS):
            shown = Shown([str(self.folder / "scripts" / command[0]), *command[1:]], self.folder, terminal)
            if shown.longest_gap() <= LONGEST_GAP:
                break
        self.assertLessEqual(shown.longest_gap(), LONGEST_GAP, f"a person waits without a sign of life:\n{shown.text}")
        return shown

    def test_a_build_tells_step_part_and_time_in_a_log(self):
        shown = self.run_script("run", "--text")
        self.assertEqual(shown.code, 0, shown.text)
        lines = shown.text.splitlines()
        lines.remove("flown")
        for line in lines:
            self.assertRegex(line, LINE)
        self.assertIn("[3/4] Build: 3 of 4 (75 %), ", shown.text)
        self.assertRegex(shown.text, r"\n\[3/4\] Build: done, [3-9] s\n")
        self.assertRegex(shown.text, r"\n\[4/4\] Fly: 900 of 1800 \(50 %\), [0-9] s\n")

    def test_a_terminal_has_one_line_that_is_written_again(self):
        shown = self.run_script("run", "--text", terminal=True)
        self.assertEqual(shown.code, 0, shown.text)
        build = [line for line in shown.text.split("\r\n") if "Build" in line]
        self.assertEqual(len(build), 1, f"the build takes more than a line: {build}")
        self.assertGreaterEqual(build[0].count("\r[3/3] Build: 3 of 4 (75 %), "), 2)

    def test_an_installation_tells_how_far_it_is(self):
        self.program("bin/dpkg-query", NO_PACKAGE)
        shown = self.run_script("run", "--text")
        self.assertEqual(shown.code, 0, shown.text)
        self.assertIn("[1/4] Packages: [1/2] Read the lists of packages: ", shown.text)
        self.assertRegex(
            shown.text,
            r"\[1/4\] Packages: \[2/2\] Install \d+ packages and what they need: 20 %, Retrieving file 1 of 5, \d s\n",
        )
        self.assertRegex(
            shown.text,
            r"\[1/4\] Packages: \[2/2\] Install \d+ packages and what they need: 60 %, Unpacking cmake, \d s\n",
        )

    def test_what_a_step_says_is_shown_when_it_fails(self):
        self.program("bin/cmake", BROKEN_CMAKE)
        shown = self.run_script("run", "--text")
        self.assertEqual(shown.code, 3)
        self.assertIn("[3/4] Build: FAILED, ", shown.text)
        self.assertIn("winch.cpp:7: error: expected ';'", shown.text)
        self.assertIn("run: this failed: cmake --build --preset release --target programs", shown.text)

    def test_a_function_that_is_a_step_sees_the_variables_of_its_script(self):
        self.program("scripts/greet", GREETING)
        shown = self.run_script("greet")
        self.assertEqual(shown.code, 0, shown.text)
        self.assertIn("mine mine mine mine mine mine", shown.text)

    def test_every_script_that_builds_or_installs_shows_its_progress(self):
        for script in sorted(self.scripts.iterdir()):
            if script.is_file():
                self.assertRegex(
                    script.read_text(), r"(?m)^\. .*lib/progress", f"{script.name} does not use scripts/lib/progress"
                )


if __name__ == "__main__":
    Progress.scripts = Path(sys.argv.pop(1))
    unittest.main()
