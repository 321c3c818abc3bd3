#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the reader of exports refuses: one sentence each, with the thing and the remedy.

usage: refusals.py GENERATE_PY [CASE]
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

GENERATE = Path(sys.argv[1]).resolve()
HERE = Path(__file__).resolve().parent


class Export:
    """A copy of a model of this folder, in which a test changes texts."""

    def __init__(self, folder, model):
        self.folder = Path(folder) / "export"
        shutil.copytree(HERE / "models" / model, self.folder)
        self.options = {"dir": self.folder, "include": HERE / "matlab", "period": "10ms"}

    def change(self, name, old, new, count=-1):
        path = self.folder / name
        text = path.read_text()
        assert old in text, f"'{old}' is not in {name}"
        path.write_text(text.replace(old, new, count))

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def generate(self, **changed):
        options = {**self.options, **changed}
        command = [sys.executable, "-B", GENERATE, "--target", "node", "--output", self.folder.parent / "output"]
        command += [f"--{name}={value}" for name, value in options.items() if value]
        return subprocess.run([str(word) for word in command], capture_output=True, text=True)


def refuses(export, *words, **options):
    run = export.generate(**options)
    error = run.stderr.strip()
    assert run.returncode != 0, "the export is taken"
    assert "Traceback" not in error and error.count("\n") == 0, f"not one sentence: {error}"
    for word in words:
        assert word in error, f"'{word}' is not in: {error}"


def takes(export, **options):
    run = export.generate(**options)
    assert run.returncode == 0, run.stderr
    return {path.name: path.read_text() for path in (export.folder.parent / "output").iterdir()}


def missing_headers_of_matlab(folder):
    export = Export(folder, "Pendulum")
    words = ["headers of MATLAB", "rtwtypes.h, rtw_continuous.h, rtw_solver.h", "Package code and artifacts"]
    refuses(export, *words, include=None)


