#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Follows docs/howto/raspberry-pi.md as far as a computer without a board can: types what needs
neither root nor a board, and checks of the rest what can be checked here: options and commands of
our programs, packages, units, presets and keys of systemd. Each command and each file of the page
has a row below; without one the test fails.

usage: raspberry_pi.py SOURCE_FOLDER FOLDER_OF_PROGRAMS
"""
import getpass
import json
import os
import re
import shlex
import shutil
import stat
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "typed"))
from typed import Broken, Expectation, Reader, Terminal, blocks, commands, require, without_comment  # noqa: E402

BOARD = "needs a board"
OTHERS = "changes the computer, by programs of others"
NOT_TYPED = {
    "xzcat 20231109_raspi_4_bookworm.img.xz | sudo dd of=/dev/sdX bs=4M conv=fsync status=progress": "needs a card",
    "passwd": BOARD,
    "apt update && apt install sudo openssh-server avahi-daemon ethtool": OTHERS,
    "adduser pi && adduser pi sudo": OTHERS,
    "hostnamectl set-hostname winch": OTHERS,
    "ssh pi@winch.local": BOARD,
    "sudo apt update && sudo apt full-upgrade": OTHERS,
    "nmcli --fields NAME,DEVICE connection show": BOARD,
    "sudo nmcli connection modify NAME ipv4.method manual ipv4.addresses 192.168.1.5/24": BOARD,
    "sudo nmcli connection modify NAME ipv4.gateway 192.168.1.1 ipv4.dns 192.168.1.1": BOARD,
    "sudo nmcli connection up NAME": BOARD,
    "sudo apt install linux-image-rt-arm64": BOARD,
    "sudo apt install linux-image-rpi-v8-rt": BOARD,
    "echo kernel=kernel8_rt.img | sudo tee --append /boot/firmware/config.txt": BOARD,
    "sudo reboot": OTHERS,
    "cat /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor": "a virtual machine has no governor",
    "sudo apt purge dphys-swapfile": OTHERS,
    "sudo apt purge rpi-swap": OTHERS,
    "scp build/packages-arm64/*.deb pi@192.168.1.5:": BOARD,
    'sudo adduser "$USER" qtplc': OTHERS,
    "sudo tar --extract --no-overwrite-dir --file board.tar.gz --directory /": OTHERS,
    "sudo ldconfig": OTHERS,
    "cd /etc/qtplc": "a folder of the test stands for it",
    "sudo chown qtplc:qtplc *.ini": "needs root and the user qtplc",
    "scp pi@192.168.1.5:anna.ini . && ssh pi@192.168.1.5 rm anna.ini": BOARD,
}


def output(*command):
    return subprocess.run(
        [str(word) for word in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
    ).stdout


def has_options(line, *program):
    """The program knows the options of this line."""
    known = output(*program, "--help")
    for option in re.findall(r"(?<!\S)--([\w-]+)", line):
        require(re.search(rf"--{option}\b", known), f"{Path(program[0]).name} has no option --{option}:\n{known}")


def has_keys(text, binary, sections):
    """systemd knows the keys of this file. sections: the table of the binary has 'Section.Key'."""
    if not Path(binary).exists():
        print(f"not checked: {binary} is not installed")
        return
    known = Path(binary).read_bytes()
    section = None
    for line in text.splitlines():
        if line.startswith("["):
            section = line.strip("[]")
        elif line:
            key = line.partition("=")[0]
            name = f"{section}.{key}" if sections else key
            require(f"\0{name}\0".encode() in known, f"{binary} does not know {section}: {key}")


class Page:
    def __init__(self, source, programs, home):
        self.source, self.programs, self.home = source, programs, home

    # ---- what is checked, command by command ----

    def checks(self):
        qtplc, systemd = self.programs / "qtplc", self.source / "packaging" / "systemd"
        return {
            "sudo apt purge $(dpkg --list 'linux-image-*' | awk '/^ii/ && $2 !~ /-rt-/ { print $2 }')": self.purge,
            "scripts/package arm64": lambda _: self.names("scripts/package", "scripts/package arm64"),
            "sudo apt install ./libqtplc_*.deb ./qtplc-tools_*.deb ./qtplc-awe_*.deb ./qtplc-doc_*.deb": self.packages,
            "scripts/sysroot armhf": lambda _: self.names("scripts/sysroot", "scripts/sysroot armhf"),
            "cmake --preset armhf -DCMAKE_INSTALL_PREFIX=/usr -DQTPLC_INSTALL_SERVICES=ON "
            "-DQTPLC_BUILD_TESTS=OFF": self.preset,
            "cmake --build --preset armhf": lambda _: self.has_preset("buildPresets", "armhf"),
            "DESTDIR=build/board cmake --install build/armhf": lambda _: self.has_preset("configurePresets", "armhf"),
            "scp build/board.tar.gz packaging/debian/qtplc-tools/postinst pi@192.168.1.5:": lambda _: require(
                (self.source / "packaging/debian/qtplc-tools/postinst").is_file(), "there is no such postinst"
            ),
            "sudo apt install adduser libgpiod2 libmodbus5 libqt5network5 libqt5serialbus5 libqt5serialbus5-plugins "
            "libsodium23 libzip4 libzstd1": self.libraries,
            "sudo sh postinst configure": lambda _: self.script("packaging/debian/qtplc-tools/postinst"),
            "sudo systemd-run --pipe --uid=qtplc --property=LimitRTPRIO=99 --property=LimitMEMLOCK=infinity "
            "qtplc doctor": self.systemd_run,
            "sudo systemctl enable --now qtplc-awe.target": lambda _: require(
                (systemd / "qtplc-awe.target.in").is_file(), "there is no such target"
            ),
            "systemctl status 'qtplc-awe-*'": lambda _: require(
                list(systemd.glob("qtplc-awe-*.service.in")), "there are no such services"
            ),
            "sudo -u qtplc qtplc state --security psk --keys /etc/qtplc/keys.ini --identity anna "
            "--master 192.168.1.5": lambda line: has_options(line, qtplc, "state"),
            "awe_control_center --master 192.168.1.5:50000 --security psk --keys anna.ini": self.control_center,
            "qtplc --master 192.168.1.5 jitter --hist --security psk --keys anna.ini": lambda line: has_options(
                line, qtplc, "jitter"
            ),
        }

    def purge(self, line):
        """Of the kernels that dpkg lists, it names all that are installed and have no real time."""
        stub = self.home / "stubs" / "dpkg"
        stub.parent.mkdir()
        stub.write_text(
            "#!/bin/sh\n"
            "echo 'ii  linux-image-6.1.0-18-arm64     6.1.76-1  arm64  Linux'\n"
            "echo 'ii  linux-image-6.1.0-18-rt-arm64  6.1.76-1  arm64  Linux'\n"
            "echo 'rc  linux-image-6.1.0-10-arm64     6.1.38-1  arm64  Linux'\n"
            "echo 'ii  linux-image-arm64              6.1.76-1  arm64  Linux'\n"
        )
        stub.chmod(0o755)
        typed = f"PATH={shlex.quote(str(stub.parent))}:$PATH; " + line.replace("sudo apt purge", "echo")
        named = output("bash", "-c", typed).split()
        require(named == ["linux-image-6.1.0-18-arm64", "linux-image-arm64"], f"the page would purge {named}")

    def names(self, script, text):
        known = output(self.source / script, "--help")
        require(text in known, f"'{text}' is not in its help:\n{known}")

    def packages(self, line):
        known = (self.source / "cmake" / "QtPlcPackages.cmake").read_text()
        for package in re.findall(r"\./([\w-]+)_\*", line):
            require(f"qtplc_package({package} " in known, f"there is no package {package}")

    def has_preset(self, kind, name):
        presets = json.loads((self.source / "CMakePresets.json").read_text())[kind]
        require(name in [preset["name"] for preset in presets], f"there is no preset {name} in {kind}")

    def preset(self, line):
        self.has_preset("configurePresets", "armhf")
        declared = "".join(path.read_text() for path in (self.source / "cmake").glob("*.cmake"))
        declared += (self.source / "CMakeLists.txt").read_text()
        for option in re.findall(r"-D(QTPLC_\w+)=", line):
            require(re.search(rf"option\({option}\b", declared), f"there is no option {option}")

    def libraries(self, line):
        """A computer that builds QtPLC has these libraries, too, if it has the same Debian."""
        if 'VERSION_ID="12"' not in Path("/etc/os-release").read_text():
            print("not checked: these packages are those of Debian 12")
            return
        for package in line.split()[3:]:
            state = output("dpkg-query", "--show", "--showformat=${db:Status-Status}\n", package)
            require("installed" in state.split(), f"{package}: {state}")

    def script(self, name):
        said = output("sh", "-n", self.source / name)
        require(said == "", f"{name}: {said}")

    def systemd_run(self, line):
        if shutil.which("systemd-run"):
            has_options(line, "systemd-run")
        require("doctor" in output(self.programs / "qtplc", "help"), "qtplc has no doctor")

    def control_center(self, line):
        program = self.programs / "awe_control_center"
        if not program.exists():
            print("not checked: this build has no awe_control_center")
            return
        has_options(line, program)

    def service_options(self, line):
        """A line of /etc/default/qtplc-awe: units use it, and their programs have its options."""
        name, value = re.fullmatch(r'(\w+)="(.*)"', line).groups()
        users = [
            path.name[len("qtplc-awe-") : -len(".service.in")]
            for path in (self.source / "packaging" / "systemd").glob("qtplc-awe-*.service.in")
            if re.search(rf"\${{?{name}\b", path.read_text())
        ]
        require(users, f"no unit uses {name}")
        for user in users:
            has_options(value, self.programs / f"awe_{user}")

    # ---- files ----

    def file(self, _language, text):
        first = text.splitlines()[0]
        if first == "[Match]":
            has_keys(text, "/lib/systemd/systemd-networkd", sections=True)
        elif first == "[Manager]":
            has_keys(text, "/lib/systemd/systemd", sections=False)
        elif first.startswith("@"):
            for line in text.splitlines():
                require(re.fullmatch(r"@qtplc - (rtprio \d+|memlock unlimited)", line), f"'{line}' is no limit")
        elif first.startswith("isolcpus="):
            self.processors(dict(word.split("=") for word in first.split()))
        else:
            return first == "dtparam=spi=on"  # only a board knows
        return True

    def processors(self, words):
        """The cycles run on those that are reserved, and the interrupts on the others."""
        page = (self.source / "docs/howto/raspberry-pi.md").read_text()
        reserved = set(words["isolcpus"].split(","))
        require(set(re.findall(r"--cpu (\d)", page)) <= reserved, "a cycle runs on a processor that is not reserved")
        require(
            reserved == set("0123") - set(words["irqaffinity"].split(",")), "interrupts and cycles share processors"
        )

    # ---- what is typed ----

    def expected(self):
        folder = self.home / "etc"

        def has_files(*names):
            for name in names:
                require((folder / name).is_file(), f"there is no {name}")
                mode = stat.S_IMODE((folder / name).stat().st_mode)
                require(mode == 0o600, f"{name} has the mode {mode:04o}")

        def is_at_home():
            require((self.home / "anna.ini").is_file() and not (folder / "anna.ini").exists(), "anna.ini is not moved")

        def copy():
            shutil.copyfile(self.home / "anna.ini", folder / "anna.ini")
            (folder / "anna.ini").chmod(0o644)

        return {
            "uname -v": Expectation(shows=r"\w"),
            "cat /sys/devices/system/cpu/isolated": Expectation(),
            "qtplc --version": Expectation(shows=r"\d+\.\d+\.\d+"),
            "tar --create --gzip --file build/board.tar.gz --owner=root --group=root --directory build/board .": (
                Expectation(
                    after=lambda: require(
                        "./usr/bin/qtplc" in output("tar", "tf", folder / "build/board.tar.gz"), "no qtplc"
                    )
                )
            ),
            "for node in Model Autopilot; do sudo qtplc keys new $node --keys keys.ini --copy $node.ini; done": (
                Expectation(after=lambda: has_files("keys.ini", "Model.ini", "Autopilot.ini"))
            ),
            "sudo qtplc keys new anna --role Operator --keys keys.ini --copy anna.ini": Expectation(
                after=lambda: has_files("keys.ini", "anna.ini")
            ),
            'sudo install --owner="$USER" --mode=600 anna.ini ~/anna.ini && sudo rm anna.ini': Expectation(
                after=is_at_home
            ),
            "chmod 600 anna.ini": Expectation(before=copy, after=lambda: has_files("anna.ini")),
        }


def main():
    source, programs = (Path(argument).resolve() for argument in sys.argv[1:])
    howto = source / "docs" / "howto" / "raspberry-pi.md"
    with tempfile.TemporaryDirectory() as home:
        home = Path(home)
        page = Page(source, programs, home)
        sudo = home / "bin" / "sudo"
        sudo.parent.mkdir()
        sudo.write_text('#!/bin/sh\nexec "$@"\n')  # nothing of what is typed needs root
        sudo.chmod(0o755)
        (home / "etc" / "build" / "board" / "usr" / "bin").mkdir(parents=True)
        (home / "etc" / "build" / "board" / "usr" / "bin" / "qtplc").touch()
        checks, expected = page.checks(), page.expected()
        for block in blocks(howto):
            for line in map(without_comment, commands(block["text"])) if block["language"] == "sh" else ():
                if re.match(r"[A-Z_]+_OPTIONS=", line):
                    checks[line] = page.service_options
                said = output("bash", "-n", "-c", line)
                require(said == "", f"'{line}': {said}")
                # A command that nobody has looked at may do anything to this computer.
                require({line} & {*checks, *expected, *NOT_TYPED}, f"'{line}' has no row in {Path(__file__).name}")
                if line in checks:
                    print(f"checked: {line}")
                    checks[line](line)
        terminal = Terminal(home, {"PATH": f"{sudo.parent}:{programs}:/usr/bin:/bin", "USER": getpass.getuser()})
        try:
            terminal.type("cd ~/etc")
            not_typed = {**NOT_TYPED, **{line: "is checked above" for line in checks}}
            Reader(howto, home / "etc", terminal, expected, not_typed, page.file).follow()
        finally:
            terminal.close()
    print("the commands for a board are as far in order as a computer without one can tell")


if __name__ == "__main__":
    try:
        main()
    except Broken as broken:
        sys.exit(f"raspberry-pi breaks: {broken}")
