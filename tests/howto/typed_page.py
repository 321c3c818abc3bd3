#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types the commands of docs/howto/find-out-why-it-stopped.md, with the programs of a build.

usage: typed_page.py PAGE FOLDER_OF_PROGRAMS
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

# What the page says of a command: its exit code, and what it shows.
SAYS = {
    "qtplc verify flight.mcap": (0, r"as that of the flight: nothing is missing"),
    "qtplc events --file flight.mcap": (0, r" state +\S"),
    "qtplc replay flight.mcap --node awe_autopilot --compare": (0, r" 0 differences"),
    "qtplc replay flight.mcap --node 'awe_autopilot --gains tuned' --compare": (1, r"first difference: \w+, cycle \d+"),
}


def main(page, programs):
    text = Path(page).read_text()
    commands = [line for block in re.findall(r"```sh\n(.*?)```", text, re.S) for line in block.splitlines()]
    forgotten = set(SAYS) - set(commands)
    if forgotten:
        sys.exit(f"the page does not type {forgotten}")
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")
    with tempfile.TemporaryDirectory() as work:
        for command in commands:
            run = subprocess.run(
                command, shell=True, cwd=work, env=environment, capture_output=True, text=True, timeout=240
            )
            code, shows = SAYS.get(command, (0, ""))
            if run.returncode != code or not re.search(shows, run.stdout):
                sys.exit(f"{command}: exit code {run.returncode}\n{run.stdout}{run.stderr}")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
