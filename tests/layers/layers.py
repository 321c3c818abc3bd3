#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks who includes whom, what each room may know, and the length of functions:
docs/design/layers.md says why.

usage: layers.py SOURCE_FOLDER
"""
import functools
import os
import re
import sys
from pathlib import Path

BELOW_NODE = {"signals", "realtime", "transport", "protocol", "protocol/messages"}
# Room: the rooms whose headers it may include. The public headers of all rooms of the node belong
# to "node".
ARROWS = {
    "signals": {"signals"},
    "realtime": {"realtime"},
    # Transports say what they need of each other with fields of their own.
    "transport": {"realtime", "transport", "protocol/messages"},
    "protocol": {"signals", "protocol"},
    "protocol/messages": {"signals", "protocol", "protocol/messages"},
    "node": BELOW_NODE | {"node"},
    "node/state": {"protocol/messages", "node", "node/state"},
    "node/security": BELOW_NODE | {"node", "node/security"},
    "node/cycle": BELOW_NODE | {"node", "node/cycle"},
    "node/statistics": BELOW_NODE | {"node", "node/cycle", "node/statistics"},
    "node/session": BELOW_NODE
    | {"node", "node/state", "node/security", "node/cycle", "node/statistics", "node/session"},
    "node/api": BELOW_NODE
    | {"node", "node/state", "node/security", "node/cycle", "node/statistics", "node/session", "node/api"},
    "hardware": {"signals", "realtime", "node", "node/session", "hardware"},
    "models": {"signals", "realtime", "node", "models"},
    # What people write about signals.
    "formulas": {"formulas"},
    "recording": BELOW_NODE | {"node", "node/cycle", "formulas", "recording"},
    # A replay is a master of its own.
    "replay": BELOW_NODE
    | {
        "node",
        "node/state",
        "node/security",
        "node/cycle",
        "node/statistics",
        "node/session",
        "node/api",
        "recording",
        "replay",
    },
    "gui": {"signals", "node", "gui"},
    "gui/store": {"signals", "gui/store"},
    "gui/plant": {
        "signals",
        "formulas",
        "protocol",
        "protocol/messages",
        "node",
        "node/state",
        "node/cycle",
        "node/session",
        "recording",
        "gui",
        "gui/store",
        "gui/plant",
    },
    "gui/plot": {"signals", "node", "formulas", "gui", "gui/store", "gui/plant", "gui/plot"},
    "gui/models": {"signals", "node", "formulas", "node/state", "gui", "gui/plant", "gui/models"},
    "gui/panel": {"signals", "node", "formulas", "gui", "gui/plant", "gui/plot", "gui/models", "gui/panel"},
    # Panels do not know each other.
    "gui/charts": {"signals", "node", "gui", "gui/plot", "gui/models", "gui/panel", "gui/charts"},
    "gui/gauges": {"signals", "node", "formulas", "gui", "gui/plot", "gui/models", "gui/panel", "gui/gauges"},
    "gui/setters": {"signals", "node", "formulas", "gui", "gui/models", "gui/panel", "gui/setters"},
    "gui/tables": {"signals", "node", "formulas", "gui", "gui/models", "gui/panel", "gui/tables"},
    "gui/layout": {"signals", "node", "gui", "gui/panel", "gui/layout"},
    # It makes panels by their names (QPlcWidgetFactory).
    "gui/window": {
        "signals",
        "node",
        "node/state",
        "node/session",
        "recording",
        "gui",
        "gui/plant",
        "gui/models",
        "gui/panel",
        "gui/layout",
        "gui/window",
    },
    "gui3d": {"signals", "node", "gui", "gui/panel", "gui3d"},
    # Users compile it: public headers alone.
    "export": {"signals", "node", "export"},
    "test_support": BELOW_NODE | {"node", "replay", "test_support"},
    "tools": BELOW_NODE
    | {
        "node",
        "node/state",
        "node/security",
        "node/cycle",
        "node/statistics",
        "node/session",
        "recording",
        "replay",
        "tools",
    },
}
# Room with a library of its own: folder of its list of headers, and its umbrella header. All others
# belong to QtPlc::Core.
LIBRARIES = {
    "hardware": ("src/hardware", "QtPlcHardware"),
    "models": ("src/models", "QtPlcModels"),
    "recording": ("src/recording", "QtPlcRecording"),
    "gui": ("src/gui", "QtPlcGui"),
    "gui3d": ("src/gui3d", "QtPlcGui3D"),
    "test_support": ("src/test_support", "QtPlcTest"),
    "test": ("src/test_support", "QtPlcTest"),
}
# Public headers without a source file of their own; "all": a plain value that every room may use.
HEADER_ONLY = {
    "QPlcBoundInput": "node",
    "QPlcBoundOutput": "node",
    "QPlcClock": "all",
    "QPlcCycle": "all",
    "QPlcCycleStatistics": "all",
    "QPlcDistribution": "all",
    "QPlcDurationStatistics": "all",
    "QPlcGlobal": "all",
    "QPlcGuiGlobal": "gui",
    "QPlcGui3DGlobal": "gui3d",
    "QPlcDeviceEvent": "hardware",
    "QPlcHardwareGlobal": "hardware",
    "QPlcModelsGlobal": "models",
    "QPlcRecordingGlobal": "recording",
    "QPlcReadChannel": "hardware",
    "QPlcWriteChannel": "hardware",
    "QPlcInput": "node",
    "QPlcInputTiming": "all",
    "QPlcLease": "node",
    "QPlcMasterStatistics": "all",
    "QPlcNodeInfo": "all",
    "QPlcNodeStatistics": "all",
    "QPlcOutput": "node",
    "QPlcRealTimeSetting": "realtime",
    "QPlcSignalDefinition": "signals",
    "QPlcSimulatedRoad": "test_support",
    "QPlcSlaveStatistics": "node",
    "QPlcStatisticFigure": "node",
    "QPlcWidgetFactoryOf": "gui",
    "QPlcWorstCycle": "all",
    "QSplitPrimitive": "signals",
}
INCLUDE = r'^\s*#\s*include\s+"([^"]+)"'
PRIVATE_INCLUDE = r'^\s*#\s*include\s+"((?:gui|gui3d|node|signals|protocol)/[^"]+)"'
SOCKETS = r"<QtNetwork/|<sys/socket\.h>|<netinet/|<arpa/inet\.h>|Q(Tcp|Udp|Abstract)Socket\b"
EVENT_LOOP = r"\bQ(Object|Thread|Timer|EventLoop|SocketNotifier)\b|\bQ_OBJECT\b"
QT = r"[<\"]Q\w+|\bQ[A-Z]\w+|\bq[A-Z]\w+\s*\(|\bQ_\w+"
# Room: what its code may not mention, and how to say that.
FORBIDDEN = {
    "src/signals": [(SOCKETS, "a socket"), (EVENT_LOOP, "the event loop of Qt")],
    "src/realtime": [(SOCKETS, "a socket"), (EVENT_LOOP, "the event loop of Qt")],
    "src/protocol": [(SOCKETS, "a socket"), (EVENT_LOOP, "the event loop of Qt")],
    "src/node/cycle": [(EVENT_LOOP, "the event loop of Qt")],
    "examples/airborne_wind_energy/plant": [(QT, "Qt")],
    "examples/airborne_wind_energy/flight_control": [(QT, "Qt")],
}
# Lines of a function, from its name to its last brace: at most, and for 99 of 100.
MOST_LINES, USUAL_LINES = 80, 40
# Fields of control messages have their names in src/protocol/messages alone. Elsewhere nobody reads
# a QPlcMessage by names, or makes one with fields: messages come and go as structs.
NAME = r"(?:QStringLiteral|QLatin1String)\("
BY_NAME = re.compile(
    rf"(?<!settings)(?<!reader)\.(?:hex64|text|bytes)\({NAME}"
    r"|(?:[mM]essage|answer|hello|reply|request|question|rejected)\.fields\(\)"
    rf"|\.fields\(\)(?:\.(?:value|contains|find|take|keys)\(|\[{NAME})"
    r"|\b(?:QPlc)?Message(?:\s+\w+)?\s*[({]\s*(?:QPlc)?Message::\w+\s*,"
    r"|\{\{QStringLiteral\(\"(?:error|text|name)\"\)"
)
# JSON that is no message: settings and layouts of windows, configurations of devices, channels of
# recordings, what transports add to a registration. The tool writes documents for --json, and reads
# none. All other rooms know no JSON.
HAS_JSON = {
    "transport",
    "hardware",
    "recording",
    "test_support",
    "gui3d",
    "gui",
    "gui/charts",
    "gui/gauges",
    "gui/layout",
    "gui/panel",
    "gui/plot",
    "gui/setters",
    "gui/tables",
    "gui/window",
    "gui/models",
}
JSON = re.compile(r"\bQJson\w+")
READS_JSON = re.compile(r"\.to(?:Object|Array)\(\)|QJsonDocument::fromJson\(")
# Panels know the window by QPlcPanelContext alone.
WINDOW = re.compile(r'[wW]indowContext\b|"gui/(?:window|layout)/')
PANEL_ROOMS = ("charts", "gauges", "setters", "tables")
# Clocks, random numbers, sleeps, threads and sockets come from the Host
# (docs/design/simulation.md), so that a simulator can give others. QTimer and QSocketNotifier
# belong to the event dispatcher, which a simulator has, too. A word counts wherever it stands in
# the code. Functions whose name others have, too, count with :: or std:: before them, or with the
# arguments of the kernel's.
GLOBAL = r"(?:(?<![\w>])::|\bstd::)"
ARGUMENT = r"(?:[^(),;]|\((?:[^()]|\([^()]*\))*\))*"


def with_arguments(name, count):
    return rf"(?<![\w:.>]){name}\s*\({','.join([ARGUMENT] * count)}\)"


KERNEL = {
    "a clock": r"\b(?:steady_clock|system_clock|high_resolution_clock|file_clock|clock_get(?:time|res)|gettimeofday|"
    r"timespec_get|ftime|QElapsedTimer|QDeadlineTimer|current(?:DateTime\w*|MSecs\w*|Secs\w*|Time|Date)(?=\s*\())\b"
    rf"|{GLOBAL}(?:time|clock|times)\s*\(|(?<![\w:.>])time\s*\(\s*(?:nullptr|NULL|0|&\s*\w+)\s*\)",
    "a timer": r"\b(?:timerfd_\w+|timer_(?:create|settime)|[gs]etitimer|ualarm)\b" rf"|{GLOBAL}alarm\s*\(",
    "a sleep": r"\b(?:[un]sleep|nanosleep|clock_nanosleep|sleep_for|sleep_until|msleep|qSleep|sigtimedwait|"
    r"FUTEX_WAIT\w*)\b"
    rf"|(?<![\w:.>])(?<!void )sleep\s*\(|\bQThread::sleep\b|{GLOBAL}(?:sleep|p?poll|p?select|pause)\s*\("
    r"|\b(?:ppoll|pselect|epoll_\w+|io_uring_\w+)\s*\("
    rf"|{with_arguments('poll', 3)}|{with_arguments('select', 5)}",
    "a wake-up": r"\b(?:eventfd|signalfd)\s*\([^)]",
    "a random number": r"\b(?:s?rand|rand_r|[dlm]rand48|getrandom|getentropy|arc4random\w*|randombytes_\w+|"
    r"RAND_\w*bytes|QRandomGenerator(?:64)?|qs?rand|createUuid(?!V)\w*|mt19937(?:_64)?|minstd_rand0?|"
    rf"default_random_engine|random_device)\b|{GLOBAL}s?random\s*\(",
    "a thread": r"\b(?:pthread_\w+|thrd_\w+|QThread|QThreadPool|QtConcurrent|QRunnable|QWaitCondition|"
    r"QSemaphore|QFuture\w*|condition_variable(?:_any)?|std::(?:jthread|thread|async|packaged_task|promise))\b",
    "a process": r"\b(?:v?fork|posix_spawnp?|exec[lv]p?e?|popen|QProcess|clone3?(?=\s*\([^)]))\b"
    rf"|{GLOBAL}system\s*\(",
    # Whoever gets a socket may use it: a pointer to one is none.
    "a socket": r"\b(?:Q(?:Udp|Local|Sctp|Web)Socket|Q(?:Tcp|Local|Sctp|WebSocket)Server|QNetworkAccessManager|"
    r"QDnsLookup|QHostInfo|socketpair|accept4|getaddrinfo|gethostbyname\w*)\b"
    r"|(?<!class )\bQ(?:Tcp|Ssl|Abstract)Socket\b(?!\s*(?:[*&]|::))"
    rf"|{GLOBAL}(?:socket|accept)\s*\(|{with_arguments('socket', 3)}",
}
# The simulator is what gives others.
HOSTED = {room.split("/")[0] for room in ARROWS} - {"test_support"}
# A window shows the time of the person before it, and measures its own drawing.
OF_ROOM = {"gui": {"a clock"}, "gui3d": {"a clock"}}
# Why, what, and by which files the machine itself is asked. A list that only shrinks: one day the
# beacon and the names of a machine belong to a Host, too.
OF_MACHINE = (
    ("is the machine as a Host", "a clock, a sleep, a wake-up, a random number", "realtime/Machine.cpp"),
    ("runs cycles where a host has no strand", "a thread", "realtime/CycleThread.cpp realtime/CycleThread.h"),
    ("ends the waits of a thread", "a thread", "realtime/InterruptibleWaits.cpp realtime/InterruptibleWaits.h"),
    ("ends the waits of a thread", "a timer", "realtime/InterruptibleWaits.cpp"),
    ("wakes a wait of the kernel, where a host has kernel timers", "a timer", "realtime/AlarmTime.cpp"),
    ("does long work beside an event loop where a host has threads", "a thread", "realtime/Worker.cpp"),
    ("writes the log of the machine behind the cycles", "a sleep, a thread", "realtime/LogWriter.cpp"),
    (
        "writes recordings beside the cycles, to disks that may stall",
        "a thread",
        "recording/RecorderThread.cpp recording/RecorderThread.h",
    ),
    (
        "sets up or measures the machine",
        "a thread",
        "realtime/RealTimeSetup.cpp realtime/StackPrefault.cpp realtime/WakeUpProbe.cpp transport/LoopbackProbe.cpp",
    ),
    ("runs the program that makes a video", "a process", "gui/window/VideoSink.cpp"),
    ("runs the program of a node that is replayed", "a process", "replay/NodeProgram.cpp replay/NodeProgram.h"),
    ("measures the machine", "a socket", "transport/LoopbackProbe.cpp"),
    ("runs loads and cyclictest beside a measurement", "a process", "tools/CampaignPrograms.cpp"),
    (
        "is the network of the machine, to which hosts have others",
        "a socket",
        "transport/ControlNetwork.cpp transport/OpenSslTls.cpp",
    ),
    (
        "is a transport of the kernel; hosts have those of their own",
        "a socket",
        "transport/LocalListener.cpp transport/LocalSocket.cpp transport/UdpLink.cpp transport/UdpMulticastKind.cpp "
        "transport/UdpTransport.cpp",
    ),
    (
        "waits for frames of the kernel or of other processes",
        "a sleep",
        "transport/CyclicHub.cpp transport/SharedChannel.cpp",
    ),
    ("resolves the name of a machine", "a socket", "transport/TransportKind.cpp gui/plant/AddressResolver.cpp"),
    (
        "finds masters by their beacons",
        "a socket",
        "node/session/MasterBeacon.cpp node/session/MasterFinder.cpp node/session/MasterFinder.h",
    ),
    ("talks to the service manager of the machine", "a socket", "transport/NotifySocket.cpp"),
    (
        "runs a master in a program without an event loop",
        "a thread",
        "node/api/OwnApplication.cpp node/api/QPlcEmbeddedMaster.cpp",
    ),
    ("keeps signals away from threads", "a thread", "realtime/BlockedSignals.h"),
    ("knows whether a host calls it on the thread of the master", "a thread", "node/api/QPlcMasterNodePrivate.cpp"),
    ("carries signals of the kernel, such as Ctrl-C", "a socket", "node/api/QPlcApplicationOptions.cpp"),
    ("receives the values of a plant beside the drawing", "a thread", "gui/plant/Listener.cpp gui/plant/Listener.h"),
    ("computes spectra beside the drawing", "a thread", "gui/plot/SpectrumJob.cpp"),
    ("reads recordings beside the drawing", "a thread", "gui/plant/PlantPast.cpp"),
    ("gives each connection a timeout that tells it from others", "a random number", "gui/plant/PlantLeases.cpp"),
    ("waits for the graphics card", "a sleep, a thread", "gui3d/SceneRenderer.cpp"),
    (
        "devices are read and written beside the cycle",
        "a thread",
        "hardware/DriverRunner.cpp hardware/DriverRunner.h hardware/can/QtCanBus.cpp hardware/can/QtCanBus.h "
        "hardware/can/CanLogWriter.cpp hardware/can/CanLogWriter.h",
    ),
    (
        "wakes the thread of a device, and tries again after a random pause",
        "a sleep, a wake-up, a random number",
        "hardware/DriverRunner.cpp",
    ),
    ("wakes the thread of a device", "a wake-up", "hardware/can/QtCanBus.cpp"),
    ("waits for answers of a device, before the cycles", "a sleep", "hardware/canopen/CanOpenClient.cpp"),
    ("waits for udev, which gives new files to us", "a sleep", "hardware/sysfs/SysfsPwm.cpp"),
    ("waits for the threads of devices", "a sleep", "hardware/QPlcHardwareNode.cpp"),
    ("lets a line become quiet after a damaged answer", "a sleep", "hardware/modbus/LibModbusLink.cpp"),
    ("ends a program whose device hangs", "a timer", "hardware/program/main.cpp"),
    (
        "is a bus of the kernel",
        "a socket",
        "hardware/can/SocketCanBus.cpp hardware/can/CanLink.cpp hardware/can/FakeCanBus.cpp",
    ),
    ("waits for the master of a program that knows no Host", "a sleep", "export/HeldPlantNode.cpp"),
    ("ends a process whose foreign code does not return", "a timer", "models/program/CrashReport.cpp"),
    ("prints at a rate that a person wants", "a clock", "tools/EchoCommand.cpp"),
    ("makes keys, which nobody can guess", "a random number", "tools/KeysCommand.cpp"),
)
EXCUSED = {(file, what) for _, kinds, names in OF_MACHINE for file in names.split() for what in kinds.split(", ")}
# Classes that may only wire others, and how many functions they may have.
MOST_FUNCTIONS = {"node/api/QPlcMasterNodePrivate.h": 25}
FUNCTION = r"^ {4}[^\s/=(][^/=(\n]*\("
# A table of data may be longer: rows of a test, or one constant that is returned.
TABLE = r"_data\(\)$|^\s*static const\b"
SOURCES = ("include", "src", "examples", "tests", "benchmarks", "docs")


def files(folder):
    return sorted(
        p for p in folder.rglob("*") if p.is_file() and (p.suffix in (".h", ".cpp") or p.parent.name == "QtPlc")
    )


# A comment, or what may contain the signs of one: a raw text, a text, a character (an apostrophe in
# a number is none).
COMMENT_OR_TEXT = re.compile(
    r'''//[^\n]*|/\*.*?\*/|\b(?:u8|[uUL])?R"([^()\\\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'''
    r"""|(?:(?<!\w)|(?<=\b[uUL])|(?<=\bu8))'(?:\\.|[^'\\\n])+'""",
    re.S,
)


