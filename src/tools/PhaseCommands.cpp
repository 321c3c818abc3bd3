// SPDX-License-Identifier: Apache-2.0
// init, arm, start, stop, safestop, reset: what brings a plant from one state to the next.
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

int armMaster(const CommandCall &call)
{
    QPlcMessage armed;
    if (!call.connect() || !call.askFor(QPlcMessage::Arm, QPlcMessage::Armed, {}, &armed))
        return call.exitCode();
    if (call.isJson())
        printJson(QJsonDocument(armed.fields()));
    else
        printLine(QStringLiteral("armed for %1 s; token %2")
                      .arg(armed.fields().value(QStringLiteral("validFor")).toDouble() * 1e-9)
                      .arg(armed.text(QStringLiteral("token"))));
    return QPlcCoreApplication::Success;
}

int resetMaster(const CommandCall &call)
{
    return command(call, QPlcMessage(QPlcMessage::Reset), QStringLiteral("reset"));
}

int stopSafely(const CommandCall &call)
{
    const QString reason = call.arguments.join(QLatin1Char(' '));
    const QJsonObject fields = reason.isEmpty() ? QJsonObject() : QJsonObject{{QStringLiteral("reason"), reason}};
    return command(call, QPlcMessage(QPlcMessage::SafeStop, fields), QStringLiteral("stopped safely"));
}

namespace {

/// The token of a start, where the master requires one. \return false, with the message out
bool armIfRequired(const CommandCall &call, QString *token)
{
    QPlcMessage state;
    QPlcMessage armed;
    if (!call.connect() || !call.ask(QPlcMessage(QPlcMessage::GetState), &state))
        return false;
    if (!state.fields().value(QStringLiteral("armingRequired")).toBool())
        return true;
    if (state.text(QStringLiteral("state")) == QLatin1String("Off")
        && !call.ask(QPlcMessage(QPlcMessage::InitializeAllStates)))
        return false;  // a start would have done it, but permits are given in Ready
    if (!call.askFor(QPlcMessage::Arm, QPlcMessage::Armed, {}, &armed))
        return false;
    *token = armed.text(QStringLiteral("token"));
    return true;
}

}  // namespace

int startRealTime(const CommandCall &call)
{
    constexpr qint64 mostCycles = 1'000'000'000'000;
    qint64 cycles = 0;
    QString token = call.application.value(QStringLiteral("token"));
    if (!call.readInteger("cycles", 1, mostCycles, &cycles))
        return call.exitCode();
    if (token.isEmpty() ? !armIfRequired(call, &token) : !call.connect())
        return call.exitCode();
    QJsonObject fields;
    QJsonObject document{{QStringLiteral("done"), QStringLiteral("StartRealTime")}};
    if (!token.isEmpty())
        fields.insert(QStringLiteral("token"), token);
    if (cycles > 0) {
        fields.insert(QStringLiteral("cycles"), cycles);
        document.insert(QStringLiteral("cycles"), cycles);
    }
    if (!call.ask(QPlcMessage(QPlcMessage::StartRealTime, fields)))
        return call.exitCode();
    if (call.isJson())
        printJson(QJsonDocument(document));
    else if (cycles == 0)
        printLine(QStringLiteral("started"));
    else
        printLine(QStringLiteral("started for %1 %2")
                      .arg(cycles)
                      .arg(cycles == 1 ? QStringLiteral("cycle") : QStringLiteral("cycles")));
    return QPlcCoreApplication::Success;
}

int stopRealTime(const CommandCall &call)
{
    return command(call, QPlcMessage(QPlcMessage::Stop), QStringLiteral("stopped"));
}

}  // namespace tools