def missing_headers_of_others(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", '#include "rtwtypes.h"', '#include "rtwtypes.h"\n#include "valves.h"')
    refuses(export, "valves.h", "INCLUDE")
    export.change("Tank.h", '#include "valves.h"', '#ifdef VALVES\n#include "valves.h"\n#endif')
    takes(export)  # the compiler does not read it either


def two_rates(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", "extern void Tank_output(void);", "extern void Tank_step0(void);")
    export.change("Tank.h", "extern void Tank_update(void);", "extern void Tank_step1(void);")
    refuses(export, "several rates", "Tank_step0, Tank_step1", "one sample time")


def two_rates_by_argument(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", "Tank_output(void)", "Tank_output(int_T tid)")
    refuses(export, "several rates", "Tank_output", "one sample time")


def wrong_period(folder):
    export = Export(folder, "Pendulum")
    refuses(export, "PERIOD is 20ms", "0.01 s", "Pendulum.c", "write PERIOD 10ms", period="20ms")
    takes(export, period="0.01s")


def period_that_is_no_time(folder):
    export = Export(folder, "Tank")
    for period in ("10", "fast", "0ms", "-1s"):
        refuses(export, f"'{period}' is not a duration", "10ms", period=period)
    for period in ("1e9s", "1e999s", "10.1s", "9us", "1ns"):
        refuses(export, f"PERIOD '{period}' is out of range; use 10us to 10s", period=period)
    for period in ("10us", "10s"):
        takes(export, period=period)


def entry_points_with_names_of_their_own(folder):
    export = Export(folder, "Pendulum")
    for name in ("Pendulum.h", "Pendulum.c"):
        export.change(name, "Pendulum_initialize", "Pendulum_init")
        export.change(name, "Pendulum_step", "Pendulum_compute")
    refuses(export, "no function that computes a step", "STEP", "Pendulum_compute, Pendulum_init")
    refuses(export, "no function 'Pendulum_compute_initialize'", "INITIALIZE", "Pendulum_init", step="Pendulum_compute")
    refuses(export, "no function 'Pendulum_run'", "STEP", "Pendulum_compute", step="Pendulum_run")
    text = takes(export, step="Pendulum_compute", initialize="Pendulum_init", terminate="Pendulum_terminate")
    assert "Pendulum_init();" in text["node_node.cpp"]


def autosar(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", "extern void Tank_output(void);", "extern void Runnable(void);")
    export.change("Tank.c", "Tank_U.inflow = 0.0;", "Tank_U.inflow = Rte_IRead_Runnable_In_inflow();")
    refuses(export, "AUTOSAR", "ert.tlc")


def single_arguments(folder):
    export = Export(folder, "Gearbox")
    export.change(
        "Gearbox.h", "Gearbox_step(RT_MODEL_Gearbox_T *const Gearbox_M)", "Gearbox_step(real_T in, real_T *out)"
    )
    refuses(export, "Gearbox_step", "single values", "Part of model data structure")


def types_without_a_header(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", "real_T inflow;", "PipeBus inflow;")
    refuses(export, "'PipeBus' of 'inflow'", "INCLUDE")


def ports_that_are_pointers(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", "real_T inflow;", "real_T *inflow;")
    refuses(export, "'inflow'", "a pointer", "'Auto'")


def models_without_ports(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", "extern ExtU_Tank_T Tank_U;", "")
    export.change("Tank.h", "extern ExtY_Tank_T Tank_Y;", "")
    refuses(export, "no inputs and outputs", "inports and outports")


def several_models(folder):
    export = Export(folder, "Tank")
    export.write("Pool.h", (export.folder / "Tank.h").read_text().replace("Tank", "Pool"))
    refuses(export, "several models (Pool, Tank)", "MODEL")
    takes(export, model="Tank")
    refuses(export, "no header 'Lake.h'", "MODEL", model="Lake")


def folders_that_are_none(folder):
    export = Export(folder, "Tank")
    refuses(export, "'/none' is not a folder", "unpacked export", dir="/none")
    refuses(export, "INCLUDE '/none'", include="/none")
    refuses(export, "no header in", "declares a model", dir=HERE / "matlab")


def maps_that_do_not_fit(folder):
    export = Export(folder, "Gearbox")
    file = export.folder / "map.ini"
    for text, words in (
        ("[signals]\nx = speed\n", ["'speed' of signal 'x'", "no input or output", "inputs.gear"]),
        ("[signals]\nx = gear\n", ["'gear'", "both an input and an output", "inputs.NAME"]),
        ("[signals]\nJ = inputs.inertia[3x3]\n", ["'inertia'", "3x3"]),
        ("[signals]\ncount = moving\n", ["two outputs", "'count'"]),
        ("[inputs]\nx = gear\n", ["[inputs]", "[signals]"]),
        ("x = gear\n", ["line 1: 'x = gear' stands before the section [signals]"]),
        ("[signals]\nx = inputs.gear\n  more\n", ["line 3: 'more' is not 'signal = field"]),
        ("[signals]\nx\n", ["line 2: 'x' is not 'signal = field"]),
        ("[signals]\n= gear\n", ["line 2: '= gear' is not 'signal = field"]),
        ("[signals]\nx =\n", ["line 2: 'x =' is not 'signal = field"]),
        ("[signals\nx = inputs.gear\n", ["line 1: unknown section [signals"]),
        ("[signals]\nx = [3x3]\n", ["'[3x3]' of signal 'x' is no input or output"]),
        ("[signals]\nx = inputs.gear * 0\n", ["'inputs.gear * 0' of signal 'x' is no input or output"]),
        ("[signals]\nx = inputs.inertia[0x0]\n", ["'inertia'", "0x0"]),
        ("[signals]\nx = inputs.inertia[99999999999999999999x3]\n", ["is no input or output"]),
        ("[signals]\nx = inputs.gear\ny = inputs.gear\n", ["line 3", "has a signal already, in line 2"]),
        ("[signals]\nx = inputs.gear\nx = outputs.gear\n", ["line 3: signal 'x' is there twice, first in line 2"]),
        # all errors at once
        ("[DEFAULT]\nx = 1\n[signals]\ny\nz =\n", ["line 1: unknown section [DEFAULT]", "; line 4: ", "; line 5: "]),
        ("[signals]\na = nothing\nb = gear\nc = none\n", ["line 2: 'nothing'", "; line 3: 'gear'", "; line 4: 'none'"]),
        ("[signals]\n" + "x\n" * 1000, ["line 11: 'x' is not"]),
    ):
        file.write_text(text)
        refuses(export, *words, map=file)
    file.write_bytes(b"\xff\xfe[signals]\n")
    refuses(export, "it is not a text in UTF-8", map=file)
    refuses(export, "none.ini", map=export.folder / "none.ini")
    refuses(export, "cannot be read", map=export.folder)


def definitions_decide_what_a_header_declares(folder):
    export = Export(folder, "Tank")
    export.change("Tank.h", "/* Model entry point functions */", "#if TANK == 2")
    export.change("Tank.h", "extern void Tank_terminate(void);", "extern void Tank_terminate(void);\n#endif")
    refuses(export, "no function that computes a step", define="TANK=1")
    takes(export, define="TANK=2")


def functions_with_main_are_left_out(folder):
    text = takes(Export(folder, "Pendulum"))["node.cmake"]
    sources = text[: text.index("set(folders")]
    assert "Pendulum.c" in sources and "Pendulum_data.c" in sources and "ert_main.c" not in sources, sources


def same_export_same_text(folder):
    export = Export(folder, "Gearbox")
    first = takes(export)
    times = {path: path.stat().st_mtime_ns for path in (export.folder.parent / "output").iterdir()}
    assert takes(export) == first
    assert times == {path: path.stat().st_mtime_ns for path in times}, "what has not changed is written again"
    export.change("Gearbox.h", "uint32_T count;", "uint32_T steps;")
    assert '"steps"' in takes(export)["node_node.cpp"]


CASES = [value for value in list(globals().values()) if callable(value) and getattr(value, "__code__", None)]
CASES = [case for case in CASES if case.__code__.co_varnames[:1] == ("folder",)]


def main():
    failed = 0
    for case in CASES:
        if len(sys.argv) > 2 and sys.argv[2] != case.__name__:
            continue
        with tempfile.TemporaryDirectory() as folder:
            try:
                case(folder)
                print(f"passed: {case.__name__}")
            except AssertionError as error:
                failed += 1
                print(f"FAILED: {case.__name__}: {error}")
    sys.exit(f"{failed} cases failed" if failed else 0)


if __name__ == "__main__":
    main()
