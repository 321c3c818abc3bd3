#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants one fault after the other into a copy of the tree; layers.py has to name each of them.

usage: tst_layers.py SOURCE_FOLDER
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import layers

SOURCE = Path(sys.argv.pop(1)).resolve()

# What it is, and a line that asks the machine for it.
ASKS_THE_MACHINE = (
    ("a clock", "timespec time; clock_gettime(CLOCK_MONOTONIC, &time);"),
    ("a clock", "gettimeofday(&time, nullptr);"),
    ("a clock", "const time_t now = time(nullptr);"),
    ("a clock", "const auto now = ::time(&seconds);"),
    ("a clock", "const auto now = std::time(nullptr);"),
    ("a clock", "if (time(NULL) > end)"),
    ("a clock", "const auto used = std::clock();"),
    ("a clock", "const auto now = std::chrono::steady_clock::now();"),
    ("a clock", "const auto now = std::chrono::high_resolution_clock::now();"),
    ("a clock", "const QTime now = QTime::currentTime();"),
    ("a clock", "const QDate day = QDate::currentDate();"),
    ("a clock", "const QDateTime now = QDateTime::currentDateTimeUtc();"),
    ("a clock", "const qint64 now = QDateTime::currentMSecsSinceEpoch();"),
    ("a clock", "QElapsedTimer since;"),
    ("a clock", "QDeadlineTimer end(10);"),
    ("a timer", "const int timer = timerfd_create(CLOCK_MONOTONIC, 0);"),
    ("a timer", "setitimer(ITIMER_REAL, &time, nullptr);"),
    ("a sleep", "usleep(10);"),
    ("a sleep", "nanosleep(&time, nullptr);"),
    ("a sleep", "sleep(1);"),
    ("a sleep", "::sleep(1);"),
    ("a sleep", "std::this_thread::sleep_for(pause);"),
    ("a sleep", "QThread::msleep(1);"),
    ("a sleep", "poll(&descriptor, 1, 10);"),
    ("a sleep", "if (poll(list.data(), nfds_t(list.size()), limit(now)) < 0)"),
    ("a sleep", "::poll(&descriptor, 1, 10);"),
    ("a sleep", "select(count, &in, nullptr, nullptr, &time);"),
    ("a sleep", "epoll_wait(descriptor, events, 1, -1);"),
    ("a wake-up", "const int descriptor = eventfd(0, EFD_CLOEXEC);"),
    ("a socket", "const int descriptor = ::socket(AF_INET, SOCK_DGRAM, 0);"),
    ("a socket", "const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);"),
    ("a socket", "::socketpair(AF_UNIX, SOCK_STREAM, 0, ends);"),
    ("a socket", "QTcpSocket socket;"),
    ("a socket", "auto *socket = new QTcpSocket(this);"),
    ("a socket", "auto socket = std::make_unique<QTcpSocket>();"),
    ("a socket", "auto *socket = new QSslSocket;"),
    ("a socket", "QUdpSocket socket;"),
    ("a socket", "QLocalSocket *socket;"),
    ("a socket", "QTcpServer server;"),
    ("a random number", "const int any = rand();"),
    ("a random number", "const int any = std::rand();"),
    ("a random number", "const long any = ::random();"),
    ("a random number", "getrandom(bytes, sizeof bytes, 0);"),
    ("a random number", "randombytes_buf(bytes, sizeof bytes);"),
    ("a random number", "std::mt19937 engine;"),
    ("a random number", "const auto any = QRandomGenerator::global()->generate();"),
    ("a random number", "const QUuid name = QUuid::createUuid();"),
    ("a thread", "const auto later = std::async(compute);"),
    ("a thread", "pthread_create(&thread, nullptr, run, this);"),
    ("a thread", "QWaitCondition changed;"),
    ("a thread", "QtConcurrent::run(compute);"),
    ("a thread", "QThreadPool::globalInstance()->start(task);"),
    ("a thread", 'log("tcp://"); std::thread t;'),
    ("a thread", "log('\"'); std::thread t; log('\"');"),
    ("a thread", "const int most = 1'000; std::thread t; log('/');"),
    ("a thread", 'log(R"(/*)"); std::thread t;'),
    ("a process", "if (fork() == 0)"),
    ("a process", "QProcess::startDetached(name);"),
)
ASKS_NOTHING = (
    'log("usleep(1), fork(), std::thread t");',
    'log("a \\" fork()"); // std::thread t',
    "/* std::thread t; */ step();",
    'const char *text = R"x(a " std::thread t; )" )x";',
    "void connectTo(QTcpSocket *socket);",
    "connect(socket, &QTcpSocket::connected, this, &Link::begin);",
    "poll();",
    "select(place);",
    "return socket()->error();",
    "link.poll(&frame, &size, limit);",
    "const Time first = time(row);",
    "const QPlcClock clock = master.clock();",
    "const auto number = Host::current().random();",
    "const QUuid name = QUuid::createUuidV5(space, text);",
)


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        for part in (
            "include",
            "src",
            "examples/airborne_wind_energy/plant",
            "examples/airborne_wind_energy/flight_control",
        ):
            shutil.copytree(SOURCE / part, cls.root / part)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def replace(self, path, text):
        """Until the test ends."""
        file = self.root / path
        if file.exists():
            self.addCleanup(file.write_text, file.read_text())
        else:
            self.addCleanup(file.unlink)
        file.write_text(text)

    def plant(self, path, text):
        file = self.root / path
        self.replace(path, (file.read_text() if file.exists() else "") + text)

    def assert_named(self, *words):
        errors = "\n".join(layers.errors_of(self.root))
        for word in words:
            self.assertIn(word, errors)

    def test_the_exit_code_tells(self):
        program = [sys.executable, "-B", layers.__file__, self.root]
        self.assertEqual(subprocess.run(program, capture_output=True).returncode, 0)
        self.plant("src/signals/Fnv1a.h", "#include <sys/socket.h>\n")
        run = subprocess.run(program, capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("a socket", run.stdout)

    def test_transports_may_describe_fields_and_know_no_frame(self):
        self.plant("src/transport/UdpLink.h", '#include "protocol/CyclicFrame.h"\n')
        self.assert_named("src/transport/UdpLink.h:", "which belongs to protocol")

    def test_protocol_may_not_include_node(self):
        self.plant("src/protocol/ControlFrame.h", '#include "node/cycle/MasterCycle.h"\n')
        self.assert_named("src/protocol/ControlFrame.h:", "which belongs to node")

    def test_transport_may_not_include_signals(self):
        self.plant("src/transport/CyclicHub.h", '#include "../signals/ProcessImage.h"\n')
        self.assert_named("src/transport/CyclicHub.h:", "which belongs to signals")

    def test_signals_may_not_include_a_public_header_of_node(self):
        self.plant("src/signals/Fnv1a.h", '#include "QPlcMasterNode.h"\n')
        self.assert_named("src/signals/Fnv1a.h:", "QPlcMasterNode.h")

    def test_a_public_header_obeys_the_arrows_of_its_room(self):
        self.plant("include/QtPlc/QPlcValue.h", '#include "QPlcSlaveNode.h"\n')
        self.assert_named("include/QtPlc/QPlcValue.h:", "QPlcSlaveNode.h")

    def test_realtime_knows_no_qobject(self):
        self.plant("src/realtime/CycleThread.h", "class Worker : public QObject {};\n")
        self.assert_named("src/realtime/CycleThread.h:", "event loop")

    def test_random_numbers_come_from_the_host(self):
        self.plant("src/node/session/ViewerPushes.cpp", "const auto any = QRandomGenerator::global()->generate();\n")
        self.assert_named("src/node/session/ViewerPushes.cpp:", "a random number, ask Host::current() for it")

    def test_whatever_asks_the_machine_is_found(self):
        for what, line in ASKS_THE_MACHINE:
            with self.subTest(line):
                self.assertIn(what, layers.asked_of_machine(f"void step()\n{{\n    {line}\n}}\n"))

    def test_the_line_is_the_one_of_the_file(self):
        text = '#include <QtCore/QThread>\n\n/* a\ncomment */ log(R"(a\n"text//")"); poll(&line, 1,\n     100);\n'
        self.assertEqual([number for number, _ in layers.asked_of_machine(text).values()], [5])

    def test_what_only_looks_like_it_is_none(self):
        for line in ASKS_NOTHING:
            with self.subTest(line):
                self.assertEqual(layers.asked_of_machine(f"void step()\n{{\n    {line}\n}}\n"), {})

    def test_every_room_of_the_product_is_looked_at(self):
        for path in (
            "src/signals/Fnv1a.h",
            "src/realtime/CycleClock.cpp",
            "src/protocol/CyclicFrame.cpp",
            "src/transport/UdpLink.cpp",
            "src/node/cycle/MasterCycle.cpp",
            "src/gui/plant/Plant.cpp",
            "src/gui3d/View3DEditor.cpp",
            "src/hardware/DeviceFiles.cpp",
            "src/tools/EchoCommand.cpp",
            "src/formulas/Formula.cpp",
            "src/replay/NodeReplay.cpp",
            "src/export/Discon.cpp",
            "include/QtPlc/QPlcSlaveNode.h",
        ):
            with self.subTest(path):
                self.plant(path, "std::future<int> later = std::async(compute);\n")
                self.assert_named(f"{path}:", "asks the machine for a thread")

    def test_realtime_has_one_clock(self):
        self.plant("src/realtime/CycleThread.cpp", "const auto now = std::chrono::steady_clock::now();\n")
        self.assert_named("src/realtime/CycleThread.cpp:", "asks the machine for a clock")

    def test_an_excuse_is_for_one_thing(self):
        self.plant("src/hardware/can/CanLogWriter.cpp", "QTcpSocket socket;\n")
        self.assert_named("src/hardware/can/CanLogWriter.cpp:", "asks the machine for a socket")

    def test_a_file_that_asks_nothing_of_the_machine_leaves_the_list(self):
        self.replace("src/realtime/WakeUpProbe.cpp", "// SPDX-License-Identifier: Apache-2.0\n")
        self.assert_named("src/realtime/WakeUpProbe.cpp:", "take it out of OF_MACHINE")

    def test_a_field_of_a_message_has_its_name_in_one_place(self):
        self.plant(
            "src/node/session/ViewerPushes.cpp", 'const QString who = message.text(QStringLiteral("whoever"));\n'
        )
        self.assert_named("src/node/session/ViewerPushes.cpp:", "fields have their names in src/protocol/messages")

    def test_a_window_reads_no_message_by_names(self):
        self.plant(
            "src/gui/window/NewNotice.cpp", 'const bool ok = message.fields().value(QLatin1String("ok")).toBool();\n'
        )
        self.assert_named("src/gui/window/NewNotice.cpp:1:", "fields have their names in src/protocol/messages")

    def test_a_new_command_makes_no_message_by_names(self):
        self.plant(
            "src/tools/NewCommand.cpp",
            'call.ask(QPlcMessage(\n    QPlcMessage::Stop, {{QStringLiteral("how"), how}}));\n',
        )
        self.assert_named("src/tools/NewCommand.cpp:1:", "fields have their names in src/protocol/messages")

    def test_the_tool_writes_json_and_reads_none(self):
        self.plant(
            "src/tools/NewCommand.cpp", 'const QJsonObject rows = document[QStringLiteral("signals")].toObject();\n'
        )
        self.assert_named("src/tools/NewCommand.cpp:1:", "fields have their names in src/protocol/messages")

    def test_the_plant_of_a_window_knows_no_json(self):
        self.plant("src/gui/plant/NewStatus.h", "void take(const QJsonObject &fields);\n")
        self.assert_named("src/gui/plant/NewStatus.h:1:", "fields have their names in src/protocol/messages")

    def test_devices_read_no_message_by_names(self):
        self.plant("src/hardware/NewDriver.cpp", 'const quint64 token = message.hex64(QStringLiteral("token"));\n')
        self.assert_named("src/hardware/NewDriver.cpp:1:", "fields have their names in src/protocol/messages")

    def test_a_panel_knows_the_window_by_its_context_alone(self):
        self.plant("src/gui3d/View3DEditor.cpp", '#include "gui/panel/WindowContext.h"\n')
        self.assert_named("src/gui3d/View3DEditor.cpp:", "a panel knows the window by QPlcPanelContext alone")

    def test_a_panel_knows_no_plant_of_the_window(self):
        self.plant("src/gui/gauges/GaugeFeed.cpp", '#include "gui/plant/Plant.h"\n')
        self.assert_named("src/gui/gauges/GaugeFeed.cpp:", "which belongs to gui/plant")

    def test_an_example_knows_public_headers_alone(self):
        self.plant("examples/airborne_wind_energy/plant/Wind.h", '#include "gui/plant/Plant.h"\n')
        self.assert_named("examples/airborne_wind_energy/plant/Wind.h:", "an example knows the public headers alone")

    def test_signals_know_no_socket(self):
        self.plant("src/signals/Fnv1a.h", "#include <sys/socket.h>\n")
        self.assert_named("src/signals/Fnv1a.h:", "a socket")

    def test_only_realtime_reads_clocks(self):
        self.plant("src/node/cycle/NodeSlot.h", "inline auto now() { return std::chrono::steady_clock::now(); }\n")
        self.assert_named("src/node/cycle/NodeSlot.h:", "a clock")

    def test_a_word_in_a_comment_is_no_fault(self):
        self.plant("src/node/cycle/NodeSlot.h", "// not steady_clock\n")
        self.assertEqual(layers.errors_of(self.root), [])

    def test_the_plant_knows_no_qt(self):
        self.plant("examples/airborne_wind_energy/plant/Plant.h", "#include <QtCore/QString>\n")
        self.assert_named("plant/Plant.h:", "may not know Qt")

    def test_a_public_header_has_one_class_and_is_listed(self):
        self.plant(
            "include/QtPlc/QPlcNews.h",
            "// SPDX-License-Identifier: Apache-2.0\nclass QPlcOther\n{\n};\nclass QPlcNews\n{\n};\n",
        )
        self.assert_named(
            "QPlcNews.h:1: defines QPlcOther, QPlcNews",
            "missing in the list of headers",
            "missing in the umbrella header",
        )

    def test_a_public_class_needs_a_comment(self):
        header = "include/QtPlc/QPlcCycle.h"
        lines = (self.root / header).read_text().split("\n")
        self.replace(header, "\n".join(line for line in lines if not line.startswith("///")))
        self.assert_named("QPlcCycle has no comment")

    def test_a_function_has_at_most_80_lines(self):
        self.plant("src/node/cycle/NodeSlot.cpp", "\nvoid tooLong()\n{\n" + "    step();\n" * 78 + "}\n")
        self.assert_named("src/node/cycle/NodeSlot.cpp:", "a function of 81 lines")

    def test_a_table_may_be_longer(self):
        self.plant(
            "src/node/cycle/NodeSlot.cpp",
            "\nint table()\n{\n    static const int rows[] = {\n" + "        1,\n" * 90 + "    };\n}\n",
        )
        self.assertEqual(layers.errors_of(self.root), [])

    def test_one_function_of_a_hundred_may_have_40_lines(self):
        self.plant("src/node/cycle/NodeSlot.cpp", ("\nvoid long_()\n{\n" + "    step();\n" * 47 + "}\n") * 120)
        self.assert_named("src/node/cycle/NodeSlot.cpp:", "one function of a hundred has")

    def test_a_room_of_the_node_has_its_own_arrows(self):
        self.plant("src/node/state/StateText.cpp", '#include "node/session/Leases.h"\n')
        self.assert_named(
            "src/node/state/StateText.cpp:",
            "node/state may not include node/session/Leases.h, which belongs to node/session",
        )

    def test_the_private_class_of_the_master_only_wires(self):
        header = "src/node/api/QPlcMasterNodePrivate.h"
        more = "class Requests;\n\n    bool isNew() const;\n    void doMore(int times = 1);\n"
        self.replace(header, (self.root / header).read_text().replace("class Requests;\n", more))
        self.assert_named(f"{header}:1: has 27 functions, more than 25")

    def test_a_file_begins_with_its_licence(self):
        self.plant("src/node/News.h", "#pragma once\n")
        self.assert_named("src/node/News.h:1:", "SPDX-License-Identifier")


if __name__ == "__main__":
    unittest.main()
