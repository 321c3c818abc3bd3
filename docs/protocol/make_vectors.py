#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the byte vectors of the QtPLC protocol out of docs/protocol.md alone.

It shares nothing with the C++ code, not even the CRC-32C, so that each tests the other. The vectors
are the protocol: a change of them is a change of the protocol and needs a new version number.

    make_vectors.py --check    says whether vectors/ holds what this script makes (exit code 1 when
                               not)
    make_vectors.py --write    writes vectors/
"""
import json
import pathlib
import sys

from control_vectors import make_beacons, make_control, make_crc32c
from cyclic_vectors import make_cyclic, make_layouts, make_sealed

FOLDER = pathlib.Path(__file__).resolve().parent / "vectors"


def main():
    files = {
        "crc32c.json": make_crc32c(),
        "layouts.json": make_layouts(),
        "cyclic_frames.json": make_cyclic(),
        "sealed_frames.json": make_sealed(),
        "control_frames.json": make_control(),
        "beacons.json": make_beacons(),
    }
    if sys.argv[1:] not in (["--check"], ["--write"]):
        sys.exit(__doc__)
    different = []
    for name, content in files.items():
        text = json.dumps(content, indent=1, ensure_ascii=False) + "\n"
        path = FOLDER / name
        if sys.argv[1] == "--write":
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            different.append(name)
    if different:
        sys.exit(
            f"vectors/{', vectors/'.join(different)}: not what this script makes; "
            "the protocol is changed by intent only"
        )


if __name__ == "__main__":
    main()
