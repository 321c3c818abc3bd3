#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks how long lines are: code has at most 120 columns, comments and documents at most 100.

usage: columns.py SOURCE_FOLDER
"""
import ast
import fnmatch
import os
import re
import sys
from pathlib import Path

CODE, PROSE = 120, 100
NO_SOURCES = {".git", ".cache", "build", "__pycache__"}
# Files that may have longer lines, and why. A line with one value cannot be wrapped there.
EXCUSED = {
    "*.json": "a text in JSON is one line",
    "*.ini": "a value is one line",
    "*.dbc": "a value is one line",
    "*.service": "a value is one line",
    "*.csv": "a row is one line",
    "*.svg": "drawn by programs",
    "*.qrc": "names of files",
    "abi/*.txt": "a symbol is one line",
    "tests/fuzz/corpus/*": "what a fuzzer reads",
    "docs/design/model/tables.pml": "written by a program",
    ".clang-tidy": "a check and its reason are one line",
}
# The first characters of a comment. Behind /// and three spaces stands a formula or a drawing,
# which may take the columns of code.
SLASHES, HASH = r"\s*//(?!/<? {3})", r"\s*#(?!!)"


def lines_of_docstrings(text):
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node) is not None:
            found |= set(range(node.body[0].lineno, node.body[0].end_lineno + 1))
    return found


def long_prose(text):
    """Code, headings, rows of tables, and single long words are as long as they are."""
    text = re.sub(r"^ *```.*?^ *```$", lambda block: "\n" * block[0].count("\n"), text, flags=re.S | re.M)
    for number, line in enumerate(text.split("\n"), 1):
        can_be_wrapped = " " in re.sub(r"`[^`]*`|\[[^]]*\]\([^)]*\)", "", line).strip()[:PROSE]
        if len(line) > PROSE and can_be_wrapped and not re.match(r" *\||#", line):
            yield number, len(line), PROSE


def long_lines(path, text):
    """Number and length of each line that is too long, and how long it may be."""
    lines = text.split("\n")
    if path.suffix == ".md":
        yield from long_prose(text)
        return
    is_cpp = path.suffix in (".h", ".cpp", ".c", ".pml") or path.parent.name == "QtPlc"
    is_python = path.suffix == ".py" or re.match("#!.*python", lines[0])
    prose = lines_of_docstrings(text) if is_python else ()
    for number, line in enumerate(lines, 1):
        most = PROSE if number in prose or re.match(SLASHES if is_cpp else HASH, line) else CODE
        # The preprocessor takes a message as it stands behind #error.
        if len(line) > most and not line.startswith("#error"):
            yield number, len(line), most


def sources(root):
    """Path and text of each file of the project."""
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(set(folders) - NO_SOURCES)
        for path in (Path(folder) / name for name in sorted(names)):
            relative = path.relative_to(root)
            if not any(fnmatch.fnmatch(relative, pattern) for pattern in EXCUSED):
                try:
                    yield relative, path.read_text()
                except UnicodeDecodeError:
                    pass  # a picture


def main():
    count, errors = 0, []
    for path, text in sources(Path(sys.argv[1]).resolve()):
        count += 1
        for number, length, most in long_lines(path, text):
            what = "comments and documents" if most == PROSE else "code"
            errors.append(f"{path}:{number}: {length} columns; wrap {what} at {most}")
    print("\n".join(errors) or f"{count} files have lines that are short enough")
    return 1 if errors or not count else 0


if __name__ == "__main__":
    sys.exit(main())
