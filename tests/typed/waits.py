#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Commands for which a person waits longer than a moment say on a terminal how far they are.

usage: waits.py FOLDER_OF_PROGRAMS
"""
import subprocess
import sys
import tempfile
from pathlib import Path

from typed import Broken, Terminal, in_own_network, require


def main():
    programs = Path(sys.argv[1]).resolve()
    in_own_network()
    with tempfile.TemporaryDirectory() as home:
        terminal = Terminal(Path(home))
        try:
            shown, code = terminal.type(f"{programs}/qtplc find --seconds 2.2")
            require(code == 1, f"qtplc find gives {code}")
            for seconds in ("0.5", "1", "1.5", "2"):
                require(
                    f"listens for masters: {seconds} of 2.2 s" in shown,
                    f"qtplc find does not say what it waits for at {seconds} s: {shown}",
                )
            shown, _ = terminal.type(f"{programs}/qtplc doctor")
            for step in ("1", "2", "3"):
                require(f"measures {step} of 3" in shown, f"qtplc doctor does not show its step {step}: {shown}")
        finally:
            terminal.close()
        # No line for a log.
        run = subprocess.run(
            [programs / "qtplc", "find", "--seconds", "1.2"],
            capture_output=True,
            text=True,
            env={"XDG_RUNTIME_DIR": home, "HOME": home},
        )
        require("listens" not in run.stderr + run.stdout, f"a log gets {run.stderr}")
    print("commands say how far they are")


if __name__ == "__main__":
    try:
        main()
    except Broken as broken:
        sys.exit(str(broken))
