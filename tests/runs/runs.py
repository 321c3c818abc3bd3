#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sees that every test runs somewhere (docs/tests.md).

runs.py labels SOURCE BUILD        by its labels each test of the build runs for each change, or is
                                   in the list of the nightly run
runs.py ran SOURCE BUILD...        each test of these builds is in the file tests.xml that CTest
                                   wrote in one of them, or in that list
runs.py record SOURCE NAME RESULT SECONDS   writes the result of a nightly run into that list
"""
import datetime
import json
import re
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

PAGE = Path("docs/tests.md")
ROW = re.compile(
    r"^\| `([^`]+)` \|([^|\n]*)\| (never|\d{4}-\d\d-\d\d) \| (-|passed|FAILED|skipped) \| (-|\d+ s) \|$", re.M
)
CHANGE = ("change-release", "change-asan")


def tests_of(build):
    """Name of each test: its labels."""
    command = ["ctest", "--test-dir", str(build), "--show-only=json-v1"]
    listed = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    properties = {test["name"]: {p["name"]: p["value"] for p in test["properties"]} for test in listed["tests"]}
    return {name: set(values.get("LABELS", [])) for name, values in properties.items()}


def filters_of(source):
    """Name of each test preset of a change: tells whether it takes a test with these labels."""
    presets = json.loads((Path(source) / "CMakePresets.json").read_text())["testPresets"]
    found = {}
    for preset in presets:
        if preset["name"] in CHANGE:
            label = {kind: preset["filter"].get(kind, {}).get("label") for kind in ("include", "exclude")}
            found[preset["name"]] = lambda labels, label=label: (
                (label["include"] is None or any(re.search(label["include"], one) for one in labels))
                and not (label["exclude"] and any(re.search(label["exclude"], one) for one in labels))
            )
    return found


def nightly_of(page):
    return {row[0]: row[1:] for row in ROW.findall(page)}


def check_labels(tests, filters, nightly):
    errors = [f"there is no test preset {name}" for name in CHANGE if name not in filters]
    for name, labels in tests.items():
        runs = [preset for preset, takes in filters.items() if takes(labels)]
        if "nightly" in labels and name not in nightly:
            errors.append(f"{name} has the label nightly, and no row in {PAGE}")
        if not runs and "nightly" not in labels:
            errors.append(f"{name} runs nowhere: no test preset of a change takes its labels ({', '.join(labels)})")
        if len(runs) > 1 and "optimised" not in labels:
            errors.append(f"{name} runs twice; if both builds tell something, its label is optimised")
    errors += [
        f"{PAGE} has a row for {name}, which is no nightly test"
        for name in nightly
        if " " not in name and "nightly" not in tests.get(name, {"nightly"})
    ]
    return errors


def check_ran(tests, ran, nightly):
    return [
        f"{name} ran nowhere, and is not in the nightly list of {PAGE}" for name in sorted(tests - ran - set(nightly))
    ]


def ran_in(build):
    suite = xml.etree.ElementTree.parse(Path(build) / "tests.xml").getroot()
    return {case.get("name") for case in suite.iter("testcase") if case.get("status") != "disabled"}


def record(page, name, result, seconds, date):
    row = re.compile(rf"^(\| `{re.escape(name)}` \|[^|\n]*\|).*$", re.M)
    if not row.search(page):
        raise SystemExit(f"runs: {PAGE} has no row for {name}")
    return row.sub(rf"\1 {date} | {result} | {seconds} s |", page)


def main(arguments):
    if len(arguments) < 3 or arguments[0] not in ("labels", "ran", "record"):
        raise SystemExit(__doc__)
    source = Path(arguments[1])
    page = (source / PAGE).read_text()
    nightly = nightly_of(page)
    if arguments[0] == "record":
        name, result, seconds = arguments[2:]
        (source / PAGE).write_text(record(page, name, result, seconds, datetime.date.today()))
        return 0
    if arguments[0] == "labels":
        tests = tests_of(arguments[2])
        errors = check_labels(tests, filters_of(source), nightly)
    else:
        tests = set().union(*(tests_of(build) for build in arguments[2:]))
        errors = check_ran(tests, set().union(*(ran_in(build) for build in arguments[2:])), nightly)
    print("\n".join(errors) or f"each of {len(tests)} tests runs")
    return 1 if errors or not tests else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
