// SPDX-License-Identifier: Apache-2.0
// init, start, stop: what brings a plant from one state to the next.
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace {

int command(const CommandCall &call, const QPlcMessage &request, const QString &done)
{
    if (!call.client.ask(request))
        return reportFailure(call.client);
    printLine(done);
    return QPlcCoreApplication::Success;
}

}  // namespace

int initializeStates(const CommandCall &call)
{
    return command(call, QPlcMessage(QPlcMessage::InitializeAllStates), QStringLiteral("initialized"));
}

int startRealTime(const CommandCall &call)
{
    if (!call.application.isSet(QStringLiteral("cycles")))
        return command(call, QPlcMessage(QPlcMessage::StartRealTime), QStringLiteral("started"));
    constexpr qint64 mostCycles = 1'000'000'000'000;
    qint64 cycles = 0;
    if (!call.application.integer(QStringLiteral("cycles"), 1, mostCycles, &cycles))
        return call.application.exitCode();
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
