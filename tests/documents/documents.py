#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the documents: code blocks are what the files hold that they are said to show, links lead
somewhere, tests that are named (`tst_X::aSentence`) exist, functions that
docs/design/architecture.md names (`Class::function`) too, and indexes name all rooms and pages.

A block that stands behind the line <!-- file: PATH --> (from the root of the repository) shows that
file without its licence line; with "begin of" or "end of" in the place of "file", lines at its
begin or end.

usage: documents.py [--write] SOURCE_FOLDER        --write copies the files into the documents
       documents.py --installed FOLDER             only the links of an installation's documents
"""
import re
import sys
from pathlib import Path

BLOCK = re.compile(
    r"<!-- (?P<kind>file|begin of|end of): (?P<path>\S+) -->\n```(?P<language>\w*)\n(?P<text>.*?)```\n", re.S
)
MARK = re.compile(r"<!-- (?:file|begin of|end of): ")
TEST = re.compile(r"`(tst_\w+)::(\w+)`")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)\s]*)?\)")
LINK_INSIDE = re.compile(r"\]\((#[^)\s]*)\)")


def shown(path):
    lines = path.read_text().split("\n")
    if "SPDX-License-Identifier" in lines[0]:
        lines = lines[1:]
    return "\n".join(lines).lstrip("\n")


def part_of(text, block):
    return block["text"].strip() and (
        text.startswith(block["text"]) if block["kind"] == "begin of" else text.endswith(block["text"])
    )


def check_blocks(root, document, write, errors):
    text = document.read_text()
    for block in BLOCK.finditer(text):
        source = root / block["path"]
        if not source.is_file():
            errors.append(f"{document.relative_to(root)}: shows {block['path']}, which does not exist")
        elif block["kind"] != "file":
            if not part_of(shown(source), block):
                errors.append(
                    f"{document.relative_to(root)}: shows the {block['kind']} {block['path']} as it was; copy the lines"
                )
        elif block["text"] != shown(source):
            if write:
                document.write_text(
                    document.read_text().replace(
                        block[0], f"<!-- file: {block['path']} -->\n```{block['language']}\n{shown(source)}```\n"
                    )
                )
            else:
                errors.append(
                    f"{document.relative_to(root)}: shows {block['path']} as it was; "
                    "remedy: tests/documents/documents.py --write ."
                )
    if len(MARK.findall(text)) != len(BLOCK.findall(text)):
        errors.append(f"{document.relative_to(root)}: a line <!-- file: PATH --> is not followed by a code block")


def check_links(root, document, errors):
    text = re.sub(r"```.*?```", "", document.read_text(), flags=re.S)
    for link in LINK.findall(text):
        if not re.match(r"\w+:", link) and not (document.parent / link).exists():
            errors.append(f"{document.relative_to(root)}: the link to {link} leads nowhere")
    for part in LINK_INSIDE.findall(text):
        errors.append(
            f"{document.relative_to(root)}: the link to {part} needs the name of the page, as Doxygen wants it; "
            f"remedy: {document.name}{part}"
        )


def sources_of_tests(root):
    """Name of a test program: the source of all that have it."""
    sources = {}
    for path in [*(root / "tests").rglob("tst_*.cpp"), *(root / "examples").rglob("tst_*.cpp")]:
        sources[path.stem] = sources.get(path.stem, "") + path.read_text()
    return sources


def check_headings(root, document, errors):
    """A part of a page that stands there twice is one that was mended and one that was
    forgotten."""
    headings = re.findall(r"^## .*$", re.sub(r"^```.*?^```$", "", document.read_text(), flags=re.S | re.M), re.M)
    errors += [
        f"{document.relative_to(root)}: has the part '{heading}' twice"
        for heading in sorted(set(headings))
        if headings.count(heading) > 1
    ]


def check_tests(root, document, sources, errors):
    for program, name in TEST.findall(document.read_text()):
        if program not in sources:
            errors.append(f"{document.relative_to(root)}: names {program}::{name}, and there is no {program}.cpp")
        elif not re.search(rf"void (?:{program}::)?{name}\(\)", sources[program]):
            errors.append(f"{document.relative_to(root)}: names {program}::{name}, which {program}.cpp has not")


def check_functions(root, errors):
    """The stops of the values that the first page follows."""
    page = root / "docs/design/architecture.md"
    sources = "\n".join(
        path.read_text()
        for folder in ("src", "include")
        for path in (root / folder).rglob("*")
        if path.suffix in (".h", ".cpp")
    )
    for owner, name in re.findall(r"`(\w+)::(\w+)`", page.read_text()):
        body = re.search(rf"^(?:class|struct) [\w ]*\b{owner}\b[^;\n]*\n\{{\n.*?^\}};", sources, re.M | re.S)
        if not re.search(rf"\b{owner}::{name}\(|^class {owner}::{name}\b", sources, re.M) and not (
            body and re.search(rf"\b{name}\(", body[0])
        ):
            errors.append(f"{page.relative_to(root)}: names {owner}::{name}, which the sources do not have")


def check_rooms(root, errors):
    """CONTRIBUTING names every folder of the project in which sources are, and an index every page
    of its folder."""
    text = (root / "CONTRIBUTING.md").read_text()
    ignored = {"build"}
    for folder in sorted(
        path for path in root.iterdir() if path.is_dir() and not path.name.startswith(".") and path.name not in ignored
    ):
        if not re.search(rf"\b{folder.name}\b", text):
            errors.append(f"CONTRIBUTING.md: does not name the folder {folder.name}")
    for parent in ("src", "src/gui", "src/hardware", "tests"):
        for room in sorted(
            path for path in (root / parent).iterdir() if path.is_dir() and not path.name.startswith("__")
        ):
            if parent != "tests" and parent != "src":
                line = re.search(rf"^{parent} .*(?:\n +.*)*", text, re.M)
                named = line is not None and re.search(rf"\b{room.name}\b", line[0])
            else:
                named = f"{parent}/{room.name}" in text or re.search(
                    rf"^Tests have (?:.|\n(?!\n))*`{room.name}`", text, re.M
                )
            if not named:
                errors.append(f"CONTRIBUTING.md: does not name the room {parent}/{room.name}")
    for index, folder in (
        ("docs/design/README.md", "docs/design"),
        ("README.md", "docs/howto"),
        ("docs/hardware/README.md", "docs/hardware"),
        ("README.md", "docs"),
    ):
        links = {(root / index).parent / link for link in LINK.findall((root / index).read_text())}
        for page in sorted((root / folder).glob("*.md")):
            if page not in links and page != root / index:
                errors.append(f"{index}: does not lead to {page.relative_to(root)}")


def check_installed(folder):
    """The links of the documents of an installation."""
    errors = []
    documents = sorted(folder.rglob("*.md"))
    for document in documents:
        check_links(folder, document, errors)
    print("\n".join(errors) or f"{len(documents)} installed documents lead somewhere")
    return 1 if errors or not documents else 0


def main():
    if sys.argv[1] == "--installed":
        return check_installed(Path(sys.argv[2]).resolve())
    arguments = [argument for argument in sys.argv[1:] if argument != "--write"]
    root = Path(arguments[0]).resolve()
    errors = []
    documents = sorted(root.glob("*.md")) + sorted((root / "docs").rglob("*.md"))
    sources = sources_of_tests(root)
    for document in documents:
        check_blocks(root, document, "--write" in sys.argv, errors)
        check_links(root, document, errors)
        check_headings(root, document, errors)
        check_tests(root, document, sources, errors)
    check_rooms(root, errors)
    check_functions(root, errors)
    print("\n".join(errors) or f"{len(documents)} documents are in order")
    return 1 if errors or not documents else 0


if __name__ == "__main__":
    sys.exit(main())
