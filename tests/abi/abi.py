#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Are the symbols that the shared libraries export those of abi/*.txt, and public API all of them?

usage: abi.py SOURCE_FOLDER LIBRARY...            compares; exit code 1: they differ
       abi.py --renew SOURCE_FOLDER LIBRARY...    writes the lists
"""
import re
import subprocess
import sys
from pathlib import Path

FIRST_NAME = re.compile(r"_Z(?:T[VIST]|GV|Tc?h?v?n?\d*_|Z)*N?[rVK]*(?=\d)")


def scope(symbol):
    """The names that the mangled symbol begins with: qplc, Histogram, record."""
    begin = FIRST_NAME.match(symbol)
    names, place = [], begin.end() if begin else len(symbol)
    while digits := re.match(r"\d+", symbol[place:]):
        place += digits.end()
        names.append(symbol[place : place + int(digits[0])])
        place += int(digits[0])
    return names


def is_private(symbol):
    names = scope(symbol)
    return names[:1] == ["qplc"] or any(name.endswith("Private") for name in names)


def is_inline_of_others(symbol, kind):
    """Whether the compiler has put it into this library although it belongs into each program that
    uses it."""
    of_qtplc = scope(symbol)[:1] and re.match("QPlc|QSplit|qplc$", scope(symbol)[0])
    is_code_or_type = kind == "W" or symbol.startswith("_ZT")
    return kind in "WVu" and not (of_qtplc and is_code_or_type)


def exported(library):
    """Mangled: those that other programs can use."""
    text = subprocess.run(
        ["nm", "--dynamic", "--defined-only", "--format=posix", library], capture_output=True, text=True, check=True
    ).stdout
    lines = [line.split() for line in text.splitlines()]
    return [symbol for symbol, kind, *_ in lines if symbol.startswith("_Z") and not is_inline_of_others(symbol, kind)]


def readable(symbols):
    """Sorted; the two symbols of a constructor are one line."""
    text = subprocess.run(["c++filt"], input="\n".join(symbols), capture_output=True, text=True, check=True).stdout
    return sorted(set(text.splitlines()))


def list_of(root, library):
    return root / "abi" / (Path(library).name.split(".")[0].removeprefix("lib") + ".txt")


def compare(root, library):
    """What a person has to know, empty when nothing has changed."""
    symbols, file = exported(library), list_of(root, library)
    report = [f"{file.stem} exports the private {name}" for name in readable(filter(is_private, symbols))]
    now, before = readable(symbols), file.read_text().splitlines() if file.exists() else []
    report += [f"{file.stem} has lost {name}" for name in before if name not in set(now)]
    broken = len(report)
    report += [f"{file.stem} has gained {name}" for name in now if name not in set(before)]
    if broken:
        report.append(
            "Lost symbols break programs that use them, private ones are nobody's business. "
            "Remedy: QTPLC_EXPORT, or Q_DECL_HIDDEN; docs/design/abi.md"
        )
    return report


def main(arguments):
    renew = arguments[:1] == ["--renew"]
    root, *libraries = arguments[1:] if renew else arguments
    root, report = Path(root), []
    for library in libraries:
        if renew:
            list_of(root, library).write_text("\n".join(readable(exported(library))) + "\n")
        report += compare(root, library)
    if report:
        report.append("If all of that is meant, renew the lists: cmake --build --preset release --target renew_abi")
    print("\n".join(report))
    return 1 if report else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
