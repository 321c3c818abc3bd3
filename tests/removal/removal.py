#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Takes the defences of QtPLC away, one after the other, in a copy of the sources, and sees whether
the test notices that is said to show the defence.

usage: removal.py [--work FOLDER] [--only WORD]... [--jobs N] [--check] SOURCE_FOLDER

--work FOLDER  keeps the copy and its build there: the next call is faster
--only WORD    only the faults with this word in their names; may come several times
--jobs N       compilers at a time; one leaves the rest of the machine to others
--check        builds nothing: sees whether all that is to be taken away is there, and all tests
               are, and whether each fault of docs/faults.md has a removal that one of its tests
               notices
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from removals import REMOVALS

PATIENCE = 60  # [s] of a test that nothing ends without its defence


def source_of(program):
    """Programs of the example have a prefix that their sources, and the documents, have not."""
    return program.removeprefix("awe_")


def name_of(removal):
    """As docs/faults.md names the test."""
    return f"{source_of(removal.program)}::{removal.test}" if removal.test else removal.program


def test_exists(root, removal):
    if not removal.test:
        lists = [path.read_text() for path in (root / "tests").rglob("CMakeLists.txt")]
        return any(f"add_test(NAME {removal.program} " in text for text in lists)
    sources = [
        path.read_text()
        for folder in ("tests", "examples")
        for path in (root / folder).rglob(source_of(removal.program) + ".cpp")
    ]
    return any(re.search(rf"void (?:\w+::)?{removal.test}\(\)", source) for source in sources)


def errors_of(root, removals):
    """What has changed since the list was written."""
    errors = []
    for removal in removals:
        count = (root / removal.file).read_text().count(removal.old)
        if count != 1:
            errors.append(f"{removal.fault}: {removal.file} has what is to be taken away {count} times, not once")
        if not test_exists(root, removal):
            errors.append(f"{removal.fault}: there is no {name_of(removal)}")
    return errors


def faults_of(root):
    """Each row of the tables that say by which tests a fault is shown: the fault, and the tests."""
    tables = re.findall(r"^\|.*\| shown by \|\n\|[-|]+\|\n((?:\|.*\n)+)", (root / "docs/faults.md").read_text(), re.M)
    rows = [row.strip("|").split("|") for row in "".join(tables).splitlines()]
    return [(row[0].strip(), re.findall(r"`(\w+(?:::\w+)?)`", row[-1])) for row in rows]


def faults_without_removal(root):
    noticed = {name_of(removal) for removal in REMOVALS}
    faults = faults_of(root)
    if not faults:
        return ["docs/faults.md: no table says by which tests a fault is shown"]
    return [
        f"docs/faults.md: {fault}: none of its tests is named by a removal; add one"
        for fault, tests in faults
        if not noticed.intersection(tests)
    ]


def copy(root, target):
    """The files of the repository; those that are the same keep their times, so that little is
    built again."""
    listed = subprocess.run(
        ["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        capture_output=True,
        check=True,
    )
    for name in filter(None, listed.stdout.decode().split("\0")):
        source, place = root / name, target / name
        if not source.is_file() or (place.is_file() and place.read_bytes() == source.read_bytes()):
            continue
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, place)
        shutil.copymode(source, place)


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options
    )


def build(folder, jobs, *targets):
    result = run("cmake", "--build", folder, "--parallel", jobs, "--target", *targets)
    return None if result.returncode == 0 else result.stdout


def passes(folder, removal):
    try:
        offscreen = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        if removal.test:
            command = [folder / "bin" / removal.program, removal.test]
        else:
            command = ["ctest", "--no-tests=error", "--tests-regex", f"^{removal.program}$"]
        return run(*command, timeout=PATIENCE, cwd=folder, env=offscreen).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def outcome(source, folder, jobs, removal):
    """What the test says without the defence."""
    path = source / removal.file
    text = path.read_text()
    path.write_text(text.replace(removal.old, removal.new))
    try:
        log = build(folder, jobs, removal.program)
        if log:
            return "NOT BUILT: " + next((line for line in log.split("\n") if "error" in line), "")
        return "NOT NOTICED" if passes(folder, removal) else "noticed"
    finally:
        path.write_text(text)


def prove(root, work, jobs, removals):
    source, folder = work, work / "build/removal"
    copy(root, source)
    # As the preset release says, so that a compiler cache knows most of it. Only what a test needs
    # is built.
    gui = any(removal.file.startswith("src/gui/") for removal in removals)
    options = [
        "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG",
        "-DQTPLC_WARNINGS_AS_ERRORS=ON",
        f"-DQTPLC_BUILD_GUI={'ON' if gui else 'OFF'}",
        "-DQTPLC_BUILD_EXAMPLES=ON",
        "-DQTPLC_BUILD_BENCHMARKS=OFF",
    ]
    configured = run("cmake", "-S", source, "-B", folder, "-G", "Ninja", *options)
    log = (
        configured.stdout
        if configured.returncode != 0
        else build(folder, jobs, *sorted({removal.program for removal in removals}))
    )
    if log:
        sys.exit(log)
    failed = 0
    for removal in removals:
        result = outcome(source, folder, jobs, removal)
        failed += result != "noticed"
        print(f"{result:12} {removal.fault:55} {name_of(removal)}", flush=True)
    log = build(folder, jobs, *sorted({removal.program for removal in removals}))
    broken = sorted({name_of(removal) for removal in removals if log or not passes(folder, removal)})
    for test in broken:
        print(f"fails with its defence, too: {test}")
    print(f"{len(removals)} defences taken away, {failed} of them without notice")
    return 1 if failed or broken else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=Path)
    parser.add_argument("--only", action="append")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("root", type=Path)
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    removals = [removal for removal in REMOVALS if any(word in removal.fault for word in arguments.only or [""])]
    errors = errors_of(root, removals) + (faults_without_removal(root) if arguments.check else [])
    if errors or not removals:
        sys.exit("\n".join(errors) or f"no fault has one of {arguments.only} in its name")
    if arguments.check:
        print(f"{len(removals)} defences are where they were, and {len(faults_of(root))} faults have one")
        return 0
    if arguments.work:
        return prove(root, arguments.work.resolve(), arguments.jobs, removals)
    with tempfile.TemporaryDirectory(prefix="qtplc-removal-") as work:
        return prove(root, Path(work), arguments.jobs, removals)


if __name__ == "__main__":
    sys.exit(main())
