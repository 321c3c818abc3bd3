#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each installed file belongs to a Debian package, or to the documentation that packages have of their own.

usage: components.py BUILD_FOLDER
"""
import re
import sys
from pathlib import Path


def install_scripts(script):
    """The script and those that it includes: other projects may be built in the folder, too."""
    yield script
    for included in re.findall(r'include\("(.*/cmake_install\.cmake)"\)', script.read_text()):
        yield from install_scripts(Path(included))


def main():
    build = Path(sys.argv[1])
    packages = set(re.search(r'set\(CPACK_COMPONENTS_ALL "([^"]*)"\)', (build / "CPackConfig.cmake").read_text())[1].split(";"))
    used = set()
    for script in install_scripts(build / "cmake_install.cmake"):
        used |= set(re.findall(r'CMAKE_INSTALL_COMPONENT STREQUAL "([^"]+)"', script.read_text()))
    errors = [f"files are installed for the component '{component}', which no package has: give install() the COMPONENT of a package"
              for component in sorted(used - packages - {"documentation"})]
    errors += [f"the package {package} has no files" for package in sorted(packages - used)]
    print("\n".join(errors) or f"{len(packages)} packages have all that is installed")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
