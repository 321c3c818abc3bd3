// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>

namespace tools {

int showLeases(const CommandCall &call)
{
    QPlcMessage answer;
    if (!call.connect() || !call.askFor(QPlcMessage::GetLeases, QPlcMessage::Leases, {}, &answer))
        return call.exitCode();
    if (call.isJson()) {
        printJson(QJsonDocument(answer.fields()));
        return QPlcCoreApplication::Success;
    }
    const QJsonArray leases = answer.fields().value(QStringLiteral("leases")).toArray();
    if (leases.isEmpty()) {
        printLine(QStringLiteral("no leases"));
        return QPlcCoreApplication::Success;
    }
    TextTable table;
    for (const char *title : {"signal", "holder", "lease"})
        table.addColumn(QString::fromLatin1(title));
    table.addColumn(QStringLiteral("timeout [s]"), Right);
    for (const QJsonValue &lease : leases) {
        table.addRow({lease[QStringLiteral("signal")].toString(), lease[QStringLiteral("holder")].toString(),
                      lease[QStringLiteral("lease")].toString(),
                      QString::number(lease[QStringLiteral("timeout")].toDouble() * 1e-9)});
        table.setTone(2, lease[QStringLiteral("lease")].toString() == QLatin1String("lost") ? Tone::Bad : Tone::Plain);
    }
    table.print();
    return QPlcCoreApplication::Success;
}

}  // namespace tools
