#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is the model in the repository what its script makes, small, and a kite?

usage: kite_model.py MAKE_KITE MODEL
"""
import subprocess
import sys
import tempfile
from pathlib import Path


def main():
    script, model = map(Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "kite.obj"
        subprocess.run([sys.executable, "-B", script, made], check=True)
        if made.read_bytes() != model.read_bytes():
            sys.exit(f"{model} is not what {script.name} makes: run it again")
    if model.stat().st_size >= 200_000:
        sys.exit(f"{model} has {model.stat().st_size} bytes, 200 000 are the limit")
    places = [tuple(map(float, line.split()[1:4])) for line in model.read_text().splitlines() if line.startswith("v ")]
    if {(x, -y, z) for x, y, z in places} != set(places):
        sys.exit(f"{model} is not symmetric")


if __name__ == "__main__":
    main()
