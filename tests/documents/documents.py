#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the documents: code blocks are what the files hold that they are said to show, links lead somewhere, and tests that are named
(`tst_X::aSentence`) exist.

A block that stands behind the line <!-- file: PATH --> (from the root of the repository) shows that file without its licence line; with "begin of" or "end of" in the place of "file", lines at its begin or end.

usage: documents.py [--write] SOURCE_FOLDER        --write copies the files into the documents
"""
import re
import sys
from pathlib import Path

BLOCK = re.compile(r"<!-- (?P<kind>file|begin of|end of): (?P<path>\S+) -->\n```(?P<language>\w*)\n(?P<text>.*?)```\n", re.S)
MARK = re.compile(r"<!-- (?:file|begin of|end of): ")
TEST = re.compile(r"`(tst_\w+)::(\w+)`")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)\s]*)?\)")


def shown(path):
    lines = path.read_text().split("\n")
    if "SPDX-License-Identifier" in lines[0]:
        lines = lines[1:]
    return "\n".join(lines).lstrip("\n")


def part_of(text, block):
    return block["text"].strip() and (text.startswith(block["text"]) if block["kind"] == "begin of" else text.endswith(block["text"]))


def check_blocks(root, document, write, errors):
    text = document.read_text()
    for block in BLOCK.finditer(text):
        source = root / block["path"]
        if not source.is_file():
            errors.append(f"{document.relative_to(root)}: shows {block['path']}, which does not exist")
        elif block["kind"] != "file":
            if not part_of(shown(source), block):
                errors.append(f"{document.relative_to(root)}: shows the {block['kind']} {block['path']} as it was; copy the lines")
        elif block["text"] != shown(source):
            if write:
                document.write_text(document.read_text().replace(block[0], f"<!-- file: {block['path']} -->\n```{block['language']}\n{shown(source)}```\n"))
            else:
                errors.append(f"{document.relative_to(root)}: shows {block['path']} as it was; remedy: tests/documents/documents.py --write .")
    if len(MARK.findall(text)) != len(BLOCK.findall(text)):
        errors.append(f"{document.relative_to(root)}: a line <!-- file: PATH --> is not followed by a code block")


def check_links(root, document, errors):
    text = re.sub(r"```.*?```", "", document.read_text(), flags=re.S)
    for link in LINK.findall(text):
        if not re.match(r"\w+:", link) and not (document.parent / link).exists():
            errors.append(f"{document.relative_to(root)}: the link to {link} leads nowhere")


def sources_of_tests(root):
    """Name of a test program: the source of all that have it."""
    sources = {}
    for path in [*(root / "tests").rglob("tst_*.cpp"), *(root / "examples").rglob("tst_*.cpp")]:
        sources[path.stem] = sources.get(path.stem, "") + path.read_text()
    return sources


def check_tests(root, document, sources, errors):
    for program, name in TEST.findall(document.read_text()):
        if program not in sources:
            errors.append(f"{document.relative_to(root)}: names {program}::{name}, and there is no {program}.cpp")
        elif not re.search(rf"void (?:{program}::)?{name}\(\)", sources[program]):
            errors.append(f"{document.relative_to(root)}: names {program}::{name}, which {program}.cpp has not")


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--write"]
    root = Path(arguments[0]).resolve()
    errors = []
    documents = sorted(root.glob("*.md")) + sorted((root / "docs").rglob("*.md"))
    sources = sources_of_tests(root)
    for document in documents:
        check_blocks(root, document, "--write" in sys.argv, errors)
        check_links(root, document, errors)
        check_tests(root, document, sources, errors)
    print("\n".join(errors) or f"{len(documents)} documents are in order")
    return 1 if errors or not documents else 0


if __name__ == "__main__":
    sys.exit(main())