# A test looks at the same texts again and again.
@functools.lru_cache(maxsize=None)
def code_of(text, has_texts=True):
    """The lines of a file without comments, numbered from 1.

    \param has_texts  false: texts are empty, and includes are left out
    """

    def kept(match):
        is_comment = match[0].startswith(("//", "/*"))
        return (
            "\n" * match[0].count("\n") if is_comment else match[0] if has_texts else '""' + "\n" * match[0].count("\n")
        )

    text = COMMENT_OR_TEXT.sub(kept, text)
    if not has_texts:
        text = re.sub(r"^[ \t]*#[ \t]*include\b.*", "", text, flags=re.M)
    return list(enumerate(text.split("\n"), 1))


@functools.lru_cache(maxsize=None)
def functions_of(text):
    """The functions of a file: line of the name, number of lines, whether it is a table. The format
    of the code is relied on."""
    found = []
    lines = text.split("\n")
    for brace, line in enumerate(lines):
        if line.strip() != "{":
            continue
        margin, first = line[:-1], brace - 1
        while first > 0 and lines[first].startswith(margin) and re.match(r"[ :,]", lines[first][len(margin) :]):
            first -= 1
        head = " ".join(part.strip() for part in lines[first:brace])
        if "(" not in head or re.match(
            r"(template<.*> )?(class|struct|union|enum|namespace|extern|if|for|while|switch|do|//)\b", head
        ):
            continue
        last = next((at for at in range(brace, len(lines)) if lines[at].startswith(margin + "}")), len(lines))
        found.append((first + 1, last - first + 1, bool(re.search(TABLE, head) or re.search(TABLE, lines[brace + 1]))))
    return found


