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


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        for part in ("include", "src", "examples/airborne_wind_energy/plant", "examples/airborne_wind_energy/flight_control"):
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

    def test_comments_and_code_are_wrapped(self):
        self.plant("include/QtPlc/QPlcValue.h", f"// {'long ' * 20}\n")
        self.assert_named("include/QtPlc/QPlcValue.h:", "103 columns: wrap comments at 100")
        self.plant("src/signals/Fnv1a.h", f"int a; // {'long ' * 24}\n")
        self.assert_named("src/signals/Fnv1a.h:", "130 columns")

    def test_code_of_a_public_header_is_wrapped(self):
        self.plant("include/QtPlc/QPlcValue.h", f"constexpr int long{'er' * 60} = 1;\n")
        self.assert_named("include/QtPlc/QPlcValue.h:", "and code at 120")

    def test_realtime_knows_no_qobject(self):
        self.plant("src/realtime/CycleThread.h", "class Worker : public QObject {};\n")
        self.assert_named("src/realtime/CycleThread.h:", "event loop")

    def test_random_numbers_come_from_the_host(self):
        self.plant("src/node/session/ViewerPushes.cpp", "const auto any = QRandomGenerator::global()->generate();\n")
        self.assert_named("src/node/session/ViewerPushes.cpp:", "ask Host::current() for it")

    def test_a_file_that_asks_nothing_of_the_machine_leaves_the_list(self):
        self.replace("src/realtime/WakeUpProbe.cpp", "// SPDX-License-Identifier: Apache-2.0\n")
        self.assert_named("src/realtime/WakeUpProbe.cpp:", "take it out of OF_MACHINE")

    def test_a_field_of_a_message_has_its_name_in_one_place(self):
        self.plant("src/node/session/ViewerPushes.cpp", 'const QString who = message.text(QStringLiteral("whoever"));\n')
        self.assert_named("src/node/session/ViewerPushes.cpp:", "fields have their names in src/protocol/messages")

    def test_a_window_reads_no_message_by_names(self):
        self.plant("src/gui/window/NewNotice.cpp", 'const bool ok = message.fields().value(QLatin1String("ok")).toBool();\n')
        self.assert_named("src/gui/window/NewNotice.cpp:1:", "fields have their names in src/protocol/messages")

    def test_a_new_command_makes_no_message_by_names(self):
        self.plant("src/tools/NewCommand.cpp", 'call.ask(QPlcMessage(\n    QPlcMessage::Stop, {{QStringLiteral("how"), how}}));\n')
        self.assert_named("src/tools/NewCommand.cpp:1:", "fields have their names in src/protocol/messages")

    def test_the_tool_writes_json_and_reads_none(self):
        self.plant("src/tools/NewCommand.cpp", 'const QJsonObject rows = document[QStringLiteral("signals")].toObject();\n')
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
        self.plant("include/QtPlc/QPlcNews.h", "// SPDX-License-Identifier: Apache-2.0\nclass QPlcOther\n{\n};\nclass QPlcNews\n{\n};\n")
        self.assert_named("QPlcNews.h:1: defines QPlcOther, QPlcNews", "missing in the list of headers", "missing in the umbrella header")

    def test_a_public_class_needs_a_comment(self):
        header = "include/QtPlc/QPlcCycle.h"
        lines = (self.root / header).read_text().split("\n")
        self.replace(header, "\n".join(line for line in lines if not line.startswith("///")))
        self.assert_named("QPlcCycle has no comment")

    def test_a_function_has_at_most_80_lines(self):
        self.plant("src/node/cycle/NodeSlot.cpp", "\nvoid tooLong()\n{\n" + "    step();\n" * 78 + "}\n")
        self.assert_named("src/node/cycle/NodeSlot.cpp:", "a function of 81 lines")

    def test_a_table_may_be_longer(self):
        self.plant("src/node/cycle/NodeSlot.cpp", "\nint table()\n{\n    static const int rows[] = {\n" + "        1,\n" * 90 + "    };\n}\n")
        self.assertEqual(layers.errors_of(self.root), [])

    def test_one_function_of_a_hundred_may_have_40_lines(self):
        self.plant("src/node/cycle/NodeSlot.cpp", ("\nvoid long_()\n{\n" + "    step();\n" * 47 + "}\n") * 60)
        self.assert_named("src/node/cycle/NodeSlot.cpp:", "one function of a hundred has")

    def test_a_room_of_the_node_has_its_own_arrows(self):
        self.plant("src/node/state/StateText.cpp", '#include "node/session/Leases.h"\n')
        self.assert_named("src/node/state/StateText.cpp:", "node/state may not include node/session/Leases.h, which belongs to node/session")

    def test_a_file_begins_with_its_licence(self):
        self.plant("src/node/News.h", "#pragma once\n")
        self.assert_named("src/node/News.h:1:", "SPDX-License-Identifier")


if __name__ == "__main__":
    unittest.main()
