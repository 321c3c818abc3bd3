#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Defects that are planted into copies of sources, to see whether simulated faults find them.

usage: planted.py make NAME SOURCE_FOLDER FILE    writes the source with the defect to FILE
       planted.py check SOURCE_FOLDER             exit code 1: a defect does not fit its source
"""
import sys
from collections import namedtuple
from pathlib import Path

# What it is, source file, and pairs of what stands there (exactly once) and what stands there with
# the defect.
Defect = namedtuple("Defect", "what file changes")

DEFECTS = {
    "old_frames": Defect(
        "a frame that was overtaken by a newer one counts as new",
        "src/protocol/CyclicFrame.cpp",
        [
            (
                "    if (ahead < 0)\n"
                "        return m_anyComplete && header.cycle == m_cycle"
                " ? FrameStatus::Duplicate : FrameStatus::Old;\n",
                "",
            ),
            ("if (ahead > 0 || !m_any)", "if (ahead != 0 || !m_any)"),
        ],
    ),
    "former_session": Defect(
        "frames of a master that was killed are good for the next one",
        "src/protocol/CyclicFrame.cpp",
        [
            ("    storeLittle(seed.session, bytes);\n", "    storeLittle(std::uint64_t(0), bytes);\n"),
            (
                "    if (loadLittle<std::uint16_t>(bytes + SessionAt) != m_session)\n"
                "        return FrameStatus::WrongSession;\n",
                "",
            ),
        ],
    ),
    "safe_node_moves": Defect(
        "a node in its safe state moves again as soon as its master asks it",
        "src/node/cycle/NodeRuntime.cpp",
        [
            (
                "    if (m_hasFailed || (m_isSafe && !m_traits.listener))\n        return !m_hasFailed;\n",
                "    m_isSafe = m_isSafe && m_hasFailed;\n    if (m_hasFailed)\n        return false;\n",
            )
        ],
    ),
    "safe_stop_ends": Defect(
        "a safe stop ends by itself when the node that caused it answers in time again",
        "src/node/cycle/SafetyGuard.cpp",
        [
            (
                "        slot.bucket.store(level - 1, std::memory_order_relaxed);\n",
                "        slot.bucket.store(level - 1, std::memory_order_relaxed);\n"
                "    if (level == 1)\n        m_tripped = false;\n",
            )
        ],
    ),
    "dead_holder": Defect(
        "a connection that breaks, and is not closed, keeps its name, signals and leases",
        "src/node/session/MasterServer.cpp",
        [
            (
                "    const QString error = socket->errorString();\n    drop(",
                "    const QString error = socket->errorString();\n"
                "    if (!error.isEmpty())\n        return;\n    drop(",
            )
        ],
    ),
    "evicted_returns": Defect(
        "an evicted node loses its connection, and may come back at once",
        "src/node/session/MasterRegistration.cpp",
        [
            ("    if (!evicted.error.isEmpty()) {\n", "    if (evicted.error == messages::errorWord::denied) {\n"),
            (
                "        if (refusal.error.isEmpty())\n"
                "            refusal = m_evictions.refusalOf(declaration.name, connection->peer);\n",
                "",
            ),
        ],
    ),
    "required_forgotten": Defect(
        "a plant starts without a required node of its manifest",
        "src/node/session/NeededNodes.cpp",
        [("        if (node.need != QPlcManifest::Optional)\n", "        if (node.need == QPlcManifest::Critical)\n")],
    ),
    "parameters_unchecked": Defect(
        "a node takes part with other safety parameters than those of its master",
        "src/node/cycle/NodeRegistry.cpp",
        [("if (signal.safety && *signal.safety != ", "if (signal.safety && !*signal.safety && *signal.safety != ")],
    ),
    "devices_run_on": Defect(
        "a node with devices does not notice that the program hangs that turns the clock",
        "src/node/cycle/SlaveCycle.cpp",
        [
            (
                "    if (m_phase.clock.isExternal() && m_runtime.traits().hardware)\n"
                "        return m_phase.watchdog.count();\n",
                "",
            )
        ],
    ),
    "silent_stays": Defect(
        "a node that answers nothing ends each start, and is never dropped",
        "src/node/session/SequenceStep.cpp",
        [("        node->drop(text);\n", "        (void)node;\n")],
    ),
}


def planted(root, defect):
    text = (root / defect.file).read_text()
    for old, new in defect.changes:
        if text.count(old) != 1:
            raise SystemExit(
                f"planted: {defect.file} has {text.count(old)} times, and not once:\n{old}"
                "Remedy: change tests/planted/planted.py like the source"
            )
        text = text.replace(old, new)
    return text


def main(arguments):
    if arguments[0] == "make":
        name, root, target = arguments[1], Path(arguments[2]), Path(arguments[3])
        target.write_text(planted(root, DEFECTS[name]))
    else:
        for defect in DEFECTS.values():
            planted(Path(arguments[1]), defect)


if __name__ == "__main__":
    main(sys.argv[1:])
