#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sees that the compiler refuses messages of which something is forgotten, and says what.

forgotten.py SOURCE COMPILER ARGUMENT...   SOURCE compiles; with FORGOTTEN it does not, and the
                                           compiler says each sentence behind "// refused:"
"""
import re
import subprocess
import sys
from pathlib import Path


def compile_(command):
    return subprocess.run(command, capture_output=True, text=True)


def main(source, *compiler):
    command = [*compiler, "-std=c++17", "-fPIC", "-fsyntax-only", source]
    whole = compile_(command)
    if whole.returncode != 0:
        sys.exit(f"{source} does not compile:\n{whole.stderr}")
    sentences = re.findall(r"^// refused: (.+)$", Path(source).read_text(), re.M)
    refused = compile_([*command, "-DFORGOTTEN"])
    errors = [line for line in refused.stderr.splitlines() if "error:" in line]
    silent = [sentence for sentence in sentences if not any(sentence in error for error in errors)]
    if refused.returncode == 0 or silent or not sentences:
        sys.exit("the compiler does not say: " + "; ".join(silent) + "\n" + refused.stderr)
    print(f"{len(sentences)} mistakes are refused")


if __name__ == "__main__":
    main(*sys.argv[1:])
