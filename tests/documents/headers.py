#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that each public header reads as a manual page: doxygen documents everything that it
declares, and its class has an example, a thread rule and a group. Functions that override a
documented one may inherit its comment.

usage: headers.py check SOURCE_FOLDER WORK_FOLDER [DOXYGEN]
       headers.py sample NUMBER SOURCE_FOLDER WORK_FOLDER
           a random choice of what is documented, for a reader
       headers.py examples SOURCE_FOLDER OUTPUT_FOLDER
           writes examples_LIBRARY.cpp with the examples of all headers
"""
import random
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

# Library: its umbrella header, and what its examples use of Qt. A header that no other umbrella
# names belongs to the first.
LIBRARIES = {
    "core": ("QtPlcCore", "<QtNetwork/QtNetwork>"),
    "hardware": ("QtPlcHardware", "<QtNetwork/QtNetwork>"),
    "models": ("QtPlcModels", "<QtNetwork/QtNetwork>"),
    "recording": ("QtPlcRecording", "<QtNetwork/QtNetwork>"),
    "gui": ("QtPlcGui", "<QtWidgets/QtWidgets>"),
    "gui3d": ("QtPlcGui3D", "<QtWidgets/QtWidgets>"),
    "test": ("QtPlcTest", "<QtNetwork/QtNetwork>"),
}
XML = """
OUTPUT_DIRECTORY = {work}
INPUT = {source}/docs/reference.dox {source}/include/QtPlc
GENERATE_HTML = NO
GENERATE_XML = YES
WARN_AS_ERROR = NO
WARNINGS = NO
"""
CLASS = {"class", "struct", "union"}


def run_doxygen(doxygen, source, work):
    """The XML pages of the public headers. The settings are those of the target docs."""
    work.mkdir(parents=True, exist_ok=True)
    settings = (source / "docs/Doxyfile.in").read_text()
    settings = re.sub(r"@PROJECT_SOURCE_DIR@", str(source), settings)
    settings = re.sub(r"@\w+@", "0", settings) + XML.format(work=work, source=source)
    (work / "Doxyfile").write_text(settings)
    for page in (work / "xml").glob("*.xml"):
        page.unlink()
    subprocess.run([doxygen, str(work / "Doxyfile")], cwd=source, check=True)
    return [ElementTree.parse(page).getroot() for page in sorted((work / "xml").glob("*.xml"))]


def text_of(element):
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def description(element):
    return (text_of(element.find("briefdescription")) + " " + text_of(element.find("detaileddescription"))).strip()


def is_inherited(member):
    """Whether the comment of a function is that of another one, or there is nothing to say."""
    arguments = text_of(member.find("argsstring"))
    return re.search(r"\boverride\b|\bfinal\b|=\s*delete", arguments) or member.find("reimplements") is not None


def entries(roots):
    """Everything that a user of the headers can name: its place, its declaration, its text."""
    compounds = [
        (each, each.get("kind"), text_of(each.find("compoundname")))
        for root in roots
        for each in root.findall("compounddef")
    ]
    hidden = tuple(
        f"{name}::" for compound, kind, name in compounds if kind in CLASS and compound.get("prot") == "private"
    )
    for compound, kind, name in compounds:
        if kind not in CLASS | {"file"} or f"{name}::".startswith(hidden):
            continue
        if kind in CLASS:
            yield compound.find("location"), name, description(compound)
        for member in compound.iter("memberdef"):
            if member.get("prot") == "private" or re.match(
                r"friend (class|struct)", text_of(member.find("definition")) + " "
            ):
                continue
            if kind == "file" and member.get("kind") == "define" and not description(member):
                continue  # of a list of macros that say the same in turn, the first has the comment
            whole = (
                f"{name}::{text_of(member.find('name'))}{text_of(member.find('argsstring'))}"
                if kind in CLASS
                else text_of(member.find("name"))
            )
            for value in member.findall("enumvalue"):
                yield member.find("location"), f"{name}::{text_of(value.find('name'))}", description(value)
            if description(member) or not is_inherited(member):
                yield member.find("location"), whole, description(member)


def pages(roots):
    """The classes that are a page of their own."""
    for compound in (each for root in roots for each in root.findall("compounddef")):
        name = text_of(compound.find("compoundname"))
        if compound.get("kind") in CLASS and "::" not in name and compound.get("prot") == "public":
            yield compound, name


def check(source, work, doxygen):
    roots = run_doxygen(doxygen, source, work)
    found = list(entries(roots))
    errors = [
        f"{place.get('file')}:{place.get('line')}: {name} has no comment" for place, name, text in found if not text
    ]
    grouped = {
        text_of(inner)
        for root in roots
        for group in root.findall("compounddef")
        if group.get("kind") == "group"
        for inner in group.findall("innerclass")
    }
    for compound, name in pages(roots):
        place = compound.find("location")
        where = f"{place.get('file')}:{place.get('line')}: {name}"
        detail = compound.find("detaileddescription")
        if detail is None or detail.find(".//programlisting") is None:
            errors.append(f"{where} has no example (\\code ... \\endcode)")
        if detail is None or "Threads:" not in [text_of(title) for title in detail.iter("title")]:
            errors.append(f"{where} has no thread rule (\\threadsafe)")
        if name not in grouped:
            errors.append(f"{where} belongs to no group of docs/reference.dox (\\ingroup)")
    page = (source / "docs/reference.dox").read_text()
    for group in re.findall(r"\\defgroup (\w+)", page):
        if not re.search(rf"\\ref {group}$", page, re.M):
            errors.append(f"docs/reference.dox: the list of groups does not name {group} (\\ref {group})")
    print("\n".join(errors + [f"{sum(1 for entry in found if entry[2])} of {len(found)} public names have a comment"]))
    return 1 if errors or not found else 0


def sample(number, source, work):
    for place, name, text in random.sample(
        [entry for entry in entries(run_doxygen("doxygen", source, work)) if entry[2]], number
    ):
        print(f"{name}\n    {text}")
    return 0


def examples_of(header):
    """C++ between \\code and \\endcode, and the line where it begins. Other languages are named, as
    in \\code{.ini}."""
    lines = header.read_text().split("\n")
    begin = None
    for number, line in enumerate(lines, 1):
        comment = line.strip()
        if comment == "/// \\code":
            begin = number
        elif comment == "/// \\endcode" and begin is not None:
            yield begin + 1, [re.sub(r"^\s*/// ?", "", text) for text in lines[begin : number - 1]]
            begin = None


def write_examples(source, output):
    """An example stands in a namespace of its own, and in a function unless it is a whole
    program."""
    public = source / "include/QtPlc"
    owner = {
        name: library
        for library, (umbrella, _) in LIBRARIES.items()
        for name in re.findall(r'#include "(\w+\.h)"', (public / umbrella).read_text())
    }
    output.mkdir(parents=True, exist_ok=True)
    for library, (umbrella, qt) in LIBRARIES.items():
        text = [f"// Made by headers.py of the examples of the public headers.\n#include {qt}\n#include <{umbrella}>\n"]
        text += [
            f'#pragma GCC diagnostic ignored "-W{warning}"'
            for warning in ("unused-variable", "unused-parameter", "unused-but-set-variable", "unused-local-typedefs")
        ]
        for header in sorted(public.glob("*.h")):
            if owner.get(header.name) != library:
                continue
            for line, example in examples_of(header):
                code = "\n".join(example)
                is_program = re.search(r"^int main\(", code, re.M)
                begin, end = ("", "") if is_program else ("int example(int &argc, char **argv)\n{\n", "\nreturn 0;\n}")
                text.append(f'\nnamespace {header.stem}_{line} {{\n{begin}#line {line} "{header}"\n{code}{end}\n}}')
        text.append("\nint main()\n{\n    return 0;\n}")
        page = output / f"examples_{library}.cpp"
        new = "\n".join(text) + "\n"
        if not page.is_file() or page.read_text() != new:
            page.write_text(new)
    return 0


def main():
    command, *arguments = sys.argv[1:]
    if command == "check":
        return check(
            Path(arguments[0]).resolve(),
            Path(arguments[1]).resolve(),
            arguments[2] if len(arguments) > 2 else "doxygen",
        )
    if command == "sample":
        return sample(int(arguments[0]), Path(arguments[1]).resolve(), Path(arguments[2]).resolve())
    if command == "examples":
        return write_examples(Path(arguments[0]).resolve(), Path(arguments[1]).resolve())
    print(__doc__)
    return 2


if __name__ == "__main__":
    sys.exit(main())
