#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types the commands of README.md, and builds its programs with the installed package, as written.
A block that this test does not know fails it.

usage: readme.py SOURCE_FOLDER BUILD_FOLDER
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from typed import ANY, Broken, Expectation, Reader, Terminal, await_that, in_own_network, require

NOT_TYPED = {
    "scripts/run": "the test progress_of_scripts runs it, with a slow compiler in the place of the true one",
    "scripts/test": "runs this test",
    "sudo chrt -f 49 ./awe_autopilot --master udp://192.168.1.5": "needs root and a second computer",
    "sudo ./awe_autopilot --master udp://192.168.1.5 --priority 49 --cpu 3 --lock-memory": (
        "needs root, four processors and a second computer"
    ),
}
INTERRUPT = b"\x03"
WINDOW_IS_THERE = None  # Ctrl-C as soon as the program can be ended by it


def expected(terminal, programs):
    def forget_flight():
        for name in ("flight.mcap", "power.csv", "flight.html"):
            (programs / name).unlink(missing_ok=True)

    def registered():
        terminal.take(0.1)
        return terminal.shown.count("registered at") >= 2

    return {
        "awe_control_center": Expectation(keys=(WINDOW_IS_THERE, INTERRUPT)),
        "./awe_sil --duration 60 --record flight.mcap": Expectation(before=forget_flight),
        "./awe_control_center --recording flight.mcap": Expectation(keys=(WINDOW_IS_THERE, INTERRUPT)),
        "./qtplc verify flight.mcap": Expectation(shows="nothing is missing"),
        "./qtplc replay flight.mcap --node ./awe_autopilot --compare": Expectation(
            shows="0 differences", after=forget_flight
        ),
        "awe_control_center --master 192.168.1.5:50000": Expectation(keys=(WINDOW_IS_THERE, INTERRUPT)),
        "./awe_master &": Expectation(after=lambda: terminal.await_text("port 50000")),
        "./qtplc state": Expectation(
            shows=r"(?s)(?=.*\bModel\b)(?=.*\bAutopilot\b)",
            before=lambda: await_that(registered, lambda: f"the nodes never register: {terminal.shown[-2000:]}"),
        ),
        "./qtplc watch 'tether*' power": Expectation(shows="tetherLength", keys=("power", b"q")),
        "./qtplc get tetherLength --plain": Expectation(shows=r"(?m)^\d+(\.\d+)?$"),
        "./qtplc hz": Expectation(shows=r"\d Hz", keys=(r"\d Hz", INTERRUPT), code=ANY),
        "./qtplc note gust from the north": Expectation(shows="noted: gust from the north"),
        "./qtplc events": Expectation(shows="Real time"),
        "kill %1": Expectation(after=lambda: terminal.type("wait")),
        "./awe_sil --same-cycle": Expectation(shows="mean power"),
    }


class Programs:
    """Builds each CMake part of the page as a project of its own, with the source that the page has
    shown."""

    def __init__(self, folder, prefix):
        self.folder, self.prefix = folder, prefix

    def build(self, language, text):
        if language != "cmake":
            return False
        program, source = re.search(r"add_executable\((\w+) (\S+)\)", text).groups()
        project = self.folder / program
        project.mkdir()
        (self.folder / source).rename(project / source)
        (project / "CMakeLists.txt").write_text(
            f"cmake_minimum_required(VERSION 3.23)\nproject(Readme LANGUAGES CXX)\n{text}"
        )
        self.run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.run("cmake", "--build", project / "build")
        print(f"built: {program}", flush=True)
        return True

    def run(self, *command):
        result = subprocess.run(
            [str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        require(result.returncode == 0, f"{' '.join(map(str, command))} fails:\n{result.stdout[-4000:]}")


def main():
    source, build = (Path(argument).resolve() for argument in sys.argv[1:])
    in_own_network()
    with tempfile.TemporaryDirectory() as home:
        home = Path(home)
        (home / "QtPLC" / "build").mkdir(parents=True)
        (home / "QtPLC" / "build" / "release").symlink_to(build)
        programs = Programs(home, home / "qtplc")
        programs.run("cmake", "--install", build, "--prefix", home / "qtplc")
        terminal = Terminal(home, {"PATH": f"{home}/qtplc/bin:/usr/local/bin:/usr/bin:/bin"})
        try:
            terminal.type("cd QtPLC")
            Reader(
                source / "README.md", home, terminal, expected(terminal, build / "bin"), NOT_TYPED, programs.build
            ).follow()
        finally:
            terminal.close()
    print("the README works as written")


if __name__ == "__main__":
    try:
        main()
    except Broken as broken:
        sys.exit(f"the README breaks: {broken}")
