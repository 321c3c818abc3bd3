#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each installed file belongs to a Debian package, and the links of the documents hold in a
computer that has only the package with them.

usage: components.py BUILD_FOLDER SOURCE_FOLDER
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def install_scripts(script):
    """The script and those that it includes: other projects may be built in the folder, too."""
    yield script
    for included in re.findall(r'include\("(.*/cmake_install\.cmake)"\)', script.read_text()):
        yield from install_scripts(Path(included))


def dead_links(build, package, documents):
    """What documents.py finds in the documents of the package alone."""
    with tempfile.TemporaryDirectory() as prefix:
        subprocess.run(
            ["cmake", "--install", build, "--prefix", prefix, "--component", package],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        if not list(Path(prefix).rglob("*.md")):
            return []
        run = subprocess.run([sys.executable, "-B", documents, "--installed", prefix], capture_output=True, text=True)
        return [] if run.returncode == 0 else [f"{package}: {line}" for line in run.stdout.splitlines()]


def main():
    build = Path(sys.argv[1])
    packages = set(
        re.search(r'set\(CPACK_COMPONENTS_ALL "([^"]*)"\)', (build / "CPackConfig.cmake").read_text())[1].split(";")
    )
    used = set()
    for script in install_scripts(build / "cmake_install.cmake"):
        used |= set(re.findall(r'CMAKE_INSTALL_COMPONENT STREQUAL "([^"]+)"', script.read_text()))
    errors = [
        f"files are installed for the component '{component}', which no package has: "
        "give install() the COMPONENT of a package"
        for component in sorted(used - packages)
    ]
    errors += [f"the package {package} has no files" for package in sorted(packages - used)]
    for package in sorted(packages):
        errors += dead_links(build, package, Path(sys.argv[2]) / "tests" / "documents" / "documents.py")
    print(
        "\n".join(errors)
        or f"{len(packages)} packages have all that is installed, and all that their documents lead to"
    )
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