@functools.lru_cache(maxsize=None)
def lines_with(text, pattern):
    """Number and text of each line of the code that the pattern fits."""
    pattern = re.compile(pattern)
    return [(number, line) for number, line in code_of(text) if pattern.search(line)]


@functools.lru_cache(maxsize=None)
def first_with(text, pattern, has_texts=True):
    """Number and text of the line where the first piece of code begins that the pattern fits; it
    may go over lines."""
    lines = [line for _, line in code_of(text, has_texts)]
    found = re.search(pattern, "\n".join(lines))
    if not found:
        return None
    number = found.string.count("\n", 0, found.start())
    return number + 1, lines[number].strip()


def asked_of_machine(text):
    """What the code asks of the machine: number and text of the first line where it does."""
    found = {what: first_with(text, pattern, False) for what, pattern in KERNEL.items()}
    return {what: line for what, line in found.items() if line}


class Check:
    def __init__(self, root):
        self.root, self.errors = root.resolve(), []
        self.source, self.public = self.root / "src", self.root / "include/QtPlc"
        # Each check looks at the same files.
        self.files, self.text, self.room = map(functools.lru_cache(maxsize=None), (files, Path.read_text, self.room))
        self.homes = {p.stem: p.relative_to(self.source).parts[0] for p in self.source.rglob("*.cpp")}

    def error(self, path, line, text):
        self.errors.append(f"{path.relative_to(self.root)}:{line}: {text}")

    def room(self, path):
        if path.parent != self.public:
            return self.room_of_source(path) if self.source in path.parents else None
        return self.homes.get(path.stem) or HEADER_ONLY.get(path.stem)

    def room_of_source(self, path):
        """The folder, with its room where the folder has rooms with arrows of their own."""
        folder, *rest = path.relative_to(self.source).parts
        room = f"{folder}/{rest[0]}"
        return room if room in ARROWS else folder

    def arrows(self):
        known = {str(path): path for path in self.files(self.source) + self.files(self.public)}
        for path in self.files(self.source) + [p for p in self.files(self.public) if p.suffix == ".h"]:
            room = self.room(path)
            if room not in ARROWS and room != "all":
                self.error(path, 1, f"belongs to no room (found: {room}): name it in tests/layers/layers.py")
                continue
            for number, line in lines_with(self.text(path), INCLUDE):
                match = re.match(INCLUDE, line)
                names = (f"{folder}/{match[1]}" for folder in (path.parent, self.source, self.public))
                target = next(filter(None, map(known.get, map(os.path.normpath, names))), None)
                if target is None:
                    continue
                other = self.room(target)
                if other is None and target.suffix == "":
                    if room != "tools":
                        self.error(path, number, f"includes the umbrella {match[1]}: include what is used")
                elif other != "all" and other not in ARROWS.get(room, set()):
                    self.error(path, number, f"{room} may not include {match[1]}, which belongs to {other}")

    def words(self):
        for folder, rules in FORBIDDEN.items():
            of_room = [p for p in self.files(self.public) if folder == f"src/{self.room(p)}"]
            for path in self.files(self.root / folder) + of_room:
                for pattern, what in rules:
                    for number, line in lines_with(self.text(path), pattern):
                        self.error(path, number, f"{folder} may not know {what}: {line.strip()}")

    def fields(self):
        for path in self.files(self.source):
            room = self.room(path)
            if str(room).startswith("protocol"):
                continue
            text = self.text(path)
            foreign = READS_JSON if room == "tools" else None if room in HAS_JSON else JSON
            found = first_with(text, BY_NAME) or (foreign and first_with(text, foreign))
            if found:
                number, line = found
                self.error(path, number, f"fields have their names in src/protocol/messages: {line}")

    def panels(self):
        folders = [self.source / "gui" / room for room in PANEL_ROOMS] + [self.source / "gui3d"]
        for path in [path for folder in folders for path in self.files(folder)]:
            for number, line in lines_with(self.text(path), WINDOW):
                self.error(path, number, f"a panel knows the window by QPlcPanelContext alone: {line.strip()}")
        for path in self.files(self.root / "examples"):
            for number, line in lines_with(self.text(path), PRIVATE_INCLUDE):
                header = re.match(PRIVATE_INCLUDE, line)[1]
                self.error(path, number, f"an example knows the public headers alone, not {header}")

    def kernel(self):
        """What a file asks of the machine, and may not, or no longer does."""
        for path in self.files(self.source) + [p for p in self.files(self.public) if p.suffix == ".h"]:
            room = str(self.room(path)).split("/")[0]
            if room not in HOSTED and room != "all":
                continue
            name = str(path.relative_to(self.source if self.source in path.parents else self.public))
            asked = asked_of_machine(self.text(path))
            for what, (number, line) in asked.items():
                if (name, what) not in EXCUSED and what not in OF_ROOM.get(room, ()):
                    self.error(path, number, f"asks the machine for {what}, ask Host::current() for it: {line}")
            for what in KERNEL:
                if (name, what) in EXCUSED and what not in asked:
                    self.error(path, 1, f"asks the machine for {what} no more: take it out of OF_MACHINE")

    def wiring(self):
        for name, most in MOST_FUNCTIONS.items():
            path = self.source / name
            count = len(re.findall(FUNCTION, self.text(path), flags=re.M))
            if count > most:
                self.error(path, 1, f"has {count} functions, more than {most}: it only wires others")

    def public_headers(self):
        for path in sorted(self.public.rglob("*")):
            if path.parent != self.public:
                self.error(path, 1, "public headers stand side by side in include/QtPlc")
            elif path.suffix == ".h" and not path.stem.endswith("Global"):
                # Definitions at the left margin outside of namespaces for internals.
                text = re.sub(r"^namespace \w+ \{\n.*?^\} +// namespace", "", self.text(path), flags=re.S | re.M)
                classes = re.findall(
                    r"^(?:class|struct|union)\s+(?:QTPLC_\w*EXPORT\s+)?(\w+)[^;\n]*$", text, flags=re.M
                )
                if classes != [path.stem]:
                    self.error(
                        path, 1, f"defines {', '.join(classes) or 'no class'}: one class a header, named like the file"
                    )
                elif not re.search(r"^///.*\n(?:template<[^\n]*>\n)?(?:class|struct|union)\b", text, flags=re.M):
                    self.error(path, 1, f"{path.stem} has no comment that says what it is for")
        for path in self.public.iterdir():
            folder, umbrella = LIBRARIES.get(
                self.room(path) or path.name.lower().removeprefix("qtplc"), ("src", "QtPlcCore")
            )
            if path.name not in re.findall(r"include/QtPlc/(\S+)", (self.root / folder / "CMakeLists.txt").read_text()):
                self.error(path, 1, f"is missing in the list of headers of {folder}/CMakeLists.txt")
            if path.suffix == ".h" and path.name not in re.findall(
                r'#include "(\w+\.h)"', (self.public / umbrella).read_text()
            ):
                self.error(path, 1, f"is missing in the umbrella header {umbrella}")

    def lengths_and_licences(self):
        lengths = []
        for folder in SOURCES:
            for path in self.files(self.root / folder):
                if "SPDX-License-Identifier: Apache-2.0" not in self.text(path).split("\n")[0]:
                    self.error(path, 1, "does not begin with // SPDX-License-Identifier: Apache-2.0")
                for line, length, is_table in functions_of(self.text(path)):
                    if length > MOST_LINES and not is_table:
                        self.error(path, line, f"a function of {length} lines, more than {MOST_LINES}: split it")
                    if folder in ("include", "src"):
                        lengths.append((length, path, line))
        lengths.sort(key=lambda entry: -entry[0])
        usual, path, line = lengths[len(lengths) // 100]
        if usual > USUAL_LINES:
            self.error(
                path,
                line,
                f"one function of a hundred has {usual} lines or more, more than {USUAL_LINES}: split the longest",
            )


def errors_of(root):
    check = Check(root)
    check.arrows()
    check.words()
    check.fields()
    check.panels()
    check.kernel()
    check.wiring()
    check.public_headers()
    check.lengths_and_licences()
    return check.errors


def main():
    errors = errors_of(Path(sys.argv[1]))
    print("\n".join(errors) or "the layers are in order")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
