#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Looks at the FMUs of the kite with FMPy, a simulator of others: whether its checker has something
to say, and whether model and autopilot, coupled there for 120 s, have the energy of the plant to
the last bit, with FMI 2.0 and 3.0. FMPy is not a part of QtPLC: download its sources where you
like. They need numpy, lxml and attr (Debian: python3-numpy, python3-lxml, python3-attr).

usage: fly_in_fmpy.py FMPY_SOURCES AWE_SIL FOLDER_OF_FMUS
       fly_in_fmpy.py ~/FMPy/src build/release/bin/awe_sil build/release/fmu

The exit code is 0 if there is nothing to say, and if all energies are equal.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PERIOD = 0.01  # [s]
DURATION = 120  # [s]


class Unit:
    """An instance of an FMU, whose arrays are one variable (FMI 3.0) or several (FMI 2.0)."""

    def __init__(self, file):
        import fmpy.fmi2
        import fmpy.fmi3

        description = fmpy.read_model_description(str(file))
        self.is_fmi2 = description.fmiVersion == "2.0"
        self.folder = fmpy.extract(str(file))
        self.slave = (fmpy.fmi2.FMU2Slave if self.is_fmi2 else fmpy.fmi3.FMU3Slave)(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=file.stem,
        )
        self.variables = {}
        for variable in description.modelVariables:
            self.variables.setdefault(re.sub(r"\[\d+\]$", "", variable.name), []).append(variable)
        self.slave.instantiate()
        if self.is_fmi2:
            self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()

    def names(self, causality):
        return {name for name, variables in self.variables.items() if variables[0].causality == causality}

    def access(self, kind, name):
        variables = self.variables[name]
        return getattr(self.slave, kind + variables[0].type), [variable.valueReference for variable in variables]

    def size(self, name):
        variables = self.variables[name]
        dimensions = getattr(variables[0], "dimensions", None) or []
        return len(variables) * int(dimensions[0].start) if dimensions else len(variables)

    def get(self, name):
        get, references = self.access("get", name)
        return list(get(references)) if self.is_fmi2 else list(get(references, nValues=self.size(name)))

    def set(self, name, values):
        set_values, references = self.access("set", name)
        set_values(references, values)

    def step(self, time):
        self.slave.doStep(currentCommunicationPoint=time, communicationStepSize=PERIOD)

    def end(self):
        self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder)


def energy_of_fmus(folder, suffix):
    """[J] of both, coupled: in each cycle all inputs, then all steps."""
    model, autopilot = (Unit(folder / f"{name}{suffix}.fmu") for name in ("awe_model", "awe_autopilot"))

    def exchange():
        for source, target in ((model, autopilot), (autopilot, model)):
            for name in source.names("output") & target.names("input"):
                target.set(name, source.get(name))

    exchange()
    for unit in (model, autopilot):
        unit.slave.exitInitializationMode()
    # The observer of the plant has read the outputs of the cycle before its last one.
    for cycle in range(round(DURATION / PERIOD) - 2):
        exchange()
        for unit in (model, autopilot):
            unit.step(cycle * PERIOD)
    (energy,) = model.get("energy")
    for unit in (model, autopilot):
        unit.end()
    return energy


def energy_of_plant(sil):
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "flight.json"
        options = ["--lockstep", "--same-cycle", "--dead-time", "1", "--duration", str(DURATION), "--report", report]
        subprocess.run([sil, *options], check=True, stdout=subprocess.DEVNULL)
        return json.loads(report.read_text())["energy_J"]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sources, sil, folder = (Path(argument).expanduser().resolve() for argument in sys.argv[1:])
    sys.path.insert(0, str(sources))
    try:
        from fmpy.validation import validate_fmu
    except ImportError as error:
        sys.exit(f"{sources} has no FMPy that runs: {error}")
    faults = 0
    for file in sorted(folder.glob("*.fmu")):
        problems = validate_fmu(str(file))
        faults += len(problems)
        print(f"{file.name}: {'; '.join(problems) or 'no problem found'}")
    expected = energy_of_plant(sil)
    print(f"plant: {expected} J after {DURATION} s")
    for suffix in ("", "_fmi3"):
        energy = energy_of_fmus(folder, suffix)
        faults += energy != expected
        print(
            f"awe_model{suffix} and awe_autopilot{suffix}: {energy} J, {'equal' if energy == expected else 'NOT EQUAL'}"
        )
    return 0 if faults == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
