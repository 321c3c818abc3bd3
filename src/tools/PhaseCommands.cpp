// SPDX-License-Identifier: Apache-2.0
// init, start, stop: what brings a plant from one state to the next.
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace {

/// Asks for something that is done or not.
int command(const CommandCall &call, const QPlcMessage &request, const QString &done)
{
    if (!call.connect() || !call.ask(request))
        return call.exitCode();
    if (call.isJson()) {
        QJsonObject document = request.fields();
        document.insert(QStringLiteral("done"), request.kindName());
        printJson(QJsonDocument(document));
    } else {
        printLine(done);
    }
    return QPlcCoreApplication::Success;
}

}  // namespace

int initializeStates(const CommandCall &call)
{
    return command(call, QPlcMessage(QPlcMessage::InitializeAllStates), QStringLiteral("initialized"));
}

int startRealTime(const CommandCall &call)
{
    constexpr qint64 mostCycles = 1'000'000'000'000;
    qint64 cycles = 0;
    if (!call.readInteger("cycles", 1, mostCycles, &cycles))
        return call.exitCode();
    if (cycles == 0)
        return command(call, QPlcMessage(QPlcMessage::StartRealTime), QStringLiteral("started"));
    return command(call, QPlcMessage(QPlcMessage::StartRealTime, {{QStringLiteral("cycles"), cycles}}),
                   QStringLiteral("started for %1 %2")
                       .arg(cycles)
                       .arg(cycles == 1 ? QStringLiteral("cycle") : QStringLiteral("cycles")));
}

int stopRealTime(const CommandCall &call)
{
    return command(call, QPlcMessage(QPlcMessage::Stop), QStringLiteral("stopped"));
}

}  // namespace tools
