// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace messages = qplc::messages;

int showLeases(const CommandCall &call)
{
    messages::Leases answer;
    if (!call.connect() || !call.askFor(messages::GetLeases(), &answer))
        return call.exitCode();
    if (call.isJson()) {
        printJson(call.client.lastAnswer());
        return QPlcCoreApplication::Success;
    }
    if (answer.leases.empty()) {
        printLine(QStringLiteral("no leases"));
        return QPlcCoreApplication::Success;
    }
    TextTable table;
    for (const char *title : {"signal", "holder", "lease"})
        table.addColumn(QString::fromLatin1(title));
    table.addColumn(QStringLiteral("timeout [s]"), Right);
    for (const messages::LeaseEntry &lease : answer.leases) {
        table.addRow({lease.signal, lease.holder, QString::fromLatin1(messages::nameOf(lease.lease)),
                      QString::number(double(lease.timeout.count()) * 1e-9)});
        table.setTone(2, lease.lease == messages::LeaseState::Lost ? Tone::Bad : Tone::Plain);
    }
    table.print();
    return QPlcCoreApplication::Success;
}

}  // namespace tools
