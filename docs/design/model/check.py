#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Searches all states of the model of a plant (README.md beside this file) with spin.

usage: check.py [--events] [--quick] [--only WORD] [--keep FOLDER]

Without an option: every property, the run without each switch, and every mutant: minutes.
  --events  no search: only compares the events and actions of model and tables; needs no spin
  --quick   some properties, each switch and each mutant: for each change
  --only    runs whose name contains WORD
  --keep    keeps the folder of each run, with the trail of a violation: spin -t -p plant.pml

The exit code is 0 if all runs end as expected, 1 if one does not, 77 if spin or gcc is missing.
"""
import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
MEMORY = 2800  # [MB] of a search
TIME = 1800  # [s] of a search

# Events of the tables that the model never applies, and why.
LEFT_OUT = {
    "ME_Listen": "a program starts its server again",
    "ME_ServerListens": "likewise",
    "ME_ServerFailed": "likewise",
    "ME_AddNode": "nodes in the process of the master",
    "ME_End": "a master that ends in order",
    "ME_ListenerJoined": "listeners",
    "ME_CycleLimitReached": "phases of a fixed length",
    "ME_OverrunStop": "overrun policies",
    "NE_Connect": "as Retry",
    "NE_Leave": "a node that ends in order",
    "NE_AddedLocally": "nodes in the process of the master",
    "NE_HelloCame": "changes no state",
    "NE_Accepted": "changes no state",
    "NE_MasterEnded": "a master that ends in order",
}


class Run:
    """One search. `fails`: words of the assertion that it has to violate, empty if all has to hold;
    it may violate others, too."""

    def __init__(self, name, what, fails="", quick=False, formula="", edit=None, **switches):
        self.name, self.what, self.fails, self.quick = name, what, fails, quick
        self.formula, self.edit, self.switches = formula, edit, switches


def text(old, new):
    """A mutant of the model: `old`, which has to be there once, becomes `new`."""

    def edit(plant, tables):
        if plant.count(old) != 1:
            raise SystemExit(
                f"check: the mutant of '{old}' fits {plant.count(old)} places of plant.pml; update check.py"
            )
        return plant.replace(old, new), tables

    return edit


def both(first, second):
    return lambda plant, tables: second(*first(plant, tables))


def cell(event, state, outcome):
    """A mutant of the tables: another outcome of one event in one state."""

    def edit(plant, tables):
        head = f"    :: event == {event} ->\n        if\n"
        begin = tables.index(head) + len(head)
        end = tables.index("        fi\n", begin)
        options = []
        for line in tables[begin:end].splitlines():
            states, then = line.strip()[3:].split(" -> ")
            kept = [one for one in states.split(" || ") if one != f"state == {state}"]
            if kept:
                options.append(f"        :: {' || '.join(kept)} -> {then}\n")
        options.append(f"        :: state == {state} -> {outcome}\n")
        return plant, tables[:begin] + "".join(options) + tables[end:]

    return edit


PRESENT = "attached[0]&&(stage[0]"  # the critical node takes part, as far as the master knows
BOUNDED = "without<="  # and it really does, but for some cycles
PERSON, RESET, SEEN, STAYS_SAFE = "permitted", "latched", "||seen", "mayNotMove"
CYCLES = "cycles==("  # they run in the states in which they should
OUT = "&&attached"  # an evicted node has no session
NEUTRAL, STOPS, RESTS, WATCHED = "unheard<=", "event!=ME_Stop", "connection[0]", "alone[0]<="

# fmt: off
RUNS = [
    # ---- all switches on: everything holds ----
    Run("start_stop_reset", "properties 1, 3, 4; three commands on a good network", COMMANDS=3, FAULTS=0, LOSS=0),
    Run("two_commands", "the same, two commands", quick=True, COMMANDS=2, FAULTS=0, LOSS=0),
    Run("one_fault", "properties 1, 3, 4; two commands, one kill, hang or cut cable", COMMANDS=2, FAULTS=1, LOSS=0),
    Run("fault_and_reset", "the same with three commands, so that a plant can be reset and started again",
        COMMANDS=3, FAULTS=1, LOSS=0, PROMPT=1),
    Run("two_faults", "properties 1 and 3; two faults after a start", COMMANDS=1, FAULTS=2, LOSS=0, PROMPT=1),
    Run("bad_network", "properties 1, 2, 5; frames that are lost and late",
        COMMANDS=1, FAULTS=0, LOSS=2, PRESENCE=1, SILENCE=1),
    Run("bad_network_and_stop", "the same with a second command", COMMANDS=2, FAULTS=0, LOSS=1, PRESENCE=1, SILENCE=1),
    Run("presence", "property 1 in cycles; one fault, frames are lost",
        COMMANDS=1, FAULTS=1, LOSS=1, PRESENCE=1, PROMPT=1),
    Run("code_fails", "property 1 in cycles; code of a node throws",
        COMMANDS=1, FAULTS=1, LOSS=0, PRESENCE=1, CODE_FAILS=1),
    Run("silence", "property 5; one fault, and a stop", COMMANDS=2, FAULTS=1, LOSS=0, SILENCE=1, MASTER_FAULTS=0),
    Run("master_dies", "property 5; master killed or stopped", COMMANDS=1, FAULTS=1, LOSS=0, SILENCE=1),
    Run("short_watchdog", "property 1 with a watchdog that is shorter than the time for late answers",
        COMMANDS=1, FAULTS=0, LOSS=1, PRESENCE=1, BucketLimit=6, WatchdogTime=2),
    Run("waits", "properties 1 and 3; the master waits for node 1",
        COMMANDS=2, FAULTS=0, LOSS=1, WAITS=1, PRESENCE=1, PROMPT=1),
    Run("arming", "properties 1, 3, 4 with arming", COMMANDS=3, FAULTS=0, LOSS=0, ARMING=1),
    Run("thread_fails", "properties 1, 3, 4; the cycle thread may fail to start",
        COMMANDS=3, FAULTS=0, LOSS=0, THREAD_FAILS=1),
    Run("lease", "property 2", quick=True, COMMANDS=2, FAULTS=0, LOSS=0, PROMPT=1, LEASE=1),
    Run("lease_and_stop", "property 2; three commands", COMMANDS=3, FAULTS=0, LOSS=0, PROMPT=1, LEASE=1),
    Run("evictions", "properties 1, 3, 4, 6; nodes are evicted and admitted", quick=True,
        COMMANDS=2, FAULTS=0, LOSS=0, EVICTS=1),
    Run("eviction_and_fault", "the same with a fault", COMMANDS=2, FAULTS=1, LOSS=0, PROMPT=1, EVICTS=1),
    Run("eviction_and_silence", "properties 1 and 5: an evicted node is safe soon",
        COMMANDS=2, FAULTS=0, LOSS=1, PRESENCE=1, SILENCE=1, PROMPT=1, EVICTS=1),
    Run("moves_again", "property 4: after a fault a patient operator moves the plant again", formula="moves_again",
        HELPFUL=1, COMMANDS=0, FAULTS=1, LOSS=0, PROMPT=1),
    Run("stop_stops", "property 4: a Stop that was sent is carried out, or the master has died", formula="stop_stops",
        SINGLE_STOP=1, COMMANDS=2, FAULTS=0, LOSS=0, PROMPT=1),
    # ---- without one switch: each shows a defect ----
    Run("without_MANIFEST", "a plant starts without its critical node", PRESENT, True,
        MANIFEST=0, COMMANDS=1, FAULTS=0, LOSS=0),
    Run("without_FAULT_TRIPS", "code of the critical node has failed, and node 1 moves on", BOUNDED,
        FAULT_TRIPS=0, COMMANDS=1, FAULTS=1, LOSS=0, PRESENCE=1, CODE_FAILS=1),
    Run("without_SAFE_ANSWER_TRIPS", "the critical node is safe by its watchdog, and node 1 moves on", BOUNDED,
        SAFE_ANSWER_TRIPS=0, COMMANDS=1, FAULTS=0, LOSS=1, PRESENCE=1, BucketLimit=6, WatchdogTime=2),
    Run("without_WATCHDOG_FIRST", "a node that was stopped moves by a frame of a phase that is over", WATCHED,
        WATCHDOG_FIRST=0, COMMANDS=2, FAULTS=1, LOSS=0, SILENCE=1, MASTER_FAULTS=0),
    Run("without_LEASE_IN_CYCLE", "a lost lease is found late by a busy thread", NEUTRAL,
        LEASE_IN_CYCLE=0, COMMANDS=2, FAULTS=0, LOSS=0, PROMPT=1, LEASE=1),
    Run("without_RESET_NAMES_FAULT", "a reset ends a safe stop that its sender has not seen", SEEN,
        RESET_NAMES_FAULT=0, COMMANDS=2, FAULTS=1, LOSS=0, PROMPT=1),
    # ---- mutants: each of them has to be found ----
    Run("mutant_start_in_safe_stop", "a start leads out of a safe stop", CYCLES,
        edit=cell("ME_Start", "M_SafeStop", "go(M_Initializing, MA_CollectThenStart)"),
        COMMANDS=3, FAULTS=0, LOSS=0),
    Run("mutant_stop_is_refused", "a stop is refused while cycles run", STOPS,
        edit=cell("ME_Stop", "M_RealTime", "refuse()"), COMMANDS=2, FAULTS=0, LOSS=0),
    Run("mutant_critical_node_leaves", "a critical node that is lost stops nothing", PRESENT,
        edit=cell("ME_CriticalNodeLeft", "M_RealTime", "stay(MA_None)"), COMMANDS=1, FAULTS=1, LOSS=0),
    Run("mutant_start_goes_on", "a start goes on without a node that has left", PRESENT,
        edit=cell("ME_SequenceFailed", "M_Initializing", "stay(MA_None)"), COMMANDS=1, FAULTS=1, LOSS=0),
    Run("mutant_initialization_starts", "an initialization ends in motion", PERSON,
        edit=cell("ME_StatesInitialized", "M_Initializing", "go(M_RealTime, MA_None)"), COMMANDS=1, FAULTS=0, LOSS=0),
    Run("mutant_node_ignores_the_end", "a node ignores that the initialization has failed", RESTS,
        edit=cell("NE_InitializationFailed", "N_Initializing", "ignore()"), COMMANDS=1, FAULTS=0, LOSS=0),
    Run("mutant_node_refuses_values", "a node refuses its initial values: nobody ever moves", "acceptance cycle",
        formula="moves_again", edit=cell("NE_ValuesCame", "N_Initializing", "refuse()"),
        HELPFUL=1, COMMANDS=0, FAULTS=0, LOSS=0, PROMPT=1),
    Run("mutant_manifest_at_start_only",
        "before a start the manifest asks who is registered, before an initialization nothing", PRESENT,
        edit=both(text(":: what == C_Initialize -> event = (mayBegin -> ME_Initialize : ME_InitializeIncomplete)",
                       ":: what == C_Initialize -> event = ME_Initialize"),
                  text("(attached[0] && (master != M_Ready || isComplete))", "attached[0]")),
        COMMANDS=2, FAULTS=0, LOSS=0),
    Run("mutant_manifest_is_empty_in_ready",
        "in Ready a start asks for nobody, and an initialization begins without the critical node", PRESENT,
        edit=text("(attached[0] && (master != M_Ready || isComplete))", "true"),
        COMMANDS=2, FAULTS=0, LOSS=0),
    Run("mutant_evicted_node_registers", "an evicted node registers again", OUT,
        edit=text(":: !isEvicted(n) && !attached[n] -> follows = n", ":: !attached[n] -> follows = n"),
        COMMANDS=1, FAULTS=0, LOSS=0, EVICTS=1),
    Run("mutant_eviction_ends_no_session", "an eviction leaves the session of a node", OUT,
        edit=text("sendToNode(who, Rejected); nodeLost(who)", "sendToNode(who, Rejected)"),
        COMMANDS=1, FAULTS=0, LOSS=0, EVICTS=1),
    Run("mutant_evicted_node_is_not_needed", "a plant starts without a critical node that is evicted", PRESENT,
        edit=both(text("(attached[0] && (master != M_Ready || isComplete))",
                       "(isEvicted(0) || (attached[0] && (master != M_Ready || isComplete)))"),
                  text("#define isComplete (stage[0] >= IsInitialized)",
                       "#define isComplete (isEvicted(0) || stage[0] >= IsInitialized)")),
        COMMANDS=2, FAULTS=0, LOSS=0, EVICTS=1),
    Run("mutant_late_answers_are_forgiven", "late answers of a critical node stop nothing", BOUNDED,
        edit=text(":: isCritical(n) && bucket[n] == BucketLimit -> trip(n + 2)", ":: false -> trip(n + 2)"),
        COMMANDS=1, FAULTS=1, LOSS=0, PRESENCE=1),
    Run("mutant_no_flag_in_frames", "frames never have the flag SafeStop", BOUNDED,
        edit=text("    gap = 0;\n    flag = tripped;\n", "    gap = 0;\n    flag = false;\n"),
        COMMANDS=1, FAULTS=1, LOSS=0, PRESENCE=1),
    Run("mutant_no_watchdog", "the watchdog of a node only reports", WATCHED,
        edit=text("            safe[n] = true; mayNotMove[n] = true; watchdogReport[n] = true\n",
                  "            watchdogReport[n] = true\n"),
        COMMANDS=1, FAULTS=1, LOSS=0, SILENCE=1),
    Run("mutant_node_resumes", "a node in its safe state moves when a frame has no flag", STAYS_SAFE,
        edit=text("        :: frame[n] == Rest && !safe[n] ->",
                  "        :: frame[n] == Motion -> safe[n] = false\n        :: frame[n] == Rest && !safe[n] ->"),
        COMMANDS=1, FAULTS=0, LOSS=1),
    Run("mutant_lost_lease_keeps_its_value", "a lost lease leaves its value", NEUTRAL,
        edit=text("lease = Lost; leaseAge = 0; setting = Neutral", "lease = Lost; leaseAge = 0"),
        COMMANDS=2, FAULTS=0, LOSS=0, PROMPT=1, LEASE=1),
]
# fmt: on


def check_events():
    """Every event of the tables is applied by the model, or is left out with a reason."""
    plant, tables = (HERE / "plant.pml").read_text(), (HERE / "tables.pml").read_text()
    events = re.findall(r"^#define ([MN]E_\w+)", tables, re.M)
    used = set(re.findall(r"\b[MN]E_\w+", plant))
    errors = [
        f"the model never applies {event}: model it in plant.pml, or say in check.py why not"
        for event in events
        if event not in used and event not in LEFT_OUT
    ]
    errors += [f"check.py leaves out {event}, which the model applies" for event in LEFT_OUT if event in used]
    errors += [f"{event} is in no table any more" for event in sorted((used | set(LEFT_OUT)) - set(events))]
    actions = re.findall(r"^#define ([MN]A_\w+)", tables, re.M)
    errors += [f"the model does not carry out {action}" for action in actions if not re.search(rf"\b{action}\b", plant)]
    return errors


def execute(command, folder, seconds=TIME):
    return subprocess.run(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=seconds
    )


def search(run, folder):
    """The output of the search; raises RuntimeError if there was none."""
    plant, tables = (HERE / "plant.pml").read_text(), (HERE / "tables.pml").read_text()
    if run.edit:
        plant, tables = run.edit(plant, tables)
    switches = "".join(f"#define {name} {value}\n" for name, value in run.switches.items())
    (folder / "plant.pml").write_text(switches + plant)
    (folder / "tables.pml").write_text(tables)
    made = execute(["spin", "-a", "plant.pml"], folder)
    if made.returncode or "Error" in made.stdout:
        raise RuntimeError(f"spin: {made.stdout}")
    kind = ["-DNFAIR=3"] if run.formula else ["-DSAFETY", "-DNOCLAIM"]
    # An optimiser needs minutes for the functions that spin makes; -O0 needs seconds, and most
    # searches are short.
    built = execute(["gcc", "-O0", "-w", "-DCOLLAPSE", f"-DMEMLIM={MEMORY}", *kind, "-o", "pan", "pan.c"], folder)
    if built.returncode:
        raise RuntimeError(f"gcc: {built.stdout[:2000]}")
    # -E: states in which nothing can happen are judged by the process Monitor.
    # -c: a mutant may violate other assertions before the one that it has to violate.
    found = execute(
        ["./pan", "-m3000000", "-w22", *(["-c100"] if run.fails else []), *(["-a", "-f"] if run.formula else ["-E"])],
        folder,
    )
    if "max search depth too small" in found.stdout or "out of memory" in found.stdout or "errors:" not in found.stdout:
        raise RuntimeError(f"the search is not complete: {found.stdout[-2000:]}")
    return found.stdout


def judge(run, output):
    """What is wrong with a search; empty: nothing."""
    seen = sorted(set(re.findall(r"^pan:\d+: (.*) \(at depth", output, re.M)))
    if not run.fails:
        return f"violated: {seen[0]}" if seen else ""
    if not seen:
        return "no violation was found: the model cannot fail here"
    # spin writes the assertions with the numbers of the names
    numbers = dict(re.findall(r"^#define (\w+) (\d+)", (HERE / "tables.pml").read_text(), re.M))
    fails = re.sub(r"\b[MN]E_\w+", lambda name: numbers[name[0]], run.fails)
    return (
        ""
        if any(fails in one.replace(" ", "") or fails in one for one in seen)
        else f"violated something else: {'; '.join(seen)}"
    )


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--events", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--keep", type=Path)
    arguments = parser.parse_args()
    errors = check_events()
    missing = [program for program in ("spin", "gcc") if not shutil.which(program)]
    if missing and not errors and not arguments.events:
        print(f"check: {missing[0]} is not installed, so no property was checked; run scripts/setup --tests")
        return 77
    for run in [] if arguments.events or missing else RUNS:
        if arguments.only not in run.name or (arguments.quick and not (run.quick or run.fails)):
            continue
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as temporary:
            folder = arguments.keep / run.name if arguments.keep else Path(temporary)
            folder.mkdir(parents=True, exist_ok=True)
            try:
                output = search(run, folder)
                wrong = judge(run, output)
            except (RuntimeError, subprocess.TimeoutExpired) as error:
                output, wrong = "", str(error)
        states = re.search(r"(\d\S*) states, stored", output)
        memory = re.search(r"([\d.]+)\s+total actual memory", output)
        print(
            f"{'FAILED' if wrong else 'found' if run.fails else 'holds':6} {time.monotonic() - begin:5.0f} s "
            f"{float(states[1]) if states else 0:12,.0f} states {float(memory[1]) if memory else 0:6.0f} MB  "
            f"{run.name}: {run.what}",
            flush=True,
        )
        if wrong:
            errors.append(f"{run.name}: {wrong}")
    print(
        "\n".join(errors) or ("the model has the events of the tables" if arguments.events else "the model is in order")
    )
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
