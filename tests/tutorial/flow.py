#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types docs/tutorial in order, from an installed package, in an empty folder: creates its files
and runs its commands as written. A file that a later step introduces is not there yet.

usage: flow.py SOURCE_FOLDER BUILD_FOLDER
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "typed"))
from typed import ANY, Broken, Expectation, Reader, Terminal, await_that, in_own_network, require  # noqa: E402

NOT_TYPED = {
    "scripts/setup": "tests/scripts runs it with a slow apt-get",
    "cmake --preset release && cmake --build --preset release --target programs": (
        "builds QtPLC; what the test installs was built like that"
    ),
}


class Winch:
    """The plant of the page, as the commands of the page show it."""

    def __init__(self, terminal, program):
        self.terminal, self.program = terminal, program

    def qtplc(self, command):
        """Beside what the page types, so that its terminal shows only that."""
        run = subprocess.run(
            [self.program, *command.split()], env=self.terminal.environment, capture_output=True, text=True
        )
        require(run.returncode == 0, f"qtplc {command} gives {run.returncode}: {run.stderr}")
        return run.stdout

    def value(self, signal):
        return float(self.qtplc(f"get {signal} --plain"))

    def await_nodes(self, count):
        """Each node of the shell says that it has registered."""

        def registered():
            self.terminal.take(0.1)
            return self.terminal.shown.count("registered at") >= count

        await_that(registered, lambda: f"{count} nodes never register: {self.terminal.shown[-2000:]}")

    def await_value(self, signal, condition, text):
        await_that(
            lambda: condition(self.value(signal)), lambda: f"{signal} {text} never comes, it is {self.value(signal)}"
        )

    def cycles_both_ways(self):
        self.await_value("tetherLength", lambda length: length >= 309.0, ">= 309")
        self.await_value("tetherSpeed", lambda speed: speed < 0.0, "< 0")

    def safe_length(self):
        self.await_value("tetherLength", lambda length: length == 310.0, "= 310, its safe value,")

    def moves_again(self):
        self.await_nodes(3)
        self.await_value("tetherLength", lambda length: 300.0 < length < 309.9, "of the new winch")

    def stands(self):
        self.await_value("tetherSpeed", lambda speed: speed == 0.0, "= 0, its safe value,")

    def reels_in(self):
        before = self.value("tetherLength")
        self.await_value("tetherLength", lambda length: length < before - 1.0, "by hand, one metre shorter,")


def expected(winch):
    return {
        "build/winch_master &": Expectation(after=lambda: winch.terminal.await_text("port 50000")),
        "qtplc state": Expectation(shows=r"(?s)(?=.*\bWinch\b)(?=.*\bOperator\b)", before=lambda: winch.await_nodes(2)),
        "qtplc start": Expectation(after=winch.cycles_both_ways),
        "qtplc list": Expectation(shows=r"(?s)tetherSpeed.*tetherLength"),
        "qtplc echo tetherLength": Expectation(
            keys=(r"(?s)(.*tetherLength.*\n){3}|(.*\d\.\d.*\n){3}", b"\x03"), code=ANY
        ),
        "kill %2": Expectation(after=winch.safe_length),
        "build/winch &": Expectation(),
        "build/winch": Expectation(shows=r"(?i)winch.*(in use|already)", code=ANY, before=winch.moves_again),
        "kill %3": Expectation(after=winch.stands),
        "qtplc set tetherSpeed -1.5": Expectation(after=winch.reels_in),
        "ctest --test-dir build --output-on-failure": Expectation(shows="100% tests passed"),
    }


def same_files(created, code):
    """What the reader has at the end is what is in the repository."""
    for path in sorted(code.glob("[!.]*")):
        text = re.sub(r"\A.*SPDX.*\n+", "", path.read_text())
        require(
            (created / path.name).is_file() and (created / path.name).read_text() == text,
            f"the reader's {path.name} is not that of {code}",
        )


def main():
    source, build = (Path(argument).resolve() for argument in sys.argv[1:])
    in_own_network()
    with tempfile.TemporaryDirectory() as home:
        home = Path(home)
        (home / "QtPLC" / "build").mkdir(parents=True)
        (home / "QtPLC" / "build" / "release").symlink_to(build)
        terminal = Terminal(home)
        try:
            terminal.type("cd QtPLC")
            reader = Reader(
                source / "docs" / "tutorial" / "README.md",
                home / "winch",
                terminal,
                expected(Winch(terminal, home / "qtplc" / "bin" / "qtplc")),
                NOT_TYPED,
            )
            reader.follow()
            same_files(home / "winch", source / "docs" / "tutorial" / "code")
        finally:
            terminal.close()
    print("the tutorial works as written")


if __name__ == "__main__":
    try:
        main()
    except Broken as broken:
        sys.exit(f"the tutorial breaks: {broken}")
