# SPDX-License-Identifier: Apache-2.0
"""Does what a page tells its reader: creates the files that it shows and types the commands that it
shows, in order, as written, in a terminal of its own.

The terminal has a network of its own, so that the commands may use the ports that the pages name,
while other tests run.

A block of a page is
    commands      ```sh
    a file        behind the line <!-- file: PATH -->: the file of that name is created
    its begin     behind the line <!-- begin of: PATH -->: the file is created, and goes on later
    its end       behind the line <!-- end of: PATH -->: is appended
    a part        each other language: given to the function for this page
"""
import os
import pty
import re
import select
import shutil
import signal
import subprocess
import sys
import termios
import time
from pathlib import Path

SKIPPED = 77
PATIENCE = 60.0  # [s]
BLOCK = re.compile(
    r"(?:^<!-- (?P<kind>file|begin of|end of): (?P<path>\S+) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```\n",
    re.M | re.S,
)
ANY = None  # exit code of a command that ends by a signal, or in more than one way
PROMPT = re.compile(r"<<<(\d+)>>>")


class Broken(Exception):
    """The page says what is not so."""


def require(condition, text):
    if not condition:
        raise Broken(text)


def await_that(condition, text):
    """text: a function that says at the end what is there in its place."""
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise Broken(text())
        time.sleep(0.05)


def blocks(page):
    return list(BLOCK.finditer(page.read_text()))


def commands(text):
    """The commands of a block: a line each, unless it goes on in the next one."""
    command = ""
    for line in text.splitlines():
        command += line
        if command.endswith("\\"):
            command += "\n"
        elif command.strip() and not command.lstrip().startswith("#"):
            yield command
            command = ""
        else:
            command = ""


def without_comment(command):
    return re.sub(r"\s+#\s.*$", "", command).strip()


def in_own_network():
    """Starts this program again in a network of its own, once."""
    if os.environ.get("QTPLC_OWN_NETWORK"):
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
        return
    unshare = ["unshare", "--net"] if os.geteuid() == 0 else ["unshare", "--user", "--map-root-user", "--net"]
    if not shutil.which("ip") or subprocess.run([*unshare, "true"], capture_output=True).returncode != 0:
        print("SKIP   : this system allows no network of its own for a test (unshare, ip)")
        sys.exit(SKIPPED)
    os.execvpe(unshare[0], [*unshare, sys.executable, "-B", *sys.argv], {**os.environ, "QTPLC_OWN_NETWORK": "1"})


