#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types the commands of pages about recordings, and runs their Python, in an empty folder.

usage: tst_pages.py PROGRAMS_FOLDER SOURCE_FOLDER
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

BLOCK = re.compile(r"^```(sh|python)\n(.*?)^```$", re.M | re.S)
# What is on a page, and what is seen when it is typed.
PAGES = {"docs/howto/read-a-recording.md": "2000 cycles, largest power", "docs/recording.md": "report of"}
FILES = {
    "docs/howto/read-a-recording.md": ["flight.csv", "flight.parquet", "flight.mat", "report.html"],
    "docs/recording.md": ["flight.csv", "report.html", "power.html"],
}
# Of other pages of the same test, or of a master that runs.
BEFORE = {"docs/recording.md": "awe_sil --duration 20 --record flight.mcap\n"}


def number_of(text):
    count, power = re.search(r"(\d+) cycles, largest power (\S+) W", text).groups()
    return int(count), float(power)


def main():
    programs, source = map(Path, sys.argv[1:3])
    example = source / "examples/airborne_wind_energy/report"
    path = f"{programs}:{example}:{os.environ['PATH']}"
    for page, text in PAGES.items():
        blocks = BLOCK.findall((source / page).read_text())
        if page in BEFORE:  # the part about tables alone: the others need a plant
            blocks = [("sh", BEFORE[page])] + [
                block for block in blocks if "export" in block[1] or "report" in block[1]
            ]
        seen = ""
        with tempfile.TemporaryDirectory() as folder:
            for kind, block in blocks:
                command = ["bash", "-euc", block] if kind == "sh" else [sys.executable, "-c", block]
                run = subprocess.run(
                    command, cwd=folder, env=dict(os.environ, PATH=path), capture_output=True, text=True, timeout=120
                )
                seen += run.stdout
                if "built without HDF5" in run.stderr:
                    continue
                assert run.returncode == 0, f"{page}: {block}\n{run.stdout}{run.stderr}"
            assert text in seen, f"{page}: no '{text}' in\n{seen}"
            if page == "docs/howto/read-a-recording.md":
                program = [programs / "howto_largest_power", Path(folder) / "flight.mcap"]
                line = subprocess.run(program, capture_output=True, text=True, timeout=120, check=True).stdout
                count, power = number_of(line)
                cycles, written = number_of(seen)  # with the digits of the type of the signal
                assert count == cycles and abs(power - written) < 1e-6 * power, f"{page}: C++ prints {line}"
            missing = [name for name in FILES[page] if not (Path(folder) / name).exists()]
            assert missing in ([], ["flight.mat"]), f"{page}: {missing}"
            if page in BEFORE:
                html = (Path(folder) / "power.html").read_text()
                for wanted in ("mean mechanical power", "<h2>Power</h2>", "prefers-color-scheme", "bodyPosition_earth"):
                    assert wanted in html, f"the report has no '{wanted}'"
                nodes = html[html.index("<h2>Nodes</h2>") : html.index("<h2>All signals</h2>")]
                asked = re.findall(r'<tr><td>(\w+)</td><td class="n">(\d+)</td>', nodes)
                assert asked == [(name, "2000") for name in ("FlightObserver", "Model", "Autopilot")], nodes
                assert "http" not in html and "<script" not in html and " src=" not in html
    print("all pages were typed")


if __name__ == "__main__":
    main()
