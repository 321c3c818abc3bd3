#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares what qtplc_fmu computes with published results: for each MODEL.fmu of a folder, with
MODEL_out.csv below another one, such as those of the Reference FMUs of the Modelica Association.
Neither is a part of QtPLC: download and build them where you like.

usage: reference.py QTPLC_FMU FOLDER_OF_FMUS FOLDER_OF_RESULTS

Prints the largest difference of each model; the exit code is 0 if there is none.
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

UNPUBLISHED = "none of its outputs is published"
TRUTH = {"false": 0.0, "true": 1.0}


def table(path):
    """Names of the columns, and the lines."""
    with open(path) as file:
        rows = list(csv.reader(file))
    return rows[0], rows[1:]


def numbers(cell):
    return [TRUTH[word] if word in TRUTH else float(word) for word in cell.split()]


def compare(program, fmu, published, folder):
    """\\return the largest difference and how many values were compared, or what has failed"""
    names, rows = table(published)
    step = float(rows[1][0]) - float(rows[0][0])
    out = Path(folder) / "out.csv"
    # An FMU may end itself at the last line.
    stop = float(rows[-1][0]) + (step if "Stair" in fmu.stem else 0.0)
    result = subprocess.run(
        [program, "run", fmu, "--step", str(step), "--stop", str(stop), "--out", out], capture_output=True, text=True
    )
    if result.returncode != 0:
        return None, result.stderr.strip()
    own_names, own_rows = table(out)
    if len(own_rows) != len(rows):
        return None, f"{len(own_rows)} lines instead of {len(rows)}"
    common = [name for name in own_names[1:] if name in names]
    if not common:
        return None, UNPUBLISHED
    differences = [
        abs(a - b)
        for row, own in zip(rows, own_rows)
        for name in common
        for a, b in zip(numbers(row[names.index(name)]), numbers(own[own_names.index(name)]))
    ]
    return max(differences), len(differences)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, fmus, results = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    worst, count = 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        for fmu in sorted(fmus.glob("*.fmu")):
            published = next(results.rglob(f"{fmu.stem}_out.csv"), None)
            if published is None:
                print(f"{fmu.stem}: no published result")
                continue
            difference, text = compare(program, fmu, published, folder)
            if difference is None and text == UNPUBLISHED:
                print(f"{fmu.stem}: {text}")
                continue
            count += 1
            worst = max(worst, float("inf") if difference is None else difference)
            print(f"{fmu.stem}: {text if difference is None else f'largest difference of {text} values: {difference}'}")
    return 0 if count > 0 and worst == 0.0 else 1


if __name__ == "__main__":
    sys.exit(main())