class Terminal:
    """A shell on a terminal, in a folder, in which commands are typed."""

    def __init__(self, folder, environment=None):
        self.shown, self.read = "", 0
        keep = {name: os.environ[name] for name in ("LANG", "CXX", "CCACHE_DIR") if name in os.environ}
        self.environment = {
            **keep,
            "HOME": str(folder),
            "PATH": "/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin",
            "TERM": "xterm",
            "PS1": "<<<$?>>>",
            "PS2": "",
            "XDG_RUNTIME_DIR": str(folder),
            "QT_QPA_PLATFORM": "offscreen",
            **(environment or {}),
        }
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execvpe("bash", ["bash", "--noprofile", "--norc", "--noediting", "-i"], self.environment)
        modes = termios.tcgetattr(self.terminal)
        modes[3] &= ~termios.ECHO
        termios.tcsetattr(self.terminal, termios.TCSANOW, modes)
        self.await_prompt(None, "bash")

    def take(self, seconds):
        if not select.select([self.terminal], [], [], seconds)[0]:
            return
        try:
            self.shown += os.read(self.terminal, 65536).decode(errors="replace").replace("\r", "")
        except OSError:
            raise Broken(f"the shell has ended:\n{self.shown[-2000:]}") from None

    def await_prompt(self, answer, command):
        """What the command shows, and its exit code. answer: the pattern that is awaited, None:
        until the command can be interrupted; and the keys that are pressed then."""
        end = time.monotonic() + 10 * PATIENCE
        while True:
            found = PROMPT.search(self.shown, self.read)
            if found:
                text = self.shown[self.read : found.start()]
                self.read = found.end()
                return text, int(found[1])
            if answer and (
                self.is_interruptible() if answer[0] is None else re.search(answer[0], self.shown[self.read :])
            ):
                os.write(self.terminal, answer[1])
                answer = None
            require(time.monotonic() < end, f"'{command}' does not end; it shows:\n{self.shown[self.read:][-2000:]}")
            self.take(0.1)

    def is_interruptible(self):
        """Whether the program in the foreground has a handler for Ctrl-C."""
        try:
            status = Path(f"/proc/{os.tcgetpgrp(self.terminal)}/status").read_text()
        except OSError:
            return False
        handled = int(re.search(r"^SigCgt:\s*(\w+)$", status, re.M)[1], 16)
        return "Name:\tbash" not in status and bool(handled & 1 << (signal.SIGINT - 1))

    def type(self, command, answer=None):
        self.take(0)
        self.read = len(self.shown)
        os.write(self.terminal, command.encode() + b"\n")
        return self.await_prompt(answer, command)

    def await_text(self, text):
        def seen():
            self.take(0.1)
            return text in self.shown

        await_that(seen, lambda: f"'{text}' is never shown, but:\n{self.shown[-2000:]}")

    def close(self):
        try:
            self.type("kill -TERM $(jobs -p) 2> /dev/null; wait 2> /dev/null")
        except Broken:
            pass
        finally:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
            os.close(self.terminal)


class Expectation:
    """What the reader of a page waits for before a command, which keys he presses, and what he
    sees."""

    def __init__(self, shows="", code=0, before=None, keys=None, after=None):
        self.shows, self.code, self.before, self.keys, self.after = shows, code, before, keys, after


class Reader:
    """Follows a page in a folder. expected: what is seen at some of its commands. not_typed:
    commands that are left out, and why."""

    def __init__(self, page, folder, terminal, expected=None, not_typed=None, part=None):
        self.page, self.folder, self.terminal = page, folder, terminal
        self.expected, self.not_typed, self.part = expected or {}, not_typed or {}, part
        self.seen = set()

    def follow(self):
        for block in blocks(self.page):
            try:
                self.follow_block(block)
            except Broken as broken:
                line = self.page.read_text()[: block.start()].count("\n") + 1
                raise Broken(f"{self.page}:{line}: {broken}") from None
        unknown = set(self.expected) | set(self.not_typed)
        require(
            unknown <= self.seen,
            f"{self.page}: the page does not show {sorted(unknown - self.seen)}, which the test expects",
        )

    def follow_block(self, block):
        if block["kind"]:
            path = self.folder / Path(block["path"]).name
            if block["kind"] == "end of":
                require(path.is_file(), f"{path.name} goes on, and was not begun")
            else:
                require(not path.exists(), f"{path.name} is there already")
            with open(path, "a") as file:
                file.write(block["text"] if block["kind"] != "end of" else "\n" + block["text"])
        elif block["language"] == "sh":
            for command in commands(block["text"]):
                self.follow_command(without_comment(command))
        else:
            require(
                self.part is not None and self.part(block["language"], block["text"]), "this block is run by no test"
            )

    def follow_command(self, command):
        self.seen.add(command)
        if command in self.not_typed:
            print(f"not typed: {command} ({self.not_typed[command]})")
            return
        expectation = self.expected.get(command, Expectation())
        if expectation.before:
            expectation.before()
        begin = time.monotonic()
        text, code = self.terminal.type(command, expectation.keys)
        print(f"{time.monotonic() - begin:6.1f} s  {command}", flush=True)
        require(expectation.code in (ANY, code), f"'{command}' gives {code}:\n{text}")
        require(re.search(expectation.shows, text), f"'{command}' does not show '{expectation.shows}', but:\n{text}")
        if expectation.after:
            expectation.after()
