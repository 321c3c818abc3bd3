#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types a page of docs/howto as written, from an installed package, after the tutorial: in ~/winch
are its programs.

usage: typed_howtos.py PAGE SOURCE_FOLDER BUILD_FOLDER
PAGE: wire-a-sensor, simulink-model, fmu-as-a-node, write-a-panel, test-a-node, test-a-plant,
my-node-as-an-fmu, my-controller-as-a-dll or master-in-a-host
"""
import ctypes
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "typed"))
from typed import Broken, Expectation, Reader, Terminal, await_that, in_own_network, require  # noqa: E402

NEEDS_ROOT = "needs root and a system with systemd"
NOT_TYPED = {
    "wire-a-sensor": {
        "ls -l /dev/serial/by-id /dev/i2c-* /dev/spidev* /dev/gpiochip*": "needs a sensor",
        'sudo adduser "$USER" dialout': NEEDS_ROOT,
        "sudo cp wind.ini /etc/qtplc/wind.ini": NEEDS_ROOT,
        "sudo systemctl enable --now qtplc-hardware@wind": NEEDS_ROOT,
    },
    "simulink-model": {},
    "fmu-as-a-node": {},
    "write-a-panel": {},
    "test-a-node": {},
    "test-a-plant": {},
    "my-node-as-an-fmu": {},
    "my-controller-as-a-dll": {},
    "master-in-a-host": {},
}


class Plant:
    def __init__(self, home, terminal):
        self.home, self.terminal = home, terminal

    def value(self, signal):
        """None: not yet. Beside what the page types, so that its terminal shows only that."""
        run = subprocess.run(
            [self.home / "qtplc" / "bin" / "qtplc", "get", signal, "--plain"],
            env=self.terminal.environment,
            capture_output=True,
            text=True,
        )
        return float(run.stdout) if run.returncode == 0 else None

    def await_value(self, signal, condition, text):
        def comes():
            value = self.value(signal)
            return value is not None and condition(value)

        await_that(
            comes,
            lambda: f"{signal} {text} never comes, it is {self.value(signal)}; "
            f"the terminal shows {self.terminal.shown[-1500:]}",
        )

    def await_nodes(self, count):
        def registered():
            self.terminal.take(0.1)
            return self.terminal.shown.count("registered at") >= count

        await_that(registered, lambda: f"{count} nodes never register: {self.terminal.shown[-1500:]}")


def wire_a_sensor(plant):
    terminal, device = plant.terminal, plant.home / "winch" / "devices" / "wind"
    return {
        "python3 play_wind.py wind &": Expectation(
            after=lambda: await_that(device.exists, lambda: "the sensor that is played never comes")
        ),
        "qtplc_hardware wind.ini --check": Expectation(shows=r"relativeSpeed +-> windSpeed"),
        "qtplc_hardware wind.ini --monitor": Expectation(shows=r"windSpeed +5\.1", keys=(r"windSpeed +5\.1", b"\x03")),
        "build/winch_master &": Expectation(after=lambda: terminal.await_text("port 50000")),
        "qtplc_hardware wind.ini --master localhost &": Expectation(after=lambda: plant.await_nodes(1)),
        "qtplc get windSpeed windDirection": Expectation(
            shows=r"(?s)5\.1.*214\.8",
            before=lambda: plant.await_value("windSpeed", lambda speed: speed == 5.1, "= 5.1"),
        ),
        "kill %1": Expectation(
            after=lambda: plant.await_value("windSpeed", lambda speed: speed == 0.0, "= 0, its safe value,")
        ),
        "qtplc watch 'wind*'": Expectation(
            before=lambda: plant.await_value("windSpeed", lambda speed: speed == 5.1, "= 5.1, again,"),
            keys=("windSpeed", b"q"),
        ),
    }


def simulink_model(plant):
    def flies():
        plant.await_value("tetherLength", lambda length: length >= 309.0, ">= 309")
        plant.await_value("tetherSpeed", lambda speed: speed < 0.0, "< 0")
        plant.await_value("tetherLength", lambda length: length <= 301.0, "<= 301")

    return {
        "~/winch/build/winch_master --signals ~/winch/winch.ini &": Expectation(
            after=lambda: plant.terminal.await_text("port 50000")
        ),
        "~/winch/build/winch_operator &": Expectation(after=lambda: plant.await_nodes(2)),
        "qtplc start": Expectation(after=flies),
        "qtplc list": Expectation(shows="tetherLength.*Winch"),
        "build/winch_model --table": Expectation(shows=r"(?s)\[tetherSpeed\]\s+type = Real64.*\[tetherLength\]"),
    }


def fmu_as_a_node(plant):
    def flies():
        plant.await_value("tetherLength", lambda length: length >= 309.0, ">= 309")
        plant.await_value("tetherSpeed", lambda speed: speed < 0.0, "< 0")
        plant.await_value("tetherLength", lambda length: length <= 301.0, "<= 301")

    return {
        "qtplc_fmu info model.fmu": Expectation(shows=r"input +Real +u \[m/s\]"),
        "qtplc_fmu check model.fmu": Expectation(shows="no faults found"),
        "tail -n 1 model.csv": Expectation(shows=r"2,(3|2\.9999|3\.0000)"),
        "qtplc_fmu node model.fmu --check": Expectation(shows="signals of the same name"),
        "build/winch_master --signals winch.ini &": Expectation(after=lambda: plant.terminal.await_text("port 50000")),
        "qtplc_fmu node winch_fmu.ini &": Expectation(after=lambda: plant.await_nodes(1)),
        "build/winch_operator &": Expectation(after=lambda: plant.await_nodes(2)),
        "qtplc start": Expectation(after=flies),
        "qtplc list": Expectation(shows="tetherLength.*Winch"),
        "qtplc_fmu bench model.fmu --step 0.005 --count 1000 --period 0.01": Expectation(shows="1000 steps of 0.005 s"),
    }


def write_a_panel(plant):
    return {
        "~/winch/build/winch_master --signals ~/winch/winch.ini &": Expectation(
            after=lambda: plant.terminal.await_text("port 50000")
        ),
        "~/winch/build/winch_operator &": Expectation(after=lambda: plant.await_nodes(1)),
        "build/my_window &": Expectation(after=lambda: plant.await_nodes(2)),
    }


def test_a_node(_plant):
    return {"build/tst_Winch -silent": Expectation(shows=r"Totals: 5 passed, 0 failed")}


def step_the_fmu(folder):
    """As a host of FMI 2.0: a second with 2 m/s."""
    with zipfile.ZipFile(folder / "build/fmu/winch.fmu") as fmu:
        fmu.extractall(folder / "unpacked")
    description = (folder / "unpacked/modelDescription.xml").read_text()
    guid = re.search(r'guid="([^"]+)"', description)[1].encode()

    def reference(name):
        return ctypes.byref(ctypes.c_uint(int(re.search(rf'name="{name}" valueReference="(\d+)"', description)[1])))

    library = ctypes.CDLL(folder / "unpacked/binaries/linux64/winch.so")
    library.fmi2Instantiate.restype = ctypes.c_void_p
    winch = ctypes.c_void_p(library.fmi2Instantiate(b"winch", 1, guid, None, None, 0, 0))
    speed, length = ctypes.c_double(2.0), ctypes.c_double()
    done = [
        library.fmi2SetupExperiment(winch, 0, ctypes.c_double(), ctypes.c_double(), 0, ctypes.c_double()),
        library.fmi2EnterInitializationMode(winch),
        library.fmi2ExitInitializationMode(winch),
        library.fmi2SetReal(winch, reference("tetherSpeed"), ctypes.c_size_t(1), ctypes.byref(speed)),
        library.fmi2DoStep(winch, ctypes.c_double(0.0), ctypes.c_double(1.0), 1),
        library.fmi2GetReal(winch, reference("tetherLength"), ctypes.c_size_t(1), ctypes.byref(length)),
    ]
    library.fmi2FreeInstance(winch)
    require(not any(done), f"functions of the FMU return {done}")
    require(abs(length.value - 302.0) < 1e-9, f"the tether is {length.value} m long, not 302 m")


def my_node_as_an_fmu(plant):
    return {
        "cmake -E tar tf build/fmu/winch.fmu": Expectation(
            shows="binaries/linux64/winch.so", after=lambda: step_the_fmu(plant.home / "winch_fmu")
        )
    }


def call_the_controller(folder):
    """As OpenFAST does, once."""
    library = ctypes.CDLL(folder / "build/discon/libdiscon_example.so")
    file, message = str(folder / "records.ini").encode(), ctypes.create_string_buffer(400)
    records, fail = (ctypes.c_float * 200)(), ctypes.c_int(99)
    for record, value in {3: 0.0125, 20: 100.0, 49: 400, 50: len(file)}.items():
        records[record - 1] = value
    library.DISCON(records, ctypes.byref(fail), file, b"", message)
    require(fail.value == 0, f"aviFAIL is {fail.value}: {message.value.decode()}")
    require(records[46] == 23300.0, f"the torque is {records[46]} N m, not 23300 N m")


def my_controller_as_a_dll(plant):
    return {"cmake --build build": Expectation(after=lambda: call_the_controller(plant.home / "turbine"))}


def master_in_a_host(plant):
    return {
        "qtplc_fmu info build/fmu/winch_plant.fmu": Expectation(shows=r"(?s)plant\.port.*tetherSpeed.*tetherLength"),
        "tail -n 1 length.csv": Expectation(shows=r"1,(302|301\.9999|302\.0000)"),
    }


def test_a_plant(_plant):
    return {
        "build/tst_Winch -silent": Expectation(shows=r"Totals: 4 passed, 0 failed"),
        "build/tst_WinchReplay -silent": Expectation(shows=r"Totals: 4 passed, 0 failed"),
    }


def run(*command, **variables):
    result = subprocess.run(
        [str(word) for word in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, **variables},
    )
    require(result.returncode == 0, f"{' '.join(map(str, command))} fails:\n{result.stdout[-4000:]}")


def after_the_tutorial(home, source, build):
    """What its reader has made."""
    run("cmake", "--install", build, "--prefix", home / "qtplc")
    winch = home / "winch"
    winch.mkdir()
    for path in (source / "docs" / "tutorial" / "code").glob("[!.]*"):
        (winch / path.name).write_text(path.read_text())
    # Each page begins with the same programs: what one of them has compiled serves the others.
    launcher = f"-DCMAKE_CXX_COMPILER_LAUNCHER={shutil.which('ccache') or ''}"
    run("cmake", "-S", winch, "-B", winch / "build", f"-DCMAKE_PREFIX_PATH={home / 'qtplc'}", launcher)
    programs = "winch_master", "winch_operator", "winch"
    run("cmake", "--build", winch / "build", "--target", *programs, CCACHE_BASEDIR=str(home), CCACHE_NOHASHDIR="1")


def main():
    page = sys.argv[1]
    source, build = (Path(argument).resolve() for argument in sys.argv[2:])
    in_own_network()
    with tempfile.TemporaryDirectory() as home:
        home = Path(home)
        after_the_tutorial(home, source, build)
        terminal = Terminal(home, {"PATH": f"{home}/qtplc/bin:/usr/local/bin:/usr/bin:/bin"})
        plant = Plant(home, terminal)
        try:
            expected, folder = {
                "wire-a-sensor": (wire_a_sensor, "winch"),
                "simulink-model": (simulink_model, "winch_model"),
                "fmu-as-a-node": (fmu_as_a_node, "winch"),
                "write-a-panel": (write_a_panel, "my_window"),
                "test-a-node": (test_a_node, "node_tests"),
                "my-node-as-an-fmu": (my_node_as_an_fmu, "winch_fmu"),
                "my-controller-as-a-dll": (my_controller_as_a_dll, "turbine"),
                "master-in-a-host": (master_in_a_host, "winch_plant"),
                "test-a-plant": (test_a_plant, "winch_tests"),
            }[page]
            if page == "fmu-as-a-node":
                shutil.copy(build / "tests" / "models" / "fmus" / "plant2.fmu", home / folder / "model.fmu")
            terminal.type(f"cd ~/{folder}")
            Reader(
                source / "docs" / "howto" / f"{page}.md", home / folder, terminal, expected(plant), NOT_TYPED[page]
            ).follow()
        finally:
            terminal.close()
    print(f"{page} works as written")


if __name__ == "__main__":
    try:
        main()
    except Broken as broken:
        sys.exit(f"{sys.argv[1]} breaks: {broken}")
