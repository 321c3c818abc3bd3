#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes archives that are no FMUs, or FMUs that nobody should trust, out of a good one.

usage: hostile.py GOOD.fmu FOLDER
"""
import stat
import struct
import sys
import zipfile
from pathlib import Path

good, folder = Path(sys.argv[1]), Path(sys.argv[2])
DESCRIPTION = "modelDescription.xml"
with zipfile.ZipFile(good) as archive:
    CONTENT = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
XML = CONTENT[DESCRIPTION].decode()
LIBRARY = next(name for name in CONTENT if name.endswith(".so"))


def write(name, content, more=()):
    """An archive with \\a content, and then entries (a name or a ZipInfo, and its bytes)."""
    with zipfile.ZipFile(folder / f"{name}.fmu", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for entry, data in [*content.items(), *more]:
            archive.writestr(entry, data)


def with_xml(name, xml):
    write(name, {**CONTENT, DESCRIPTION: xml})


def link(name, target):
    info = zipfile.ZipInfo(name)
    info.create_system = 3
    info.external_attr = (stat.S_IFLNK | 0o777) << 16
    return info, target.encode()


def patched(name, source, old, new):
    data = (folder / f"{source}.fmu").read_bytes()
    (folder / f"{name}.fmu").write_bytes(data.replace(old, new))


folder.mkdir(parents=True, exist_ok=True)

# ---- archives ----
write("parent", CONTENT, [("../evil", b"x")])
write("parent_inside", CONTENT, [("resources/../../evil", b"x")])
write("absolute", CONTENT, [("/tmp/evil", b"x")])
write("drive", CONTENT, [("C:/evil", b"x")])
write("backslash", CONTENT, [("resources\\..\\..\\evil", b"x")])
write("link", CONTENT, [link("resources/link", "/etc/passwd")])
write("link_folder", CONTENT, [link("resources", "/tmp"), ("resources/evil", b"x")])
write("control", CONTENT, [("resources/a\nb", b"x")])
write("deep", CONTENT, [("resources/" + "d/" * 40 + "x", b"x")])
write("long_name", CONTENT, [("resources/" + "n" * 2000, b"x")])
write("many", CONTENT, [(f"resources/{i}", b"") for i in range(20001)])
write("file_and_folder", CONTENT, [("resources/a", b"x"), ("resources/a/b", b"x")])
with zipfile.ZipFile(folder / "twice.fmu", "w") as archive:
    for name, data in [*CONTENT.items(), ("resources/a", b"x"), ("resources/b", b"x")]:
        archive.writestr(name, data)
patched("twice", "twice", b"resources/b", b"resources/a")
write("empty", {})
write("without_description", {LIBRARY: CONTENT[LIBRARY]})
(folder / "text.fmu").write_text("this is not an archive\n")
(folder / "nothing.fmu").write_bytes(b"")
(folder / "half.fmu").write_bytes(good.read_bytes()[: good.stat().st_size // 2])
with zipfile.ZipFile(folder / "damaged.fmu", "w", zipfile.ZIP_STORED) as archive:
    for name, data in CONTENT.items():
        archive.writestr(name, data)
whole = bytearray((folder / "damaged.fmu").read_bytes())
at = whole.index(CONTENT[LIBRARY]) + len(CONTENT[LIBRARY]) // 2
whole[at] ^= 0xFF
(folder / "damaged.fmu").write_bytes(whole)

# A bomb: a gigabyte of zeros, and the same that calls itself small.
SIZE = 1100 * 1024 * 1024
with zipfile.ZipFile(folder / "bomb.fmu", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
    for name, data in CONTENT.items():
        archive.writestr(name, data)
    with archive.open("resources/zeros", "w", force_zip64=False) as entry:
        block = bytes(1 << 20)
        for _ in range(SIZE >> 20):
            entry.write(block)
patched("lying_bomb", "bomb", struct.pack("<I", SIZE), struct.pack("<I", 1000))
write("large_description", {DESCRIPTION: bytes(70 * 1024 * 1024)})

# ---- descriptions ----
LAUGHS = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 12))
with_xml("laughs", f'<!DOCTYPE x [<!ENTITY l0 "ha">{LAUGHS}]><fmiModelDescription>&l11;</fmiModelDescription>')
with_xml(
    "external_entity",
    '<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]><fmiModelDescription fmiVersion="2.0">&e;'
    "</fmiModelDescription>",
)
with_xml("nested", '<fmiModelDescription fmiVersion="2.0">' + "<a>" * 1000000)
with_xml("attributes", "<fmiModelDescription " + " ".join(f'a{i}="1"' for i in range(100000)) + "/>")
with_xml("no_xml", "fmiModelDescription")
with_xml("cut", XML[: len(XML) // 2])
with_xml("other_root", "<SystemStructureDescription/>")
with_xml("fmi1", XML.replace('fmiVersion="2.0"', 'fmiVersion="1.0"'))
with_xml("beta", XML.replace('fmiVersion="2.0"', 'fmiVersion="3.0-beta.2"'))
with_xml("model_exchange", XML.replace("CoSimulation modelIdentifier", "ModelExchange modelIdentifier"))
with_xml("needs_tool", XML.replace("<CoSimulation ", '<CoSimulation needsExecutionTool="true" '))
with_xml("wrong_guid", XML.replace("{9d1a4f0e-plant-2}", "{other}"))
with_xml("wrong_library", XML.replace('modelIdentifier="plant"', 'modelIdentifier="../../plant"'))
with_xml("double_variable", XML.replace('name="x0"', 'name="x"'))
with_xml("no_reference", XML.replace('valueReference="4"', 'valueReference="four"'))
write("windows", {DESCRIPTION: XML, "binaries/win64/plant.dll": b"MZ", "binaries/darwin64/plant.dylib": b""})
write("no_platform", {DESCRIPTION: XML})
write("no_library", {**CONTENT, LIBRARY: b"this is not a library"})
with_xml(
    "wrong_version",
    XML.replace('fmiVersion="2.0"', 'fmiVersion="3.0"')
    .replace("ScalarVariable", "Old")
    .replace("guid", "instantiationToken"),
)
(folder / "made").write_text("")
