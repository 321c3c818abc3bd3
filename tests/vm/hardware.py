# SPDX-License-Identifier: Apache-2.0
"""The hardware library on the devices of the kernel, and what of the core depends on the kernel."""
import json
from pathlib import Path

from steps import Skipped, command, program

CORE_TESTS = ("tst_QPlcRealTimeOptions", "tst_CycleThread", "tst_HotPath", "tst_SystemFacts", "tst_MasterCycle")
SKIP_CODE = 77


def steps(bench):
    for name in CORE_TESTS:
        yield f"core: {name}", lambda name=name: test(name)
    yield "hardware: conformance of the drivers on devices of the kernel", lambda: test(
        "tst_DriverConformance", bench.environment()
    )
    yield "hardware: CAN bus of the kernel, and its queue", lambda: test("tst_CanBus", bench.environment())
    yield "hardware: 20 CAN frames a cycle on vcan", lambda: can_frames(bench)


def test(name, environment=None):
    """Runs a Qt Test program. \\return how many functions passed"""
    output = command(program(name), seconds=240, environment=environment)
    totals = [line for line in output.splitlines() if line.startswith("Totals:")]
    skipped = [line.strip() for line in output.splitlines() if line.startswith("SKIP")]
    print("\n".join(skipped), end="\n" if skipped else "")
    return totals[-1].removeprefix("Totals: ") if totals else None


def can_frames(bench):
    if not bench.can:
        raise Skipped("there is no CAN")
    output = command(
        program("qtplc_can_cycle"), "--device", bench.can, "--period-us", "20000", "--seconds", "20", seconds=240
    )
    result = json.loads(output.strip().splitlines()[-1])
    faults = {name: result[name] for name in ("lost", "reordered", "unsent", "wrong_ages")}
    assert not any(faults.values()), f"frames went wrong: {faults}"
    return (
        f"{result['frames_in']:.0f} frames in, {result['frames_out']:.0f} out, none lost, reordered or unsent, "
        f"{result['judged_ages']:.0f} ages right"
    )
